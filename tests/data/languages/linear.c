/* The linear law of point_bench.c. */
#define LAW_NAME "linear-c"
#define LAW_VERSION "1.0.0"
#define LAW_SUMMARY "wear depth proportional to pressure and sliding distance"
#define LAW_READS(F) F(pressure) F(slip)
#define LAW_CONSTANTS(C)                                                                                               \
    C(K, WL_NUMBER, WL_FROM(0) WL_CLOSES_UNITS, WL_REQUIRED, "wear coefficient") \
    C(H, WL_PASCAL, WL_ABOVE(0), WL_REQUIRED, "hardness")
#define LAW_WRITES WL_OUT_D_PRESSURE
#include "wearlaw_point.h"

WL_POINT {
    double p = in->pressure > 0 ? in->pressure : 0;
    out->d_pressure = c->K / c->H * in->slip;
    out->increment = out->d_pressure * p;
    return WL_OK;
}
