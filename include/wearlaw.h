/*
 * wearlaw.h: the C ABI of wear laws, major version 1.
 *
 * A wear law is a shared library that exports one function, wearlaw_entry_1. The host calls it with index 0, 1, ..
 * until it answers WL_NO_MORE; each call fills one wl_law. The law is then created, evaluated and destroyed through
 * the functions in that table. Every struct begins with its size: touch min(struct_size, sizeof) of a struct that the
 * other side has allocated. wearlaw_point.h turns a procedure for one point into all of this.
 *
 * SPDX-License-Identifier: MIT OR Apache-2.0
 */


#ifndef WEARLAW_H
#define WEARLAW_H

/* Generated from plugin-api by cbindgen; `WEARLAW_REGENERATE=1 cargo test --test headers` writes it anew. */

#include <stddef.h>
#include <stdint.h>
#if defined(_WIN32)
#define WL_EXPORT __declspec(dllexport)
#elif defined(__GNUC__)
#define WL_EXPORT __attribute__((visibility("default")))
#else
#define WL_EXPORT
#endif


/*
 Major version of the ABI; part of the entry's name, so that two majors can never meet.
 */
#define WL_ABI_MAJOR 1

/*
 Minor version of the ABI that this header describes; fields are only ever appended between minors.
 */
#define WL_ABI_MINOR 0

/*
 Bytes of a name, with its closing NUL.
 */
#define WL_NAME_SIZE 64

/*
 Bytes of a version text, with its closing NUL.
 */
#define WL_VERSION_SIZE 32

/*
 Bytes of a summary or source text, with its closing NUL.
 */
#define WL_SUMMARY_SIZE 256

/*
 The values are good.
 */
#define WL_OK 0

/*
 The values may be used, with a warning: near the edge of what the law was made for.
 */
#define WL_UNRELIABLE 1

/*
 The values are void; a substep shorter by the output's `dt_factor` may work.
 */
#define WL_CUT_STEP 2

/*
 The values are void; the inputs are outside what the law can answer, and a shorter substep does not help.
 */
#define WL_OUT_OF_DOMAIN 3

/*
 The values are void; an input that the law needs was not given (bits in the output's `missing`).
 */
#define WL_MISSING_INPUT 4

/*
 The values are void; the law failed. A host takes every value it does not know for this one.
 */
#define WL_FAILED 5

/*
 Answer of the entry and of `describe` past the last index.
 */
#define WL_NO_MORE -1

/*
 Field bit. Contact pressure, positive in compression.
 */
#define WL_FIELD_PRESSURE 1

/*
 Field bit. Slip increment: length of the slip path over the substep, never negative.
 */
#define WL_FIELD_SLIP 2

/*
 Field bit. Sliding velocity: slip increment over `dt`, never negative.
 */
#define WL_FIELD_VELOCITY 4

/*
 Field bit. Net tangential displacement of the worn body relative to the counter body over the substep, 3 components.
 */
#define WL_FIELD_SLIP_VECTOR 8

/*
 Field bit. Outward unit normal of the worn body, 3 components.
 */
#define WL_FIELD_NORMAL 16

/*
 Field bit. Position of the point, 3 components.
 */
#define WL_FIELD_COORDINATES 32

/*
 Field bit. First unit tangent, 3 components.
 */
#define WL_FIELD_TANGENT 64

/*
 Field bit. Temperature of the worn surface.
 */
#define WL_FIELD_TEMPERATURE 128

/*
 Field bit. Temperature of the counter surface.
 */
#define WL_FIELD_COUNTER_TEMPERATURE 256

/*
 Field bit. Friction stress that acts on the worn body, 3 components.
 */
#define WL_FIELD_FRICTION_STRESS 512

/*
 Field bit. Friction coefficient.
 */
#define WL_FIELD_FRICTION_COEFFICIENT 1024

/*
 Field bit. Dissipated friction work per area over the substep (path integral, never negative).
 */
#define WL_FIELD_FRICTION_WORK 2048

