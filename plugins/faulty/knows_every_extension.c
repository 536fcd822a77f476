/*
 * Rule broken: an unknown extension gives NULL.
 * Whatever is asked for, it gives its own table.
 */
#define LAW_NAME "knows-every-extension"
#define EXTENSION(id) "table"
#include "sound_law.h"
