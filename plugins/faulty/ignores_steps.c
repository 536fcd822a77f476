/*
 * Rule broken: the step of a column is the number of values from one point to the next.
 * Any step of a scalar field but 0 is taken for 1.
 */
#define LAW_NAME "ignores-steps"
#define SCALAR_AT(column, i) ((column).ptr[(column).step == 0 ? 0 : (i)])
#include "sound_law.h"
