/* The memory that an evaluation takes: bytes asked of the allocator meanwhile, for 1000 and for 1 000 000 points. */
#include "expect.h"

extern void *__libc_malloc(size_t);
extern void *__libc_calloc(size_t, size_t);
extern void *__libc_realloc(void *, size_t);
extern void *__libc_memalign(size_t, size_t);

static size_t asked;

void *malloc(size_t size) { return asked += size, __libc_malloc(size); }
void *calloc(size_t count, size_t size) { return asked += count * size, __libc_calloc(count, size); }
void *realloc(void *block, size_t size) { return asked += size, __libc_realloc(block, size); }
void *aligned_alloc(size_t alignment, size_t size) { return asked += size, __libc_memalign(alignment, size); }
int posix_memalign(void **block, size_t alignment, size_t size) {
    asked += size;
    return (*block = __libc_memalign(alignment, size)) ? 0 : 12;
}

/* Bytes that the third evaluation of so many points asks for. */
static size_t taken(wlh_law *law, int64_t points) {
    wlh_surface *surface;
    size_t before = 0;
    double *pressure = malloc(3 * points * sizeof(double)), *increment = malloc(points * sizeof(double)), velocity = 0.5;
    double values[] = {1e-4, 2e9};
    wlh_constants constants = {sizeof constants, 2, NULL, values, 2, NULL, 0, NULL, 0};
    wlh_step step = {sizeof step, 0, 0.5};
    wlh_outputs outputs = {sizeof outputs, increment, points};
    for (int64_t i = 0; i < 3 * points; ++i) pressure[i] = (double)i;
    DONE(wlh_open_surface(law, points, &surface, TEXT));
    DONE(wlh_set_constants(surface, &constants, TEXT));
    DONE(wlh_set_field(surface, WL_FIELD_PRESSURE, pressure, 3 * points, 3, TEXT));
    DONE(wlh_set_field(surface, WL_FIELD_VELOCITY, &velocity, 1, 0, TEXT));
    for (int i = 0; i < 3; ++i) {
        before = asked;
        DONE(wlh_evaluate(surface, &step, &outputs, TEXT));
    }
    before = asked - before;
    TRUE(increment[points - 1] > 0);
    DONE(wlh_close_surface(surface, TEXT));
    free(pressure);
    free(increment);
    return before;
}

int main(void) {
    wlh_law *law;
    wlh_source source = {sizeof source};
    wlh_solver solver = {sizeof solver, WL_FIELD_PRESSURE | WL_FIELD_VELOCITY, 3};
    size_t few, many;
    source.name = "embedded:archard";
    DONE(wlh_open_1(&source, &solver, &law, TEXT));
    few = taken(law, 1000);
    many = taken(law, 1000000);
    printf("%zu and %zu bytes\n", few, many);
    TRUE(few > 0 && few == many && many < 8192);
    return ended();
}