/*
 Field bit. Wear depth at the start of the substep.
 */
#define WL_FIELD_ACCUMULATED_WEAR 4096

/*
 Field bit. Sliding distance at the start of the substep.
 */
#define WL_FIELD_ACCUMULATED_SLIP 8192

/*
 Field bit. Normal traction from nodal stresses, max(0, -n.sigma.n).
 */
#define WL_FIELD_NODAL_TRACTION 16384

/*
 Field bit. Gap between the surfaces; negative is penetration.
 */
#define WL_FIELD_GAP 32768

/*
 Field bit. Area that belongs to the point (length in 2-D).
 */
#define WL_FIELD_AREA 65536

/*
 Field bit. Contact state: `WL_OPEN`, `WL_STICK` or `WL_SLIDING` (index column).
 */
#define WL_FIELD_CONTACT_STATE 131072

/*
 Field bit. Number of the point in the host's numbering (index column).
 */
#define WL_FIELD_POINT_ID 262144

/*
 Field bit. Number of the contact element (index column).
 */
#define WL_FIELD_ELEMENT_ID 524288

/*
 All field bits that this version of the ABI knows.
 */
#define WL_FIELDS_KNOWN 1048575

/*
 Output bit. Wear direction, 3 components a point.
 */
#define WL_OUT_DIRECTION 1

/*
 Output bit. State variables at the end of the substep.
 */
#define WL_OUT_STATE 2

/*
 Output bit. Derivative of the wear increment with respect to the contact pressure.
 */
#define WL_OUT_D_PRESSURE 4

/*
 Output bit. Status of every point.
 */
#define WL_OUT_STATUS 8

/*
 All output bits that this version of the ABI knows.
 */
#define WL_OUTS_KNOWN 15

/*
 Claim bit. The same inputs give the same bits, whatever the batch, the thread or the process.
 */
#define WL_CLAIM_DETERMINISTIC 1

/*
 Claim bit. The wear increment is never negative.
 */
#define WL_CLAIM_NON_NEGATIVE 2

/*
 Claim bit. At fixed rates a substep wears as much as its equal parts, one after the other: without state variables, the
 increment is proportional to `dt` (slip and friction work scale with it).
 */
#define WL_CLAIM_LINEAR_IN_DT 4

/*
 Claim bit. No pressure, no wear.
 */
#define WL_CLAIM_ZERO_WITHOUT_PRESSURE 8

/*
 Claim bit. No slip, no wear.
 */
#define WL_CLAIM_ZERO_WITHOUT_SLIP 16

/*
 Claim bit. Turning the frame turns the direction and leaves the increment.
 */
#define WL_CLAIM_FRAME_INDIFFERENT 32

/*
 All claim bits that this version of the ABI knows.
 */
#define WL_CLAIMS_KNOWN 63

/*
 Law flag. One instance must not be evaluated from several threads at once.
 */
#define WL_FLAG_SERIAL 1

/*
 Law flag. The law wants points out of contact too (oxide growth, healing); otherwise the host copies their state.
 */
#define WL_FLAG_OPEN_POINTS 2

/*
 Law flag. The derivative has jumps where the law changes branch.
 */
#define WL_FLAG_KINKS 4

/*
 All law flags that this version of the ABI knows.
 */
#define WL_FLAGS_KNOWN 7

/*
 Quantity flag. The unit of this constant follows from the others (at most one constant of a law has it).
 */
#define WL_QUANTITY_CLOSES_UNITS 1

/*
 Quantity flag. The minimum itself is excluded.
 */
#define WL_QUANTITY_ABOVE_MINIMUM 2

/*
 Quantity flag. The maximum itself is excluded.
 */
#define WL_QUANTITY_BELOW_MAXIMUM 4

/*
 What `describe` is asked for: a constant.
 */
#define WL_KIND_CONSTANT 0

/*
 What `describe` is asked for: a state variable.
 */
#define WL_KIND_STATE 1

/*
 What `describe` is asked for: a further input that the law declares by name.
 */
