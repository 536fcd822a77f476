/*
 * wearlaw_point_loop.h: the second half of wearlaw_point.h, which includes it: batch loop, table and entry.
 *
 * Scalars are read at unit step: where the host's column has another step, a block of it is laid out in a buffer
 * first, so that one loop serves uniform and strided fields and the compiler vectorises it.
 *
 * SPDX-License-Identifier: MIT OR Apache-2.0
 */

#if !defined(WEARLAW_POINT_H)
#include "wearlaw_point.h" /* which includes this file in its place */
#elif !defined(WEARLAW_POINT_LOOP_H)
#define WEARLAW_POINT_LOOP_H

#define WL_BLOCK 256

#define WL_COLUMN_SCALAR(f) wl_column f;
#define WL_COLUMN_VECTOR(f) wl_column f;
#define WL_COLUMN_INDEX(f) wl_index_column f;
#define WL_COLUMN(f) WL_BY_KIND(WL_COLUMN_, f)
#define WL_COLUMN_QUANTITY(name, unit, bounds, preset, summary) wl_column name;
typedef struct wl_point_columns {
    LAW_READS(WL_COLUMN) LAW_USES(WL_COLUMN) LAW_INPUTS(WL_COLUMN_QUANTITY)
    wl_column wl_state;
} wl_point_columns;

static const double wl_absent_real[3] = {NAN, NAN, NAN};
static const int64_t wl_absent_index = -1;

/* Loads of point i: at any step, and within a block whose scalars are at unit step. */
#define WL_GET_SCALAR(f) in.f = k->f.ptr[i * k->f.step];
#define WL_GET_VECTOR(f)                                                                                               \
    in.f[0] = k->f.ptr[i * k->f.step];                                                                                 \
    in.f[1] = k->f.ptr[i * k->f.step + 1];                                                                             \
    in.f[2] = k->f.ptr[i * k->f.step + 2];
