/*
 * sound_law.h: a law that keeps every rule, written against the bare ABI, with places where a fault can be put.
 *
 * increment = K / H * max(pressure, 0) * |slip|, direction = -normal, d(increment)/d(pressure) = K / H * |slip|;
 * two state variables: distance grows by |slip|, work by max(pressure, 0) * |slip|.
 *
 * A faulty law defines one of the macros below, includes this file, and differs from the sound law in nothing else:
 * then a tester that finds anything but its own fault is wrong. `sound.c` defines none of them.
 */
#ifndef SOUND_LAW_H
#define SOUND_LAW_H

#ifndef _GNU_SOURCE
#define _GNU_SOURCE
#endif
#include "wearlaw.h"

#include <math.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* What the law says of itself. */
#ifndef LAW_NAME
#define LAW_NAME "sound"
#endif
#ifndef LAW_READS
#define LAW_READS (WL_FIELD_PRESSURE | WL_FIELD_SLIP | WL_FIELD_NORMAL)
#endif
#ifndef LAW_USES
#define LAW_USES 0
#endif
#ifndef LAW_WRITES
#define LAW_WRITES WL_OUTS_KNOWN
#endif
#ifndef LAW_CLAIMS
#define LAW_CLAIMS WL_CLAIMS_KNOWN
#endif
#ifndef LAW_FLAGS
#define LAW_FLAGS 0
#endif
#ifndef LAW_DEGREE
#define LAW_DEGREE 1
#endif
#ifndef LAW_DEGREE_CONSTANT
#define LAW_DEGREE_CONSTANT -1
#endif
#ifndef LAW_H_UNIT
#define LAW_H_UNIT -1, 1, -2, 0
#endif
#ifndef LAW_WORK_UNIT
#define LAW_WORK_UNIT 0, 1, -2, 0
#endif
#ifndef LAW_H_MINIMUM
#define LAW_H_MINIMUM 0
#endif
#ifndef LAW_H_MAXIMUM
#define LAW_H_MAXIMUM INFINITY
#endif
#ifndef LAW_H_DEFAULT
#define LAW_H_DEFAULT 2e9
#endif
#ifndef LAW_K_FLAGS
#define LAW_K_FLAGS 0
#endif
#ifndef LAW_H_NAME
#define LAW_H_NAME "H"
#endif
#ifndef LAW_H_FLAGS
#define LAW_H_FLAGS WL_QUANTITY_ABOVE_MINIMUM
#endif

/* Statements at points of the law's life; the arguments of the function around them are in reach. */
#ifndef AT_LOAD
#define AT_LOAD /* in a constructor of the library */
#endif
#ifndef AT_UNLOAD
#define AT_UNLOAD /* in its destructor */
#endif
#ifndef AT_ENTRY
#define AT_ENTRY /* first in the entry: index, host, law */
#endif
#ifndef AT_CREATE
#define AT_CREATE /* in create, once `own` is made */
#endif
#ifndef AT_DESTROY
#define AT_DESTROY /* in destroy, before `own` is freed */
#endif
#ifndef BEFORE_POINTS
#define BEFORE_POINTS /* in evaluate, before the loop: v (view), o (output), own */
#endif
#ifndef AT_POINT
#define AT_POINT /* in the loop, before anything is written: also i, p (pressure), s (slip), K, H, a (answer) */
#endif
#ifndef AFTER_POINTS
#define AFTER_POINTS /* in evaluate, behind the loop: also worst */
#endif

/* The numbers themselves; p, s, K and H are in reach, p is not negative, nothing is NaN or infinite. */
#ifndef INCREMENT
#define INCREMENT (K / H * p * s)
#endif
#ifndef SLOPE
#define SLOPE (K / H * s)
#endif
#ifndef STRANGE
#define STRANGE(x) (!isfinite(x))
#endif
#ifndef ACCEPTED
#define ACCEPTED (!STRANGE(p) && !STRANGE(s) && !STRANGE(K) && !(K < 0) && !STRANGE(H) && !(H <= 0))
#endif
#define VALUE_AT(column, i) ((column).ptr[(i) * (column).step])
#ifndef SCALAR_AT
#define SCALAR_AT VALUE_AT /* a scalar field */
#endif
#ifndef CONSTANT_AT
#define CONSTANT_AT VALUE_AT
#endif

/* Parts of the law that a fault replaces as a whole. */
#ifndef WRITE_INCREMENT
#define WRITE_INCREMENT o->increment[i] = a.increment;
#endif
#ifndef WRITE_DIRECTION
#define WRITE_DIRECTION                                                                                                \
    for (int k = 0; k < 3; ++k) {                                                                                      \
        o->direction[3 * i + k] = a.direction[k];                                                                      \
    }