#define WL_KIND_INPUT 2

/*
 What `describe` is asked for: the name of a field; `index` is the number of its bit.
 */
#define WL_KIND_FIELD 3

/*
 Contact state: not in contact.
 */
#define WL_OPEN 0

/*
 Contact state: in contact, not sliding.
 */
#define WL_STICK 1

/*
 Contact state: in contact and sliding.
 */
#define WL_SLIDING 2

/*
 What the host is and what it can give; filled by the host, constant.
 */
typedef struct wl_host {
  /*
   Bytes of this struct, set by the host.
   */
  int64_t struct_size;
  /*
   Minor version of the ABI that the host speaks.
   */
  int64_t abi_minor;
  /*
   Field bits that the host knows.
   */
  int64_t provides;
  /*
   Output bits that the host knows.
   */
  int64_t accepts;
  /*
   Name of the host, NUL-terminated.
   */
  char name[WL_NAME_SIZE];
  /*
   Version of the host, NUL-terminated.
   */
  char version[WL_VERSION_SIZE];
} wl_host;

/*
 One constant, state variable or further input of a law; allocated by the host, filled by the law's `describe`.

 Bounds and default are in SI units; a host that knows the sizes of its units converts them.
 */
typedef struct wl_quantity {
  /*
   Bytes of this struct, set by the host.
   */
  int64_t struct_size;
  /*
   Name: a letter, then letters, digits and underscores; NUL-terminated.
   */
  char name[WL_NAME_SIZE];
  /*
   One line on what it is, NUL-terminated.
   */
  char summary[WL_SUMMARY_SIZE];
  /*
   SI exponent of the metre.
   */
  double metre;
  /*
   SI exponent of the kilogram.
   */
  double kilogram;
  /*
   SI exponent of the second.
   */
  double second;
  /*
   SI exponent of the kelvin.
   */
  double kelvin;
  /*
   Smallest value allowed (-infinity: none).
   */
  double minimum;
  /*
   Largest value allowed (infinity: none).
   */
  double maximum;
  /*
   Default of a constant or input, initial value of a state variable; NaN: it must be given.
   */
  double default_value;
  /*
   `WL_QUANTITY_` bits.
   */
  int64_t flags;
} wl_quantity;

/*
 A real input: `ptr` NULL means absent, `step` is the number of doubles from point to point (0: one value for all).

 Vectors have their 3 components adjacent at `ptr + i * step`, in the global frame, also in 2-D.
 */
typedef struct wl_column {
  /*
   First value, or NULL.
   */
  const double *ptr;
  /*
   Doubles from one point to the next.
   */
  int64_t step;
} wl_column;

/*
 An integer input; as [`Column`], with `step` counted in 64-bit integers.
 */
typedef struct wl_index_column {
  /*
   First value, or NULL.
   */
  const int64_t *ptr;
  /*
   Integers from one point to the next.
   */
  int64_t step;
} wl_index_column;

/*
 The inputs of one call: points of one surface, the worn body, over one substep.

 Inputs are constant over the substep. Units are the scene's own, consistent set.
 */
