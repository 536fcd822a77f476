/* probe_expected.c: the rows of an expected.csv that lies beside the library. */
#include "probe.h"

enum { MOST_COLUMNS = 64 };

static const char *const fields[] = {"pressure", "slip", "velocity", "slip_vector", "normal"};

/* Where the number of a column goes: `name`, or `name_x` .. of a vector, `name_start` of a state variable. */
static double *place_of(law_handle *h, job *j, const char *column) {
    for (int f = 0; f < 5; ++f) {
        size_t length = strlen(fields[f]);
        if (j->field[f] && strncmp(column, fields[f], length) == 0) {
            if (width_of(f) == 1 && column[length] == '\0') {
                return j->field[f];
            }
            if (width_of(f) == 3 && column[length] == '_' && column[length + 1] >= 'x' && column[length + 1] <= 'z') {
                return j->field[f] + (column[length + 1] - 'x');
            }
        }
    }
    for (int64_t k = 0; k < h->constants + h->states; ++k) {
        wl_quantity q = {sizeof q};
        char start[WL_NAME_SIZE + 8];
        int state = k >= h->constants;
        h->law.describe(state ? WL_KIND_STATE : WL_KIND_CONSTANT, state ? k - h->constants : k, &q);
        (void)snprintf(start, sizeof start, "%s%s", q.name, state ? "_start" : "");
        if (strcmp(column, start) == 0) {
            return state ? j->state + (k - h->constants) : j->constant[k];
        }
    }
    return strcmp(column, "dt") == 0 ? &j->dt : NULL;
}

static void hold(law_handle *h, FILE *table) {
    char heads[4096], line[4096], *names[MOST_COLUMNS];
    void *instance = make_instance(h);
    int columns = 0, row = 0;
    for (char *name = strtok(fgets(heads, sizeof heads, table), ",\n"); name; name = strtok(NULL, ",\n")) {
        names[columns++] = name;
    }
    for (; fgets(line, sizeof line, table); ++row) {
        job *j = make_job(h, 1, 1);
        double expected = NAN;
        char *at = line;
        for (int c = 0; c < columns; ++c, ++at) {
            double value = strtod(at, &at), *place = place_of(h, j, names[c]);
            if (place) {
                *place = value;
            } else if (strcmp(names[c], "increment") == 0) {
                expected = value;
            }
        }
        double found = evaluate(h, instance, j, all_outputs(h))->increment[0];
        if (!(fabs(found - expected) <= 1e-15 * fabs(expected))) {
            bad("row %d has increment %.17g, expected %.17g", row + 1, found, expected);
        }
    }
}

int probe_expected(const char *name, const char *path) {
    char beside[4096];
    const char *slash = strrchr(path, '/');
    FILE *table;
    if (strcmp(name, "values/expected") != 0) {
        return 0;
    }
    (void)snprintf(beside, sizeof beside, "%.*sexpected.csv", slash ? (int)(slash - path + 1) : 0, path);
    table = fopen(beside, "r");
    if (!table) {
        fprintf(stderr, "there is no %s\n", beside);
        _Exit(2);
    }
    hold(open_law(path), table);
    return 1;
}
