/* probe_units.c: the same body in other base units, or in degrees Celsius, wears the same. */
#include "probe.h"

/* Exponents of metre, kilogram, second and kelvin of the fields, in the order of their bits. */
static const double dimensions[FIELDS][4] = {
    {-1, 1, -2, 0}, {1, 0, 0, 0},   {1, 0, -1, 0}, {1, 0, 0, 0}, {0, 0, 0, 0}, {1, 0, 0, 0},
    {0, 0, 0, 0},   {0, 0, 0, 1},   {0, 0, 0, 1},  {-1, 1, -2, 0}, {0, 0, 0, 0}, {0, 1, -2, 0},
    {1, 0, 0, 0},   {1, 0, 0, 0},   {-1, 1, -2, 0}, {1, 0, 0, 0}, {2, 0, 0, 0}};

/* What a quantity's number is multiplied by if the units become so many SI units each. */
static double factor(const double *exponents, const double *units) {
    double f = 1;
    for (int k = 0; k < 4; ++k) {
        f *= pow(units[k], -exponents[k]);
    }
    return f;
}

static double factor_of(law_handle *h, int32_t kind, int64_t index, const double *units) {
    wl_quantity q = {sizeof q};
    h->law.describe(kind, index, &q);
    return factor((double[]){q.metre, q.kilogram, q.second, q.kelvin}, units);
}

enum { POINTS = 50 };

/* The temperatures in degrees Celsius; no law here has a temperature among its constants. */
static void celsius(law_handle *h) {
    job *kelvin = make_job(h, POINTS, 1), *other = part_of(h, kelvin, NULL, POINTS);
    other->absolute_zero = -273.15;
    for (int f = 7; f <= 8; ++f) {
        for (int64_t i = 0; other->field[f] && i < POINTS; ++i) {
            other->field[f][i] -= 273.15;
        }
    }
    reply *r = evaluate(h, make_instance(h), kelvin, all_outputs(h));
    reply *s = evaluate(h, make_instance(h), other, all_outputs(h));
    for (int64_t i = 0; i < POINTS; ++i) {
        if (fabs(s->increment[i] - r->increment[i]) > 1e-9 * fabs(r->increment[i])) {
            bad("in degrees Celsius the wear is %g times that in kelvin", s->increment[i] / r->increment[i]);
        }
    }
}

static void same(double expected, double found, const char *what) {
    if (fabs(found - expected) > 1e-9 * fabs(expected)) {
        bad("in other units the %s is %g times what it should be", what, found / expected);
    }
}

int probe_units(const char *name, const char *path) {
    static const double millimetres[4] = {1e-3, 1e3, 10, 2};
    int scale = strcmp(name, "physics/temperature-scale") == 0;
    if (strcmp(name, "physics/units") != 0 && !scale) {
        return 0;
    }
    law_handle *h = open_law(path);
    if (scale) {
        celsius(h);
        return 1;
    }
    job *si = make_job(h, POINTS, 1);
    for (int k = 0; k < 4; ++k) {
        si->unit[k] = 1;
    }
    job *other = part_of(h, si, NULL, POINTS);
    memcpy(other->unit, millimetres, sizeof other->unit);
    other->dt /= millimetres[2];
    other->time /= millimetres[2];
    for (int f = 0; f < FIELDS; ++f) {
        for (int64_t i = 0; other->field[f] && i < width_of(f) * POINTS; ++i) {
            other->field[f][i] *= factor(dimensions[f], millimetres);
        }
    }
    for (int64_t k = 0; k < h->constants; ++k) {
        other->constant[k] = malloc(sizeof(double));
        other->constant[k][0] = si->constant[k][0] * factor_of(h, WL_KIND_CONSTANT, k, millimetres);
    }
    for (int64_t k = 0; k < h->states; ++k) {
        for (int64_t i = 0; i < POINTS; ++i) {
            other->state[h->states * i + k] *= factor_of(h, WL_KIND_STATE, k, millimetres);
        }
    }
    reply *r = evaluate(h, make_instance(h), si, all_outputs(h));
    reply *s = evaluate(h, make_instance(h), other, all_outputs(h));
    for (int64_t i = 0; i < POINTS; ++i) {
        same(r->increment[i] * factor((double[]){1, 0, 0, 0}, millimetres), s->increment[i], "wear");
        for (int64_t k = 0; k < h->states && (r->want & WL_OUT_STATE); ++k) {
            double by = factor_of(h, WL_KIND_STATE, k, millimetres);
            same(r->state[h->states * i + k] * by, s->state[h->states * i + k], "state");
        }
        if ((r->want & WL_OUT_D_PRESSURE) && isfinite(r->slope[i])) {
            same(r->slope[i] * factor((double[]){2, -1, 2, 0}, millimetres), s->slope[i], "derivative");
        }
    }
    return 1;
}
