/*
 * Rule broken: an instance answers by itself, whatever becomes of others.
 * A table that all instances use ends with the first that is destroyed; the others then answer twice as much.
 */
#define LAW_NAME "ends-with-another"
static int ended;
#define INSTANCE_MEMBERS int table;
#define AT_CREATE                                   \
    if (own) {                                      \
        own->table = ended;                         \
    }
#define AT_DESTROY ++ended;
#define AT_POINT a.increment *= own->table == ended ? 1 : 2;
#include "sound_law.h"
