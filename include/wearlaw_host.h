/*
 * wearlaw_host.h: wear laws in a solver, major version 1. Link with -lwearlaw_host.
 *
 * wlh_open_1 opens a law, wlh_open_surface makes a surface of points under it; the surface is told where the solver's
 * arrays are, evaluates the law on them in place, and holds the state variables. Every function but wlh_minor
 * answers a status (0: done) and writes what is wrong into `text` [text_size], which may be NULL; no function ends the
 * program or keeps anything outside of its handles. A law may be used from all threads at once, a surface from one at a
 * time (another gets WLH_BUSY). Structs begin with their size: write `wlh_step step = {sizeof step};`, members that
 * are left zero mean what their comment says. Fields, flags and the statuses 0 to 5 are those of wearlaw.h.
 *
 * SPDX-License-Identifier: MIT OR Apache-2.0
 */


#ifndef WEARLAW_HOST_H
#define WEARLAW_HOST_H

/* Generated from host/c by cbindgen; `WEARLAW_REGENERATE=1 cargo test --test headers` writes it anew. */

#include <stdint.h>
#include "wearlaw.h"

/*
 Minor version of this interface; functions and members are only ever added between minors.
 */
#define WLH_ABI_MINOR 0

/*
 An argument is wrong; the text names it. Nothing was changed or evaluated.
 */
#define WLH_BAD_INPUT 16

/*
 The law could not be opened.
 */
#define WLH_NOT_LOADED 17

/*
 The handle is NULL, closed, or not of this kind.
 */
#define WLH_BAD_HANDLE 18

/*
 Another thread is using the surface.
 */
#define WLH_BUSY 19

/*
 A defect of this library; the handle can only be closed.
 */
#define WLH_INTERNAL 20

/*
 An open law.
 */
typedef struct wlh_law wlh_law;

/*
 The points of one surface under a law.
 */
typedef struct wlh_surface wlh_surface;

/*
 Which law is opened, and how.
 */
typedef struct {
  /*
   Bytes of this struct.
   */
  int64_t struct_size;
  /*
   `embedded:archard`, or a library's path (with a `/` or the ending of a library); `LIB#NAME` for one of several.
   */
  const char *name;
  /*
   SHA-256 that the library must have, in hexadecimal; NULL: any.
   */
  const char *sha256;
  /*
   Text for laws that take options; NULL: none.
   */
  const char *options;
  /*
   Path of the program `wearlaw`, of this version: the law runs in processes of its own. NULL: in this process.
   */
  const char *worker;
  /*
   Longest time for one call of a law in a process of its own, s; 0: 60.
   */
  double deadline;
} wlh_source;

/*
 What the solver is and provides.
 */
typedef struct {
  /*
   Bytes of this struct.
   */
  int64_t struct_size;
  /*
   `WL_FIELD_` bits that it provides. A law that reads others is refused; others cannot be set.
   */
  int64_t provides;
  /*
   Dimension of its scene, 2 or 3. Vectors have 3 components in both.
   */
  int64_t dimension;
  /*
   Its unit of length in metres; 0: 1.
   */
  double unit_metre;
  /*
   Its unit of mass in kilograms; 0: 1.
   */
  double unit_kilogram;
  /*
   Its unit of time in seconds; 0: 1.
   */
  double unit_second;
  /*
   Its degree of temperature in kelvin; 0: 1.
   */
  double unit_kelvin;
  /*
   Absolute zero on its temperature scale: 0 for kelvin, -273.15 for degrees Celsius.
   */
  double absolute_zero;
  /*
   Reference temperature, on its temperature scale.
   */
  double reference_temperature;
} wlh_solver;

/*
 What a law says of itself.
 */
typedef struct {
  /*
   Bytes of this struct, set by the solver.
   */
  int64_t struct_size;
  /*
   `WL_FIELD_` bits that the law must have.
   */
  int64_t reads;
  /*
   `WL_FIELD_` bits that it uses if they are there.
   */
  int64_t uses;
  /*
   `WL_OUT_` bits that it can write beside the wear increment.
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
   Number of further inputs.
   */
  int64_t input_count;
  /*
   Name, NUL-terminated.
   */
  char name[WL_NAME_SIZE];
  /*
   Version, NUL-terminated.
   */
  char version[WL_VERSION_SIZE];
} wlh_description;

