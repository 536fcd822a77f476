/* Bad input, from C: what each call says of it, and that nothing was changed by it. Arguments: the library of a law in C
 * with the fields pressure and slip, its SHA-256, the library of a law that reads what tests `needs` say, a source. */
#include "expect.h"

#include <math.h>

static wlh_source named(const char *name) {
    wlh_source source = {sizeof source};
    source.name = name;
    return source;
}

static wlh_solver providing(int64_t fields) {
    wlh_solver solver = {sizeof solver};
    solver.provides = fields;
    solver.dimension = 3;
    return solver;
}

static const int64_t BOTH = WL_FIELD_PRESSURE | WL_FIELD_VELOCITY;

static void opening(char **argv) {
    wlh_law *law = (wlh_law *)&law;
    wlh_solver solver = providing(BOTH);
    wlh_source source = named("archad");
    EXPECT(WLH_NOT_LOADED, "did you mean `archard`?", wlh_open_1(&source, &solver, &law, TEXT));
    TRUE(law == NULL);
    source = named("embedded:archard");
    EXPECT(WLH_BAD_INPUT, "`law` is NULL", wlh_open_1(&source, &solver, NULL, TEXT));
    EXPECT(WLH_BAD_INPUT, "`wlh_source` is NULL", wlh_open_1(NULL, &solver, &law, TEXT));
    EXPECT(WLH_BAD_INPUT, "`wlh_solver` is NULL", wlh_open_1(&source, NULL, &law, TEXT));
    source.struct_size = 8;
    EXPECT(WLH_BAD_INPUT, "`wlh_source.struct_size` is 8, expected at least 48", wlh_open_1(&source, &solver, &law, TEXT));
    source = named(NULL);
    EXPECT(WLH_BAD_INPUT, "`wlh_source.name` is NULL", wlh_open_1(&source, &solver, &law, TEXT));
    source = named("law\xff");
    EXPECT(WLH_BAD_INPUT, "not UTF-8 (byte 3)", wlh_open_1(&source, &solver, &law, TEXT));
    source = named("./no-such-law.so");
    EXPECT(WLH_NOT_LOADED, "no file `no-such-law.so`", wlh_open_1(&source, &solver, &law, TEXT));
    source = named(argv[4]);
    EXPECT(WLH_NOT_LOADED, "wearlaw build", wlh_open_1(&source, &solver, &law, TEXT));
    source = named(argv[1]);
    source.sha256 = "0000000000000000000000000000000000000000000000000000000000000000";
    solver = providing(WL_FIELD_PRESSURE | WL_FIELD_SLIP);
    EXPECT(WLH_NOT_LOADED, argv[2], wlh_open_1(&source, &solver, &law, TEXT));
    source.sha256 = argv[2];
    DONE(wlh_open_1(&source, &solver, &law, TEXT));
    DONE(wlh_close_law(law, TEXT));
    source = named("embedded:archard");
    source.deadline = -1;
    EXPECT(WLH_BAD_INPUT, "`wlh_source.deadline` is -1", wlh_open_1(&source, &solver, &law, TEXT));
    source = named("embedded:archard");
    source.worker = "./no-such-program";
    EXPECT(WLH_NOT_LOADED, "no-such-program", wlh_open_1(&source, &solver, &law, TEXT));
}

