/*
 * wearlaw.hpp: turns a class with a procedure for one point into a complete wear law in C++ (C++11 or later).
 *
 *     #include "wearlaw.hpp"
 *     using namespace wearlaw;
 *     struct Archard : Law<Archard> {
 *         static About about() { return {"archard", "1.0.0", "wear proportional to pressure and sliding distance"}; }
 *         using Reads = Fields<Pressure, Slip>;
 *         template <class T> struct Constants {
 *             T k{"k", per_pascal, from(0), required, "specific wear rate"};
 *         };
 *         int32_t point(const In &in, const C &c, const S &, Out &out) const {
 *             out.increment = c.k * in.pressure * in.slip;
 *             return WL_OK;
 *         }
 *     };
 *     WEARLAW_EXPORT(Archard)
 *
 * The batch loop (wearlaw_loop.hpp), the checks for absent inputs, the descriptions and the exported entry are made
 * here; an exception becomes WL_FAILED with its text. `in.f` exists only if the field is in Reads or Uses.
 * README.md explains every member a law can have.
 *
 * SPDX-License-Identifier: MIT OR Apache-2.0
 */

#ifndef WEARLAW_HPP
#define WEARLAW_HPP

#include "wearlaw.h"

#include <cstdarg>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <exception>
#include <limits>
#include <type_traits>

#if defined(__GNUC__)
#define WEARLAW_INLINE inline __attribute__((always_inline))
#define WEARLAW_RESTRICT __restrict__
#define WEARLAW_FORMAT(text, values) __attribute__((format(printf, text, values)))
#else
#define WEARLAW_INLINE inline
#define WEARLAW_RESTRICT
#define WEARLAW_FORMAT(text, values)
#endif
#if defined(__clang__)
#define WEARLAW_NO_OVERLAP _Pragma("clang loop vectorize(assume_safety)")
#elif defined(__GNUC__) && __GNUC__ >= 8 /* gcc leaves the loop at one vector a round, bound by its jumps */
#define WEARLAW_NO_OVERLAP _Pragma("GCC ivdep") _Pragma("GCC unroll 2")
#elif defined(__GNUC__)
#define WEARLAW_NO_OVERLAP _Pragma("GCC ivdep")
#else
#define WEARLAW_NO_OVERLAP
#endif

