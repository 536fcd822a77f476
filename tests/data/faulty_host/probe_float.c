/* probe_float.c: the floating-point environment before and after everything that a law does, and NaN as an input. */
#include "probe.h"

#include <dlfcn.h>
#include <fenv.h>
#include <pthread.h>

/* Rounding, flushing to zero and exception masks, without the exception flags. */
static uint64_t control(void) {
#if defined(__x86_64__)
    uint32_t mxcsr;
    uint16_t x87;
    __asm__ volatile("stmxcsr %0" : "=m"(mxcsr));
    __asm__ volatile("fnstcw %0" : "=m"(x87));
    return (uint64_t)(mxcsr & 0xffc0) << 16 | (x87 & 0x0f3f);
#elif defined(__aarch64__)
    uint64_t fpcr;
    __asm__ volatile("mrs %0, fpcr" : "=r"(fpcr));
    return fpcr;
#else
    return (uint64_t)fegetround();
#endif
}

static void compare(uint64_t before, const char *when) {
    uint64_t after = control();
    if (after != before) {
        bad("the control words of the floating-point unit are %llx %s, and were %llx", (unsigned long long)after, when,
            (unsigned long long)before);
    }
}

static uint64_t first;

static void *in_a_thread(void *of) {
    law_handle *h = of;
    compare(first, "in a thread that was started after loading");
    evaluate(h, make_instance(h), make_job(h, 10, 1), all_outputs(h));
    compare(first, "after an evaluation in another thread");
    return NULL;
}

static int has(const char *name, const char *part) { return strcmp(name, part) == 0; }

static void nan_in(law_handle *h) {
    void *instance = make_instance(h);
    for (int which = 0; which < FIELDS + h->constants + h->states; ++which) {
        job *j = make_job(h, 1, 3);
        double *of = which < FIELDS ? j->field[which]
                     : which < FIELDS + h->constants ? j->constant[which - FIELDS]
                                                     : j->state + (which - FIELDS - h->constants);
        if (!of) {
            continue;
        }
        of[0] = NAN;
        reply *r = evaluate(h, instance, j, all_outputs(h) & ~WL_OUT_DIRECTION);
        int silent = isnan(r->increment[0]) || ((r->want & WL_OUT_D_PRESSURE) && isnan(r->slope[0]));
        for (int64_t k = 0; k < h->states && (r->want & WL_OUT_STATE); ++k) {
            silent |= isnan(r->state[k]);
        }
        if (r->returned <= WL_UNRELIABLE && silent) {
            bad("input %d is not a number, increment %g, status %d", which, r->increment[0], (int)r->returned);
        }
    }
}

int probe_float(const char *name, const char *path) {
    pthread_t thread;
    if (strncmp(name, "float/", 6) != 0) {
        return 0;
    }
    first = control();
    law_handle *h = open_law(path);
    if (has(name, "float/load")) {
        compare(first, "after loading");
    } else if (has(name, "float/thread")) {
        pthread_create(&thread, NULL, in_a_thread, h);
        pthread_join(thread, NULL);
    } else if (has(name, "float/create")) {
        void *instance = NULL;
        char text[200] = "";
        make_instance(h);
        compare(first, "after create");
        if (h->law.create) {
            h->law.create(&h->host, "no law has = this option", &instance, text, sizeof text);
            compare(first, "after a create that was refused");
        }
    } else if (has(name, "float/evaluate")) {
        void *instance = make_instance(h);
        job *j = make_job(h, 10, 1);
        first = control();
        for (int call = 0; call < 20001; ++call) {
            evaluate(h, instance, j, all_outputs(h));
            compare(first, "after an evaluation");
        }
    } else if (has(name, "float/destroy")) {
        void *instance = make_instance(h);
        first = control();
        end_instance(h, instance);
        compare(first, "after destroy");
    } else if (has(name, "float/nan")) {
        nan_in(h);
    } else {
        return 0;
    }
    return 1;
}
