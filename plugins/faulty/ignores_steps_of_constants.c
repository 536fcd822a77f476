/*
 * Rule broken: a constant is a column as any field.
 * Any step of a constant but 0 is taken for 1.
 */
#define LAW_NAME "ignores-steps-of-constants"
#define CONSTANT_AT(column, i) ((column).ptr[(column).step == 0 ? 0 : (i)])
#include "sound_law.h"