#endif
#ifndef WRITE_STATE
#define WRITE_STATE                                                                                                    \
    for (int k = 0; k < 2; ++k) {                                                                                      \
        o->state[2 * i + k] = a.state[k];                                                                              \
    }
#endif
#ifndef WRITE_D_PRESSURE
#define WRITE_D_PRESSURE o->d_pressure[i] = a.slope;
#endif
#ifndef WRITE_STATUS
#define WRITE_STATUS o->status[i] = status;
#endif
#ifndef SAY
#define SAY(to, size, what) say(to, size, what)
#endif
#ifndef SAY_IN_CREATE
#define SAY_IN_CREATE SAY
#endif
#ifndef VIEW_OF
#define VIEW_OF(from) view_of(from)
#endif
#ifndef OUTPUT_OF
#define OUTPUT_OF(from) output_of(from)
#endif
#ifndef COPY_LAW
#define COPY_LAW(to, from)                                                                                             \
    memcpy(to, from, (size_t)((to)->struct_size < (int64_t)sizeof *(from) ? (to)->struct_size : (int64_t)sizeof *(from)))
#endif
#ifndef COPY_QUANTITY
#define COPY_QUANTITY COPY_LAW
#endif
#ifndef LAST_CONSTANT
#define LAST_CONSTANT(kind, index) (index)
#endif
#ifndef EXTENSION
#define EXTENSION(id) NULL
#endif
#ifndef OPTIONS_ACCEPTED
#define OPTIONS_ACCEPTED(options) (!(options) || !*(options))
#endif
#ifndef INSTANCE_MEMBERS
#define INSTANCE_MEMBERS /* further members of an instance */
#endif

typedef struct sound_instance {
    double unused;
    INSTANCE_MEMBERS
} sound_instance;

typedef struct sound_answer {
    double increment, slope, direction[3], state[2];
} sound_answer;

/* A text into a buffer of `size` bytes, cut short where it does not fit, always ended. */
static inline void say(char *to, int64_t size, const char *what) {
    if (to && size > 0) {
        (void)snprintf(to, (size_t)size, "%s", what);
    }
}

/* A struct of the host as far as it reaches; what an older host does not have is absent. */
static inline wl_view view_of(const wl_view *from) {
    wl_view view;
    memset(&view, 0, sizeof view);
    memcpy(&view, from, (size_t)(from->struct_size < (int64_t)sizeof view ? from->struct_size : (int64_t)sizeof view));
    return view;
}

static inline wl_output output_of(const wl_output *from) {
    wl_output out;
    memset(&out, 0, sizeof out);
    memcpy(&out, from, (size_t)(from->struct_size < (int64_t)sizeof out ? from->struct_size : (int64_t)sizeof out));
    return out;
}

/* Whether a member lies within a struct of the host. */
#define REACHES(p, type, member) ((p)->struct_size >= (int64_t)(offsetof(type, member) + sizeof((p)->member)))

static int32_t sound_describe(int32_t kind, int64_t index, wl_quantity *quantity) {
    static const wl_quantity constants[] = {
        {0, "K", "wear coefficient", 0, 0, 0, 0, 0, INFINITY, 1e-4, LAW_K_FLAGS},
        {0, LAW_H_NAME, "hardness of the worn body", LAW_H_UNIT, LAW_H_MINIMUM, LAW_H_MAXIMUM, LAW_H_DEFAULT,
         LAW_H_FLAGS}};
    static const wl_quantity states[] = {
        {0, "distance", "sliding distance so far", 1, 0, 0, 0, 0, INFINITY, 0, 0},
        {0, "work", "pressure times sliding distance so far", LAW_WORK_UNIT, 0, INFINITY, 0, 0}};
    wl_quantity one;
    index = LAST_CONSTANT(kind, index);
    if (index < 0 || index > 1 || (kind != WL_KIND_CONSTANT && kind != WL_KIND_STATE)) {
        return WL_NO_MORE;
    }
    one = kind == WL_KIND_CONSTANT ? constants[index] : states[index];
    one.struct_size = quantity->struct_size;
    COPY_QUANTITY(quantity, &one);
    return WL_OK;
}

