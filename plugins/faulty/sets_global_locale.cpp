// Rule broken: no change of the locale.
// Create makes the locale of its table that of the whole program.
#define LAW_NAME "sets-global-locale"
#include "sound_law.hpp"

#include <locale>

static int32_t create_instance(const wl_host *, const char *, void **, char *, int64_t) {
    std::locale::global(std::locale("C.UTF-8"));
    return WL_OK;
}
EXPORT_SOUND_LAW(law->create = create_instance)
