/* law.c: from a library to a law that can be called. */
#include "probe.h"

#include <dlfcn.h>

/* The real fields in the order of their bits, as offsets into the view; how many numbers each has at a point. */
static const struct {
    size_t offset;
    int width;
} fields[FIELDS] = {
    {offsetof(wl_view, pressure), 1},         {offsetof(wl_view, slip), 1},
    {offsetof(wl_view, velocity), 1},         {offsetof(wl_view, slip_vector), 3},
    {offsetof(wl_view, normal), 3},           {offsetof(wl_view, coordinates), 3},
    {offsetof(wl_view, tangent), 3},          {offsetof(wl_view, temperature), 1},
    {offsetof(wl_view, counter_temperature), 1}, {offsetof(wl_view, friction_stress), 3},
    {offsetof(wl_view, friction_coefficient), 1}, {offsetof(wl_view, friction_work), 1},
    {offsetof(wl_view, accumulated_wear), 1}, {offsetof(wl_view, accumulated_slip), 1},
    {offsetof(wl_view, nodal_traction), 1},   {offsetof(wl_view, gap), 1},
    {offsetof(wl_view, area), 1}};

int width_of(int field) { return fields[field].width; }

int64_t bit_of(int field) { return (int64_t)1 << field; }

/* Sets the step of a field's column in a view and answers where its pointer is kept. */
double *column_of(wl_view *view, int field, int64_t step) {
    wl_column *column = (wl_column *)((char *)view + fields[field].offset);
    column->step = step;
    return (double *)column;
}

int try_open(const char *path, law_handle *h) {
    int32_t (*entry)(int32_t, const wl_host *, wl_law *);
    void *symbol;
    memset(h, 0, sizeof *h);
    h->library = dlopen(path, RTLD_NOW | RTLD_LOCAL);
    symbol = h->library ? dlsym(h->library, "wearlaw_entry_1") : NULL;
    if (!symbol) {
        return 0;
    }
    memcpy(&entry, &symbol, sizeof entry);
    h->host = (wl_host){sizeof h->host, WL_ABI_MINOR, WL_FIELDS_KNOWN, WL_OUTS_KNOWN, "probe", "1"};
    h->law.struct_size = sizeof h->law;
    h->law.pressure_degree = NAN;
    h->law.pressure_degree_constant = -1;
    if (entry(0, &h->host, &h->law) != WL_OK || !h->law.evaluate) {
        return 0;
    }
    h->constants = h->law.constant_count;
    h->states = h->law.state_count;
    return h->constants <= MOST_QUANTITIES;
}

law_handle *open_law(const char *path) {
    law_handle *h = malloc(sizeof *h);
    if (!try_open(path, h)) {
        fprintf(stderr, "%s gives no law: %s\n", path, h->library ? "its entry refuses" : dlerror());
        _Exit(2);
    }
    return h;
}

void *make_instance(law_handle *h) {
    void *instance = NULL;
    char text[200] = "";
    if (h->law.create && h->law.create(&h->host, NULL, &instance, text, sizeof text) != WL_OK) {
        fprintf(stderr, "no instance: %s\n", text);
        _Exit(2);
    }
    return instance;
}

void end_instance(law_handle *h, void *instance) {
    if (h->law.destroy) {
        h->law.destroy(instance);
    }
}
