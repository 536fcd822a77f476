/*
 * Rule broken: the call returns the worst status of its points.
 * It returns that of the last one.
 */
#define LAW_NAME "returns-last-status"
#define AFTER_POINTS worst = last;
#define BEFORE_POINTS int32_t last = WL_OK;
#define AT_POINT last = status;
#include "sound_law.h"