typedef struct wl_view {
  /*
   Bytes of this struct, set by the host.
   */
  int64_t struct_size;
  /*
   Number of points.
   */
  int64_t points;
  /*
   Dimension of the scene, 2 or 3.
   */
  int64_t dimension;
  /*
   Output bits that are wanted; the same as the output pointers that are not NULL.
   */
  int64_t request;
  /*
   Time at the start of the substep.
   */
  double time;
  /*
   Duration of the substep (represented time).
   */
  double dt;
  /*
   Time since the start of the load step.
   */
  double step_time;
  /*
   Number of the load step, from 1.
   */
  int64_t load_step;
  /*
   Number of the substep in its load step, from 1.
   */
  int64_t substep;
  /*
   Number of the cycle, from 1; 0 outside cycles.
   */
  int64_t cycle;
  /*
   Number of the wear material.
   */
  int64_t material;
  /*
   Number of the contact pair.
   */
  int64_t pair;
  /*
   Number of the worn body.
   */
  int64_t body;
  /*
   Number of the counter body.
   */
  int64_t counter_body;
  /*
   Reference temperature, in the scene's temperature scale.
   */
  double reference_temperature;
  /*
   Temperature of absolute zero, in the scene's temperature scale.
   */
  double absolute_zero;
  /*
   Size of the scene's unit of length in metres; 0: not stated.
   */
  double unit_metre;
  /*
   Size of the scene's unit of mass in kilograms; 0: not stated.
   */
  double unit_kilogram;
  /*
   Size of the scene's unit of time in seconds; 0: not stated.
   */
  double unit_second;
  /*
   Size of the scene's degree of temperature in kelvin; 0: not stated.
   */
  double unit_kelvin;
  /*
   Number of columns in `constants`: what the law declared.
   */
  int64_t constant_count;
  /*
   Constants, one column each `[constant_count]`.
   */
  const struct wl_column *constants;
  /*
   Number of columns in `inputs`: what the law declared.
   */
  int64_t input_count;
  /*
   Further inputs, one column each `[input_count]`.
   */
  const struct wl_column *inputs;
  /*
   Number of state variables at a point: what the law declared.
   */
  int64_t state_count;
  /*
   State variables at the start of the substep `[points][state_count]`, the variables of a point adjacent.
   */
  struct wl_column state;
  /*
   Contact pressure `[points]`, positive in compression; pressure.
   */
  struct wl_column pressure;
  /*
   Slip increment `[points]`: path length over the substep; length.
   */
  struct wl_column slip;
  /*
   Sliding velocity `[points]`; length per time.
   */
  struct wl_column velocity;
  /*
   Net slip displacement `[points][3]`; length.
   */
  struct wl_column slip_vector;
  /*
   Outward unit normal of the worn body `[points][3]`.
   */
  struct wl_column normal;
  /*
   Position `[points][3]`; length.
   */
  struct wl_column coordinates;
  /*
   First unit tangent `[points][3]`.
   */
  struct wl_column tangent;
  /*
   Temperature of the worn surface `[points]`.
   */
  struct wl_column temperature;
  /*
   Temperature of the counter surface `[points]`.
   */
  struct wl_column counter_temperature;
  /*
   Friction stress on the worn body `[points][3]`; pressure.
   */
  struct wl_column friction_stress;
  /*
   Friction coefficient `[points]`.
   */
  struct wl_column friction_coefficient;
  /*
   Friction work per area over the substep `[points]`; pressure times length.
   */
  struct wl_column friction_work;
  /*
   Wear depth at the start of the substep `[points]`; length.
   */
  struct wl_column accumulated_wear;
  /*
   Sliding distance at the start of the substep `[points]`; length.
   */
  struct wl_column accumulated_slip;
  /*
   Normal traction from nodal stresses `[points]`; pressure.
   */
  struct wl_column nodal_traction;
  /*
   Gap `[points]`, negative is penetration; length.
   */
  struct wl_column gap;
  /*
   Area of the point `[points]`; length squared (length in 2-D).
   */
  struct wl_column area;
  /*
   Contact state `[points]`: `WL_OPEN`, `WL_STICK` or `WL_SLIDING`.
   */
  struct wl_index_column contact_state;
  /*
   Number of the point in the host's numbering `[points]`.
   */
  struct wl_index_column point_id;
  /*
   Number of the contact element `[points]`.
   */
  struct wl_index_column element_id;
} wl_view;

/*
 Where the answers of one call go: arrays of the host, contiguous, never overlapping an input.

 A law writes every item whose pointer is given, and nothing else.
 */