static void solvers(char **argv) {
    wlh_law *law;
    wlh_source source = named("embedded:archard");
    wlh_solver solver = providing(WL_FIELD_PRESSURE | WL_FIELD_SLIP);
    EXPECT(WLH_BAD_INPUT, "law `archard` needs `velocity`, which the solver's `provides` does not have: provide "
                          "WL_FIELD_VELOCITY by the sliding velocity (slip over dt", wlh_open_1(&source, &solver, &law, TEXT));
    solver = providing(BOTH | (int64_t)1 << 40);
    EXPECT(WLH_BAD_INPUT, "field 0x10000000000 is none", wlh_open_1(&source, &solver, &law, TEXT));
    solver = providing(BOTH);
    solver.dimension = 1;
    EXPECT(WLH_BAD_INPUT, "`wlh_solver.dimension` is 1, expected 2 or 3", wlh_open_1(&source, &solver, &law, TEXT));
    solver = providing(BOTH);
    solver.unit_metre = -1e-3;
    EXPECT(WLH_BAD_INPUT, "`wlh_solver.unit_metre` is -0.001", wlh_open_1(&source, &solver, &law, TEXT));
    solver = providing(BOTH);
    solver.absolute_zero = NAN;
    EXPECT(WLH_BAD_INPUT, "`wlh_solver.absolute_zero` is NaN", wlh_open_1(&source, &solver, &law, TEXT));
    source = named(argv[3]);
    solver = providing(WL_FIELDS_KNOWN);
    EXPECT(WLH_NOT_LOADED, "is malformed", wlh_open_1(&source, &solver, &law, TEXT));
}

static void constants(wlh_surface *surface) {
    const char *names[] = {"K", "h", "m"};
    double values[] = {1e-4, 2e9, 1, 1}, more[] = {1, 2, 3, 4, 5}, times[] = {0, 0};
    wlh_constants given = {sizeof given, 2, names, values, 2, NULL, 0, NULL, 0};
    EXPECT(WLH_BAD_INPUT, "no constant `h` (did you mean `H`?)", wlh_set_constants(surface, &given, TEXT));
    names[1] = "K";
    EXPECT(WLH_BAD_INPUT, "`K` of law `archard` is given twice", wlh_set_constants(surface, &given, TEXT));
    names[1] = NULL;
    EXPECT(WLH_BAD_INPUT, "`wlh_constants.names` is NULL", wlh_set_constants(surface, &given, TEXT));
    names[1] = "H";
    given.count = 1;
    EXPECT(WLH_BAD_INPUT, "`wlh_constants.value_count` is 2, expected 1", wlh_set_constants(surface, &given, TEXT));
    given.value_count = 1;
    EXPECT(WLH_BAD_INPUT, "constant `H` (number 2) of law `archard` is not given", wlh_set_constants(surface, &given, TEXT));
    given.count = -1;
    EXPECT(WLH_BAD_INPUT, "`wlh_constants.count` is -1", wlh_set_constants(surface, &given, TEXT));
    given.count = given.value_count = 2;
    values[1] = -1;
    EXPECT(WLH_BAD_INPUT, "constant `H` of law `archard` is -1", wlh_set_constants(surface, &given, TEXT));
    values[1] = NAN;
    EXPECT(WLH_BAD_INPUT, "constant `H` of law `archard` is NaN", wlh_set_constants(surface, &given, TEXT));
    given.values = NULL;
    EXPECT(WLH_BAD_INPUT, "`wlh_constants.values` is NULL", wlh_set_constants(surface, &given, TEXT));
    given.names = NULL;
    given.values = more;
    given.count = given.value_count = 5;
    EXPECT(WLH_BAD_INPUT, "5 constants are given, law `archard` has 4", wlh_set_constants(surface, &given, TEXT));
    given.count = 2;
    given.value_count = 4;
    given.times = times;
    given.time_count = 2;
    EXPECT(WLH_BAD_INPUT, "`wlh_constants.times[1]` is 0, expected a number above the one before",
           wlh_set_constants(surface, &given, TEXT));
    times[1] = 1;
    more[3] = -2;
    EXPECT(WLH_BAD_INPUT, "row 2: constant `H` of law `archard` is -2", wlh_set_constants(surface, &given, TEXT));
}

