/* State at the start and the end, commit and roll back, here and in a process of its own; arguments: the library of
 * running-in, one state variable (the sliding distance so far), and the program that is the worker. */
#include "expect.h"

#include <math.h>

enum { POINTS = 2 };

static double pressure[POINTS] = {1e6, 3e6}, slip[POINTS] = {0.5, 0.25};

static wlh_surface *opened(const char *library, const char *worker) {
    wlh_law *law;
    wlh_surface *surface;
    wlh_source source = {sizeof source};
    wlh_solver solver = {sizeof solver, WL_FIELD_PRESSURE | WL_FIELD_SLIP, 3};
    double values[] = {1e-4, 1e-5, 2, 1e9}; /* K_0, K_inf, s_0, H */
    wlh_constants constants = {sizeof constants, 4, NULL, values, 4, NULL, 0, NULL, 0};
    source.name = library;
    source.worker = worker;
    DONE(wlh_open_1(&source, &solver, &law, TEXT));
    DONE(wlh_open_surface(law, POINTS, &surface, TEXT));
    DONE(wlh_set_constants(surface, &constants, TEXT));
    DONE(wlh_set_field(surface, WL_FIELD_PRESSURE, pressure, POINTS, 1, TEXT));
    DONE(wlh_set_field(surface, WL_FIELD_SLIP, slip, POINTS, 1, TEXT));
    DONE(wlh_close_law(law, TEXT));
    return surface;
}

int main(int argc, char **argv) {
    wlh_surface *surface, *apart;
    double first[POINTS], again[POINTS], second[POINTS], state[POINTS], restart[POINTS] = {0.5, 0.25};
    wlh_step step = {sizeof step, 0, 1};
    wlh_outputs outputs = {sizeof outputs, first, POINTS};
    if (argc != 3) return 2;
    surface = opened(argv[1], NULL);
    DONE(wlh_get_state(surface, state, POINTS, TEXT));
    TRUE(state[0] == 0 && state[1] == 0);

    /* A substep that is tried twice begins twice from the same state. */
    DONE(wlh_evaluate(surface, &step, &outputs, TEXT));
    DONE(wlh_roll_back(surface, TEXT));
    EXPECT(WLH_BAD_INPUT, "nothing to commit", wlh_commit(surface, TEXT));
    outputs.increment = again;
    DONE(wlh_evaluate(surface, &step, &outputs, TEXT));
    TRUE(memcmp(first, again, sizeof first) == 0);
    DONE(wlh_get_state(surface, state, POINTS, TEXT));
    TRUE(state[0] == 0 && state[1] == 0);

    /* The next one begins where this one ended, and wears less: the law runs in. */
    DONE(wlh_commit(surface, TEXT));
    DONE(wlh_get_state(surface, state, POINTS, TEXT));
    TRUE(state[0] == 0.5 && state[1] == 0.25);
    outputs.increment = second;
    DONE(wlh_evaluate(surface, &step, &outputs, TEXT));
    TRUE(second[0] < 0.95 * first[0] && second[1] < 0.95 * first[1]);
    EXPECT(WLH_BAD_INPUT, "`state` has 1 values, expected 2", wlh_get_state(surface, state, 1, TEXT));
    EXPECT(WLH_BAD_INPUT, "`values` is NULL", wlh_get_state(surface, NULL, POINTS, TEXT));
    EXPECT(WLH_BAD_INPUT, "`state` has 3 values, expected 2", wlh_set_state(surface, first, 3, TEXT));
    state[1] = NAN;
    EXPECT(WLH_BAD_INPUT, "`distance` of point 1 is NaN", wlh_set_state(surface, state, POINTS, TEXT));

    /* A restart, in a process of its own: the same bits. */
    apart = opened(argv[1], argv[2]);
    DONE(wlh_set_state(apart, restart, POINTS, TEXT));
    outputs.increment = again;
    DONE(wlh_evaluate(apart, &step, &outputs, TEXT));
    TRUE(memcmp(second, again, sizeof again) == 0);
    DONE(wlh_commit(apart, TEXT));
    DONE(wlh_get_state(apart, state, POINTS, TEXT));
    TRUE(state[0] == 1 && state[1] == 0.5);
    DONE(wlh_close_surface(apart, TEXT));
    DONE(wlh_close_surface(surface, TEXT));
    return ended();
}
