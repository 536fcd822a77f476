/* A pin on a disc (host/scenes/pin_on_disc.toml) from a solver in C: constants from a table in time, explicit steps.
 *
 *     cc -std=c99 -I include host/c/examples/pin_on_disc.c -L target/release -lwearlaw_host -o pin && ./pin
 *
 * `./pin RANK RANKS` takes the rank's share of the points, as a program under MPI does: nothing is shared. */
#include "wearlaw_host.h"

#include <stdio.h>
#include <stdlib.h>

enum { POINTS = 3, SUBSTEPS = 2000 };

static char text[400];

/* Ends the program if the library could not do what it was asked. */
static void need(int32_t status) {
    if (status == WL_OK) return;
    if (status == WL_UNRELIABLE) { /* the values may be used */
        fprintf(stderr, "warning: %s\n", text);
        return;
    }
    fprintf(stderr, "status %d: %s\n", (int)status, text);
    exit(3);
}

int main(int argc, char **argv) {
    int rank = argc > 2 ? atoi(argv[1]) : 0, ranks = argc > 2 ? atoi(argv[2]) : 1;
    int64_t first = POINTS * rank / ranks, points = POINTS * (rank + 1) / ranks - first;

    wlh_source source = {sizeof source};
    wlh_solver solver = {sizeof solver};
    source.name = "embedded:archard";
    solver.provides = WL_FIELD_PRESSURE | WL_FIELD_VELOCITY;
    solver.dimension = 3;
    wlh_law *law = NULL;
    wlh_surface *surface = NULL;
    need(wlh_open_1(&source, &solver, &law, text, sizeof text));
    need(wlh_open_surface(law, points, &surface, text, sizeof text));

    const char *names[] = {"K", "H", "m", "n"};
    double times[] = {0, 1}, values[] = {1e-4, 2e3, 1, 1, 3e-4, 1e3, 1.5, 0.8}; /* [times][constants] */
    wlh_constants constants = {sizeof constants, 4, names, values, 8, times, 2, NULL, 0};
    need(wlh_set_constants(surface, &constants, text, sizeof text));

    /* The solver's own arrays; the velocity is the same everywhere. */
    double pressure[POINTS] = {50, 50, 50}, velocity = 0.2, increment[POINTS], depth[POINTS] = {0};
    need(wlh_set_field(surface, WL_FIELD_PRESSURE, pressure + first, points, 1, text, sizeof text));
    need(wlh_set_field(surface, WL_FIELD_VELOCITY, &velocity, 1, 0, text, sizeof text));

    wlh_step step = {sizeof step};
    wlh_outputs outputs = {sizeof outputs, increment + first, points};
    step.dt = 1.0 / SUBSTEPS;
    for (int substep = 0; substep < SUBSTEPS; ++substep) {
        step.time = substep * step.dt;
        step.substep = substep + 1;
        need(wlh_evaluate(surface, &step, &outputs, text, sizeof text));
        need(wlh_commit(surface, text, sizeof text));
        for (int64_t i = first; i < first + points; ++i) depth[i] += increment[i];
    }
    for (int64_t i = first; i < first + points; ++i) printf("%.17g\n", depth[i]);
    need(wlh_close_surface(surface, text, sizeof text));
    need(wlh_close_law(law, text, sizeof text));
    return 0;
}
