/*
 * Rule broken: a constant is a column as any field.
 * The constants of the first point are used for all.
 */
#define LAW_NAME "constants-of-first-point"
#define CONSTANT_AT(column, i) ((column).ptr[0])
#include "sound_law.h"
