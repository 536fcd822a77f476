/*
 * {{name}}: Archard's law with a pressure that levels off.
 *
 *     wear increment = k * q * slip,    q = p / (1 + p / p_half)
 *
 * At low contact pressure p this is Archard's law with the specific wear rate k; at p = p_half it gives half of it, and
 * beyond that more pressure hardly wears more. Put your own equation in its place.
 */

/* What the law is. Every constant: name, unit, bounds, default, what it is. */
#define LAW_NAME "{{name}}"
#define LAW_VERSION "0.1.0"
#define LAW_SUMMARY "Archard wear that levels off at high pressure"
#define LAW_READS(F) F(pressure) F(slip)
#define LAW_CONSTANTS(C)                                                                  \
    C(k, WL_PER_PASCAL, WL_FROM(0), WL_REQUIRED, "specific wear rate")                    \
    C(p_half, WL_PASCAL, WL_ABOVE(0), 1e9, "pressure at which the wear is half Archard's")
/* What the law promises; leave out what your equation does not keep. */
#define LAW_CLAIMS                                                                        \
    (WL_CLAIM_DETERMINISTIC | WL_CLAIM_NON_NEGATIVE | WL_CLAIM_LINEAR_IN_DT |             \
     WL_CLAIM_ZERO_WITHOUT_PRESSURE | WL_CLAIM_ZERO_WITHOUT_SLIP | WL_CLAIM_FRAME_INDIFFERENT)
/* The derivative branches at p = 0. */
#define LAW_FLAGS WL_FLAG_KINKS

#include "wearlaw_point.h" /* makes the loop over the points, the description and the entry */

/* What the law does at one point: in (fields), c (constants), s (state), out (answer). */
WL_POINT {
    if (!(in->pressure <= 0.0)) { /* a pressure that is no number comes in here, too */
        double q = in->pressure / (1.0 + in->pressure / c->p_half);
        out->increment = c->k * q * in->slip;
    } /* else: no pressure, no wear; the increment is preset to 0 */
    /* What has no answer gets a status, never a silent NaN or infinity. */
    return isfinite(out->increment) ? WL_OK : WL_OUT_OF_DOMAIN;
}
