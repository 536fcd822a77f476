/* probe_batch.c: any split, order and layout of the points, and outputs asked for or not. */
#include "probe.h"

enum { POINTS = 200, LARGE = 1000000 };

static const char *wanted;

static int is(const char *name) { return strcmp(wanted, name) == 0; }

static void compare_singles(law_handle *h, void *instance, const job *j) {
    reply *all = evaluate(h, instance, j, all_outputs(h));
    for (int64_t i = 0; i < j->points; ++i) {
        compare_part(h, all, &i, evaluate(h, instance, part_of(h, j, &i, 1), all_outputs(h)), 1, "a point alone");
    }
}

static void singles(law_handle *h, void *instance, int64_t points) {
    compare_singles(h, instance, make_job(h, points, 1));
}

/* The same with pressures about 1e-300 at every point. */
static void tiny_singles(law_handle *h, void *instance) {
    job *j = make_job(h, POINTS, 1);
    for (int64_t i = 0; j->field[0] && i < POINTS; ++i) {
        j->field[0][i] *= 1e-307;
    }
    compare_singles(h, instance, j);
}

static void shuffled(law_handle *h, void *instance) {
    int64_t order[POINTS];
    job *j = make_job(h, POINTS, 1);
    for (int64_t i = 0; i < POINTS; ++i) {
        order[i] = i * 77 % POINTS;
    }
    compare_part(h, evaluate(h, instance, j, all_outputs(h)), order,
                 evaluate(h, instance, part_of(h, j, order, POINTS), all_outputs(h)), POINTS, "another order");
}

/* The points from 1 on, in place: the arrays begin one number later. */
static void ranges(law_handle *h, void *instance) {
    int64_t which[POINTS - 1];
    job *j = make_job(h, POINTS, 1), *rest = malloc(sizeof *rest);
    reply *all = evaluate(h, instance, j, all_outputs(h));
    for (int64_t i = 0; i + 1 < POINTS; ++i) {
        which[i] = i + 1;
    }
    *rest = *j;
    rest->points = POINTS - 1;
    rest->state += rest->state_step;
    for (int f = 0; f < FIELDS; ++f) {
        rest->field[f] = j->field[f] ? j->field[f] + j->step[f] : NULL;
    }
    compare_part(h, all, which, evaluate(h, instance, rest, all_outputs(h)), POINTS - 1, "all points but the first");
}

static void large(law_handle *h, void *instance) {
    job *j = make_job(h, LARGE, 1);
    reply *all = evaluate(h, instance, j, all_outputs(h));
    int64_t *which = malloc(1000 * sizeof *which);
    for (int64_t from = 0; from < LARGE; from += 1000) {
        for (int64_t i = 0; i < 1000; ++i) {
            which[i] = from + i;
        }
        compare_part(h, all, which, evaluate(h, instance, part_of(h, j, which, 1000), all_outputs(h)), 1000,
                     "a thousand points of a million");
    }
}

static void empty(law_handle *h, void *instance) {
    job *j = make_job(h, 0, 1);
    reply *r = evaluate(h, instance, j, all_outputs(h));
    if (r->returned != WL_OK) {
        bad("no points are answered with status %d", (int)r->returned);
    }
    if (!unwritten(r->increment[0]) || !unwritten(r->slope[0]) || !unwritten(r->direction[0])) {
        bad("no points, and an output is written");
    }
}

/* Fields or constants at the given step hold, point by point, what they hold at unit step. */
static void columns(law_handle *h, void *instance, int64_t step, int fields) {
    job *plain = make_job(h, POINTS, 1), *other = malloc(sizeof *other);
    uint64_t seed = 9;
    for (int64_t k = 0; k < h->constants && !fields && step > 0; ++k) {
        double usual = plain->constant[k][0];
        plain->constant[k] = malloc(sizeof(double) * POINTS);
        plain->constant_step[k] = 1;
        for (int64_t i = 0; i < POINTS; ++i) {
            plain->constant[k][i] = usual * (1 + uniform(&seed));
        }
    }
    for (int f = 0; f < FIELDS && fields && step == 0; ++f) {
        for (int64_t i = 1; plain->field[f] && i < POINTS; ++i) {
            memcpy(plain->field[f] + width_of(f) * i, plain->field[f], sizeof(double) * (size_t)width_of(f));
        }
    }
    *other = *plain;
    for (int f = 0; f < FIELDS && fields; ++f) {
        if (plain->field[f]) {
            int64_t wide = step == 0 ? 0 : width_of(f) + step;
            other->step[f] = wide;
            other->field[f] = malloc(sizeof(double) * (size_t)(POINTS * (width_of(f) + step)));
            for (int64_t i = 0; i < POINTS * (width_of(f) + step); ++i) {
                other->field[f][i] = 0.125;
            }
            for (int64_t i = 0; i < (step == 0 ? 1 : POINTS); ++i) {
                memcpy(other->field[f] + wide * i, plain->field[f] + width_of(f) * i,
                       sizeof(double) * (size_t)width_of(f));
            }
        }
    }
    for (int64_t k = 0; k < h->constants && !fields && step > 1; ++k) {
        other->constant[k] = malloc(sizeof(double) * (size_t)(POINTS * step));
        other->constant_step[k] = step;
        for (int64_t i = 0; i < POINTS * step; ++i) {
            other->constant[k][i] = plain->constant[k][i / step] * (i % step == 0 ? 1 : 3);
        }
    }
    reply *right = evaluate(h, instance, plain, all_outputs(h));
    if (!fields && step == 1) { /* constants that differ from point to point, held to single points */
        for (int64_t i = 0; i < POINTS; ++i) {
            compare_part(h, right, &i, evaluate(h, instance, part_of(h, plain, &i, 1), all_outputs(h)), 1,
                         "constants of its own");
        }
        return;
    }
    compare_part(h, right, NULL, evaluate(h, instance, other, all_outputs(h)), POINTS, "columns of another step");
}

