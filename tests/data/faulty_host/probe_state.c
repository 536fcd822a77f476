/* probe_state.c: substeps tried again, runs carried on in a new instance, and the derivative. */
#include "probe.h"

enum { POINTS = 20, SUBSTEPS = 8 };

static void again(law_handle *h) {
    void *used = make_instance(h);
    for (int64_t substep = 1; substep <= 3; ++substep) {
        job *whole = make_job(h, POINTS, 1);
        whole->substep = substep;
        whole->time = (double)substep;
        job *half = rescaled(h, whole, 0.5);
        reply *right = evaluate(h, make_instance(h), half, all_outputs(h));
        evaluate(h, used, whole, all_outputs(h));
        if (differs(h, right, evaluate(h, used, half, all_outputs(h)), POINTS, 0) >= 0) {
            bad("half a substep after the whole one was tried ends otherwise than at the first try");
        }
    }
}

/* Runs some substeps; from `fresh` on in a new instance. */
static reply *run(law_handle *h, int64_t fresh) {
    void *instance = make_instance(h);
    double *state = NULL;
    reply *r = NULL;
    for (int64_t substep = 1; substep <= SUBSTEPS; ++substep) {
        job *j = make_job(h, POINTS, (uint64_t)substep);
        j->substep = substep;
        j->time = 0.01 * (double)substep;
        j->state = state ? state : j->state;
        if (substep == fresh) {
            instance = make_instance(h);
        }
        r = evaluate(h, instance, j, all_outputs(h));
        state = r->state;
    }
    return r;
}

static double increment_at(law_handle *h, void *instance, job *j, double pressure) {
    j->field[0][0] = pressure;
    return evaluate(h, instance, j, all_outputs(h))->increment[0];
}

/* One-sided differences with an extrapolation to no distance, on either side. */
static double slope(law_handle *h, void *instance, job *j, double p, double side) {
    double step = side * 1e-4 * p, here = increment_at(h, instance, j, p);
    double whole = (increment_at(h, instance, j, p + step) - here) / step;
    double half = (increment_at(h, instance, j, p + step / 2) - here) / (step / 2);
    return 2 * half - whole;
}

static void derivative(law_handle *h, int kinks) {
    void *instance = make_instance(h);
    for (int64_t at = 0; at < 1200; ++at) { /* ordinary pressures, some far above them and some far below */
        static const double factors[] = {1, 1e5, 1e-6};
        int64_t i = at / 3;
        job *all = make_job(h, 400, 1), *j = part_of(h, all, &i, 1);
        double p = j->field[0][0] *= kinks ? 1 : factors[at % 3];
        double given = evaluate(h, instance, j, all_outputs(h))->slope[0];
        double left = slope(h, instance, j, p, -1), right = slope(h, instance, j, p, 1);
        double size = fmax(fabs(left), fabs(right));
        if (!kinks && fabs(left - right) <= 1e-3 * size && fabs(given - left) > 1e-3 * size) {
            bad("the derivative at pressure %g is %g, differences give %g", p, given, left);
        }
    }
    for (double low = 1e5; kinks && low < 3e9; low *= 1.02) { /* a jump of the slope between neighbours */
        job *j = make_job(h, 1, 1);
        double a = slope(h, instance, j, low, -1), b = slope(h, instance, j, low * 1.02, 1);
        if (!(h->law.flags & WL_FLAG_KINKS) && fabs(a - b) > 0.3 * fmax(fabs(a), fabs(b))) {
            bad("the slope jumps from %g to %g at pressure %g, and no flag says so", a, b, low);
        }
    }
}

int probe_state(const char *name, const char *path) {
    if (strcmp(name, "state/again") != 0 && strcmp(name, "state/restart") != 0 &&
        strncmp(name, "derivative/", 11) != 0) {
        return 0;
    }
    law_handle *h = open_law(path);
    if (strcmp(name, "state/again") == 0) {
        again(h);
    } else if (strcmp(name, "state/restart") == 0) {
        if (differs(h, run(h, 0), run(h, 5), POINTS, 0) >= 0) {
            bad("a run carried on in a new instance ends otherwise than the straight run");
        }
    } else if (strcmp(name, "derivative/asked") == 0) {
        job *j = make_job(h, POINTS, 1);
        void *instance = make_instance(h);
        if (differs(h, evaluate(h, instance, j, all_outputs(h)),
                    evaluate(h, instance, j, all_outputs(h) & ~WL_OUT_D_PRESSURE), POINTS, 0) >= 0) {
            bad("asking for the derivative changes the increment");
        }
    } else if (h->law.reads & WL_FIELD_PRESSURE) {
        derivative(h, strcmp(name, "derivative/kinks") == 0);
    }
    return 1;
}
