// A pin on a disc (host/scenes/pin_on_disc.toml) from a solver in C++ that keeps its points as structs: columns with
// steps, a surface for each thread.
//
//     c++ -std=c++11 -I include host/c/examples/pin_on_disc.cpp -L target/release -lwearlaw_host -pthread -o pin && ./pin
#include "wearlaw_host.h"

#include <cstdio>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

struct Point { double x, y, z, pressure, velocity, depth; };

static void need(int32_t status, const char *text) {
    if (status != WL_OK && status != WL_UNRELIABLE) throw std::runtime_error(text);
}

class Law {
public:
    explicit Law(const char *name) {
        wlh_source source = {};
        source.struct_size = sizeof source, source.name = name;
        wlh_solver solver = {};
        solver.struct_size = sizeof solver, solver.dimension = 3;
        solver.provides = WL_FIELD_PRESSURE | WL_FIELD_VELOCITY;
        char text[400];
        need(wlh_open_1(&source, &solver, &law, text, sizeof text), text);
    }
    ~Law() { wlh_close_law(law, nullptr, 0); }
    Law(const Law &) = delete;
    wlh_law *law = nullptr;
};

/// The wear of some points over a second.
static void wear(const Law &law, Point *points, int64_t count, int substeps) {
    char text[400];
    wlh_surface *surface = nullptr;
    need(wlh_open_surface(law.law, count, &surface, text, sizeof text), text);
    const double times[] = {0, 1}, values[] = {1e-4, 2e3, 1, 1, 3e-4, 1e3, 1.5, 0.8}; // K, H, m, n at both times
    wlh_constants constants = {sizeof constants, 4, nullptr, values, 8, times, 2, nullptr, 0};
    need(wlh_set_constants(surface, &constants, text, sizeof text), text);
    // From the first point's pressure on there are so many doubles, and so many from one point to the next.
    const int64_t step = sizeof(Point) / sizeof(double), behind = (count - 1) * step + 1;
    need(wlh_set_field(surface, WL_FIELD_PRESSURE, &points->pressure, behind, step, text, sizeof text), text);
    need(wlh_set_field(surface, WL_FIELD_VELOCITY, &points->velocity, behind, step, text, sizeof text), text);
    std::vector<double> increment(count);
    wlh_outputs outputs = {};
    outputs.struct_size = sizeof outputs, outputs.increment = increment.data(), outputs.increment_length = count;
    wlh_step substep = {};
    substep.struct_size = sizeof substep, substep.dt = 1.0 / substeps;
    for (int i = 0; i < substeps; ++i) {
        substep.time = i * substep.dt;
        need(wlh_evaluate(surface, &substep, &outputs, text, sizeof text), text);
        need(wlh_commit(surface, text, sizeof text), text);
        for (int64_t k = 0; k < count; ++k) points[k].depth += increment[k];
    }
    wlh_close_surface(surface, nullptr, 0);
}

int main() {
    try {
        const Law law("embedded:archard");
        std::vector<Point> points(3, Point{0, 0, 0, 50, 0.2, 0});
        std::string wrong; // an exception must not leave its thread
        std::thread other([&] {
            try { wear(law, &points[0], 1, 2000); } catch (const std::exception &e) { wrong = e.what(); }
        });
        try { wear(law, &points[1], 2, 2000); } catch (...) { other.join(); throw; }
        other.join();
        if (!wrong.empty()) throw std::runtime_error(wrong);
        for (const Point &point : points) std::printf("%.17g\n", point.depth);
    } catch (const std::exception &e) {
        return std::fprintf(stderr, "%s\n", e.what()), 3;
    }
}
