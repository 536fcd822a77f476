/*
 * {{name}}: Archard's law with a pressure that levels off.
 *
 *     wear increment = k * q * slip,    q = p / (1 + p / p_half)
 *
 * At low contact pressure p this is Archard's law with the specific wear rate k; at p = p_half it gives half of it, and
 * beyond that more pressure hardly wears more. Put your own equation in its place.
 */

#include <cmath>

#include "wearlaw.hpp" // makes the loop over the points, the description and the entry

using namespace wearlaw;

struct TheLaw : Law<TheLaw> {
    static About about() { return {"{{name}}", "0.1.0", "Archard wear that levels off at high pressure"}; }

    // What the law must be given. Every constant: name, unit, bounds, default, what it is.
    using Reads = Fields<Pressure, Slip>;
    template <class T> struct Constants {
        T k{"k", per_pascal, from(0), required, "specific wear rate"};
        T p_half{"p_half", pascal, above(0), 1e9, "pressure at which the wear is half Archard's"};
    };
    // What the law promises; leave out what your equation does not keep. The derivative branches at p = 0.
    static constexpr int64_t claims = WL_CLAIM_DETERMINISTIC | WL_CLAIM_NON_NEGATIVE | WL_CLAIM_LINEAR_IN_DT |
                                      WL_CLAIM_ZERO_WITHOUT_PRESSURE | WL_CLAIM_ZERO_WITHOUT_SLIP |
                                      WL_CLAIM_FRAME_INDIFFERENT;
    static constexpr int64_t flags = WL_FLAG_KINKS;

    // What the law does at one point: in (fields), c (constants), state, out (answer).
    int32_t point(const In &in, const C &c, const S &, Out &out) const {
        if (!(in.pressure <= 0.0)) { // a pressure that is no number comes in here, too
            double q = in.pressure / (1.0 + in.pressure / c.p_half);
            out.increment = c.k * q * in.slip;
        } // else: no pressure, no wear; the increment is preset to 0
        // What has no answer gets a status, never a silent NaN or infinity.
        return std::isfinite(out.increment) ? WL_OK : WL_OUT_OF_DOMAIN;
    }
};

WEARLAW_EXPORT(TheLaw)
