/* probe_physics.c: claims that are false, and directions. */
#include "probe.h"

enum { POINTS = 200 };

static void set(job *j, int field, double value) {
    for (int64_t i = 0; j->field[field] && i < j->points; ++i) {
        for (int k = 0; k < width_of(field); ++k) {
            j->field[field][width_of(field) * i + k] = value;
        }
    }
}

/* No increment is negative, or any but zero, if the law claims so. */
static void none_is(law_handle *h, const job *j, int64_t claim, int negative, const char *what) {
    if (!(h->law.claims & claim)) {
        return;
    }
    reply *r = evaluate(h, make_instance(h), j, all_outputs(h));
    for (int64_t i = 0; i < j->points && r->returned <= WL_UNRELIABLE; ++i) {
        if (negative ? r->increment[i] < 0 : r->increment[i] != 0) {
            bad("%s: increment %g", what, r->increment[i]);
        }
    }
}

static void linear(law_handle *h) {
    enum { PARTS = 4 };
    job *whole = make_job(h, POINTS, 1), *part = rescaled(h, whole, 1.0 / PARTS);
    reply *once = evaluate(h, make_instance(h), whole, all_outputs(h));
    double sum[POINTS] = {0};
    for (int k = 0; k < PARTS; ++k) {
        reply *r = evaluate(h, make_instance(h), part, all_outputs(h));
        for (int64_t i = 0; i < POINTS; ++i) {
            sum[i] += r->increment[i];
        }
        part->state = h->states ? r->state : part->state;
        part->time += part->dt;
    }
    for (int64_t i = 0; i < POINTS; ++i) {
        if (fabs(sum[i] - once->increment[i]) > 1e-9 * fabs(once->increment[i])) {
            bad("one substep wears %g, its %d parts %g", once->increment[i], (int)PARTS, sum[i]);
        }
    }
}

static void degree(law_handle *h) {
    job *j = make_job(h, POINTS, 1), *more = part_of(h, j, NULL, POINTS);
    double claimed = h->law.pressure_degree;
    if (h->law.pressure_degree_constant >= 0) {
        claimed = j->constant[h->law.pressure_degree_constant][0];
    }
    if (!more->field[0]) {
        return;
    }
    for (int64_t i = 0; i < POINTS; ++i) {
        more->field[0][i] *= 3;
    }
    reply *r = evaluate(h, make_instance(h), j, all_outputs(h)), *s = evaluate(h, make_instance(h), more, all_outputs(h));
    for (int64_t i = 0; i < POINTS && isfinite(claimed); ++i) {
        double expected = r->increment[i] * pow(3, claimed);
        if (fabs(s->increment[i] - expected) > 1e-9 * fabs(expected)) {
            bad("three times the pressure gives %g times the wear, degree %g is claimed", s->increment[i] / r->increment[i],
                claimed);
        }
    }
}

/* x to y, y to z, z to x: exact in doubles. */
static void turn(double *vector) {
    double x = vector[0], y = vector[1], z = vector[2];
    vector[0] = z, vector[1] = x, vector[2] = y;
}

static void frame(law_handle *h) {
    job *j = make_job(h, POINTS, 1), *turned = part_of(h, j, NULL, POINTS);
    for (int f = 0; f < FIELDS; ++f) {
        for (int64_t i = 0; turned->field[f] && width_of(f) == 3 && i < POINTS; ++i) {
            turn(turned->field[f] + 3 * i);
        }
    }
    reply *r = evaluate(h, make_instance(h), j, all_outputs(h));
    reply *s = evaluate(h, make_instance(h), turned, all_outputs(h));
    for (int64_t i = 0; i < POINTS; ++i) {
        turn(r->direction + 3 * i);
    }
    if (differs(h, r, s, POINTS, 1e-9) >= 0) {
        bad("turning the frame changes the increment, or does not turn the direction");
    }
}

static void direction(law_handle *h, int inward) {
    job *j = make_job(h, POINTS, 1);
    reply *r = evaluate(h, make_instance(h), j, all_outputs(h));
    for (int64_t i = 0; i < POINTS && (r->want & WL_OUT_DIRECTION) && j->field[4]; ++i) {
        const double *d = r->direction + 3 * i, *n = j->field[4] + 3 * i;
        double length = sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
        double into = -(d[0] * n[0] + d[1] * n[1] + d[2] * n[2]);
        if (inward ? !(into > 0) : fabs(length - 1) > 1e-9) {
            bad("a direction has length %g and goes %g into the body", length, into);
        }
    }
}

int probe_physics(const char *name, const char *path) {
    static const int slips[] = {1, 2, 3, 11};
    if (strncmp(name, "physics/", 8) != 0 || strcmp(name, "physics/units") == 0 ||
        strcmp(name, "physics/temperature-scale") == 0) {
        return 0;
    }
    law_handle *h = open_law(path);
    job *j = make_job(h, POINTS, 1);
    if (strcmp(name, "physics/non-negative") == 0) {
        none_is(h, j, WL_CLAIM_NON_NEGATIVE, 1, "claimed never to be negative");
    } else if (strcmp(name, "physics/zero-without-pressure") == 0) {
        set(j, 0, 0);
        none_is(h, j, WL_CLAIM_ZERO_WITHOUT_PRESSURE, 0, "no pressure");
    } else if (strcmp(name, "physics/zero-without-slip") == 0) {
        for (int k = 0; k < 4; ++k) {
            set(j, slips[k], 0);
        }
        none_is(h, j, WL_CLAIM_ZERO_WITHOUT_SLIP, 0, "no slip");
    } else if (strcmp(name, "physics/linear-in-dt") == 0 && (h->law.claims & WL_CLAIM_LINEAR_IN_DT)) {
        linear(h);
    } else if (strcmp(name, "physics/pressure-degree") == 0) {
        degree(h);
    } else if (strcmp(name, "physics/frame") == 0 && (h->law.claims & WL_CLAIM_FRAME_INDIFFERENT)) {
        frame(h);
    } else if (strcmp(name, "physics/direction-length") == 0 || strcmp(name, "physics/direction-inward") == 0) {
        direction(h, strcmp(name, "physics/direction-inward") == 0);
    }
    return 1;
}
