/*
 * Rule broken: the view is constant.
 * The request is cleared once it is met.
 */
#define LAW_NAME "writes-to-view"
#define AFTER_POINTS ((wl_view *)(uintptr_t)view)->request = 0;
#include "sound_law.h"
