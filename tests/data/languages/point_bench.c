/* Time of a law made with a point-wise helper against the same loop written by hand. From the root of the repository:
 *
 *     F="-O3 -fPIC -shared -ffp-contract=off -fno-math-errno -fno-trapping-math -I include"
 *     cc -std=c99 $F tests/data/languages/linear.c -o /tmp/linear_c.so -lm
 *     c++ -std=c++11 $F tests/data/languages/linear.cpp -o /tmp/linear_cpp.so
 *     gfortran -std=f2008 -nostdinc $F -J /tmp include/wearlaw.f90 tests/data/languages/linear.f90 -o /tmp/linear_f.so
 *     cc -std=gnu99 -O3 -I include tests/data/languages/point_bench.c -o /tmp/point_bench -ldl
 *     for l in c cpp f; do /tmp/point_bench /tmp/linear_$l.so; done
 *
 * The least of many short runs is printed, by turns, so that a busy machine slows both alike. */
#include "wearlaw.h"

#include <dlfcn.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

static double now(void) {
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

__attribute__((noinline)) static void by_hand(int64_t n, double K, double H, const double *restrict pressure,
                                              const double *restrict slip, double *restrict increment) {
    double k = K / H;
    for (int64_t i = 0; i < n; ++i) {
        double p = pressure[i] > 0 ? pressure[i] : 0;
        increment[i] = k * slip[i] * p;
    }
    __asm__ volatile("" ::: "memory");
}

static double least(double a, double b) { return a < b ? a : b; }

int main(int argc, char **argv) {
    static const int64_t sizes[] = {1, 16, 1024, 65536, 1048576};
    void *library = argc > 1 ? dlopen(argv[1], RTLD_NOW | RTLD_LOCAL) : NULL;
    void *symbol = library ? dlsym(library, "wearlaw_entry_1") : NULL;
    int32_t (*entry)(int32_t, const wl_host *, wl_law *);
    wl_host host = {sizeof host, WL_ABI_MINOR, WL_FIELDS_KNOWN, WL_OUTS_KNOWN, "bench", "1"};
    wl_law law = {sizeof law};
    if (!symbol) {
        return puts("no law"), 2;
    }
    memcpy(&entry, &symbol, sizeof entry);
    entry(0, &host, &law);
    printf("%s\n       n  by hand (ns)   law (ns)  law/hand  law, uniform slip (ns)\n", law.name);
    for (int b = 0; b < 5; ++b) {
        int64_t n = sizes[b];
        double *pressure = malloc((size_t)n * 8), *slip = malloc((size_t)n * 8), *increment = malloc((size_t)n * 8);
        double K = 1e-4, H = 1e9, hand = 1, loaded = 1, uniform = 1;
        int repeats = n < 1000 ? (int)(4000 / n) + 50 : (int)(40000 / n) + 1, status = 0;
        wl_column constants[2] = {{&K, 0}, {&H, 0}};
        wl_view view = {sizeof view, n, 3};
        wl_output output = {sizeof output, increment};
        for (int64_t i = 0; i < n; ++i) {
            pressure[i] = 1e6 + (double)i;
            slip[i] = 1e-3;
        }
        view.constant_count = 2;
        view.constants = constants;
        view.pressure = (wl_column){pressure, 1};
        for (int turn = 0; turn < (n > 100000 ? 60 : 3000); ++turn) {
            double t0 = now();
            for (int r = 0; r < repeats; ++r) by_hand(n, K, H, pressure, slip, increment);
            double t1 = now();
            view.slip = (wl_column){slip, 1};
            for (int r = 0; r < repeats; ++r) status |= law.evaluate(NULL, &view, &output);
            double t2 = now();
            view.slip = (wl_column){slip, 0};
            for (int r = 0; r < repeats; ++r) status |= law.evaluate(NULL, &view, &output);
            double t3 = now();
            hand = least(hand, (t1 - t0) / repeats);
            loaded = least(loaded, (t2 - t1) / repeats);
            uniform = least(uniform, (t3 - t2) / repeats);
        }
        printf("%8ld %13.1f %10.1f %9.3f %23.1f\n", (long)n, hand * 1e9, loaded * 1e9, loaded / hand, uniform * 1e9);
        if (status != WL_OK) {
            return puts("the law refused"), 3;
        }
        free(pressure);
        free(slip);
        free(increment);
    }
    return 0;
}
