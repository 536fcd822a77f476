/*
 * Rule broken: claimed: no slip, no wear.
 * It creeps by a micrometre in a second, whatever the slip.
 */
#define LAW_NAME "wears-without-slip"
#define CREEP (1e-6 * v->dt * (v->unit_second > 0 ? v->unit_second : 1) / (v->unit_metre > 0 ? v->unit_metre : 1))
#define INCREMENT (K / H * p * (s + CREEP))
#define SLOPE (K / H * (s + CREEP))
#include "sound_law.h"
