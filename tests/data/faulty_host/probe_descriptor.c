/* probe_descriptor.c: what a law says of itself, its extensions and its texts. */
#include "probe.h"

#include <ctype.h>

enum { ROOM = 64 }; /* bytes watched behind a text */

static int closed(const char *text, size_t size) { return memchr(text, 0, size) != NULL; }

static int well_formed(const char *name, const char *besides) {
    int good = isalpha((unsigned char)name[0]) != 0;
    for (const char *at = name; *at; ++at) {
        good &= isalnum((unsigned char)*at) || strchr(besides, *at) != NULL;
    }
    return good;
}

static int ask(law_handle *h, int32_t kind, int64_t index, wl_quantity *q) {
    memset(q, 0, sizeof *q);
    q->struct_size = sizeof *q;
    return h->law.describe(kind, index, q) == WL_OK;
}

static void names(law_handle *h) {
    wl_quantity q, other;
    if (!closed(h->law.name, WL_NAME_SIZE) || !well_formed(h->law.name, "-_")) {
        bad("the law is called `%.63s`", h->law.name);
    }
    for (int64_t k = 0; k < h->constants + h->states; ++k) {
        int32_t kind = k < h->constants ? WL_KIND_CONSTANT : WL_KIND_STATE;
        ask(h, kind, k < h->constants ? k : k - h->constants, &q);
        if (!closed(q.name, WL_NAME_SIZE) || !well_formed(q.name, "_")) {
            bad("a quantity is called `%.63s`", q.name);
        }
        for (int64_t before = 0; before < k; ++before) {
            ask(h, before < h->constants ? WL_KIND_CONSTANT : WL_KIND_STATE,
                before < h->constants ? before : before - h->constants, &other);
            if (strcmp(q.name, other.name) == 0) {
                bad("two quantities are called `%s`", q.name);
            }
        }
    }
}

static void quantities(law_handle *h, const char *check) {
    int closing = 0;
    for (int64_t k = 0; k < h->constants + h->states; ++k) {
        wl_quantity q;
        ask(h, k < h->constants ? WL_KIND_CONSTANT : WL_KIND_STATE, k < h->constants ? k : k - h->constants, &q);
        closing += (q.flags & WL_QUANTITY_CLOSES_UNITS) != 0;
        if (strcmp(check, "descriptor/units") == 0 && !isfinite(q.metre + q.kilogram + q.second + q.kelvin)) {
            bad("an exponent of `%s` is not finite", q.name);
        }
        if (strcmp(check, "descriptor/bounds") == 0 && !(q.minimum <= q.maximum)) {
            bad("`%s` is at least %g and at most %g", q.name, q.minimum, q.maximum);
        }
        if (strcmp(check, "descriptor/defaults") == 0 && (q.default_value < q.minimum || q.default_value > q.maximum)) {
            bad("`%s` is %g by default, not in %g to %g", q.name, q.default_value, q.minimum, q.maximum);
        }
    }
    if (strcmp(check, "descriptor/units") == 0 && closing > 1) {
        bad("%d constants close the units", closing);
    }
}

static void fields(law_handle *h) {
    for (int64_t bit = 0; bit < 63; ++bit) {
        wl_quantity q;
        int64_t unknown = (h->law.reads | h->law.uses) & ~(int64_t)WL_FIELDS_KNOWN;
        if ((unknown >> bit & 1) && (!ask(h, WL_KIND_FIELD, bit, &q) || !q.name[0])) {
            bad("field %d is not in the table and has no name", (int)bit);
        }
    }
    if (h->law.writes & ~(int64_t)WL_OUTS_KNOWN) {
        bad("outputs %llx do not exist", (unsigned long long)(h->law.writes & ~(int64_t)WL_OUTS_KNOWN));
    }
}

static void claims(law_handle *h) {
    if ((h->law.claims & ~(int64_t)WL_CLAIMS_KNOWN) || (h->law.flags & ~(int64_t)WL_FLAGS_KNOWN)) {
        bad("claims %llx or flags %llx do not exist", (unsigned long long)h->law.claims,
            (unsigned long long)h->law.flags);
    }
    if (h->law.pressure_degree_constant < -1 || h->law.pressure_degree_constant >= h->constants) {
        bad("the pressure degree is in constant %lld of %lld", (long long)h->law.pressure_degree_constant,
            (long long)h->constants);
    }
}

