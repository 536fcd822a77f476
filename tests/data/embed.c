/* A host of sixty lines: loads a law with dlopen, gives it three points, prints their wear increments.
 *
 *     cc -std=c99 -I include tests/data/embed.c -ldl -o embed && ./embed ./libarchard.so K=1e-4 H=2e9
 *
 * The pressures are 1e6, 2e6 and 5e7; the slip is 1e-3 and the velocity 0.1 at all points, dt is 0.01. */
#include "wearlaw.h"

#include <dlfcn.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

int main(int argc, char **argv) {
    void *library = argc > 1 ? dlopen(argv[1], RTLD_NOW | RTLD_LOCAL) : NULL;
    int32_t (*entry)(int32_t, const wl_host *, wl_law *);
    void *symbol = library ? dlsym(library, "wearlaw_entry_1") : NULL;
    wl_host host = {sizeof host, WL_ABI_MINOR, WL_FIELDS_KNOWN, WL_OUTS_KNOWN, "embed", "1"};
    wl_law law = {sizeof law};
    if (!symbol) return fprintf(stderr, "no law: %s\n", argc > 1 ? dlerror() : "give its path"), 2;
    memcpy(&entry, &symbol, sizeof entry);
    if (entry(0, &host, &law) != WL_OK || law.state_count > 0) return fprintf(stderr, "%s: not for this host\n", argv[1]), 2;

    /* Constants: the law's defaults, then NAME=VALUE from the command line. */
    double values[64];
    wl_column constants[64];
    for (int64_t i = 0; i < law.constant_count && i < 64; ++i) {
        wl_quantity quantity = {sizeof quantity};
        law.describe(WL_KIND_CONSTANT, i, &quantity);
        values[i] = quantity.default_value;
        constants[i] = (wl_column){&values[i], 0};
        for (int a = 2; a < argc; ++a) {
            size_t length = strlen(quantity.name);
            if (strncmp(argv[a], quantity.name, length) == 0 && argv[a][length] == '=') {
                values[i] = atof(argv[a] + length + 1);
            }
        }
    }

    double pressure[3] = {1e6, 2e6, 5e7}, slip = 1e-3, velocity = 0.1, increment[3];
    char text[200] = "";
    wl_view view = {sizeof view, 3, 3};
    wl_output output = {sizeof output, increment};
    void *instance = NULL;
    view.dt = 0.01;
    view.constant_count = law.constant_count;
    view.constants = constants;
    view.pressure = (wl_column){pressure, 1};
    view.slip = (wl_column){&slip, 0};
    view.velocity = (wl_column){&velocity, 0};
    output.text = text;
    output.text_size = sizeof text;
    int32_t status = law.create ? law.create(&host, NULL, &instance, text, sizeof text) : WL_OK;
    status = status == WL_OK ? law.evaluate(instance, &view, &output) : status;
    for (int i = 0; status <= WL_UNRELIABLE && i < 3; ++i) {
        printf("%.17g\n", increment[i]);
    }
    fprintf(stderr, "%s: status %d %s\n", law.name, (int)status, text);
    if (law.destroy) law.destroy(instance);
    return status <= WL_UNRELIABLE ? 0 : 3;
}
