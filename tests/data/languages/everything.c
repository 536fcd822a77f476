/* A law that touches every part of the helper; its siblings in C++ and Fortran compute the same. */
#define LAW_NAME "everything-c"
#define LAW_VERSION "1.2.3"
#define LAW_SUMMARY "every part of the helper"
#define LAW_SOURCE "none"
#define LAW_READS(F) F(pressure) F(normal) F(contact_state) F(slip_vector)
#define LAW_USES(F) F(temperature) F(tangent) F(point_id)
#define LAW_INPUTS(C) C(film, WL_METRE, WL_ABOVE(0), 2, "film thickness") C(humidity, WL_NUMBER, WL_ANY, 0.5, "humidity")
#define LAW_CONSTANTS(C) C(k, WL_PER_PASCAL, WL_BETWEEN(0, 1), WL_REQUIRED, "specific wear rate")
#define LAW_STATE(C) C(total, WL_METRE, WL_ANY, 0, "wear so far") C(calls, WL_NUMBER, WL_ANY, 1, "substeps so far")
#define LAW_WRITES (WL_OUT_D_PRESSURE | WL_OUT_DIRECTION)
#define LAW_FLAGS WL_FLAG_OPEN_POINTS
#define LAW_PRESSURE_DEGREE 1.0
#include "wearlaw_point.h"

WL_POINT {
    double scale = WL_HAS(in, temperature) ? in->temperature - in->call->absolute_zero : 3;
    double slip = in->slip_vector[0] + 2 * in->slip_vector[1] + 3 * in->slip_vector[2];
    double twice = WL_HAS(in, point_id) && in->point_id % 2 ? 2 : 1;
    double slope = c->k * slip * in->film * in->humidity * scale * twice;
    out->d_pressure = in->contact_state == WL_OPEN ? 0 : slope;
    out->increment = out->d_pressure * in->pressure;
    if (WL_HAS(in, tangent)) {
        out->direction[0] = in->tangent[2];
        out->direction[1] = in->tangent[0];
        out->direction[2] = in->tangent[1];
    }
    out->state.total = s->total + out->increment;
    out->state.calls = s->calls + 1;
    out->dt_factor = 0.25;
    if (in->pressure > 1e8) {
        return WL_REFUSE(out, WL_CUT_STEP, "point %d", WL_HAS(in, point_id) ? (int)in->point_id : -1);
    }
    return in->pressure > 9e7 ? WL_UNRELIABLE : in->pressure < -1 ? 17 : WL_OK;
}
