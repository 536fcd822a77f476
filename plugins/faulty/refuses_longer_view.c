/*
 * Rule broken: longer structs of a newer host are taken.
 * It wants the view to have the size that it knows.
 */
#define LAW_NAME "refuses-longer-view"
#define BEFORE_POINTS                                               \
    if (view->struct_size > (int64_t)sizeof *view) {                \
        SAY(o->text, o->text_size, "the view has another size");    \
        return WL_FAILED;                                           \
    }
#include "sound_law.h"
