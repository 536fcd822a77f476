// A law that touches every part of the helper; its siblings in C and Fortran compute the same.
#include "wearlaw.hpp"
using namespace wearlaw;

struct Everything : Law<Everything> {
    static About about() { return {"everything-cpp", "1.2.3", "every part of the helper", "none"}; }
    using Reads = Fields<Pressure, Normal, ContactState, SlipVector>;
    using Uses = Fields<Temperature, Tangent, PointId>;
    template <class T> struct Inputs {
        T film{"film", metre, above(0), 2, "film thickness"};
        T humidity{"humidity", number, any, 0.5, "humidity"};
    };
    template <class T> struct Constants { T k{"k", per_pascal, between(0, 1), required, "specific wear rate"}; };
    template <class T> struct State {
        T total{"total", metre, any, 0, "wear so far"};
        T calls{"calls", number, any, 1, "substeps so far"};
    };
    static constexpr int64_t writes = WL_OUT_D_PRESSURE | WL_OUT_DIRECTION;
    static constexpr int64_t flags = WL_FLAG_OPEN_POINTS;
    static double pressure_degree() { return 1; }

    int32_t point(const In &in, const C &c, const S &s, Out &out) const {
        const double scale = in.has<Temperature>() ? in.temperature - in.call->absolute_zero : 3;
        const double slip = in.slip_vector[0] + 2 * in.slip_vector[1] + 3 * in.slip_vector[2];
        const double twice = in.has<PointId>() && in.point_id % 2 ? 2 : 1;
        const double slope = c.k * slip * in.film * in.humidity * scale * twice;
        out.d_pressure = in.contact_state == WL_OPEN ? 0 : slope;
        out.increment = out.d_pressure * in.pressure;
        if (in.has<Tangent>()) {
            out.direction[0] = in.tangent[2];
            out.direction[1] = in.tangent[0];
            out.direction[2] = in.tangent[1];
        }
        out.state.total = s.total + out.increment;
        out.state.calls = s.calls + 1;
        out.dt_factor = 0.25;
        if (in.pressure > 1e8) {
            return out.refuse(WL_CUT_STEP, "point %d", in.has<PointId>() ? int(in.point_id) : -1);
        }
        return in.pressure > 9e7 ? WL_UNRELIABLE : in.pressure < -1 ? 17 : WL_OK;
    }
};

// Throws at construction and at evaluation: what() must arrive as the text.
struct Thrower : Law<Thrower> {
    struct Complaint : std::exception {
        const char *what() const noexcept override { return "the table has no row"; }
    };
    static About about() { return {"thrower", "1.0.0", "throws"}; }
    using Reads = Fields<Slip>;
    double limit;
    explicit Thrower(const char *options) : limit(options[0] == '5' ? 5 : 0) {
        if (options[0] == '!') {
            throw Complaint();
        }
    }
    int32_t point(const In &in, const C &, const S &, Out &out) const {
        if (in.slip > limit) {
            throw Complaint();
        }
        out.increment = in.slip;
        return WL_OK;
    }
};
WEARLAW_EXPORT(Everything, Thrower)
