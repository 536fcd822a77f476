/* probe_faults.c: laws that do not come back, tried with every pair of extreme inputs and with millions of points. */
#include "probe.h"

#include <pthread.h>
#include <signal.h>
#include <sys/mman.h>

static const double extremes[] = {0,      -0.0,     5e-324, 1e-310,   1e-300, 1e-30, -1e-30, 1,
                                  -1,     1e30,     -1e30,  1e300,    -1e300, INFINITY, -INFINITY, NAN};
enum { EXTREMES = sizeof extremes / sizeof *extremes, STACK = 2 << 20, GUARD = 1 << 20 };

static int millions; /* whether rare points are looked for */
static char *stack; /* GUARD bytes that nobody may touch, then STACK bytes */

/* Says whether the address that could not be reached lies right below the stack. */
static void segv(int number, siginfo_t *info, void *context) {
    char *at = info->si_addr;
    (void)context;
    if (at >= stack && at < stack + GUARD + 4096) {
        note("stack");
    }
    signal(number, SIG_DFL);
    raise(number);
}

static double *value(law_handle *h, job *j, int which) {
    return which < FIELDS                  ? j->field[which]
           : which < FIELDS + h->constants ? j->constant[which - FIELDS]
                                           : j->state + (which - FIELDS - h->constants);
}

static void *try_everything(void *of) {
    law_handle *h = of;
    void *instance = make_instance(h);
    int inputs = FIELDS + (int)h->constants + (int)h->states;
    stack_t other = {.ss_sp = malloc(1 << 16), .ss_size = 1 << 16};
    struct sigaction action = {.sa_sigaction = segv, .sa_flags = SA_SIGINFO | SA_ONSTACK};
    sigaltstack(&other, NULL);
    sigaction(SIGSEGV, &action, NULL);
    sigaction(SIGBUS, &action, NULL);
    for (int one = 0; one < inputs; ++one) {
        for (int two = one; two < inputs; ++two) {
            job *j = make_job(h, 1, 1);
            if (!value(h, j, one) || !value(h, j, two)) {
                continue;
            }
            for (int e = 0; e < EXTREMES * EXTREMES; ++e) {
                *value(h, j, one) = extremes[e % EXTREMES];
                *value(h, j, two) = extremes[e / EXTREMES];
                reply *r = evaluate(h, instance, j, e % 2 ? all_outputs(h) : 0);
                free(r->increment), free(r->direction), free(r->state), free(r->slope), free(r->status), free(r);
            }
        }
    }
    for (uint64_t seed = 1; seed <= 20 && millions; ++seed) {
        job *j = make_job(h, 500000, seed);
        reply *r = evaluate(h, instance, j, 0);
        free(r->increment), free(r->direction), free(r->state), free(r->slope), free(r->status), free(r);
        for (int f = 0; f < FIELDS; ++f) {
            free(j->field[f]);
        }
        free(j->state);
    }
    end_instance(h, instance);
    return NULL;
}

static void refusal(law_handle *h) {
    void *instance = NULL;
    char text[200] = "";
    int32_t status;
    if (!h->law.create) {
        return;
    }
    make_instance(h);
    status = h->law.create(&h->host, "no law has = this option", &instance, text, sizeof text);
    if (status != WL_OK && !text[0]) {
        bad("create answers %d to strange options and says nothing", (int)status);
    }
    status = h->law.create(&h->host, NULL, &instance, text, sizeof text);
    if (status != WL_OK) {
        bad("create makes an instance, and answers %d to the same call once it refused another", (int)status);
    }
}

int probe_faults(const char *name, const char *path) {
    pthread_attr_t attributes;
    pthread_t thread;
    if (strncmp(name, "faults/", 7) != 0) {
        return 0;
    }
    law_handle *h = open_law(path);
    if (strcmp(name, "faults/create") == 0) {
        refusal(h);
        return 1;
    }
    millions = strcmp(name, "faults/signal") == 0;
    stack = mmap(NULL, GUARD + STACK, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    mprotect(stack, GUARD, PROT_NONE);
    pthread_attr_init(&attributes);
    pthread_attr_setstack(&attributes, stack + GUARD, STACK);
    pthread_create(&thread, &attributes, try_everything, h);
    pthread_join(thread, NULL);
    return 1;
}
