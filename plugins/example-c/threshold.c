/* Archard's law above a pressure threshold: increment = K / H * max(p - p0, 0) * slip. README.md has the source. */
#define LAW_NAME "archard-threshold"
#define LAW_VERSION "1.0.0"
#define LAW_SUMMARY "Archard wear above a pressure threshold"
#define LAW_SOURCE "J. F. Archard, J. Appl. Phys. 24 (1953) 981-988, with the pressure reduced by a threshold"
#define LAW_READS(F) F(pressure) F(slip)
#define LAW_CONSTANTS(C)                                                                                               \
    C(K, WL_NUMBER, WL_FROM(0), WL_REQUIRED, "wear coefficient")                                                       \
    C(H, WL_PASCAL, WL_ABOVE(0), WL_REQUIRED, "hardness of the worn body")                                             \
    C(p0, WL_PASCAL, WL_FROM(0), 0, "contact pressure below which there is no wear")
#define LAW_WRITES WL_OUT_D_PRESSURE
#define LAW_CLAIMS (WL_CLAIM_DETERMINISTIC | WL_CLAIM_NON_NEGATIVE | WL_CLAIM_LINEAR_IN_DT | WL_CLAIM_FRAME_INDIFFERENT \
                    | WL_CLAIM_ZERO_WITHOUT_PRESSURE | WL_CLAIM_ZERO_WITHOUT_SLIP)
#define LAW_FLAGS WL_FLAG_KINKS
#include "wearlaw_point.h"

WL_POINT {
    double excess = in->pressure <= c->p0 ? 0 : in->pressure - c->p0; /* not a number stays one, and is refused */
    double slope = c->K / c->H * fabs(in->slip);
    out->increment = slope * excess;
    out->d_pressure = in->pressure > c->p0 ? slope : 0;
    if (!isfinite(out->increment)) {
        return WL_REFUSE(out, WL_OUT_OF_DOMAIN, "no finite wear at pressure %g, slip %g", in->pressure, in->slip);
    }
    return WL_OK;
}
