/* probe_values.c: the numbers at ordinary and extreme inputs. */
#include "probe.h"

static int is_answer(law_handle *h, const reply *r, int64_t i) {
    int good = isfinite(r->increment[i]);
    good &= !(r->want & WL_OUT_D_PRESSURE) || !isnan(r->slope[i]);
    for (int64_t k = 0; k < h->states && (r->want & WL_OUT_STATE); ++k) {
        good &= isfinite(r->state[h->states * i + k]);
    }
    return good;
}

/* Every point has a finite answer or a status; a void status has no values. */
static void answered(law_handle *h, const job *j, const char *what) {
    int64_t want = all_outputs(h) | WL_OUT_STATUS;
    reply *r = evaluate(h, make_instance(h), j, want);
    for (int64_t i = 0; i < j->points; ++i) {
        if (r->status[i] <= WL_UNRELIABLE && !is_answer(h, r, i)) {
            bad("%s: increment %g at pressure %.17g with status %d", what, r->increment[i],
                j->field[0] ? j->field[0][i] : 0, (int)r->status[i]);
        }
    }
}

static void set(job *j, int field, double value) {
    for (int64_t i = 0; j->field[field] && i < j->points; ++i) {
        for (int k = 0; k < width_of(field); ++k) {
            j->field[field][width_of(field) * i + k] = value;
        }
    }
}

static void nothing_slips(job *j) {
    static const int slips[] = {1, 2, 3, 11};
    for (int k = 0; k < 4; ++k) {
        set(j, slips[k], 0);
    }
}

static void zero_dt(law_handle *h) {
    job *j = make_job(h, 50, 1);
    nothing_slips(j);
    j->dt = 0;
    reply *r = evaluate(h, make_instance(h), j, all_outputs(h));
    for (int64_t i = 0; i < j->points; ++i) {
        int moved = r->increment[i] != 0;
        for (int64_t k = 0; k < h->states; ++k) {
            moved |= r->state[h->states * i + k] != j->state[h->states * i + k];
        }
        if (r->returned <= WL_UNRELIABLE && moved) {
            bad("a substep of no length wears %g, or changes the state", r->increment[i]);
        }
    }
}

static void extremes(law_handle *h) {
    static const double values[] = {-0.0, 5e-324, 1e-310, 1e-300, 1e300, INFINITY, -INFINITY};
    for (int one = 0; one < FIELDS; ++one) {
        for (int two = one; two < FIELDS; ++two) {
            for (int e = 0; e < 49; ++e) {
                job *j = make_job(h, 1, 1);
                if (j->field[one] && j->field[two] && width_of(one) == 1 && width_of(two) == 1) {
                    j->field[one][0] = values[e % 7];
                    j->field[two][0] = values[e / 7];
                    answered(h, j, "an extreme input");
                }
            }
        }
    }
}

/* A state variable and a field that are each finite, and their sum is not. */
static void sums(law_handle *h) {
    for (int f = 0; f < FIELDS; ++f) {
        for (int64_t k = 0; k < h->states; ++k) {
            job *j = make_job(h, 1, 1);
            if (j->field[f] && width_of(f) == 1) {
                j->field[f][0] = j->state[k] = 1.7e308;
                answered(h, j, "a state variable near the largest number");
            }
        }
    }
}

static void bounds(law_handle *h) {
    for (int64_t k = 0; k < h->constants; ++k) {
        wl_quantity q = {sizeof q};
        job *j = make_job(h, 20, 1);
        h->law.describe(WL_KIND_CONSTANT, k, &q);
        if (!isfinite(q.minimum)) {
            continue;
        }
        j->constant[k][0] = q.flags & WL_QUANTITY_ABOVE_MINIMUM ? nextafter(q.minimum, INFINITY) : q.minimum;
        answered(h, j, "a constant at its bound");
        j->constant[k][0] = q.minimum - 1;
        if (evaluate(h, make_instance(h), j, 0)->returned <= WL_UNRELIABLE) {
            bad("`%s` is %g, below its minimum, and taken as it is", q.name, j->constant[k][0]);
        }
    }
}

int probe_values(const char *name, const char *path) {
    if (strncmp(name, "values/", 7) != 0 || strcmp(name, "values/expected") == 0) {
        return 0;
    }
    law_handle *h = open_law(path);
    job *j = make_job(h, 20000, 5);
    if (strcmp(name, "values/finite") == 0) {
        answered(h, j, "an input in bounds");
    } else if (strcmp(name, "values/zero-pressure") == 0) {
        set(j, 0, 0);
        answered(h, j, "no pressure");
    } else if (strcmp(name, "values/zero-slip") == 0) {
        nothing_slips(j);
        answered(h, j, "no slip");
    } else if (strcmp(name, "values/zero-dt") == 0) {
        zero_dt(h);
    } else if (strcmp(name, "values/negative-pressure") == 0) {
        set(j, 0, -1e7);
        set(j, 11, -10);
        reply *r = evaluate(h, make_instance(h), j, 0);
        if (r->returned <= WL_UNRELIABLE && r->increment[0] != 0) {
            bad("a pressure of -1e7 wears %g", r->increment[0]);
        }
    } else if (strcmp(name, "values/extremes") == 0) {
        extremes(h);
        sums(h);
    } else if (strcmp(name, "values/bounds") == 0) {
        bounds(h);
    } else {
        return 0;
    }
    return 1;
}
