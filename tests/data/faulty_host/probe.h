/*
 * probe.h: a small host in plain C that shows, without any part of the program, that a faulty law is bad.
 *
 * A probe looks for the fault of one check, in a child process: it calls `bad` if it finds it, and returns if it does
 * not. It knows only the ABI. A probe bears the name of its check.
 */
#ifndef PROBE_H
#define PROBE_H

#define _GNU_SOURCE
#include "wearlaw.h"

#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { FIELDS = 17, MOST_QUANTITIES = 8 };

/* A loaded law; `open_law` ends the probe with `bad` if there is none. */
typedef struct law_handle {
    void *library;
    wl_host host;
    wl_law law;
    int64_t constants, states;
} law_handle;

/* The inputs of one call: a column for each field that the law declares, for its constants and its state. */
typedef struct job {
    int64_t points;
    double time, dt;
    double absolute_zero; /* in the scale of the temperatures */
    int64_t substep;
    double unit[4]; /* sizes of metre, kilogram, second, kelvin; 0: not stated */
    double *field[FIELDS];
    int64_t step[FIELDS];
    double *constant[MOST_QUANTITIES];
    int64_t constant_step[MOST_QUANTITIES];
    double *state;
    int64_t state_step;
} job;

/* The outputs of one call; `want` are WL_OUT_ bits of what is asked for besides the increment. */
typedef struct reply {
    int64_t want;
    double *increment, *direction, *state, *slope;
    int32_t *status;
    int32_t returned;
    int64_t view_request;
} reply;

/* What outputs hold before a call: no law answers it. */
#define UNWRITTEN 0x7ff4deadbeef5a5a
#define UNWRITTEN_STATUS 0x5a5a5a5a

/* Ends the probe: the fault has been found. */
_Noreturn void bad(const char *format, ...) __attribute__((format(printf, 1, 2)));

/* Leaves a word for the parent, also from a signal handler. */
void note(const char *word);

/* law.c */
law_handle *open_law(const char *path);
int try_open(const char *path, law_handle *h);
void *make_instance(law_handle *h);
void end_instance(law_handle *h, void *instance);
int width_of(int field);
double *column_of(wl_view *view, int field, int64_t step);
int64_t bit_of(int field);

/* job.c: everything is allocated and never freed, a probe is short. */
double uniform(uint64_t *seed);
job *make_job(law_handle *h, int64_t points, uint64_t seed);
job *part_of(law_handle *h, const job *all, const int64_t *which, int64_t points);
job *rescaled(law_handle *h, const job *all, double factor_dt);
void fill_view(law_handle *h, const job *j, wl_view *view, wl_column *constants);
reply *make_reply(law_handle *h, int64_t points, int64_t want);
reply *evaluate(law_handle *h, void *instance, const job *j, int64_t want);
int64_t all_outputs(const law_handle *h);
/* Index of the first point at which the values differ by more than a part `relative`, or -1. */
int64_t differs(law_handle *h, const reply *a, const reply *b, int64_t points, double relative);
void compare_part(law_handle *h, const reply *all, const int64_t *which, const reply *part, int64_t points,
                  const char *what);

/* The probes of a file, by the name of a check; whether there is one of that name. */
int probe_load(const char *name, const char *path);
int probe_float(const char *name, const char *path);
int probe_faults(const char *name, const char *path);
int probe_descriptor(const char *name, const char *path);
int probe_sizes(const char *name, const char *path);
int probe_values(const char *name, const char *path);
int probe_purity(const char *name, const char *path);
int probe_batch(const char *name, const char *path);
int probe_memory(const char *name, const char *path);
int probe_state(const char *name, const char *path);
int probe_physics(const char *name, const char *path);
int probe_units(const char *name, const char *path);
int probe_expected(const char *name, const char *path);

/* Bits of all answers of one call, for comparison with another process. */
uint64_t fingerprint(law_handle *h, const reply *r, int64_t points);

/* Whether a value is what `make_reply` has left. */
static inline int unwritten(double x) {
    uint64_t bits;
    memcpy(&bits, &x, sizeof bits);
    return bits == UNWRITTEN;
}

#endif /* PROBE_H */
