/* probe_memory.c: arrays between pages that nobody may touch, inputs that nobody may write, leaks. */
#include "probe.h"

#include <dirent.h>
#include <malloc.h>
#include <sys/mman.h>
#include <unistd.h>

enum { POINTS = 37 };

static const char *wanted;

static int is(const char *name) { return strcmp(wanted, name) == 0; }

static size_t page(void) { return (size_t)sysconf(_SC_PAGESIZE); }

/* A copy of an array, flush with a forbidden page behind it or before it; constant if asked for. */
static void *guarded(const void *from, size_t size, int behind, int constant) {
    size_t whole = (size + page() - 1) / page() * page();
    char *memory = mmap(NULL, whole + 2 * page(), PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    char *at = memory + page() + (behind ? whole - size : 0);
    memcpy(at, from, size);
    mprotect(memory, page(), PROT_NONE);
    mprotect(memory + page() + whole, page(), PROT_NONE);
    if (constant) {
        mprotect(memory + page(), whole, PROT_READ);
    }
    return at;
}

/* Evaluates with every array so placed, fields maybe given once; the worst status does not matter here, a crash does. */
static void evaluate_guarded(law_handle *h, int behind, int inputs_constant, int state_constant, int64_t points,
                             int once) {
    wl_column columns[MOST_QUANTITIES];
    wl_view view;
    job *j = make_job(h, points, 1);
    reply *r = make_reply(h, points, all_outputs(h));
    size_t real = sizeof(double), n = (size_t)points;
    for (int f = 0; f < FIELDS; ++f) {
        if (j->field[f]) {
            j->field[f][0] = f == 0 ? -1e6 : j->field[f][0]; /* something to be clamped */
            j->field[f] = guarded(j->field[f], real * (once ? 1 : n) * (size_t)width_of(f), behind, inputs_constant);
            j->step[f] = once ? 0 : j->step[f];
        }
    }
    for (int64_t k = 0; k < h->constants; ++k) {
        j->constant[k] = guarded(j->constant[k], real, behind, inputs_constant);
    }
    j->state = guarded(j->state, real * n * (size_t)h->states, behind, state_constant);
    fill_view(h, j, &view, columns);
    view.request = r->want;
    wl_output o = {sizeof o, guarded(r->increment, real * n, behind, 0)};
    o.first_bad = -1;
    o.direction = r->want & WL_OUT_DIRECTION ? guarded(r->direction, 3 * real * n, behind, 0) : NULL;
    o.state = h->states ? guarded(r->state, real * n * (size_t)h->states, behind, 0) : NULL;
    o.d_pressure = r->want & WL_OUT_D_PRESSURE ? guarded(r->slope, real * n, behind, 0) : NULL;
    o.status = guarded(r->status, sizeof(int32_t) * n, behind, 0);
    wl_view *placed = inputs_constant ? guarded(&view, sizeof view, 1, 1) : &view;
    h->law.evaluate(make_instance(h), placed, &o);
}

/* Whether any item that was asked for is as it was before the call, at points with and without wear. */
static void look_for_unwritten(law_handle *h, int state) {
    for (int zero = 0; zero < 4; ++zero) {
        job *j = make_job(h, POINTS, 1);
        for (int f = 0; f < FIELDS; ++f) {
            for (int64_t i = 0; j->field[f] && width_of(f) == 1 && i < POINTS; ++i) {
                j->field[f][i] = ((zero & 1) && f == 0) || ((zero & 2) && f > 0 && f < 3) ? 0 : j->field[f][i];
            }
        }
        reply *r = evaluate(h, make_instance(h), j, all_outputs(h));
        for (int64_t i = 0; i < POINTS && state; ++i) {
            for (int64_t k = 0; k < h->states; ++k) {
                if (unwritten(r->state[h->states * i + k])) {
                    bad("state variable %lld of point %lld is not written", (long long)k, (long long)i);
                }
            }
        }
        for (int64_t i = 0; i < POINTS && !state; ++i) {
            if (unwritten(r->increment[i]) || ((r->want & WL_OUT_D_PRESSURE) && unwritten(r->slope[i])) ||
                ((r->want & WL_OUT_STATUS) && r->status[i] == UNWRITTEN_STATUS)) {
                bad("increment, derivative or status of point %lld is not written", (long long)i);
            }
            for (int k = 0; k < 3 && (r->want & WL_OUT_DIRECTION); ++k) {
                if (unwritten(r->direction[3 * i + k])) {
                    bad("the direction of point %lld is not written", (long long)i);
                }
            }
        }
    }
}

/* Only what the law must have is given. */
static void without_uses(law_handle *h) {
    job *j = make_job(h, POINTS, 1);
    for (int f = 0; f < FIELDS; ++f) {
        if (!(h->law.reads & bit_of(f))) {
            j->field[f] = NULL;
        }
    }
    reply *r = evaluate(h, make_instance(h), j, all_outputs(h));
    if (r->returned > WL_UNRELIABLE) {
        bad("without the fields that it only uses, it answers status %d", (int)r->returned);
    }
}

static size_t in_use(void) {
    struct mallinfo2 now = mallinfo2();
    return now.uordblks + now.hblkhd;
}

static int files(void) {
    DIR *folder = opendir("/proc/self/fd");
    int count = 0;
    while (folder && readdir(folder)) {
        ++count;
    }
    closedir(folder);
    return count;
}

static void leaks_of_calls(law_handle *h) {
    enum { CALLS = 20000, LARGE = 2000 };
    for (int way = 0; way < 3; ++way) { /* answered, refused, and refused with many points */
        wl_column columns[MOST_QUANTITIES];
        wl_view view;
        int refused = way > 0, points = way == 2 ? LARGE : 4, calls = way == 2 ? CALLS / 40 : CALLS;
        job *j = make_job(h, points, 1);
        reply *r = make_reply(h, points, 0);
        wl_output o = {sizeof o, r->increment};
        void *instance = make_instance(h);
        for (int f = 0; f < FIELDS && refused; ++f) {
            if (j->field[f]) {
                j->field[f][0] = NAN;
            }
        }
        fill_view(h, j, &view, columns);
        o.state = h->states ? r->state : NULL;
        h->law.evaluate(instance, &view, &o);
        size_t before = in_use();
        for (int call = 0; call < calls; ++call) {
            h->law.evaluate(instance, &view, &o);
        }
        if (in_use() > before + CALLS) {
            bad("%d calls of %d points hold %zu bytes more", calls, points, in_use() - before);
        }
    }
}

static void leaks_of_instances(law_handle *h) {
    enum { INSTANCES = 200 };
    end_instance(h, make_instance(h));
    size_t before = in_use();
    int open_before = files();
    for (int k = 0; k < INSTANCES; ++k) {
        end_instance(h, make_instance(h));
    }
    if (in_use() > before + 64 * INSTANCES || files() > open_before + 10) { /* freed blocks may be kept back */
        bad("%d instances leave %zu bytes and %d files", INSTANCES, in_use() - before, files() - open_before);
    }
}

int probe_memory(const char *name, const char *path) {
    if (strncmp(name, "memory/", 7) != 0 && strcmp(name, "state/start") != 0 && strcmp(name, "state/end") != 0) {
        return 0;
    }
    wanted = name;
    law_handle *h = open_law(path);
    if (is("memory/after") || is("memory/before")) {
        for (int64_t points = 1; points < 70; ++points) {
            evaluate_guarded(h, is("memory/after"), 0, 0, points, 0);
            evaluate_guarded(h, is("memory/after"), 0, 0, points, 1);
        }
    } else if (is("memory/inputs")) {
        evaluate_guarded(h, 1, 1, 0, POINTS, 0);
    } else if (is("state/start")) {
        evaluate_guarded(h, 1, 0, 1, POINTS, 0);
    } else if (is("memory/unwritten") || is("state/end")) {
        look_for_unwritten(h, is("state/end"));
    } else if (is("memory/undeclared")) {
        evaluate(h, make_instance(h), make_job(h, POINTS, 1), all_outputs(h));
    } else if (is("memory/uses")) {
        without_uses(h);
    } else if (is("memory/outputs")) {
        evaluate(h, make_instance(h), make_job(h, POINTS, 1), 0);
    } else if (is("memory/calls")) {
        leaks_of_calls(h);
    } else if (is("memory/instances")) {
        leaks_of_instances(h);
    } else {
        return 0;
    }
    return 1;
}
