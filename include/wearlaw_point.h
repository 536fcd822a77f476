/*
 * wearlaw_point.h: turns a procedure for one point into a complete wear law in C (C99 or later).
 *
 * Describe the law with the LAW_ macros below, include this file once, then write the procedure:
 *
 *     #define LAW_NAME "archard"
 *     #define LAW_VERSION "1.0.0"
 *     #define LAW_SUMMARY "wear depth proportional to pressure and sliding distance"
 *     #define LAW_READS(F) F(pressure) F(slip)
 *     #define LAW_CONSTANTS(C) C(k, WL_PER_PASCAL, WL_FROM(0), WL_REQUIRED, "specific wear rate")
 *     #include "wearlaw_point.h"
 *     WL_POINT {
 *         out->increment = c->k * in->pressure * in->slip;
 *         return WL_OK;
 *     }
 *
 * The batch loop, the checks for absent inputs, the descriptions and the exported entry are made here. The loop loads
 * only what the law declares, so that `in->f` exists only if `f` is declared. README.md explains every macro.
 *
 * SPDX-License-Identifier: MIT OR Apache-2.0
 */

#ifndef WEARLAW_POINT_H
#define WEARLAW_POINT_H

#include "wearlaw.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#if !defined(LAW_NAME) || !defined(LAW_VERSION) || !defined(LAW_SUMMARY)
#error "define LAW_NAME, LAW_VERSION and LAW_SUMMARY before including wearlaw_point.h"
#endif

/* What the law does not say. */
#ifndef LAW_SOURCE
#define LAW_SOURCE "" /* where the equation comes from */
#endif
#ifndef LAW_READS
#define LAW_READS(F) /* F(field) ..: fields the law must have */
#endif
#ifndef LAW_USES
#define LAW_USES(F) /* F(field) ..: fields used if present; ask with WL_HAS(in, field), NaN if absent */
#endif
#ifndef LAW_INPUTS
#define LAW_INPUTS(C) /* C(name, unit, bounds, default, "summary") ..: further inputs, read as in->name */
#endif
#ifndef LAW_CONSTANTS
#define LAW_CONSTANTS(C) /* C(name, unit, bounds, default, "summary") ..: read as c->name */
#endif
#ifndef LAW_STATE
#define LAW_STATE(C) /* C(name, unit, bounds, initial, "summary") ..: start s->name, end out->state.name */
#endif
#ifndef LAW_WRITES
#define LAW_WRITES 0 /* WL_OUT_D_PRESSURE, WL_OUT_DIRECTION or both; the state is understood */
#endif
#ifndef LAW_CLAIMS
#define LAW_CLAIMS 0
#endif
#ifndef LAW_FLAGS
#define LAW_FLAGS 0
#endif
#ifndef LAW_PRESSURE_DEGREE
#define LAW_PRESSURE_DEGREE NAN /* a number, if the increment is homogeneous of that degree in pressure */
#endif
/* LAW_PRESSURE_DEGREE_CONSTANT name: the constant that holds that degree.
 * LAW_CREATE function, LAW_DESTROY function: for laws that need an instance (in->instance).
 * LAW_FILL function: names the filling function instead of exporting the entry (several laws in one library). */

/* Units: exponents of metre, kilogram, second, kelvin. */
#define WL_SI(m, kg, s, K) (m), (kg), (s), (K)
#define WL_NUMBER WL_SI(0, 0, 0, 0)
#define WL_METRE WL_SI(1, 0, 0, 0)
#define WL_PER_METRE WL_SI(-1, 0, 0, 0)
#define WL_SQUARE_METRE WL_SI(2, 0, 0, 0)
#define WL_KILOGRAM WL_SI(0, 1, 0, 0)
#define WL_SECOND WL_SI(0, 0, 1, 0)
#define WL_PER_SECOND WL_SI(0, 0, -1, 0)
#define WL_KELVIN WL_SI(0, 0, 0, 1)
#define WL_PER_KELVIN WL_SI(0, 0, 0, -1)
#define WL_METRE_PER_SECOND WL_SI(1, 0, -1, 0)
#define WL_NEWTON WL_SI(1, 1, -2, 0)
#define WL_JOULE WL_SI(2, 1, -2, 0)
#define WL_PASCAL WL_SI(-1, 1, -2, 0)
#define WL_PER_PASCAL WL_SI(1, -1, 2, 0)
#define WL_PASCAL_PER_KELVIN WL_SI(-1, 1, -2, -1)
#define WL_JOULE_PER_SQUARE_METRE WL_SI(0, 1, -2, 0)
#define WL_WATT_PER_SQUARE_METRE WL_SI(0, 1, -3, 0)
#define WL_KILOGRAM_PER_CUBIC_METRE WL_SI(-3, 1, 0, 0)

