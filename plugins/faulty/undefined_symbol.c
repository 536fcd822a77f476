/*
 * Rule broken: every symbol that a library needs is found when it is loaded.
 * A function of a table library that nobody links is called, for negative slip only: lazy binding would hide it.
 */
#define LAW_NAME "undefined-symbol"
double wear_table_lookup(double pressure);
#define AT_POINT                                    \
    if (VALUE_AT(v->slip, i) < 0) {                 \
        a.increment = wear_table_lookup(p);         \
    }
#include "sound_law.h"