/*
 Constants of the law, or a table of them: linear between its points in time and temperature, held outside them.
 */
typedef struct {
  /*
   Bytes of this struct.
   */
  int64_t struct_size;
  /*
   Constants in a row.
   */
  int64_t count;
  /*
   Their names `[count]`; NULL: the first `count` in the law's order. What is left out takes its default.
   */
  const char *const *names;
  /*
   Values `[times][temperatures][count]`, in the solver's units.
   */
  const double *values;
  /*
   Numbers in `values`.
   */
  int64_t value_count;
  /*
   Times of the table, rising; NULL: the same at all times.
   */
  const double *times;
  /*
   Number of times.
   */
  int64_t time_count;
  /*
   Temperatures of the table, rising; NULL: the same at all temperatures.
   */
  const double *temperatures;
  /*
   Number of temperatures.
   */
  int64_t temperature_count;
} wlh_constants;

/*
 The substep that is evaluated; times in the solver's units.
 */
typedef struct {
  /*
   Bytes of this struct.
   */
  int64_t struct_size;
  /*
   Time at its start. Tables are read in its middle.
   */
  double time;
  /*
   Its duration: the represented time, if wear is scaled.
   */
  double dt;
  /*
   Time since the start of the load step.
   */
  double step_time;
  /*
   Number of the load step, from 1; 0: 1.
   */
  int64_t load_step;
  /*
   Number of the substep in its load step, from 1; 0: 1.
   */
  int64_t substep;
  /*
   Number of the cycle, from 1; 0: outside cycles.
   */
  int64_t cycle;
  /*
   Number of the wear material; 0: 1.
   */
  int64_t material;
  /*
   Number of the contact pair; 0: 1.
   */
  int64_t pair;
  /*
   Number of the worn body; 0: 1.
   */
  int64_t body;
  /*
   Number of the counter body; 0: 2.
   */
  int64_t counter_body;
} wlh_step;

/*
 The solver's arrays that the law writes, and what it answers beside them. They overlap no input.
 */
typedef struct {
  /*
   Bytes of this struct.
   */
  int64_t struct_size;
  /*
   Increment of the wear depth over the substep `[points]`; length. Never NULL.
   */
  double *increment;
  /*
   Numbers in `increment`: the points.
   */
  int64_t increment_length;
  /*
   Wear direction `[points][3]`, unit length; or NULL.
   */
  double *direction;
  /*
   Numbers in `direction`.
   */
  int64_t direction_length;
  /*
   Derivative of the increment with respect to the contact pressure `[points]`; or NULL.
   */
  double *d_pressure;
  /*
   Numbers in `d_pressure`.
   */
  int64_t d_pressure_length;
  /*
   Status of every point `[points]`; or NULL.
   */
  int32_t *status;
  /*
   Numbers in `status`.
   */
  int64_t status_length;
  /*
   Answered: with `WL_CUT_STEP` the factor in (0, 1) for the next try, otherwise 1.
   */
  double dt_factor;
  /*
   Answered: the first point that the text is about, from 0; -1: none.
   */
  int64_t first_bad;
} wlh_outputs;