/* Bounds in SI: minimum, maximum, flags. WL_CLOSES_UNITS may follow (`WL_FROM(0) WL_CLOSES_UNITS`). */
#define WL_ANY -INFINITY, INFINITY, 0
#define WL_FROM(a) (a), INFINITY, 0
#define WL_ABOVE(a) (a), INFINITY, WL_QUANTITY_ABOVE_MINIMUM
#define WL_BETWEEN(a, b) (a), (b), 0
#define WL_CLOSES_UNITS | WL_QUANTITY_CLOSES_UNITS
#define WL_REQUIRED NAN

/* The kind and the bit of every field. A field that is not here does not compile. */
#define WL_BIT_pressure WL_FIELD_PRESSURE
#define WL_BIT_slip WL_FIELD_SLIP
#define WL_BIT_velocity WL_FIELD_VELOCITY
#define WL_BIT_slip_vector WL_FIELD_SLIP_VECTOR
#define WL_BIT_normal WL_FIELD_NORMAL
#define WL_BIT_coordinates WL_FIELD_COORDINATES
#define WL_BIT_tangent WL_FIELD_TANGENT
#define WL_BIT_temperature WL_FIELD_TEMPERATURE
#define WL_BIT_counter_temperature WL_FIELD_COUNTER_TEMPERATURE
#define WL_BIT_friction_stress WL_FIELD_FRICTION_STRESS
#define WL_BIT_friction_coefficient WL_FIELD_FRICTION_COEFFICIENT
#define WL_BIT_friction_work WL_FIELD_FRICTION_WORK
#define WL_BIT_accumulated_wear WL_FIELD_ACCUMULATED_WEAR
#define WL_BIT_accumulated_slip WL_FIELD_ACCUMULATED_SLIP
#define WL_BIT_nodal_traction WL_FIELD_NODAL_TRACTION
#define WL_BIT_gap WL_FIELD_GAP
#define WL_BIT_area WL_FIELD_AREA
#define WL_BIT_contact_state WL_FIELD_CONTACT_STATE
#define WL_BIT_point_id WL_FIELD_POINT_ID
#define WL_BIT_element_id WL_FIELD_ELEMENT_ID
#define WL_KIND_OF_pressure SCALAR
#define WL_KIND_OF_slip SCALAR
#define WL_KIND_OF_velocity SCALAR
#define WL_KIND_OF_slip_vector VECTOR
#define WL_KIND_OF_normal VECTOR
#define WL_KIND_OF_coordinates VECTOR
#define WL_KIND_OF_tangent VECTOR
#define WL_KIND_OF_temperature SCALAR
#define WL_KIND_OF_counter_temperature SCALAR
#define WL_KIND_OF_friction_stress VECTOR
#define WL_KIND_OF_friction_coefficient SCALAR
#define WL_KIND_OF_friction_work SCALAR
#define WL_KIND_OF_accumulated_wear SCALAR
#define WL_KIND_OF_accumulated_slip SCALAR
#define WL_KIND_OF_nodal_traction SCALAR
#define WL_KIND_OF_gap SCALAR
#define WL_KIND_OF_area SCALAR
#define WL_KIND_OF_contact_state INDEX
#define WL_KIND_OF_point_id INDEX
#define WL_KIND_OF_element_id INDEX
#define WL_PASTE_(a, b) a##b
#define WL_PASTE(a, b) WL_PASTE_(a, b)
#define WL_BY_KIND(what, f) WL_PASTE(what, WL_KIND_OF_##f)(f)

#if defined(__GNUC__)
#define WL_INLINE static inline __attribute__((always_inline))
#define WL_UNUSED __attribute__((unused))
#define WL_RESTRICT __restrict__
#else
#define WL_INLINE static inline
#define WL_UNUSED
#define WL_RESTRICT
#endif
#if defined(__clang__)
#define WL_NO_OVERLAP _Pragma("clang loop vectorize(assume_safety)")
#elif defined(__GNUC__) && __GNUC__ >= 8 /* gcc leaves the loop at one vector a round, bound by its jumps */
#define WL_NO_OVERLAP _Pragma("GCC ivdep") _Pragma("GCC unroll 2")
#elif defined(__GNUC__)
#define WL_NO_OVERLAP _Pragma("GCC ivdep")
#else
#define WL_NO_OVERLAP
#endif

