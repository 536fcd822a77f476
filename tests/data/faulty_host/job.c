/* job.c: inputs of ordinary size, calls, and the comparison of answers. */
#include "probe.h"

double uniform(uint64_t *seed) {
    *seed = *seed * 6364136223846793005u + 1442695040888963407u;
    return (double)(*seed >> 11) / 9007199254740992.0;
}

static double *numbers(int64_t count) { return malloc(sizeof(double) * (size_t)(count > 0 ? count : 1)); }

/* One value of a field: pressures about 1e7, slips about 1e-4, vectors of unit length. */
static void draw(int field, double *to, uint64_t *seed) {
    if (width_of(field) == 3) {
        double length = 0;
        for (int k = 0; k < 3; ++k) {
            to[k] = 2 * uniform(seed) - 1;
            length += to[k] * to[k];
        }
        for (int k = 0; k < 3; ++k) {
            to[k] /= sqrt(length);
        }
        return;
    }
    switch (field) {
    case 0: case 14: *to = pow(10, 6 + 2.5 * uniform(seed)); break;
    case 1: *to = pow(10, -5 + 2 * uniform(seed)); break;
    case 2: *to = pow(10, -3 + 2 * uniform(seed)); break;
    case 7: case 8: *to = 290 + 50 * uniform(seed); break;
    default: *to = 0.1 + uniform(seed);
    }
}

job *make_job(law_handle *h, int64_t points, uint64_t seed) {
    job *j = calloc(1, sizeof *j);
    j->points = points;
    j->dt = 0.01;
    j->time = 1;
    j->substep = 1;
    for (int f = 0; f < FIELDS; ++f) {
        if ((h->law.reads | h->law.uses) & bit_of(f)) {
            j->step[f] = width_of(f);
            j->field[f] = numbers(width_of(f) * points);
            for (int64_t i = 0; i < points; ++i) {
                draw(f, j->field[f] + width_of(f) * i, &seed);
            }
        }
    }
    for (int64_t k = 0; k < h->constants; ++k) {
        wl_quantity q = {sizeof q};
        h->law.describe(WL_KIND_CONSTANT, k, &q);
        j->constant[k] = numbers(1);
        j->constant[k][0] = isfinite(q.default_value) ? q.default_value : isfinite(q.minimum) ? q.minimum + 1 : 1;
    }
    j->state = numbers(h->states * points);
    j->state_step = h->states;
    for (int64_t i = 0; i < h->states * points; ++i) {
        j->state[i] = uniform(&seed);
    }
    return j;
}

/* The points `which` of a job, at unit step and with constants as they are; NULL: the first ones. */
job *part_of(law_handle *h, const job *all, const int64_t *which, int64_t points) {
    job *j = malloc(sizeof *j);
    *j = *all;
    j->points = points;
    for (int f = 0; f < FIELDS; ++f) {
        if (all->field[f]) {
            j->field[f] = numbers(width_of(f) * points);
            j->step[f] = width_of(f);
            for (int64_t i = 0; i < points; ++i) {
                memcpy(j->field[f] + width_of(f) * i, all->field[f] + all->step[f] * (which ? which[i] : i),
                       sizeof(double) * (size_t)width_of(f));
            }
        }
    }
    j->state = numbers(h->states * points);
    j->state_step = h->states;
    for (int64_t i = 0; i < points; ++i) {
        memcpy(j->state + h->states * i, all->state + all->state_step * (which ? which[i] : i),
               sizeof(double) * (size_t)h->states);
    }
    for (int64_t k = 0; k < h->constants; ++k) {
        if (all->constant_step[k] != 0) {
            j->constant[k] = numbers(points);
            j->constant_step[k] = 1;
            for (int64_t i = 0; i < points; ++i) {
                j->constant[k][i] = all->constant[k][all->constant_step[k] * (which ? which[i] : i)];
            }
        }
    }
    return j;
}

/* The same rates over another dt: slip, slip vector and friction work scale with it. */
job *rescaled(law_handle *h, const job *all, double factor) {
    job *j = part_of(h, all, NULL, all->points);
    j->dt *= factor;
    for (int64_t i = 0; i < j->points; ++i) {
        for (int f = 0; f < FIELDS; ++f) {
            for (int k = 0; j->field[f] && (f == 1 || f == 3 || f == 11) && k < width_of(f); ++k) {
                j->field[f][width_of(f) * i + k] *= factor;
            }
        }
    }
    return j;
}

void fill_view(law_handle *h, const job *j, wl_view *view, wl_column *constants) {
    memset(view, 0, sizeof *view);
    view->struct_size = sizeof *view;
    view->points = j->points;
    view->dimension = 3;
    view->time = view->step_time = j->time;
    view->dt = j->dt;
    view->absolute_zero = j->absolute_zero;
    view->load_step = 1;
    view->substep = j->substep;
    view->unit_metre = j->unit[0];
    view->unit_kilogram = j->unit[1];
    view->unit_second = j->unit[2];
    view->unit_kelvin = j->unit[3];
    view->constant_count = h->constants;
    view->constants = constants;
    for (int64_t k = 0; k < h->constants; ++k) {
        constants[k] = (wl_column){j->constant[k], j->constant_step[k]};
    }
    view->state_count = h->states;
    view->state = (wl_column){h->states ? j->state : NULL, j->state_step};
    for (int f = 0; f < FIELDS; ++f) {
        double *column = column_of(view, f, j->step[f]);
        memcpy(column, &j->field[f], sizeof j->field[f]);
    }
}

