/*
 * Rule broken: the wear direction points into the worn body.
 * It is the normal, and not its opposite.
 */
#define LAW_NAME "direction-outward"
#define AT_POINT a.direction[0] = normal[0], a.direction[1] = normal[1], a.direction[2] = normal[2];
#include "sound_law.h"
