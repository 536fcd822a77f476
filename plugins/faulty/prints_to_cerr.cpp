// Rule broken: no output to the terminal.
// Destroy reports on the error stream how often it was called.
#define LAW_NAME "prints-to-cerr"
#include "sound_law.hpp"

#include <iostream>

static int32_t create_instance(const wl_host *, const char *, void **, char *, int64_t) { return WL_OK; }
static void destroy_instance(void *) { std::cerr << "one wear law fewer\n"; }
EXPORT_SOUND_LAW(law->create = create_instance; law->destroy = destroy_instance)
