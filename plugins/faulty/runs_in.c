/*
 * Rule broken: claimed: a substep wears as much as its equal parts.
 * The wear coefficient falls with the distance, so that one long substep wears more than two short ones.
 */
#define LAW_NAME "runs-in"
#define RUN_IN (s > 0 ? s / (start[0] + s) : 0)
#define INCREMENT (K / H * p * s * RUN_IN)
#define SLOPE (K / H * s * RUN_IN)
#include "sound_law.h"
