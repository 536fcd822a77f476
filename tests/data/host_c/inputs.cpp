// Bad input, from C++ with its own containers: what each call says of it, and that nothing was changed by it.
#include "wearlaw_host.h"

#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string>
#include <vector>

static int checks = 0;
static char text[400];

static void expect(int line, int32_t wanted, const char *words, int32_t status) {
    ++checks;
    if (status == wanted && std::strstr(text, words)) return;
    std::printf("line %d: status %d, expected %d: %s, expected in it: %s\n", line, status, wanted, text, words);
    std::exit(1);
}
static void truth(int line, bool answer) {
    ++checks;
    if (answer) return;
    std::printf("line %d: not so\n", line);
    std::exit(1);
}
#define EXPECT(status, words, call) expect(__LINE__, status, words, call)
#define TRUTH(answer) truth(__LINE__, answer)
#define TEXT text, static_cast<int64_t>(sizeof text)

/* A point of a solver that keeps its points as structs. */
struct Point {
    double pressure, velocity, other;
};

int main() {
    wlh_source source = wlh_source();
    source.struct_size = sizeof source;
    wlh_solver solver = wlh_solver();
    solver.struct_size = sizeof solver;
    solver.dimension = 3;
    solver.provides = WL_FIELD_PRESSURE | WL_FIELD_VELOCITY;
    wlh_law *law = nullptr;
    wlh_surface *surface = nullptr;
    const std::string wrong = "embedded:archad", right = "embedded:archard";
    source.name = wrong.c_str();
    EXPECT(WLH_NOT_LOADED, "archard", wlh_open_1(&source, &solver, &law, TEXT));
    TRUTH(law == nullptr);
    source.name = right.c_str();
    EXPECT(WL_OK, "", wlh_open_1(&source, &solver, &law, TEXT));

    std::vector<Point> points(5, Point{1e6, 0.1, 0});
    const int64_t count = static_cast<int64_t>(points.size()), step = sizeof(Point) / sizeof(double);
    const int64_t length = count * step;
    EXPECT(WL_OK, "", wlh_open_surface(law, count, &surface, TEXT));
    const double values[] = {1e-4, 2e9, 1, 1};
    const char *names[] = {"K", "hardness"};
    wlh_constants constants = wlh_constants();
    constants.struct_size = sizeof constants;
    constants.count = 2;
    constants.names = names;
    constants.values = values;
    constants.value_count = 2;
    EXPECT(WLH_BAD_INPUT, "hardness", wlh_set_constants(surface, &constants, TEXT));
    names[1] = "H";
    EXPECT(WL_OK, "", wlh_set_constants(surface, &constants, TEXT));
    // Too short for five points this far apart, a step that runs backwards, no array at all.
    EXPECT(WLH_BAD_INPUT, "pressure",
           wlh_set_field(surface, WL_FIELD_PRESSURE, &points[0].pressure, length - step, step, TEXT));
    EXPECT(WLH_BAD_INPUT, "pressure", wlh_set_field(surface, WL_FIELD_PRESSURE, &points[0].pressure, length, -step, TEXT));
    EXPECT(WL_OK, "", wlh_set_field(surface, WL_FIELD_PRESSURE, &points[0].pressure, length, step, TEXT));
    EXPECT(WL_OK, "", wlh_set_field(surface, WL_FIELD_VELOCITY, &points[0].velocity, length - 1, step, TEXT));

    std::vector<double> increment(points.size(), -7);
    wlh_outputs outputs = wlh_outputs();
    outputs.struct_size = sizeof outputs;
    outputs.increment = increment.data();
    outputs.increment_length = count + 1;
    wlh_step now = wlh_step();
    now.struct_size = sizeof now;
    now.dt = 1;
    EXPECT(WLH_BAD_INPUT, "increment", wlh_evaluate(surface, &now, &outputs, TEXT));
    outputs.increment_length = count;
    outputs.increment = &points[0].pressure;
    EXPECT(WLH_BAD_INPUT, "pressure", wlh_evaluate(surface, &now, &outputs, TEXT));
    outputs.increment = increment.data();
    points[3].pressure = 0.0 / (points[3].other);
    TRUTH(wlh_evaluate(surface, &now, &outputs, TEXT) != WL_OK && outputs.first_bad == 3);
    points[3].pressure = 2e6;
    EXPECT(WL_OK, "", wlh_evaluate(surface, &now, &outputs, TEXT));
    TRUTH(increment[3] > 1.9 * increment[0] && increment[0] > 0);
    EXPECT(WL_OK, "", wlh_close_law(law, TEXT));
    EXPECT(WL_OK, "", wlh_close_surface(surface, TEXT));
    EXPECT(WLH_BAD_HANDLE, "", wlh_evaluate(surface, &now, &outputs, TEXT));
    std::printf("%d checks\n", checks);
    return 0;
}
