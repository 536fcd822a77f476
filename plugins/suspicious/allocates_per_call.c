/* Allowed: memory that a call takes and gives back. */
#define LAW_NAME "allocates-per-call"
#define BEFORE_POINTS double *scratch = malloc(sizeof(double) * (size_t)(v->points > 0 ? v->points : 1));
#define AT_POINT scratch[i] = a.increment, a.increment = scratch[i];
#define AFTER_POINTS free(scratch);
#include "../faulty/sound_law.h"