static void columns(wlh_surface *surface) {
    double p[7] = {0};
    int64_t numbers[3] = {0};
    EXPECT(WLH_BAD_INPUT, "`pressure` has 2 values, expected 3", wlh_set_field(surface, WL_FIELD_PRESSURE, p, 2, 1, TEXT));
    EXPECT(WLH_BAD_INPUT, "`pressure` has 6 values, expected 7", wlh_set_field(surface, WL_FIELD_PRESSURE, p, 6, 3, TEXT));
    EXPECT(WLH_BAD_INPUT, "step of `pressure` is -1", wlh_set_field(surface, WL_FIELD_PRESSURE, p, 3, -1, TEXT));
    EXPECT(WLH_BAD_INPUT, "length of `pressure` is -3", wlh_set_field(surface, WL_FIELD_PRESSURE, p, -3, 1, TEXT));
    EXPECT(WLH_BAD_INPUT, "step of `normal` is 2, expected 0 (one value for all points) or at least 3",
           wlh_set_field(surface, WL_FIELD_NORMAL, p, 7, 2, TEXT));
    EXPECT(WLH_BAD_INPUT, "`normal` has 7 values, expected 9", wlh_set_field(surface, WL_FIELD_NORMAL, p, 7, 3, TEXT));
    EXPECT(WLH_BAD_INPUT, "expected a multiple of 8",
           wlh_set_field(surface, WL_FIELD_PRESSURE, (const double *)(const void *)((const char *)p + 4), 3, 1, TEXT));
    EXPECT(WLH_BAD_INPUT, "column of reals, expected one of integers: use wlh_set_index_field",
           wlh_set_field(surface, WL_FIELD_POINT_ID, p, 3, 1, TEXT));
    EXPECT(WLH_BAD_INPUT, "column of integers, expected one of reals: use wlh_set_field",
           wlh_set_index_field(surface, WL_FIELD_PRESSURE, numbers, 3, 1, TEXT));
    EXPECT(WLH_BAD_INPUT, "field 0x3 is none", wlh_set_field(surface, 3, p, 3, 1, TEXT));
    EXPECT(WLH_BAD_INPUT, "field 0x0 is none", wlh_set_field(surface, 0, p, 3, 1, TEXT));
    EXPECT(WLH_BAD_INPUT, "`gap` is set, but the solver's `provides`", wlh_set_field(surface, WL_FIELD_GAP, p, 3, 1, TEXT));
    EXPECT(WLH_BAD_INPUT, "law `archard` has no input `oil`; it has none", wlh_set_input(surface, "oil", p, 3, 1, TEXT));
    EXPECT(WLH_BAD_INPUT, "`name` is NULL", wlh_set_input(surface, NULL, p, 3, 1, TEXT));
    EXPECT(WLH_BAD_INPUT, "`state` has 3 values, expected 0", wlh_set_state(surface, p, 3, TEXT));
}