static void ends(law_handle *h, const char *path) {
    wl_quantity q;
    int64_t past[] = {h->constants, h->constants + 1, 1000, -1};
    for (size_t i = 0; i < sizeof past / sizeof *past; ++i) {
        if (ask(h, WL_KIND_CONSTANT, past[i], &q)) {
            bad("there are %lld constants, and one of index %lld is described", (long long)h->constants,
                (long long)past[i]);
        }
    }
    for (int time = 0; time < 3; ++time) {
        for (int32_t index = 1; index < 4; ++index) {
            law_handle again;
            int32_t (*entry)(int32_t, const wl_host *, wl_law *);
            extern void *entry_of(const char *path);
            void *symbol = entry_of(path);
            memcpy(&entry, &symbol, sizeof entry);
            memset(&again, 0, sizeof again);
            again.law.struct_size = sizeof again.law;
            if (entry(index, &h->host, &again.law) != WL_NO_MORE) {
                bad("the entry has a law of index %d, asked for the %d. time", (int)index, time + 1);
            }
        }
    }
}

/* A buffer of `size` bytes with a watched room behind it, after a text was written into it. */
static void look_at_text(const char *buffer, int64_t size, const char *where) {
    for (int i = 0; i < ROOM; ++i) {
        if (buffer[size + i] != 0x7e) {
            bad("the text of %s goes beyond its %lld bytes", where, (long long)size);
        }
    }
    if (size > 0 && !closed(buffer, (size_t)size)) {
        bad("the text of %s has no end within its %lld bytes", where, (long long)size);
    }
}

static void texts(law_handle *h) {
    int64_t sizes[] = {200, 17, 8, 2, 1, 0};
    void *instance = make_instance(h);
    for (size_t i = 0; i < sizeof sizes / sizeof *sizes; ++i) {
        char buffer[200 + ROOM];
        wl_column constants[MOST_QUANTITIES];
        wl_view view;
        reply *r = make_reply(h, 1, 0);
        wl_output o = {sizeof o, r->increment};
        job *j = make_job(h, 1, 1);
        void *refused = NULL;
        memset(buffer, 0x7e, sizeof buffer);
        if (h->law.create && h->law.create(&h->host, "nonsense", &refused, buffer, sizes[i]) != WL_OK) {
            look_at_text(buffer, sizes[i], "create");
        }
        memset(buffer, 0x7e, sizeof buffer);
        for (int f = 0; f < FIELDS; ++f) {
            if (j->field[f]) {
                j->field[f][0] = NAN;
            }
        }
        fill_view(h, j, &view, constants);
        o.text = buffer;
        o.text_size = sizes[i];
        if (h->law.evaluate(instance, &view, &o) != WL_OK && buffer[0] != 0x7e) {
            look_at_text(buffer, sizes[i], "evaluate");
        }
    }
}

int probe_descriptor(const char *name, const char *path) {
    const void *known;
    if (strncmp(name, "descriptor/", 11) != 0 || strstr(name, "-structs")) {
        return 0;
    }
    law_handle *h = open_law(path);
    if (strcmp(name, "descriptor/names") == 0) {
        names(h);
    } else if (strcmp(name, "descriptor/fields") == 0) {
        fields(h);
    } else if (strcmp(name, "descriptor/claims") == 0) {
        claims(h);
    } else if (strcmp(name, "descriptor/end") == 0) {
        ends(h, path);
    } else if (strcmp(name, "descriptor/text") == 0) {
        texts(h);
    } else if (strcmp(name, "descriptor/extension") == 0) {
        known = h->law.extension ? h->law.extension("wearlaw.nobody-knows/9") : NULL;
        if (known) {
            bad("an extension that nobody knows is at %p", known);
        }
    } else {
        quantities(h, name);
    }
    return 1;
}
