// Rule broken: one instance may be evaluated from several threads at once.
// The increments are scaled through one static vector, which every call fills and reads again; a pause in between makes
// sure that a busy machine shows it.
#define LAW_NAME "shares-a-vector"
#include "sound_law.hpp"

#include <chrono>
#include <thread>
#include <vector>

static int32_t evaluate_batch(void *instance, const wl_view *view, wl_output *output) {
    static std::vector<double> scratch(1 << 20);
    const int32_t status = sound.evaluate(instance, view, output);
    const int64_t points = view->points < (1 << 20) ? view->points : 1 << 20;
    for (int64_t i = 0; i < points; ++i) {
        scratch[static_cast<size_t>(i)] = 2 * output->increment[i];
    }
    std::this_thread::sleep_for(std::chrono::microseconds(points > 7 ? 100 : 0));
    for (int64_t i = 0; i < points; ++i) {
        output->increment[i] = scratch[static_cast<size_t>(i)] / 2;
    }
    return status;
}
EXPORT_SOUND_LAW(law->evaluate = evaluate_batch)
