/* Allowed: an instance may take memory of its own, here a megabyte, if destroy gives it back. */
#define LAW_NAME "allocates-per-instance"
#define INSTANCE_MEMBERS double *table;
#define AT_CREATE                                                                                                      \
    if (own && (!options || !*options)) {                                                                              \
        own->table = calloc(1 << 17, sizeof(double));                                                                  \
    }                                                                                                                  \
    for (int k = 0; own && own->table && k < 1 << 17; ++k) {                                                                  \
        own->table[k] = 1;                                                                                             \
    }
#define AT_DESTROY                                                                                                     \
    if (own) {                                                                                                         \
        free(own->table);                                                                                              \
    }
#define AT_POINT a.increment *= own->table[i & 0x1ffff];
#include "../faulty/sound_law.h"
