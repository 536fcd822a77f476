/* Allowed: a table that the library makes when it is loaded and gives back when it is unloaded. */
#define LAW_NAME "table-of-the-library"
static double *table_of_library;
#define AT_LOAD table_of_library = calloc(1024, sizeof(double));
#define AT_UNLOAD free(table_of_library);
#define AT_POINT a.increment += table_of_library[i & 1023];
#include "../faulty/sound_law.h"
