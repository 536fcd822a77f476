// Rule broken: no exception gets out.
// A pressure that is not a number below 1e200 throws std::domain_error, past the helper that would have caught it.
#define LAW_NAME "throws"
#include "sound_law.hpp"

#include <stdexcept>

static int32_t evaluate_batch(void *instance, const wl_view *view, wl_output *output) {
    for (int64_t i = 0; i < view->points && view->pressure.ptr; ++i) {
        if (!(view->pressure.ptr[i * view->pressure.step] < 1e200)) {
            throw std::domain_error("the pressure is not a number below 1e200");
        }
    }
    return sound.evaluate(instance, view, output);
}
EXPORT_SOUND_LAW(law->evaluate = evaluate_batch)
