/* Allowed: a table that create computes once, read by every call; between its rows the wear is linear (declared kinks). */
#include <math.h>
#define LAW_NAME "table-from-create"
#define LAW_FLAGS WL_FLAG_KINKS
#define LAW_DEGREE NAN
enum { ROWS = 64 };
#define INSTANCE_MEMBERS double hardening[ROWS + 1];
#define AT_CREATE                                                                                                      \
    for (int k = 0; own && k <= ROWS; ++k) {                                                                           \
        own->hardening[k] = log1p(k);                                                                                  \
    }
/* Wear factor at the part x of the hardness, and its slope in x; beyond the table the last row goes on. */
static double looked_up(const double *table, double x, double *slope) {
    int row = x * ROWS < ROWS - 1 ? (int)(x * ROWS) : ROWS - 1;
    *slope = (table[row + 1] - table[row]) * ROWS;
    return table[row] + *slope * (x - (double)row / ROWS);
}
#define AT_POINT                                                                                                       \
    double steep = 0, factor = 0;                                                                                      \
    if (status == WL_OK) {                                                                                             \
        factor = looked_up(own->hardening, p / H, &steep);                                                             \
        a.increment = K * factor * s;                                                                                  \
        a.slope = given < 0 ? 0 : K * steep / H * s;                                                                   \
        status = isfinite(a.increment) ? WL_OK : WL_OUT_OF_DOMAIN;                                                     \
    }
#include "../faulty/sound_law.h"
