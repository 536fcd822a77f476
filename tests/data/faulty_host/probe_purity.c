/* probe_purity.c: the same call gives the same answer, in any thread, process and instance. */
#include "probe.h"

#include <pthread.h>

enum { POINTS = 50, MANY = 20000, TIMES = 30 };

typedef struct task {
    law_handle *h;
    void *instance;
    const job *j;
    const reply *right;
    int64_t wrong;
} task;

static void *call(void *of) {
    task *t = of;
    t->wrong = -1;
    for (int time = 0; time < TIMES && t->wrong < 0; ++time) {
        reply *r = evaluate(t->h, t->instance, t->j, all_outputs(t->h));
        t->wrong = differs(t->h, t->right, r, t->j->points, 0);
    }
    return NULL;
}

static void in_another_process(const char *path) {
    unsigned long long found[2] = {0, 0};
    for (int k = 0; k < 2; ++k) {
        char command[4096];
        (void)snprintf(command, sizeof command, "'%s' '%s' --fingerprint 1", getenv("PROBE_ITSELF"), path);
        FILE *other = popen(command, "r");
        if (!other || fscanf(other, "%llx", &found[k]) != 1) {
            fprintf(stderr, "no answer from another process\n");
            _Exit(2);
        }
        pclose(other);
    }
    if (found[0] != found[1]) {
        bad("two processes answer with other bits: %llx and %llx", found[0], found[1]);
    }
}

static void interleaved(law_handle *h) {
    job *one = make_job(h, POINTS, 1), *two = make_job(h, POINTS, 1);
    void *first = make_instance(h), *second = make_instance(h);
    for (int64_t k = 0; k < h->constants; ++k) {
        two->constant[k][0] *= 1.5 + (double)k; /* their ratio differs, too */
    }
    reply *right_one = evaluate(h, make_instance(h), one, all_outputs(h));
    reply *right_two = evaluate(h, make_instance(h), two, all_outputs(h));
    for (int time = 0; time < 3; ++time) {
        if (differs(h, right_one, evaluate(h, first, one, all_outputs(h)), POINTS, 0) >= 0 ||
            differs(h, right_two, evaluate(h, second, two, all_outputs(h)), POINTS, 0) >= 0) {
            bad("two instances with other constants, called in turn, answer otherwise than each alone");
        }
    }
}

static void concurrent(law_handle *h) {
    task tasks[4];
    pthread_t threads[4];
    void *instance = make_instance(h);
    for (int k = 0; k < 4; ++k) {
        job *j = make_job(h, MANY, (uint64_t)k + 1);
        tasks[k] = (task){h, instance, j, evaluate(h, make_instance(h), j, all_outputs(h)), -1};
    }
    for (int k = 0; k < 4; ++k) {
        pthread_create(&threads[k], NULL, call, &tasks[k]);
    }
    for (int k = 0; k < 4; ++k) {
        pthread_join(threads[k], NULL);
        if (tasks[k].wrong >= 0) {
            bad("thread %d of 4 gets another answer at point %lld", k, (long long)tasks[k].wrong);
        }
    }
}

int probe_purity(const char *name, const char *path) {
    if (strncmp(name, "determinism/", 12) != 0 && strncmp(name, "threads/", 8) != 0) {
        return 0;
    }
    law_handle *h = open_law(path);
    job *j = make_job(h, POINTS, 1);
    if (strcmp(name, "determinism/process") == 0) {
        in_another_process(path);
    } else if (strcmp(name, "threads/interleaved") == 0) {
        interleaved(h);
    } else if (strcmp(name, "threads/concurrent") == 0) {
        concurrent(h);
    } else {
        void *instance = make_instance(h);
        task t = {h, instance, j, evaluate(h, instance, j, all_outputs(h)), -1};
        if (strcmp(name, "determinism/repeat") == 0) {
            call(&t);
        } else if (strcmp(name, "determinism/thread") == 0) {
            pthread_t thread;
            pthread_create(&thread, NULL, call, &t);
            pthread_join(thread, NULL);
        } else if (strcmp(name, "determinism/recreate") == 0) {
            end_instance(h, instance);
            t.instance = make_instance(h);
            call(&t);
            end_instance(h, make_instance(h)); /* one that comes and goes is nothing to it */
            if (t.wrong < 0) {
                call(&t);
            }
        } else {
            return 0;
        }
        if (t.wrong >= 0) {
            bad("the same call gives another answer at point %lld", (long long)t.wrong);
        }
    }
    return 1;
}
