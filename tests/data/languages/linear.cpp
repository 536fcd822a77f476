// The linear law of point_bench.c.
#include "wearlaw.hpp"
using namespace wearlaw;
struct Linear : Law<Linear> {
    static About about() { return {"linear-cpp", "1.0.0", "wear proportional to pressure and sliding distance"}; }
    using Reads = Fields<Pressure, Slip>;
    template <class T> struct Constants {
        T K{"K", number, from(0), required, "wear coefficient"};
        T H{"H", pascal, above(0), required, "hardness"};
    };
    static constexpr int64_t writes = WL_OUT_D_PRESSURE;
    int32_t point(const In &in, const C &c, const S &, Out &out) const {
        double p = in.pressure > 0 ? in.pressure : 0;
        out.d_pressure = c.K / c.H * in.slip;
        out.increment = out.d_pressure * p;
        return WL_OK;
    }
};
WEARLAW_EXPORT(Linear)
