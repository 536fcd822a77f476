/* A law that ends its process, in a process of its own: a status, and the next evaluation is good. Arguments: the library
 * of a law that aborts at pressures from 1e200 on, and the program that is the worker. */
#include "expect.h"

int main(int argc, char **argv) {
    wlh_law *law;
    wlh_surface *surface;
    double pressure[] = {1e6, 1e201, 1e6}, slip = 0.5, normal[] = {0, 0, 1}, increment[3], state[6];
    wlh_source source = {sizeof source};
    wlh_solver solver = {sizeof solver, WL_FIELD_PRESSURE | WL_FIELD_SLIP | WL_FIELD_NORMAL, 3};
    wlh_step step = {sizeof step, 0, 1};
    wlh_outputs outputs = {sizeof outputs, increment, 3};
    double values[] = {1e-4, 2e9};
    wlh_constants constants = {sizeof constants, 2, NULL, values, 2, NULL, 0, NULL, 0};
    if (argc != 3) return 2;
    source.name = argv[1];
    source.worker = argv[2];
    DONE(wlh_open_1(&source, &solver, &law, TEXT));
    DONE(wlh_open_surface(law, 3, &surface, TEXT));
    DONE(wlh_set_constants(surface, &constants, TEXT));
    DONE(wlh_set_field(surface, WL_FIELD_PRESSURE, pressure, 3, 1, TEXT));
    DONE(wlh_set_field(surface, WL_FIELD_SLIP, &slip, 1, 0, TEXT));
    DONE(wlh_set_field(surface, WL_FIELD_NORMAL, normal, 3, 0, TEXT));
    EXPECT(WL_FAILED, "crashed", wlh_evaluate(surface, &step, &outputs, TEXT));
    TRUE(strstr(text, "point 1 (") != NULL && outputs.first_bad == 1);
    EXPECT(WLH_BAD_INPUT, "nothing to commit", wlh_commit(surface, TEXT));
    pressure[1] = 2e6;
    DONE(wlh_evaluate(surface, &step, &outputs, TEXT));
    TRUE(increment[1] == 2 * increment[0] && increment[0] > 0);
    DONE(wlh_commit(surface, TEXT));
    DONE(wlh_get_state(surface, state, 6, TEXT));
    TRUE(state[0] == 0.5 && state[2] == 0.5);
    return ended();
}
