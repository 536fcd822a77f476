/*
 * sound_law.hpp: the law of sound_law.h, written with the C++ helper; faulty laws derive from it.
 *
 * A faulty law overrides `evaluate_batch` or `create_instance`, which stand in front of the helper's own functions, so
 * that nothing of the fault is caught there.
 */
#ifndef SOUND_LAW_HPP
#define SOUND_LAW_HPP

#include "wearlaw.hpp"

#include <cmath>

using namespace wearlaw;

struct Sound : Law<Sound> {
    static About about() { return {LAW_NAME, "1.0.0", "wear proportional to pressure and slip"}; }
    using Reads = Fields<Pressure, Slip, Normal>;
    template <class T> struct Constants {
        T K{"K", number, from(0), 1e-4, "wear coefficient"};
        T H{"H", pascal, above(0), 2e9, "hardness of the worn body"};
    };
    template <class T> struct State {
        T distance{"distance", metre, from(0), 0, "sliding distance so far"};
        T work{"work", joule_per_square_metre, from(0), 0, "pressure times sliding distance so far"};
    };
    static constexpr int64_t writes = WL_OUT_D_PRESSURE | WL_OUT_DIRECTION;
    static constexpr int64_t claims = WL_CLAIMS_KNOWN;
    static double pressure_degree() { return 1; }
    int32_t point(const In &in, const C &c, const S &s, Out &out) const {
        const double pressure = in.pressure < 0 ? 0 : in.pressure, slip = std::fabs(in.slip);
        const double slope = c.K / c.H * slip;
        out.d_pressure = in.pressure < 0 ? 0 : slope;
        out.increment = c.K / c.H * pressure * slip;
        out.state.distance = s.distance + slip;
        out.state.work = s.work + pressure * slip;
        const double all = out.increment + slope + out.state.distance + out.state.work + out.direction[0] +
                           out.direction[1] + out.direction[2];
        if (!std::isfinite(all) || !std::isfinite(c.H) || !(c.K >= 0) || !(c.H > 0)) {
            return out.refuse(WL_OUT_OF_DOMAIN, "an input is not finite or out of its bounds");
        }
        return WL_OK;
    }
};

/* The functions of the helper, and the entry that puts a law's own in front of them. */
static wl_law sound;
#define EXPORT_SOUND_LAW(replace)                                                                                      \
    extern "C" WL_EXPORT int32_t wearlaw_entry_1(int32_t index, const wl_host *, wl_law *law) {                        \
        const int32_t status = detail::Entry<Sound>::fill(index, law);                                                 \
        if (status == WL_OK) {                                                                                         \
            sound.evaluate = law->evaluate;                                                                            \
            replace;                                                                                                   \
        }                                                                                                              \
        return status;                                                                                                 \
    }

#endif /* SOUND_LAW_HPP */
