// Rule broken: no memory between calls but the state variables.
// Every call makes a text for a log and forgets it.
#define LAW_NAME "leaks-a-string"
#include "sound_law.hpp"

#include <string>

static std::string *volatile latest;

static int32_t evaluate_batch(void *instance, const wl_view *view, wl_output *output) {
    latest = new std::string("evaluated another batch of contact points");
    return sound.evaluate(instance, view, output);
}
EXPORT_SOUND_LAW(law->evaluate = evaluate_batch)
