// Rule broken: no exception gets out.
// A pressure that is no number throws std::domain_error out of evaluation, past the helper that would have caught it.
#define LAW_NAME "throws"
#include "sound_law.hpp"

#include <stdexcept>

static int32_t evaluate_batch(void *instance, const wl_view *view, wl_output *output) {
    for (int64_t i = 0; i < view->points && view->pressure.ptr; ++i) {
        if (std::isnan(view->pressure.ptr[i * view->pressure.step])) {
            throw std::domain_error("the pressure is not a number");
        }
    }
    return sound.evaluate(instance, view, output);
}
EXPORT_SOUND_LAW(law->evaluate = evaluate_batch)