#ifdef __cplusplus
extern "C" {
#endif // __cplusplus

/*
 Minor version of this interface; the major version is in the name of `wlh_open_1`.
 */
int32_t wlh_minor(void);

/*
 Opens a law for a solver. A law that reads what the solver does not provide is refused.
 */
int32_t wlh_open_1(const wlh_source *source, const wlh_solver *solver, wlh_law **law, char *text, int64_t text_size);

/*
 Says what a law is: name, fields, outputs, numbers of constants and state variables.
 */
int32_t wlh_describe(const wlh_law *law, wlh_description *description, char *text, int64_t text_size);

/*
 Says what a constant, state variable or further input is: `kind` WL_KIND_CONSTANT, _STATE or _INPUT, `index` from 0.
 Bounds and defaults are in SI units.
 */
int32_t wlh_quantity(const wlh_law *law,
                     int32_t kind,
                     int64_t index,
                     wl_quantity *quantity,
                     char *text,
                     int64_t text_size);

/*
 Takes the warnings since the last call, a line each, into `text`: what a law changed that was put back.
 */
int32_t wlh_warnings(const wlh_law *law, char *text, int64_t text_size);

/*
 Closes a law; it goes when its last surface is closed.
 */
int32_t wlh_close_law(wlh_law *handle, char *text, int64_t text_size);

/*
 Makes a surface of `points` points, which may be 0. Constants and state variables have their defaults.
 */
int32_t wlh_open_surface(const wlh_law *law, int64_t points, wlh_surface **surface, char *text, int64_t text_size);

/*
 Sets the law's constants, or a table of them over time and temperature; they are copied.
 */
int32_t wlh_set_constants(wlh_surface *handle, const wlh_constants *constants, char *text, int64_t text_size);

/*
 Says where a field is: `length` numbers from `values` on, `step` numbers from one point to the next (0: one value
 for all points). The array is read in place by every evaluation until another is set; NULL takes it away.
 */
int32_t wlh_set_field(wlh_surface *handle,
                      int64_t field,
                      const double *values,
                      int64_t length,
                      int64_t step,
                      char *text,
                      int64_t text_size);

/*
 As wlh_set_field, for fields of integers: WL_FIELD_CONTACT_STATE, _POINT_ID and _ELEMENT_ID.
 */
int32_t wlh_set_index_field(wlh_surface *handle,
                            int64_t field,
                            const int64_t *values,
                            int64_t length,
                            int64_t step,
                            char *text,
                            int64_t text_size);

/*
 As wlh_set_field, for a further input that the law declares by name.
 */
int32_t wlh_set_input(wlh_surface *handle,
                      const char *name,
                      const double *values,
                      int64_t length,
                      int64_t step,
                      char *text,
                      int64_t text_size);

/*
 Sets the state variables at the start of the substep, `length` numbers `[points][state_count]`; they are copied.
 */
int32_t wlh_set_state(wlh_surface *handle, const double *values, int64_t length, char *text, int64_t text_size);

/*
 Copies the state variables as they were committed into `length` numbers `[points][state_count]`.
 */
int32_t wlh_get_state(wlh_surface *handle, double *values, int64_t length, char *text, int64_t text_size);

/*
 Evaluates the law over a substep, from the state at its start. Answers WL_OK, WL_UNRELIABLE (the values may be used),
 WL_CUT_STEP (try again with `dt` times `dt_factor`) or an error; but for the first two the outputs are void.
 */
int32_t wlh_evaluate(wlh_surface *handle, const wlh_step *step, wlh_outputs *outputs, char *text, int64_t text_size);

/*
 Takes the last good evaluation: its state at the end is the state at the start of the next substep.
 */
int32_t wlh_commit(wlh_surface *handle, char *text, int64_t text_size);

/*
 Forgets the evaluations since the last commit. Evaluating again without it does the same.
 */
int32_t wlh_roll_back(wlh_surface *handle, char *text, int64_t text_size);

/*
 Closes a surface. What is kept of it is a few words, so that a use of it after this is an error.
 */
int32_t wlh_close_surface(wlh_surface *handle, char *text, int64_t text_size);

/*
 The factor on the represented time of a substep or cycle, clamp(safety / change, 1, maximum), where the wear of an
 unscaled one changes the contact pressure by the part `change` (TB,WEAR with AUTS or CBCS: C1, C2).
 */
int32_t wlh_scaling_factor(double change,
                           double safety,
                           double maximum,
                           double *factor,
                           char *text,
                           int64_t text_size);

#ifdef __cplusplus
}  // extern "C"
#endif  // __cplusplus

#endif  /* WEARLAW_HOST_H */