#define WL_GET_INDEX(f) in.f = k->f.ptr[i * k->f.step];
#define WL_GET(f) WL_BY_KIND(WL_GET_, f)
#define WL_GET_QUANTITY(name, unit, bounds, preset, summary) in.name = k->name.ptr[i * k->name.step];
#define WL_UNIT_SCALAR(f) in.f = k->f.ptr[i];
#define WL_UNIT_VECTOR(f) WL_GET_VECTOR(f)
#define WL_UNIT_INDEX(f) WL_GET_INDEX(f)
#define WL_UNIT(f) WL_BY_KIND(WL_UNIT_, f)
#define WL_UNIT_QUANTITY(name, unit, bounds, preset, summary) in.name = k->name.ptr[i];
#define WL_GET_CONSTANT(name, unit, bounds, preset, summary)                                                           \
    c.name = constants[WL_CONSTANT_##name].ptr[i * constants[WL_CONSTANT_##name].step];
#define WL_GET_STATE(name, unit, bounds, preset, summary)                                                              \
    s.name = k->wl_state.ptr[i * k->wl_state.step + WL_STATE_##name];
#define WL_UNIT_STATE(name, unit, bounds, preset, summary)                                                             \
    s.name = k->wl_state.ptr[i * WL_STATE_COUNT + WL_STATE_##name];
#define WL_PUT_STATE(name, unit, bounds, preset, summary)                                                              \
    end[i * WL_STATE_COUNT + WL_STATE_##name] = out.state.name;
#if (LAW_WRITES) & WL_OUT_DIRECTION
#define WL_PRESET_DIRECTION                                                                                            \
    out.direction[0] = -in.normal[0];                                                                                  \
    out.direction[1] = -in.normal[1];                                                                                  \
    out.direction[2] = -in.normal[2];
#define WL_PUT_DIRECTION                                                                                               \
    direction[3 * i] = out.direction[0];                                                                               \
    direction[3 * i + 1] = out.direction[1];                                                                           \
    direction[3 * i + 2] = out.direction[2];
#else
#define WL_PRESET_DIRECTION
#define WL_PUT_DIRECTION
#endif

/* m points whose scalars and state are at unit step and whose constants are uniform; answers 0 if all are WL_OK. */
WL_INLINE int32_t wl_point_block(const wl_point_columns *k WL_UNUSED, wl_point_in in,
                                 const wl_point_constants c, int64_t m,
                                 double *WL_RESTRICT increment, double *WL_RESTRICT slope WL_UNUSED,
                                 double *WL_RESTRICT direction WL_UNUSED, double *WL_RESTRICT end WL_UNUSED) {
    int32_t worst = 0;
    WL_NO_OVERLAP
    for (int64_t i = 0; i < m; ++i) {
        wl_point_state s = {0};
        wl_point_out out = {0};
        LAW_READS(WL_UNIT) LAW_USES(WL_UNIT) LAW_INPUTS(WL_UNIT_QUANTITY) LAW_STATE(WL_UNIT_STATE)
        out.state = s;
        WL_PRESET_DIRECTION
        worst |= wl_point(&in, &c, &s, &out);
        increment[i] = out.increment;
#if (LAW_WRITES) & WL_OUT_D_PRESSURE
        if (slope) {
            slope[i] = out.d_pressure;
        }
#endif
        WL_PUT_DIRECTION
        LAW_STATE(WL_PUT_STATE)
    }
    return worst;
}

/* One point at any step; a text is wanted if `text` is given. An unknown status counts as WL_FAILED. */
WL_INLINE int32_t wl_point_one(const wl_point_columns *k, const wl_column *constants WL_UNUSED, wl_point_in in,
                               int64_t i WL_UNUSED, char *text, int64_t text_size, wl_point_out *answer) {
    int32_t status;
    wl_point_constants c = {0};
    wl_point_state s = {0};
    wl_point_out out = {0};
    LAW_READS(WL_GET) LAW_USES(WL_GET) LAW_INPUTS(WL_GET_QUANTITY)
    LAW_CONSTANTS(WL_GET_CONSTANT) LAW_STATE(WL_GET_STATE)
    out.state = s;
    out.dt_factor = 0.5;
    WL_PRESET_DIRECTION
    out.wl_text = text;
    out.wl_text_size = (size_t)text_size;
    status = wl_point(&in, &c, &s, &out);
    *answer = out;
    (void)k;
    return status < WL_OK || status > WL_FAILED ? WL_FAILED : status;
}

/* All points at any step, with statuses. */
static int32_t wl_point_general(const wl_point_columns *k, const wl_column *constants, wl_point_in in, int64_t points,
                                const wl_output *o, int64_t *first_bad, double *dt_factor) {
    double *increment = o->increment;
    double *direction WL_UNUSED = o->direction, *end WL_UNUSED = o->state;
    int32_t worst = WL_OK;
    wl_point_out out;
    for (int64_t i = 0; i < points; ++i) {
        int32_t status = wl_point_one(k, constants, in, i, NULL, 0, &out);
        increment[i] = out.increment;
#if (LAW_WRITES) & WL_OUT_D_PRESSURE
        if (o->d_pressure) {
            o->d_pressure[i] = out.d_pressure;
        }
#endif
        if (direction) {
            WL_PUT_DIRECTION
        }
        if (end) {
            LAW_STATE(WL_PUT_STATE)
        }
        if (o->status) {
            o->status[i] = status;
        }
        if (status == WL_CUT_STEP && (*dt_factor == 0 || out.dt_factor < *dt_factor)) {
            *dt_factor = out.dt_factor;
        }
        if (status > worst) {
            worst = status;
            *first_bad = i;
        }
    }
    if (worst != WL_OK && o->text && o->text_size > 0) { /* once more, for its text */
        o->text[0] = '\0';
        (void)wl_point_one(k, constants, in, *first_bad, o->text, o->text_size, &out);
    }
    return worst;
}

static inline const double *wl_point_spread(const wl_column *q, int64_t at, int64_t m, double *buffer) {
    if (q->step == 1) {
        return q->ptr + at;
    }
    if (q->step == 0) {
        double value = q->ptr[0];
        for (int64_t j = 0; at == 0 && j < m; ++j) {
            buffer[j] = value;
        }
    } else {
        for (int64_t j = 0; j < m; ++j) {
            buffer[j] = q->ptr[(at + j) * q->step];
        }
    }
    return buffer;
}

#define WL_SPREAD_SCALAR(f) b.f.ptr = wl_point_spread(&k->f, at, m, buffer[WL_SLOT_##f]);
#define WL_SPREAD_VECTOR(f) b.f.ptr = k->f.ptr + at * k->f.step;
#define WL_SPREAD_INDEX(f) b.f.ptr = k->f.ptr + at * k->f.step;
#define WL_SPREAD(f) WL_BY_KIND(WL_SPREAD_, f)
#define WL_SPREAD_QUANTITY(name, unit, bounds, preset, summary)                                                        \
    b.name.ptr = wl_point_spread(&k->name, at, m, buffer[WL_SLOT_##name]);
#define WL_STEP_SCALAR(f) &&k->f.step == 1
#define WL_STEP_VECTOR(f)
#define WL_STEP_INDEX(f)
#define WL_STEP(f) WL_BY_KIND(WL_STEP_, f)
#define WL_STEP_QUANTITY(name, unit, bounds, preset, summary) &&k->name.step == 1

/* All points, block by block; one block if every column has unit step. */
static int32_t wl_point_blocks(const wl_point_columns *k, const wl_point_constants *c, const wl_point_in *in,
                               int64_t points, const wl_output *o) {
    double buffer[WL_SLOT_COUNT + 1][WL_BLOCK];
    int64_t most = 1 LAW_READS(WL_STEP) LAW_USES(WL_STEP) LAW_INPUTS(WL_STEP_QUANTITY) ? points : WL_BLOCK;
    int32_t worst = 0;
    wl_point_columns b = *k;
    (void)buffer;
    for (int64_t at = 0; at < points; at += most) {
        int64_t m = points - at < most ? points - at : most;
        double *direction = o->direction ? o->direction + 3 * at : NULL;
        double *end = o->state ? o->state + WL_STATE_COUNT * at : NULL;
        LAW_READS(WL_SPREAD) LAW_USES(WL_SPREAD) LAW_INPUTS(WL_SPREAD_QUANTITY)
        b.wl_state.ptr = WL_STATE_COUNT ? k->wl_state.ptr + WL_STATE_COUNT * at : NULL;
#if (LAW_WRITES) & WL_OUT_D_PRESSURE
        if (o->d_pressure) {
            worst |= wl_point_block(&b, *in, *c, m, o->increment + at, o->d_pressure + at, direction, end);
            continue;
        }
#endif
        worst |= wl_point_block(&b, *in, *c, m, o->increment + at, NULL, direction, end);
    }
    return worst;
}

/* ---- The functions of the law's table. ---- */

static void wl_copy_text(char *to, size_t size, const char *from) { (void)snprintf(to, size, "%s", from); }

#define WL_OPEN_READ(f)                                                                                                \
    k.f = v->f;                                                                                                        \
    missing |= k.f.ptr ? 0 : WL_BIT_##f;
#define WL_ABSENT_SCALAR(f) k.f.ptr = wl_absent_real
#define WL_ABSENT_VECTOR(f) k.f.ptr = wl_absent_real
#define WL_ABSENT_INDEX(f) k.f.ptr = &wl_absent_index
#define WL_OPEN_USE(f)                                                                                                 \
    k.f = v->f;                                                                                                        \
    if (k.f.ptr) {                                                                                                     \
        in.has |= WL_BIT_##f;                                                                                          \
    } else {                                                                                                           \
        WL_BY_KIND(WL_ABSENT_, f);                                                                                     \
        k.f.step = 0;                                                                                                  \
    }
#define WL_OPEN_INPUT(name, unit, bounds, preset, summary)                                                             \
    k.name = v->inputs[WL_INPUT_##name];                                                                               \
    void_input = k.name.ptr ? void_input : #name;
#define WL_OPEN_CONSTANT(name, unit, bounds, preset, summary)                                                          \
    void_input = v->constants[WL_CONSTANT_##name].ptr ? void_input : #name;                                            \
    uniform &= v->constants[WL_CONSTANT_##name].step == 0;                                                             \
    c.name = v->constants[WL_CONSTANT_##name].ptr ? *v->constants[WL_CONSTANT_##name].ptr : 0;
#define WL_NAME_MISSING(f) (missing & WL_BIT_##f) ? #f:
#define WL_COVERS(p, type, field)                                                                                      \
    ((p)->struct_size >= (int64_t)(offsetof(type, field) + sizeof(((const type *)0)->field)))

static int32_t wl_point_refuse(wl_output *output, const wl_output *o, int32_t status, int64_t missing,
                               const char *what, const char *name) {
    if (WL_COVERS(output, wl_output, missing)) {
        output->missing = missing;
    }
    if (o->text && o->text_size > 0) {
        (void)snprintf(o->text, (size_t)o->text_size, "%s%s", what, name);
    }
    return status;
}

static int32_t wl_point_evaluate(void *instance, const wl_view *view, wl_output *output) {
    wl_view short_view;
    wl_output short_output;
    const wl_view *v = view;
    const wl_output *o = output;
    const char *void_input = NULL;
    int64_t missing = 0, first_bad = -1;
    int uniform = 1;
    int32_t worst;
    double dt_factor = 0;
    wl_point_columns k;
    wl_point_constants c = {0};
    wl_point_in in;
    if (view->struct_size < (int64_t)sizeof(wl_view)) { /* an older host: what it does not have is absent */
        memset(&short_view, 0, sizeof short_view);
        memcpy(&short_view, view, (size_t)view->struct_size);
        v = &short_view;
    }
    if (output->struct_size < (int64_t)sizeof(wl_output)) {
        memset(&short_output, 0, sizeof short_output);
        memcpy(&short_output, output, (size_t)output->struct_size);
        o = &short_output;
    }
    if (v->points <= 0) {
        return WL_OK;
    }
    if (!o->increment || v->constant_count < WL_CONSTANT_COUNT || (WL_CONSTANT_COUNT > 0 && !v->constants) ||
        v->input_count < WL_INPUT_COUNT || (WL_INPUT_COUNT > 0 && !v->inputs) || v->state_count < WL_STATE_COUNT ||
        (WL_STATE_COUNT > 0 && !v->state.ptr)) {
        return wl_point_refuse(output, o, WL_FAILED, 0, "the host gave fewer columns than " LAW_NAME " declares", "");
    }
    memset(&in, 0, sizeof in);
    in.dt = v->dt;
    in.time = v->time;
    in.call = v;
    in.instance = instance;
    LAW_READS(WL_OPEN_READ) LAW_USES(WL_OPEN_USE) LAW_INPUTS(WL_OPEN_INPUT) LAW_CONSTANTS(WL_OPEN_CONSTANT)
    k.wl_state = v->state;
    if (missing != 0) {
        void_input = LAW_READS(WL_NAME_MISSING) "";
    }
    if (void_input) {
        return wl_point_refuse(output, o, WL_MISSING_INPUT, missing, "not given: ", void_input);
    }
    if (uniform && !o->status && (!WL_STATE_COUNT || (o->state && k.wl_state.step == WL_STATE_COUNT)) &&
        (o->direction || !((LAW_WRITES) & WL_OUT_DIRECTION)) && wl_point_blocks(&k, &c, &in, v->points, o) == WL_OK) {
        return WL_OK;
    }
    worst = wl_point_general(&k, v->constants, in, v->points, o, &first_bad, &dt_factor);
    if (WL_COVERS(output, wl_output, dt_factor)) {
        output->first_bad = first_bad;
        output->dt_factor = dt_factor;
    }
    return worst;
}

static void wl_describe_one(wl_quantity *quantity, const char *name, const char *summary, const double *unit,
                            double minimum, double maximum, int64_t flags, double preset) {
    wl_quantity full;
    int64_t size = quantity->struct_size;
    memset(&full, 0, sizeof full);
    full.struct_size = size;
    wl_copy_text(full.name, sizeof full.name, name);
    wl_copy_text(full.summary, sizeof full.summary, summary);
    full.metre = unit[0];
    full.kilogram = unit[1];
    full.second = unit[2];
    full.kelvin = unit[3];
    full.minimum = minimum;
    full.maximum = maximum;
    full.default_value = preset;
    full.flags = flags;
    memcpy(quantity, &full, size < (int64_t)sizeof full ? (size_t)size : sizeof full);
}

typedef struct wl_described {
    int32_t kind;
    int64_t index;
    const char *name, *summary;
    double unit[4], minimum, maximum;
    int64_t flags;
    double preset;
} wl_described;

#define WL_ROW_CONSTANT(name, unit, bounds, preset, summary)                                                           \
    {WL_KIND_CONSTANT, WL_CONSTANT_##name, #name, summary, {unit}, bounds, preset},
#define WL_ROW_STATE(name, unit, bounds, preset, summary)                                                              \
    {WL_KIND_STATE, WL_STATE_##name, #name, summary, {unit}, bounds, preset},
#define WL_ROW_INPUT(name, unit, bounds, preset, summary)                                                              \
    {WL_KIND_INPUT, WL_INPUT_##name, #name, summary, {unit}, bounds, preset},
#define WL_ROW_FIELD(f) {WL_KIND_FIELD, WL_BIT_##f, #f, "", {WL_NUMBER}, WL_ANY, NAN},

static int32_t wl_point_describe(int32_t kind, int64_t index, wl_quantity *quantity) {
    static const wl_described rows[] = {
        LAW_CONSTANTS(WL_ROW_CONSTANT) LAW_STATE(WL_ROW_STATE) LAW_INPUTS(WL_ROW_INPUT)
        LAW_READS(WL_ROW_FIELD) LAW_USES(WL_ROW_FIELD){-1, -1, "", "", {WL_NUMBER}, WL_ANY, NAN}};
    if (kind == WL_KIND_FIELD) { /* asked by the number of the bit, kept by its value */
        index = index >= 0 && index < 63 ? (int64_t)1 << index : -2;
    }
    for (const wl_described *r = rows; r->kind >= 0; ++r) {
        if (r->kind == kind && r->index == index) {
            wl_describe_one(quantity, r->name, r->summary, r->unit, r->minimum, r->maximum, r->flags, r->preset);
            return WL_OK;
        }
    }
    return WL_NO_MORE;
}

#ifdef LAW_CREATE
static int32_t LAW_CREATE(const wl_host *host, const char *options, void **instance, char *text, int64_t text_size);
#endif
#ifdef LAW_DESTROY
static void LAW_DESTROY(void *instance);
#endif

static int32_t wl_point_fill(wl_law *law) {
    wl_law full;
    if (law->struct_size < (char *)(&full.extension + 1) - (char *)&full) { /* less than the 1.0 table */
        return WL_FAILED;
    }
    memset(&full, 0, sizeof full);
    full.struct_size = law->struct_size;
    full.abi_minor = WL_ABI_MINOR;
    wl_copy_text(full.name, sizeof full.name, LAW_NAME);
    wl_copy_text(full.version, sizeof full.version, LAW_VERSION);
    wl_copy_text(full.summary, sizeof full.summary, LAW_SUMMARY);
    wl_copy_text(full.source, sizeof full.source, LAW_SOURCE);
    full.reads = WL_LAW_READS;
    full.uses = WL_LAW_USES;
    full.writes = WL_LAW_WRITES;
    full.claims = LAW_CLAIMS;
    full.flags = LAW_FLAGS;
    full.constant_count = WL_CONSTANT_COUNT;
    full.state_count = WL_STATE_COUNT;
    full.input_count = WL_INPUT_COUNT;
    full.pressure_degree = LAW_PRESSURE_DEGREE;
    full.pressure_degree_constant = -1;
#ifdef LAW_PRESSURE_DEGREE_CONSTANT
    full.pressure_degree_constant = WL_PASTE(WL_CONSTANT_, LAW_PRESSURE_DEGREE_CONSTANT);
#endif
    full.describe = wl_point_describe;
    full.evaluate = wl_point_evaluate;
#ifdef LAW_CREATE
    full.create = LAW_CREATE;
#endif
#ifdef LAW_DESTROY
    full.destroy = LAW_DESTROY;
#endif
    memcpy(law, &full, law->struct_size < (int64_t)sizeof full ? (size_t)law->struct_size : sizeof full);
    return WL_OK;
}

#ifdef LAW_FILL
int32_t LAW_FILL(wl_law *law);
int32_t LAW_FILL(wl_law *law) { return wl_point_fill(law); }
#else
WL_EXPORT int32_t wearlaw_entry_1(int32_t index, const wl_host *host, wl_law *law) {
    (void)host;
    return index == 0 ? wl_point_fill(law) : WL_NO_MORE;
}
#endif

#endif /* WEARLAW_POINT_LOOP_H */