int64_t all_outputs(const law_handle *h) { return h->law.writes & WL_OUTS_KNOWN; }

static void prefill(double *to, int64_t count) {
    uint64_t pattern = UNWRITTEN;
    for (int64_t i = 0; i < count; ++i) {
        memcpy(to + i, &pattern, sizeof pattern);
    }
}

reply *make_reply(law_handle *h, int64_t points, int64_t want) {
    reply *r = calloc(1, sizeof *r);
    r->want = want;
    points = points > 0 ? points : 1; /* no points have room for one, to see whether it is written */
    prefill(r->increment = numbers(points), points);
    prefill(r->direction = numbers(3 * points), 3 * points);
    prefill(r->state = numbers(h->states * points), h->states * points);
    prefill(r->slope = numbers(points), points);
    r->status = malloc(sizeof(int32_t) * (size_t)points);
    for (int64_t i = 0; i < points; ++i) {
        r->status[i] = UNWRITTEN_STATUS;
    }
    return r;
}

reply *evaluate(law_handle *h, void *instance, const job *j, int64_t want) {
    reply *r = make_reply(h, j->points, want);
    wl_column constants[MOST_QUANTITIES];
    wl_view view;
    wl_output o;
    char text[200] = "";
    fill_view(h, j, &view, constants);
    view.request = want;
    memset(&o, 0, sizeof o);
    o.struct_size = sizeof o;
    o.first_bad = -1;
    o.increment = r->increment;
    o.direction = want & WL_OUT_DIRECTION ? r->direction : NULL;
    o.state = (want & WL_OUT_STATE) && h->states ? r->state : NULL;
    o.d_pressure = want & WL_OUT_D_PRESSURE ? r->slope : NULL;
    o.status = want & WL_OUT_STATUS ? r->status : NULL;
    o.text = text;
    o.text_size = sizeof text;
    r->returned = h->law.evaluate(instance, &view, &o);
    r->view_request = view.request;
    return r;
}

static int apart(double a, double b, double relative) {
    return !(a == b) && !(isnan(a) && isnan(b)) && !(fabs(a - b) <= relative * fmax(fabs(a), fabs(b)));
}

int64_t differs(law_handle *h, const reply *a, const reply *b, int64_t points, double relative) {
    int64_t both = a->want & b->want;
    for (int64_t i = 0; i < points; ++i) {
        int off = apart(a->increment[i], b->increment[i], relative);
        for (int k = 0; k < 3; ++k) {
            off |= (both & WL_OUT_DIRECTION) && apart(a->direction[3 * i + k], b->direction[3 * i + k], relative);
        }
        for (int64_t k = 0; k < h->states; ++k) {
            off |= (both & WL_OUT_STATE) && apart(a->state[h->states * i + k], b->state[h->states * i + k], relative);
        }
        off |= (both & WL_OUT_D_PRESSURE) && apart(a->slope[i], b->slope[i], relative);
        off |= (both & WL_OUT_STATUS) && a->status[i] != b->status[i];
        if (off) {
            return i;
        }
    }
    return -1;
}

/* Holds a part to the whole: to the bit if the law claims that bits are the same in every batch. */
void compare_part(law_handle *h, const reply *all, const int64_t *which, const reply *part, int64_t points,
                  const char *what) {
    reply *expected = make_reply(h, points, all->want);
    int64_t at;
    for (int64_t i = 0; i < points; ++i) {
        int64_t from = which ? which[i] : i;
        expected->increment[i] = all->increment[from];
        memcpy(expected->direction + 3 * i, all->direction + 3 * from, 3 * sizeof(double));
        memcpy(expected->state + h->states * i, all->state + h->states * from, sizeof(double) * (size_t)h->states);
        expected->slope[i] = all->slope[from];
        expected->status[i] = all->status[from];
    }
    at = differs(h, expected, part, points, h->law.claims & WL_CLAIM_DETERMINISTIC ? 0 : 1e-15);
    if (at >= 0) {
        bad("%s: point %lld has increment %.17g, expected %.17g", what, (long long)at, part->increment[at],
            expected->increment[at]);
    }
}

uint64_t fingerprint(law_handle *h, const reply *r, int64_t points) {
    uint64_t hash = 14695981039346656037u;
    const double *of[4] = {r->increment, r->direction, r->state, r->slope};
    int64_t count[4] = {points, 3 * points, h->states * points, points};
    for (int part = 0; part < 4; ++part) {
        for (int64_t i = 0; i < count[part]; ++i) {
            uint64_t bits;
            memcpy(&bits, of[part] + i, sizeof bits);
            hash = (hash ^ bits) * 1099511628211u;
        }
    }
    return hash;
}