static int32_t sound_create(const wl_host *host, const char *options, void **instance, char *text, int64_t text_size) {
    sound_instance *own = calloc(1, sizeof *own);
    (void)host;
    AT_CREATE
    if (!own || !OPTIONS_ACCEPTED(options)) {
        free(own);
        SAY_IN_CREATE(text, text_size, "this law has no options, and was given some");
        return WL_FAILED;
    }
    *instance = own;
    return WL_OK;
}

static void sound_destroy(void *instance) {
    sound_instance *own = instance;
    AT_DESTROY
    free(own);
}

static int32_t sound_evaluate(void *instance, const wl_view *view, wl_output *output) {
    sound_instance *own = instance;
    const wl_view known = VIEW_OF(view), *v = &known;
    const wl_output wanted = OUTPUT_OF(output), *o = &wanted;
    int32_t worst = WL_OK;
    int64_t missing = 0, first_bad = -1;
    (void)own;
    BEFORE_POINTS
    missing |= v->pressure.ptr ? 0 : WL_FIELD_PRESSURE;
    missing |= v->slip.ptr ? 0 : WL_FIELD_SLIP;
    missing |= v->normal.ptr ? 0 : WL_FIELD_NORMAL;
    if (v->points > 0 && missing) {
        if (REACHES(output, wl_output, missing)) {
            output->missing = missing;
        }
        SAY(o->text, o->text_size, "pressure, slip or normal is not given");
        return WL_MISSING_INPUT;
    }
    for (int64_t i = 0; i < v->points; ++i) {
        double K = CONSTANT_AT(v->constants[0], i), H = CONSTANT_AT(v->constants[1], i);
        double given = SCALAR_AT(v->pressure, i), p = given < 0 ? 0 : given, s = fabs(SCALAR_AT(v->slip, i));
        const double *normal = &VALUE_AT(v->normal, i), *start = &VALUE_AT(v->state, i);
        int32_t status = WL_OK;
        sound_answer a = {INCREMENT, SLOPE, {-normal[0], -normal[1], -normal[2]}, {start[0] + s, start[1] + p * s}};
        if (given < 0) {
            a.slope = 0;
        }
        if (!(ACCEPTED) || STRANGE(a.increment) || STRANGE(a.slope) || STRANGE(a.state[0] + a.state[1]) ||
            STRANGE(normal[0] + normal[1] + normal[2])) {
            status = WL_OUT_OF_DOMAIN;
        }
        AT_POINT
        WRITE_INCREMENT
        if (o->direction) {
            WRITE_DIRECTION
        }
        if (o->state) {
            WRITE_STATE
        }
        if (o->d_pressure) {
            WRITE_D_PRESSURE
        }
        if (o->status) {
            WRITE_STATUS
        }
        if (status > worst) {
            worst = status;
            first_bad = i;
        }
    }
    AFTER_POINTS
    if (worst != WL_OK) {
        if (REACHES(output, wl_output, first_bad)) {
            output->first_bad = first_bad;
        }
        SAY(o->text, o->text_size, "an input is not finite or out of its bounds, or the answer overflows");
    }
    return worst;
}

static const void *sound_extension(const char *id) {
    (void)id;
    return EXTENSION(id);
}

__attribute__((constructor)) static void sound_loaded(void) { AT_LOAD }
__attribute__((destructor)) static void sound_unloaded(void) { AT_UNLOAD }

WL_EXPORT int32_t wearlaw_entry_1(int32_t index, const wl_host *host, wl_law *law) {
    wl_law own;
    (void)host;
    AT_ENTRY
    if (index != 0) {
        return WL_NO_MORE;
    }
    if (law->struct_size < (int64_t)sizeof own) { /* less than the table of 1.0 */
        return WL_FAILED;
    }
    memset(&own, 0, sizeof own);
    own.struct_size = law->struct_size;
    own.abi_minor = WL_ABI_MINOR;
    say(own.name, sizeof own.name, LAW_NAME);
    say(own.version, sizeof own.version, "1.0.0");
    say(own.summary, sizeof own.summary, "wear proportional to pressure and slip");
    own.reads = LAW_READS;
    own.uses = LAW_USES;
    own.writes = LAW_WRITES;
    own.claims = LAW_CLAIMS;
    own.flags = LAW_FLAGS;
    own.constant_count = 2;
    own.state_count = 2;
    own.pressure_degree = LAW_DEGREE;
    own.pressure_degree_constant = LAW_DEGREE_CONSTANT;
    own.describe = sound_describe;
    own.create = sound_create;
    own.evaluate = sound_evaluate;
    own.destroy = sound_destroy;
    own.extension = sound_extension;
    COPY_LAW(law, &own);
    return WL_OK;
}

#endif /* SOUND_LAW_H */