static void evaluations(wlh_surface *surface) {
    double p[3] = {1e6, 2e6, 3e6}, v = 0.5, temperature[3] = {300, NAN, 300}, w[9], values[] = {1e-4, 2e9, 2e-4, 2e9};
    double temperatures[] = {300, 400};
    int32_t status[4];
    wlh_step step = {sizeof step, 0, 0.1};
    wlh_outputs outputs = {sizeof outputs, w, 3};
    wlh_constants given = {sizeof given, 2, NULL, values, 2, NULL, 0, NULL, 0};
    EXPECT(WLH_BAD_INPUT, "constant `K` (number 1) of law `archard` is not given", wlh_evaluate(surface, &step, &outputs, TEXT));
    DONE(wlh_set_constants(surface, &given, TEXT));
    EXPECT(WLH_BAD_INPUT, "`archard` needs `pressure`, which was not set: set WL_FIELD_PRESSURE",
           wlh_evaluate(surface, &step, &outputs, TEXT));
    DONE(wlh_set_field(surface, WL_FIELD_PRESSURE, p, 3, 1, TEXT));
    DONE(wlh_set_field(surface, WL_FIELD_VELOCITY, &v, 1, 0, TEXT));
    EXPECT(WLH_BAD_INPUT, "nothing to commit", wlh_commit(surface, TEXT));
    DONE(wlh_evaluate(surface, &step, &outputs, TEXT));
    TRUE(fabs(w[2] - 1e-4 / 2e9 * 3e6 * 0.5 * 0.1) < 1e-22 && outputs.first_bad == -1 && outputs.dt_factor == 1);
    step.dt = -1;
    EXPECT(WLH_BAD_INPUT, "`wlh_step.dt` is -1", wlh_evaluate(surface, &step, &outputs, TEXT));
    step.dt = 0.1;
    EXPECT(WLH_BAD_INPUT, "nothing to commit", wlh_commit(surface, TEXT));
    step.time = INFINITY;
    EXPECT(WLH_BAD_INPUT, "`wlh_step.time` is inf", wlh_evaluate(surface, &step, &outputs, TEXT));
    step.time = 0;
    step.cycle = -2;
    EXPECT(WLH_BAD_INPUT, "`wlh_step.cycle` is -2", wlh_evaluate(surface, &step, &outputs, TEXT));
    step.cycle = 0;
    EXPECT(WLH_BAD_INPUT, "`wlh_step` is NULL", wlh_evaluate(surface, NULL, &outputs, TEXT));
    EXPECT(WLH_BAD_INPUT, "`wlh_outputs` is NULL", wlh_evaluate(surface, &step, NULL, TEXT));
    outputs.increment_length = 2;
    EXPECT(WLH_BAD_INPUT, "`wlh_outputs.increment_length` is 2, expected 3", wlh_evaluate(surface, &step, &outputs, TEXT));
    outputs.increment_length = 3;
    outputs.increment = NULL;
    EXPECT(WLH_BAD_INPUT, "`wlh_outputs.increment` is NULL", wlh_evaluate(surface, &step, &outputs, TEXT));
    outputs.increment = p; /* the law only reads it */
    EXPECT(WLH_BAD_INPUT, "output `increment` overlaps `pressure`", wlh_evaluate(surface, &step, &outputs, TEXT));
    outputs.increment = w;
    outputs.d_pressure = w + 2;
    outputs.d_pressure_length = 3;
    EXPECT(WLH_BAD_INPUT, "output `d_pressure` overlaps `increment`", wlh_evaluate(surface, &step, &outputs, TEXT));
    outputs.d_pressure = NULL;
    outputs.status = status;
    outputs.status_length = 4;
    EXPECT(WLH_BAD_INPUT, "`wlh_outputs.status_length` is 4, expected 3", wlh_evaluate(surface, &step, &outputs, TEXT));
    outputs.status = NULL;
    outputs.direction = w;
    outputs.direction_length = 9;
    outputs.increment = temperature;
    EXPECT(WLH_BAD_INPUT, "output `direction` was asked for, but law `archard` does not write it",
           wlh_evaluate(surface, &step, &outputs, TEXT));
    outputs.direction = NULL;
    outputs.increment = w;
    given.value_count = 4;
    given.temperatures = temperatures;
    given.temperature_count = 2;
    DONE(wlh_set_constants(surface, &given, TEXT));
    EXPECT(WLH_BAD_INPUT, "`archard` needs `temperature`, which was not set: its constants are a table over temperature",
           wlh_evaluate(surface, &step, &outputs, TEXT));
    temperature[0] = 300, temperature[1] = NAN, temperature[2] = 300;
    DONE(wlh_set_field(surface, WL_FIELD_TEMPERATURE, temperature, 3, 1, TEXT));
    EXPECT(WLH_BAD_INPUT, "`temperature` of point 1 is NaN", wlh_evaluate(surface, &step, &outputs, TEXT));
    temperature[1] = 350;
    DONE(wlh_evaluate(surface, &step, &outputs, TEXT));
    TRUE(fabs(w[1] / (1.5e-4 / 2e9 * 2e6 * 0.5 * 0.1) - 1) < 1e-14 && fabs(w[0] / (1e-4 / 2e9 * 1e6 * 0.05) - 1) < 1e-14);
    p[1] = INFINITY;
    EXPECT(WL_OUT_OF_DOMAIN, "point 1 (", wlh_evaluate(surface, &step, &outputs, TEXT));
    TRUE(outputs.first_bad == 1);
    EXPECT(WLH_BAD_INPUT, "nothing to commit", wlh_commit(surface, TEXT));
}