typedef struct wl_output {
  /*
   Bytes of this struct, set by the host.
   */
  int64_t struct_size;
  /*
   Wear increment over the substep `[points]`; length. Never NULL.
   */
  double *increment;
  /*
   Wear direction `[points][3]`, unit length; or NULL.
   */
  double *direction;
  /*
   State variables at the end of the substep `[points][state_count]`; or NULL.
   */
  double *state;
  /*
   Status of every point `[points]`; or NULL.
   */
  int32_t *status;
  /*
   For the law to set on a bad status: index of the first bad point in this call (preset -1).
   */
  int64_t first_bad;
  /*
   For the law to set with `WL_CUT_STEP`: factor in (0, 1) for the next try (preset 0).
   */
  double dt_factor;
  /*
   For the law to set with `WL_MISSING_INPUT`: field bits of what is missing (preset 0).
   */
  int64_t missing;
  /*
   Buffer for a text on what went wrong `[text_size]`, NUL-terminated by the law; may be NULL.
   */
  char *text;
  /*
   Bytes of `text`.
   */
  int64_t text_size;
  /*
   Derivative of the increment with respect to the pressure `[points]`; length per pressure; or NULL.
   */
  double *d_pressure;
} wl_output;

/*
 What a law is and its functions; allocated, zeroed and given defaults by the host, filled by the entry.
 */
typedef struct wl_law {
  /*
   Bytes of this struct, set by the host.
   */
  int64_t struct_size;
  /*
   Minor version of the ABI that the law was built for.
   */
  int64_t abi_minor;
  /*
   Name of the law: letters, digits, `-` and `_`; NUL-terminated.
   */
  char name[WL_NAME_SIZE];
  /*
   Version of the law, NUL-terminated.
   */
  char version[WL_VERSION_SIZE];
  /*
   One line on what the law does, NUL-terminated.
   */
  char summary[WL_SUMMARY_SIZE];
  /*
   Where its equation comes from, NUL-terminated; may be empty.
   */
  char source[WL_SUMMARY_SIZE];
  /*
   Field bits that the law must have.
   */
  int64_t reads;
  /*
   Field bits that the law uses if they are there.
   */
  int64_t uses;
  /*
   Output bits that the law can write.
   */
  int64_t writes;
  /*
   `WL_CLAIM_` bits.
   */
  int64_t claims;
  /*
   `WL_FLAG_` bits.
   */
  int64_t flags;
  /*
   Number of constants.
   */
  int64_t constant_count;
  /*
   Number of state variables at a point.
   */
  int64_t state_count;
  /*
   Number of further inputs declared by name.
   */
  int64_t input_count;
  /*
   Claim: the increment is homogeneous of this degree in the pressure. NaN (preset): not claimed.
   */
  double pressure_degree;
  /*
   Claim: index (from 0) of the constant that holds that degree. -1 (preset): none.
   */
  int64_t pressure_degree_constant;
  /*
   Describes constant, state variable, input or field `index`; NULL if there is nothing to describe.
   */
  int32_t (*describe)(int32_t kind, int64_t index, struct wl_quantity *quantity);
  /*
   Makes an instance. NULL: no instance is needed. `options` is the scene's text or NULL; a refusal writes its
   reason into `text` (at most `text_size` bytes with the closing NUL).
   */
  int32_t (*create)(const struct wl_host *host,
                    const char *options,
                    void **instance,
                    char *text,
                    int64_t text_size);
  /*
   Evaluates the law at the points of `view`. Pure: everything is read from `view` and written to `output`.
   */
  int32_t (*evaluate)(void *instance, const struct wl_view *view, struct wl_output *output);
  /*
   Frees an instance. NULL: nothing to free.
   */
  void (*destroy)(void *instance);
  /*
   Finds an extension by its name (`wearlaw.selftest/1`); NULL, or an answer of NULL: not there.
   */
  const void *(*extension)(const char *id);
} wl_law;

#endif  /* WEARLAW_H */

#ifdef __cplusplus
extern "C" {
#endif

/* The one function a plugin exports. Answers WL_OK, or WL_NO_MORE past the last law. */
WL_EXPORT int32_t wearlaw_entry_1(int32_t index, const wl_host *host, wl_law *law);

#ifdef __cplusplus
}
#endif