/* One field after the other given once, and all the others with gaps. */
static void mixed(law_handle *h, void *instance) {
    for (int once = 0; once < FIELDS; ++once) {
        job *plain = make_job(h, POINTS, 1), *other = malloc(sizeof *other);
        if (!plain->field[once]) {
            continue;
        }
        size_t wide = sizeof(double) * (size_t)width_of(once);
        for (int64_t i = 1; i < POINTS; ++i) {
            memcpy(plain->field[once] + width_of(once) * i, plain->field[once], wide);
        }
        *other = *plain;
        other->step[once] = 0;
        for (int f = 0; f < FIELDS; ++f) {
            if (f != once && plain->field[f]) {
                int64_t width = width_of(f);
                other->step[f] = 3 * width;
                other->field[f] = calloc((size_t)(3 * width * POINTS), sizeof(double));
                for (int64_t i = 0; i < POINTS; ++i) {
                    memcpy(other->field[f] + 3 * width * i, plain->field[f] + width * i,
                           sizeof(double) * (size_t)width);
                }
            }
        }
        compare_part(h, evaluate(h, instance, plain, all_outputs(h)), NULL,
                     evaluate(h, instance, other, all_outputs(h)), POINTS, "one field once, the others with gaps");
    }
}

/* One field after the other begins eight bytes behind a multiple of sixteen, the others do not. */
static void moved(law_handle *h, void *instance) {
    for (int one = 0; one < FIELDS; ++one) {
        job *plain = make_job(h, POINTS, 1), *other = malloc(sizeof *other);
        *other = *plain;
        for (int f = 0; f < FIELDS; ++f) {
            if (plain->field[f]) {
                size_t size = sizeof(double) * (size_t)(width_of(f) * POINTS);
                other->field[f] = (double *)aligned_alloc(64, (size + 8 + 63) / 64 * 64) + (f == one);
                memcpy(other->field[f], plain->field[f], size);
            }
        }
        compare_part(h, evaluate(h, instance, plain, all_outputs(h)), NULL,
                     evaluate(h, instance, other, all_outputs(h)), POINTS, "one field moved by eight bytes");
    }
}

static void statuses(law_handle *h, void *instance) {
    job *j = make_job(h, POINTS, 1);
    int64_t without = all_outputs(h) & ~WL_OUT_STATUS;
    reply *plain = evaluate(h, instance, j, without), *asked = evaluate(h, instance, j, all_outputs(h));
    if (differs(h, plain, asked, POINTS, 0) >= 0) {
        bad("with a status array the values are other ones");
    }
    for (int f = 0; f < FIELDS; ++f) {
        if (j->field[f]) {
            j->field[f][width_of(f) * 3] = NAN;
        }
    }
    asked = evaluate(h, instance, j, all_outputs(h));
    int32_t worst = 0;
    for (int64_t i = 0; i < POINTS; ++i) {
        worst = asked->status[i] > worst ? asked->status[i] : worst;
    }
    if (asked->returned != worst) {
        bad("the worst status of the points is %d, the call returns %d", (int)worst, (int)asked->returned);
    }
}

/* The increment alone, where one product overflows: the status is that of the call with statuses. */
static void overflow(law_handle *h, void *instance) {
    job *j = make_job(h, POINTS, 1);
    for (int f = 0; f < FIELDS; ++f) {
        if (j->field[f] && width_of(f) == 1) {
            j->field[f][3] = 1e300;
        }
    }
    reply *asked = evaluate(h, instance, j, all_outputs(h)), *alone = evaluate(h, instance, j, 0);
    if (asked->returned != alone->returned) {
        bad("status %d, and %d where the increment alone is asked for", (int)asked->returned, (int)alone->returned);
    }
}

int probe_batch(const char *name, const char *path) {
    if (strncmp(name, "batch/", 6) != 0) {
        return 0;
    }
    wanted = name;
    law_handle *h = open_law(path);
    void *instance = make_instance(h);
    if (is("batch/singles")) {
        singles(h, instance, POINTS);
        tiny_singles(h, instance);
    } else if (is("batch/odd")) {
        for (int64_t points = 2; points < 68; ++points) {
            singles(h, instance, points);
        }
        singles(h, instance, 4097);
    } else if (is("batch/shuffled")) {
        shuffled(h, instance);
    } else if (is("batch/ranges")) {
        ranges(h, instance);
    } else if (is("batch/large")) {
        large(h, instance);
    } else if (is("batch/empty")) {
        empty(h, instance);
    } else if (is("batch/uniform-fields")) {
        columns(h, instance, 0, 1);
    } else if (is("batch/strided-fields")) {
        columns(h, instance, 3, 1);
    } else if (is("batch/per-point-constants")) {
        columns(h, instance, 1, 0);
    } else if (is("batch/strided-constants")) {
        columns(h, instance, 3, 0);
    } else if (is("batch/mixed")) {
        mixed(h, instance);
        moved(h, instance);
    } else if (is("batch/status-array")) {
        statuses(h, instance);
        overflow(h, instance);
    } else {
        return 0;
    }
    return 1;
}