static void handles(wlh_law *law) {
    wlh_surface *surface;
    wlh_description description = {sizeof description};
    wl_quantity quantity = {sizeof quantity};
    double factor, numbers[8] = {0};
    EXPECT(WLH_BAD_HANDLE, "found a handle that is NULL, expected an open law", wlh_describe(NULL, &description, TEXT));
    EXPECT(WLH_BAD_HANDLE, "expected an open law", wlh_describe((wlh_law *)numbers, &description, TEXT));
    EXPECT(WLH_BAD_HANDLE, "expected an open surface", wlh_commit((wlh_surface *)law, TEXT));
    EXPECT(WLH_BAD_INPUT, "`points` is -1", wlh_open_surface(law, -1, &surface, TEXT));
    DONE(wlh_describe(law, &description, TEXT));
    TRUE(strcmp(description.name, "archard") == 0 && description.constant_count == 4 && description.state_count == 0);
    DONE(wlh_quantity(law, WL_KIND_CONSTANT, 1, &quantity, TEXT));
    TRUE(strcmp(quantity.name, "H") == 0 && quantity.minimum == 0 && isnan(quantity.default_value));
    EXPECT(WLH_BAD_INPUT, "`index` is 4, expected 0 or more and less than 4",
           wlh_quantity(law, WL_KIND_CONSTANT, 4, &quantity, TEXT));
    EXPECT(WLH_BAD_INPUT, "`kind` is 7", wlh_quantity(law, 7, 0, &quantity, TEXT));
    DONE(wlh_open_surface(law, 0, &surface, TEXT)); /* a rank may have none */
    DONE(wlh_close_law(law, TEXT));
    EXPECT(WLH_BAD_HANDLE, "found a handle that is closed, expected an open law", wlh_describe(law, &description, TEXT));
    EXPECT(WLH_BAD_HANDLE, "closed", wlh_close_law(law, TEXT));
    {
        double values[] = {1e-4, 2e9};
        wlh_constants given = {sizeof given, 2, NULL, values, 2, NULL, 0, NULL, 0};
        wlh_step step = {sizeof step, 0, 0.1};
        wlh_outputs outputs = {sizeof outputs};
        DONE(wlh_set_constants(surface, &given, TEXT)); /* it keeps the law open */
        DONE(wlh_evaluate(surface, &step, &outputs, TEXT));
        DONE(wlh_commit(surface, TEXT));
    }
    DONE(wlh_close_surface(surface, TEXT));
    EXPECT(WLH_BAD_HANDLE, "found a handle that is closed, expected an open surface", wlh_commit(surface, TEXT));
    DONE(wlh_scaling_factor(0.01, 0.5, 20, &factor, TEXT));
    TRUE(factor == 20);
    DONE(wlh_scaling_factor(0.05, 0.5, 20, &factor, TEXT));
    TRUE(factor == 10);
    EXPECT(WLH_BAD_INPUT, "`safety` is 1", wlh_scaling_factor(0.1, 1, 2, &factor, TEXT));
    EXPECT(WLH_BAD_INPUT, "`maximum` is 0.5", wlh_scaling_factor(0.1, 0.5, 0.5, &factor, TEXT));
    EXPECT(WLH_BAD_INPUT, "`change` is NaN", wlh_scaling_factor(NAN, 0.5, 2, &factor, TEXT));
    TRUE(wlh_scaling_factor(NAN, 0.5, 2, &factor, NULL, 0) == WLH_BAD_INPUT);
    TRUE(wlh_scaling_factor(NAN, 0.5, 2, &factor, text, 4) == WLH_BAD_INPUT && strcmp(text, "`ch") == 0);
}

int main(int argc, char **argv) {
    wlh_law *law;
    wlh_surface *surface;
    wlh_source source = named("embedded:archard");
    wlh_solver solver = providing(BOTH | WL_FIELD_TEMPERATURE | WL_FIELD_NORMAL | WL_FIELD_POINT_ID);
    if (argc != 5 || wlh_minor() != WLH_ABI_MINOR) return 2;
    opening(argv);
    solvers(argv);
    DONE(wlh_open_1(&source, &solver, &law, TEXT));
    DONE(wlh_open_surface(law, 3, &surface, TEXT));
    constants(surface);
    columns(surface);
    evaluations(surface);
    DONE(wlh_close_surface(surface, TEXT));
    handles(law);
    return ended();
}
