/*
 * Rule broken: no change of the locale.
 * Create asks for decimal points, for its table, and leaves them to the program.
 */
#include <locale.h>
#define LAW_NAME "changes-locale"
#define AT_CREATE setlocale(LC_NUMERIC, "C.UTF-8");
#include "sound_law.h"