namespace wearlaw {

/* Units: exponents of metre, kilogram, second, kelvin. */
struct Unit {
    double metre, kilogram, second, kelvin;
};
constexpr Unit number{0, 0, 0, 0};
constexpr Unit metre{1, 0, 0, 0};
constexpr Unit per_metre{-1, 0, 0, 0};
constexpr Unit square_metre{2, 0, 0, 0};
constexpr Unit kilogram{0, 1, 0, 0};
constexpr Unit second{0, 0, 1, 0};
constexpr Unit per_second{0, 0, -1, 0};
constexpr Unit kelvin{0, 0, 0, 1};
constexpr Unit per_kelvin{0, 0, 0, -1};
constexpr Unit metre_per_second{1, 0, -1, 0};
constexpr Unit newton{1, 1, -2, 0};
constexpr Unit joule{2, 1, -2, 0};
constexpr Unit pascal{-1, 1, -2, 0};
constexpr Unit per_pascal{1, -1, 2, 0};
constexpr Unit pascal_per_kelvin{-1, 1, -2, -1};
constexpr Unit joule_per_square_metre{0, 1, -2, 0};
constexpr Unit watt_per_square_metre{0, 1, -3, 0};
constexpr Unit kilogram_per_cubic_metre{-3, 1, 0, 0};

/* Bounds in SI. `from(0).closes_units()`: the unit of this constant follows from the others. */
constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double required = std::numeric_limits<double>::quiet_NaN();
struct Bounds {
    double minimum, maximum;
    int64_t flags;
    constexpr Bounds closes_units() const { return Bounds{minimum, maximum, flags | WL_QUANTITY_CLOSES_UNITS}; }
};
constexpr Bounds any{-infinity, infinity, 0};
constexpr Bounds from(double a) { return Bounds{a, infinity, 0}; }
constexpr Bounds above(double a) { return Bounds{a, infinity, WL_QUANTITY_ABOVE_MINIMUM}; }
constexpr Bounds between(double a, double b) { return Bounds{a, b, 0}; }

/* What T stands for in a law's Constants<T>, State<T> and Inputs<T>: its value in the loop, its description outside. */
struct Value {
    double value;
    Value(const char *, Unit, Bounds, double, const char *) : value(0) {}
    Value &operator=(double v) {
        value = v;
        return *this;
    }
    operator double() const { return value; }
};
struct Described {
    const char *name;
    Unit unit;
    Bounds bounds;
    double preset;
    const char *summary;
    Described(const char *n, Unit u, Bounds b, double p, const char *s)
        : name(n), unit(u), bounds(b), preset(p), summary(s) {}
};

struct About {
    const char *name, *version, *summary, *source;
    About(const char *n, const char *v, const char *s, const char *from_where = "")
        : name(n), version(v), summary(s), source(from_where) {}
};

/* The fields: what each adds to In, its bit and its column. */
#define WEARLAW_FIELD(Tag, field, Bit, Column_, member, is_scalar, load)                                               \
    struct Tag {                                                                                                       \
        member;                                                                                                        \
        struct Meta {                                                                                                  \
            typedef Column_ Column;                                                                                    \
            static constexpr int64_t bit() { return Bit; }                                                             \
            static constexpr bool scalar() { return is_scalar; }                                                       \
            static const char *name() { return #field; }                                                               \
            static const Column &of(const wl_view &v) { return v.field; }                                              \
            template <class P> static WEARLAW_INLINE void put(Tag &in, P p) { load }                                   \
        };                                                                                                             \
    };
#define WEARLAW_SCALAR(Tag, field, Bit)                                                                                \
    WEARLAW_FIELD(Tag, field, Bit, wl_column, double field, true, in.field = *p;)
#define WEARLAW_VECTOR(Tag, field, Bit)                                                                                \
    WEARLAW_FIELD(Tag, field, Bit, wl_column, double field[3], false, in.field[0] = p[0]; in.field[1] = p[1];          \
                  in.field[2] = p[2];)
#define WEARLAW_INDEX(Tag, field, Bit)                                                                                 \
    WEARLAW_FIELD(Tag, field, Bit, wl_index_column, int64_t field, false, in.field = *p;)
WEARLAW_SCALAR(Pressure, pressure, WL_FIELD_PRESSURE)
WEARLAW_SCALAR(Slip, slip, WL_FIELD_SLIP)
WEARLAW_SCALAR(Velocity, velocity, WL_FIELD_VELOCITY)
WEARLAW_VECTOR(SlipVector, slip_vector, WL_FIELD_SLIP_VECTOR)
WEARLAW_VECTOR(Normal, normal, WL_FIELD_NORMAL)
WEARLAW_VECTOR(Coordinates, coordinates, WL_FIELD_COORDINATES)
WEARLAW_VECTOR(Tangent, tangent, WL_FIELD_TANGENT)
WEARLAW_SCALAR(Temperature, temperature, WL_FIELD_TEMPERATURE)
WEARLAW_SCALAR(CounterTemperature, counter_temperature, WL_FIELD_COUNTER_TEMPERATURE)
WEARLAW_VECTOR(FrictionStress, friction_stress, WL_FIELD_FRICTION_STRESS)
WEARLAW_SCALAR(FrictionCoefficient, friction_coefficient, WL_FIELD_FRICTION_COEFFICIENT)
WEARLAW_SCALAR(FrictionWork, friction_work, WL_FIELD_FRICTION_WORK)
WEARLAW_SCALAR(AccumulatedWear, accumulated_wear, WL_FIELD_ACCUMULATED_WEAR)
WEARLAW_SCALAR(AccumulatedSlip, accumulated_slip, WL_FIELD_ACCUMULATED_SLIP)
WEARLAW_SCALAR(NodalTraction, nodal_traction, WL_FIELD_NODAL_TRACTION)
WEARLAW_SCALAR(Gap, gap, WL_FIELD_GAP)
WEARLAW_SCALAR(Area, area, WL_FIELD_AREA)
WEARLAW_INDEX(ContactState, contact_state, WL_FIELD_CONTACT_STATE)
WEARLAW_INDEX(PointId, point_id, WL_FIELD_POINT_ID)
WEARLAW_INDEX(ElementId, element_id, WL_FIELD_ELEMENT_ID)
#undef WEARLAW_SCALAR
#undef WEARLAW_VECTOR
#undef WEARLAW_INDEX
#undef WEARLAW_FIELD

template <class... Tags> struct Fields : Tags... {};

namespace detail {

/* Writes a text for the first worst point; the loop itself never gives a buffer, so that no text is made there. */
inline void say(char *text, std::size_t size, const char *format, ...) WEARLAW_FORMAT(3, 4);
inline void say(char *text, std::size_t size, const char *format, ...) {
    va_list values;
    va_start(values, format);
    (void)std::vsnprintf(text, size, format, values);
    va_end(values);
}

template <class List> struct Read : List {};
template <class List> struct Used : List {};
template <class L> struct In : Read<typename L::Reads>, Used<typename L::Uses>, L::template Inputs<Value> {
    double dt, time;
    const wl_view *call; /* everything that is one value for the call: load_step, cycle, material .. */
    int64_t given;       /* bits of the fields in Uses that are there */
    template <class Tag> bool has() const { return (given & Tag::Meta::bit()) != 0; }
};
template <class L> struct Constants : L::template Constants<Value> {};
template <class L> struct State : L::template State<Value> {};

struct Slope {
    double d_pressure;
};
struct Direction {
    double direction[3];
};
template <int> struct Nothing {};
template <class L>
struct Out : std::conditional<(L::writes & WL_OUT_D_PRESSURE) != 0, Slope, Nothing<0>>::type,
             std::conditional<(L::writes & WL_OUT_DIRECTION) != 0, Direction, Nothing<1>>::type {
    double increment; /* preset 0, as d_pressure; a direction is preset to minus the normal */
    double dt_factor; /* with WL_CUT_STEP; preset 0.5 */
    State<L> state;   /* preset the state at the start */
    char *text;
    std::size_t text_size;
    /* `return out.refuse(WL_OUT_OF_DOMAIN, "pressure %g", in.pressure);` */
    template <class... A> WEARLAW_INLINE int32_t refuse(int32_t status, const char *format, A... values) {
        if (text) {
            say(text, text_size, format, values...);
        }
        return status;
    }
};

} // namespace detail

/* The base of a law: what a law does not say. */
template <class L> struct Law {
    using Reads = Fields<>;                    /* fields the law must have */
    using Uses = Fields<>;                     /* fields used if present: in.has<Temperature>(); NaN if absent */
    template <class T> struct Constants {};    /* c.name */
    template <class T> struct State {};        /* start s.name, end out.state.name */
    template <class T> struct Inputs {};       /* further inputs, in.name */
    static constexpr int64_t writes = 0;       /* WL_OUT_D_PRESSURE, WL_OUT_DIRECTION; the state is understood */
    static constexpr int64_t claims = 0;
    static constexpr int64_t flags = 0;
    static double pressure_degree() { return required; }
    static const char *pressure_degree_constant() { return ""; }

    typedef detail::In<L> In;
    typedef detail::Constants<L> C;
    typedef detail::State<L> S;
    typedef detail::Out<L> Out;
};

} // namespace wearlaw

#include "wearlaw_loop.hpp"
#include "wearlaw_entry.hpp"

/* Exports the laws given, in this order. */
#define WEARLAW_EXPORT(...)                                                                                            \
    extern "C" WL_EXPORT int32_t wearlaw_entry_1(int32_t index, const wl_host *, wl_law *law) {                        \
        return wearlaw::detail::Entry<__VA_ARGS__>::fill(index, law);                                                  \
    }

#endif /* WEARLAW_HPP */
