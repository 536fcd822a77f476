/* Archard's law with exponents, in the order of operations that every language here writes. */
#define LAW_NAME "archard-c"
#define LAW_VERSION "1.0.0"
#define LAW_SUMMARY "K / H * p^m * v^n * dt"
#define LAW_READS(F) F(pressure) F(velocity)
#define LAW_CONSTANTS(C)                                                                                               \
    C(K, WL_NUMBER, WL_FROM(0) WL_CLOSES_UNITS, WL_REQUIRED, "wear coefficient")                                       \
    C(H, WL_PASCAL, WL_ABOVE(0), WL_REQUIRED, "hardness")                                                              \
    C(m, WL_NUMBER, WL_FROM(0), 1, "pressure exponent")                                                                \
    C(n, WL_NUMBER, WL_FROM(0), 1, "velocity exponent")
#define LAW_WRITES WL_OUT_D_PRESSURE
#define LAW_CLAIMS (WL_CLAIM_DETERMINISTIC | WL_CLAIM_NON_NEGATIVE | WL_CLAIM_LINEAR_IN_DT)
#define LAW_PRESSURE_DEGREE_CONSTANT m
#include "wearlaw_point.h"

WL_POINT {
    double p = in->pressure;
    double wear = p <= 0 ? 0 : c->K / c->H * pow(p, c->m) * pow(in->velocity, c->n) * in->dt;
    out->increment = wear;
    out->d_pressure = p <= 0 ? 0 : c->m * wear / p;
    return isfinite(wear) ? WL_OK : WL_REFUSE(out, WL_OUT_OF_DOMAIN, "no finite wear at pressure %g", p);
}
