// Allowed: threads inside one call, all ended when it returns; every point is computed as it would be alone.
#define LAW_NAME "threads-of-its-own"
#include "../faulty/sound_law.hpp"

#include <thread>
#include <vector>

enum { PARTS = 3, LEAST = 5000 };

/* The points `first` .. `end` of a call, as a call of their own. */
static int32_t part(void *instance, const wl_view *whole, const wl_output *output, int64_t first, int64_t end) {
    wl_view view = *whole;
    wl_output out = *output;
    view.points = end - first;
    view.pressure.ptr += first * view.pressure.step;
    view.slip.ptr += first * view.slip.step;
    view.normal.ptr += first * view.normal.step;
    view.state.ptr += first * view.state.step;
    wl_column constants[2] = {whole->constants[0], whole->constants[1]};
    for (wl_column &constant : constants) {
        constant.ptr += first * constant.step;
    }
    view.constants = constants;
    out.increment += first;
    out.direction = out.direction ? out.direction + 3 * first : nullptr;
    out.state = out.state ? out.state + 2 * first : nullptr;
    out.d_pressure = out.d_pressure ? out.d_pressure + first : nullptr;
    out.status = out.status ? out.status + first : nullptr;
    out.text = nullptr;
    out.text_size = 0;
    return sound.evaluate(instance, &view, &out);
}

static int32_t evaluate_batch(void *instance, const wl_view *view, wl_output *output) {
    const bool known = view->struct_size >= int64_t(sizeof *view) && output->struct_size >= int64_t(sizeof *output);
    if (!known || view->points < LEAST || !view->pressure.ptr || !view->slip.ptr || !view->normal.ptr) {
        return sound.evaluate(instance, view, output);
    }
    int32_t worst[PARTS];
    std::vector<std::thread> threads;
    for (int k = 0; k < PARTS; ++k) {
        const int64_t first = view->points * k / PARTS, end = view->points * (k + 1) / PARTS;
        threads.emplace_back([=, &worst] { worst[k] = part(instance, view, output, first, end); });
    }
    for (std::thread &thread : threads) {
        thread.join();
    }
    for (int32_t status : worst) {
        if (status != WL_OK) {
            return sound.evaluate(instance, view, output); // once more, for its text and the first bad point
        }
    }
    return WL_OK;
}
EXPORT_SOUND_LAW(law->evaluate = evaluate_batch)
