// Archard's law with exponents, in the order of operations that every language here writes.
#include "wearlaw.hpp"
#include <cmath>
using namespace wearlaw;
struct Archard : Law<Archard> {
    static About about() { return {"archard-cpp", "1.0.0", "K / H * p^m * v^n * dt"}; }
    using Reads = Fields<Pressure, Velocity>;
    template <class T> struct Constants {
        T K{"K", number, from(0).closes_units(), required, "wear coefficient"};
        T H{"H", pascal, above(0), required, "hardness"};
        T m{"m", number, from(0), 1, "pressure exponent"};
        T n{"n", number, from(0), 1, "velocity exponent"};
    };
    static constexpr int64_t writes = WL_OUT_D_PRESSURE;
    static constexpr int64_t claims = WL_CLAIM_DETERMINISTIC | WL_CLAIM_NON_NEGATIVE | WL_CLAIM_LINEAR_IN_DT;
    static const char *pressure_degree_constant() { return "m"; }
    int32_t point(const In &in, const C &c, const S &, Out &out) const {
        const double p = in.pressure;
        const double wear = p <= 0 ? 0 : c.K / c.H * std::pow(p, c.m) * std::pow(in.velocity, c.n) * in.dt;
        out.increment = wear;
        out.d_pressure = p <= 0 ? 0 : c.m * wear / p;
        return std::isfinite(wear) ? WL_OK : out.refuse(WL_OUT_OF_DOMAIN, "no finite wear at pressure %g", p);
    }
};
WEARLAW_EXPORT(Archard)
