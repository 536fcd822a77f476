/* Two threads and one law, a surface for each; then two threads and one surface. Arguments: the library of a law that
 * fails where it is called by two threads at once. Prints how many calls failed. */
#define _XOPEN_SOURCE 700
#include "expect.h"

#include <pthread.h>

enum { POINTS = 2000, CALLS = 60 };

static wlh_law *law;
static pthread_barrier_t together;

struct work {
    wlh_surface *surface;
    int failed, busy, other;
    double increment[POINTS];
};

static void *calls(void *pointer) {
    struct work *mine = pointer;
    char words[300];
    wlh_step step = {sizeof step, 0, 0.5};
    wlh_outputs outputs = {sizeof outputs, mine->increment, POINTS};
    pthread_barrier_wait(&together);
    for (int i = 0; i < CALLS; ++i) {
        int32_t status = wlh_evaluate(mine->surface, &step, &outputs, words, sizeof words);
        if (status == WL_FAILED) ++mine->failed;
        else if (status == WLH_BUSY) mine->busy += strstr(words, "in use by another thread") != NULL;
        else if (status != WL_OK || mine->increment[POINTS - 1] != 1) ++mine->other;
    }
    return NULL;
}

static void both(struct work *one, struct work *two) {
    pthread_t thread;
    pthread_create(&thread, NULL, calls, two);
    calls(one);
    pthread_join(thread, NULL);
}

int main(int argc, char **argv) {
    static struct work one, two;
    double pressure = 2;
    wlh_source source = {sizeof source};
    wlh_solver solver = {sizeof solver, WL_FIELD_PRESSURE, 2};
    if (argc != 2) return 2;
    source.name = argv[1];
    pthread_barrier_init(&together, NULL, 2);
    DONE(wlh_open_1(&source, &solver, &law, TEXT));
    DONE(wlh_open_surface(law, POINTS, &one.surface, TEXT));
    DONE(wlh_open_surface(law, POINTS, &two.surface, TEXT));
    DONE(wlh_set_field(one.surface, WL_FIELD_PRESSURE, &pressure, 1, 0, TEXT));
    DONE(wlh_set_field(two.surface, WL_FIELD_PRESSURE, &pressure, 1, 0, TEXT));
    both(&one, &two);
    printf("failed %d\n", one.failed + two.failed);
    TRUE(one.busy + two.busy + one.other + two.other == 0);

    two.surface = one.surface;
    one.failed = two.failed = 0;
    both(&one, &two);
    printf("busy %d\n", one.busy + two.busy);
    TRUE(one.failed + two.failed + one.other + two.other == 0);
    return ended();
}
