/*
 * Rule broken: a batch may hold any number of points.
 * Points are counted in sixteen bits for the table of pressures.
 */
#define LAW_NAME "counts-in-sixteen-bits"
#define AT_POINT a.increment = i > 65535 && status == WL_OK ? K / H * fmax(0, VALUE_AT(v->pressure, i & 65535)) * s : a.increment;
#include "sound_law.h"