/* What the law's procedure sees. */
#define WL_MEMBER_SCALAR(f) double f;
#define WL_MEMBER_VECTOR(f) double f[3];
#define WL_MEMBER_INDEX(f) int64_t f;
#define WL_MEMBER(f) WL_BY_KIND(WL_MEMBER_, f)
#define WL_MEMBER_QUANTITY(name, unit, bounds, preset, summary) double name;
typedef struct wl_point_in {
    double dt, time;
    const wl_view *call; /* everything that is one value for the call: load_step, cycle, material .. */
    const void *instance;
    int64_t has;
    LAW_READS(WL_MEMBER) LAW_USES(WL_MEMBER) LAW_INPUTS(WL_MEMBER_QUANTITY)
} wl_point_in;
typedef struct wl_point_constants {
    LAW_CONSTANTS(WL_MEMBER_QUANTITY)
    double wl_end;
} wl_point_constants;
typedef struct wl_point_state {
    LAW_STATE(WL_MEMBER_QUANTITY)
    double wl_end;
} wl_point_state;
typedef struct wl_point_out {
    double increment; /* preset 0 */
    double dt_factor; /* with WL_CUT_STEP; preset 0.5 */
#if (LAW_WRITES) & WL_OUT_D_PRESSURE
    double d_pressure; /* preset 0 */
#endif
#if (LAW_WRITES) & WL_OUT_DIRECTION
    double direction[3]; /* preset minus the normal, which the law must read */
#endif
    wl_point_state state; /* preset the state at the start */
    char *wl_text;
    size_t wl_text_size;
} wl_point_out;

/* The law's procedure: `WL_POINT { .. return WL_OK; }` with in, c (constants), s (state at the start) and out. */
#define WL_POINT                                                                                                       \
    WL_INLINE int32_t wl_point(const wl_point_in *in WL_UNUSED, const wl_point_constants *c WL_UNUSED,                 \
                               const wl_point_state *s WL_UNUSED, wl_point_out *out WL_UNUSED)
WL_POINT;
#define WL_HAS(in, field) (((in)->has & WL_BIT_##field) != 0)
/* `return WL_REFUSE(out, WL_OUT_OF_DOMAIN, "pressure %g", in->pressure);` leaves the text for the first worst point. */
#define WL_REFUSE(out, status, ...)                                                                                    \
    ((out)->wl_text ? (void)snprintf((out)->wl_text, (out)->wl_text_size, __VA_ARGS__) : (void)0, (status))

/* Positions, counts and masks. */
#define WL_ENUM_CONSTANT(name, unit, bounds, preset, summary) WL_CONSTANT_##name,
#define WL_ENUM_STATE(name, unit, bounds, preset, summary) WL_STATE_##name,
#define WL_ENUM_INPUT(name, unit, bounds, preset, summary) WL_INPUT_##name,
#define WL_ENUM_SLOT(f) WL_SLOT_##f,
#define WL_ENUM_SLOT_INPUT(name, unit, bounds, preset, summary) WL_SLOT_##name,
#define WL_OR_BIT(f) | WL_BIT_##f
enum { LAW_CONSTANTS(WL_ENUM_CONSTANT) WL_CONSTANT_COUNT };
enum { LAW_STATE(WL_ENUM_STATE) WL_STATE_COUNT };
enum { LAW_INPUTS(WL_ENUM_INPUT) WL_INPUT_COUNT };
enum { LAW_READS(WL_ENUM_SLOT) LAW_USES(WL_ENUM_SLOT) LAW_INPUTS(WL_ENUM_SLOT_INPUT) WL_SLOT_COUNT };
#define WL_LAW_READS ((int64_t)(0 LAW_READS(WL_OR_BIT)))
#define WL_LAW_USES ((int64_t)(0 LAW_USES(WL_OR_BIT)))
#define WL_LAW_WRITES ((int64_t)((LAW_WRITES) | (WL_STATE_COUNT ? WL_OUT_STATE : 0) | WL_OUT_STATUS))


#include "wearlaw_point_loop.h"

#endif /* WEARLAW_POINT_H */
