// Archard's law while running in: K falls from K_0 to K_inf with the sliding distance. README.md has the source.
#include "wearlaw.hpp"

#include <cmath>
using namespace wearlaw;

struct RunningIn : Law<RunningIn> {
    static About about() { return {"running-in", "1.0.0", "Archard wear whose coefficient decays while running in"}; }
    using Reads = Fields<Pressure, Slip>;
    template <class T> struct Constants {
        T K_0{"K_0", number, from(0), required, "wear coefficient of the new surface"};
        T K_inf{"K_inf", number, from(0), required, "wear coefficient after running in"};
        T s_0{"s_0", metre, above(0), required, "sliding distance over which the coefficient falls by 1 - 1/e"};
        T H{"H", pascal, above(0), required, "hardness of the worn body"};
    };
    template <class T> struct State { T distance{"distance", metre, from(0), 0, "sliding distance so far"}; };
    static constexpr int64_t writes = WL_OUT_D_PRESSURE;
    static constexpr int64_t claims = WL_CLAIM_DETERMINISTIC | WL_CLAIM_NON_NEGATIVE | WL_CLAIM_FRAME_INDIFFERENT |
                                      WL_CLAIM_ZERO_WITHOUT_PRESSURE | WL_CLAIM_ZERO_WITHOUT_SLIP;
    static double pressure_degree() { return 1; }
    int32_t point(const In &in, const C &c, const S &s, Out &out) const {
        const double slip = std::fabs(in.slip);
        const double decayed = c.s_0 * std::exp(-s.distance / c.s_0) * -std::expm1(-slip / c.s_0);
        const double fresh = decayed > slip ? slip : decayed; // rounding must not make the rest negative
        const double slope = (c.K_inf * (slip - fresh) + c.K_0 * fresh) / c.H;
        out.d_pressure = in.pressure < 0 ? 0 : slope;
        out.increment = slope * (in.pressure < 0 ? 0 : in.pressure);
        out.state.distance = s.distance + slip;
        if (!std::isfinite(out.increment + out.state.distance)) {
            return out.refuse(WL_OUT_OF_DOMAIN, "no finite wear at pressure %g, slip %g", in.pressure, in.slip);
        }
        return WL_OK;
    }
};
WEARLAW_EXPORT(RunningIn)
