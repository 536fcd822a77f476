/* probe_sizes.c: structs of the 1.0 size that end at a page nobody may touch, and longer ones of a newer host. */
#include "probe.h"

#include <dlfcn.h>
#include <sys/mman.h>
#include <unistd.h>

/* A copy of `size` bytes that ends where a page begins that may not be touched. */
static void *at_the_edge(const void *from, size_t size) {
    size_t page = (size_t)sysconf(_SC_PAGESIZE), whole = (size + page - 1) / page * page;
    char *memory = mmap(NULL, whole + page, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    mprotect(memory + whole, page, PROT_NONE);
    return memcpy(memory + whole - size, from, size);
}

/* A copy with 64 bytes behind it that a law of this version does not know, and which must stay. */
static void *longer(const void *from, size_t size) {
    char *memory = malloc(size + 64);
    int64_t grown = (int64_t)size + 64;
    memset(memory, 0x3c, size + 64);
    memcpy(memory, from, size);
    memcpy(memory, &grown, sizeof grown);
    return memory;
}

static void untouched(const void *memory, size_t size, const char *what) {
    for (size_t i = size; i < size + 64; ++i) {
        if (((const char *)memory)[i] != 0x3c) {
            bad("the part of a longer %s that no law of 1.0 knows was written", what);
        }
    }
}

void *entry_of(const char *path);
void *entry_of(const char *path) { return dlsym(dlopen(path, RTLD_NOW | RTLD_LOCAL), "wearlaw_entry_1"); }

typedef void *(*placing)(const void *from, size_t size);

/* Every struct that crosses the ABI, placed so. */
static void with(const char *path, placing place, int grown) {
    law_handle *h = open_law(path);
    int32_t (*entry)(int32_t, const wl_host *, wl_law *);
    void *symbol = entry_of(path);
    wl_law blank;
    wl_quantity question = {sizeof question};
    wl_column columns[MOST_QUANTITIES];
    wl_view view;
    job *j = make_job(h, 5, 1);
    reply *r = make_reply(h, 5, WL_OUT_STATE), *right = evaluate(h, make_instance(h), j, WL_OUT_STATE);
    wl_output output = {sizeof output, r->increment};
    memcpy(&entry, &symbol, sizeof entry);
    memset(&blank, 0, sizeof blank);
    blank.struct_size = sizeof blank;
    wl_law *law = place(&blank, sizeof blank);
    const wl_host *host = place(&h->host, sizeof h->host);
    if (entry(0, host, law) != WL_OK) {
        bad("the entry refuses a table of %lld bytes", (long long)law->struct_size);
    }
    wl_quantity *quantity = place(&question, sizeof question);
    if (h->constants > 0 && law->describe(WL_KIND_CONSTANT, 0, quantity) != WL_OK) {
        bad("describe refuses a quantity of %lld bytes", (long long)quantity->struct_size);
    }
    void *instance = make_instance(h);
    fill_view(h, j, &view, columns);
    output.first_bad = -1;
    output.state = h->states ? r->state : NULL;
    const wl_view *placed = place(&view, sizeof view);
    wl_output *answer = place(&output, sizeof output);
    int32_t status = law->evaluate(instance, placed, answer);
    if (status != WL_OK || differs(h, right, r, 5, 0) >= 0) {
        bad("a view of %lld bytes is answered with status %d", (long long)placed->struct_size, (int)status);
    }
    if (grown) {
        untouched(law, sizeof *law, "table");
        untouched(quantity, sizeof *quantity, "quantity");
        untouched(placed, sizeof *placed, "view");
        untouched(answer, sizeof *answer, "output");
    }
}

int probe_sizes(const char *name, const char *path) {
    if (strcmp(name, "descriptor/smaller-structs") == 0) {
        with(path, at_the_edge, 0);
    } else if (strcmp(name, "descriptor/larger-structs") == 0) {
        with(path, longer, 1);
    } else {
        return 0;
    }
    return 1;
}
