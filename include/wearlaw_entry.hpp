/*
 * wearlaw_entry.hpp: the last part of wearlaw.hpp, which includes it: one call of a law, its table and the entry.
 *
 * SPDX-License-Identifier: MIT OR Apache-2.0
 */

#if !defined(WEARLAW_HPP)
#include "wearlaw.hpp" /* which includes this file in its place */
#elif !defined(WEARLAW_ENTRY_HPP)
#define WEARLAW_ENTRY_HPP

namespace wearlaw {
namespace detail {

#define WEARLAW_COVERS(p, type, field) ((p)->struct_size >= int64_t(offsetof(type, field) + sizeof(type().field)))

template <class T> T at_most(const T *from) { /* what the other side allocated; the rest is absent */
    T full;
    std::memset(&full, 0, sizeof full);
    std::memcpy(&full, from, from->struct_size < int64_t(sizeof full) ? std::size_t(from->struct_size) : sizeof full);
    return full;
}
template <class T> void give(T *to, T &full) {
    full.struct_size = to->struct_size;
    std::memcpy(to, &full, to->struct_size < int64_t(sizeof full) ? std::size_t(to->struct_size) : sizeof full);
}

template <class L> int32_t run(const L &law, const wl_view *v, wl_output *output, const wl_output *o) {
    typedef Batch<L> B;
    if (v->points <= 0) {
        return WL_OK;
    }
    const bool have_text = o->text && o->text_size > 0;
    if (!o->increment || v->constant_count < B::constant_count || (B::constant_count && !v->constants) ||
        v->input_count < B::input_count || (B::input_count && !v->inputs) || v->state_count < B::state_count ||
        (B::state_count && !v->state.ptr)) {
        if (have_text) {
            say(o->text, std::size_t(o->text_size), "the host gave fewer columns than %s declares", L::about().name);
        }
        return WL_FAILED;
    }
    B batch;
    const int64_t missing = batch.reads.open(*v, false);
    In<L> in;
    in.dt = v->dt;
    in.time = v->time;
    in.call = v;
    in.given = Columns<typename L::Uses>::bits() & ~batch.uses.open(*v, true);
    batch.state = v->state;
    const char *lacking = nullptr;
    for (int64_t bit = 1; !lacking && bit <= missing; bit *= 2) {
        lacking = (missing & bit) ? Columns<typename L::Reads>::name(bit) : nullptr;
    }
    for (int64_t j = 0; j < B::input_count; ++j) {
        batch.inputs[j] = v->inputs[j];
        lacking = lacking || v->inputs[j].ptr ? lacking : "an input declared by name";
    }
    Constants<L> c;
    bool uniform = true;
    for (int64_t j = 0; j < B::constant_count; ++j) {
        lacking = lacking || v->constants[j].ptr ? lacking : "a constant";
        uniform = uniform && v->constants[j].step == 0;
        values(c)[j] = v->constants[j].ptr ? *v->constants[j].ptr : required;
    }
    if (lacking) {
        if (WEARLAW_COVERS(output, wl_output, missing)) {
            output->missing = missing;
        }
        if (have_text) {
            say(o->text, std::size_t(o->text_size), "not given: %s", lacking);
        }
        return WL_MISSING_INPUT;
    }
    if (uniform && !o->status && (!B::state_count || (o->state && v->state.step == B::state_count)) &&
        batch.blocks(law, c, in, v->points, o) == WL_OK) {
        return WL_OK;
    }
    int64_t first_bad = -1;
    double dt_factor = 0;
    const int32_t worst = batch.general(law, v->constants, in, v->points, o, &first_bad, &dt_factor);
    if (WEARLAW_COVERS(output, wl_output, dt_factor)) {
        output->first_bad = first_bad;
        output->dt_factor = dt_factor;
    }
    return worst;
}

/* A law with a constructor that takes the options text has instances; any other is made on the spot. */
template <class L> struct Instance : std::is_constructible<L, const char *> {};
template <class L> int32_t evaluate_law(void *, const wl_view *v, wl_output *output, const wl_output *o, std::false_type) {
    const L law = L();
    return run(law, v, output, o);
}
template <class L>
int32_t evaluate_law(void *instance, const wl_view *v, wl_output *output, const wl_output *o, std::true_type) {
    return run(*static_cast<const L *>(instance), v, output, o);
}
template <class L> int32_t evaluate(void *instance, const wl_view *view, wl_output *output) {
    wl_view short_view;
    wl_output short_output;
    const wl_output *o = output;
    if (view->struct_size < int64_t(sizeof *view)) {
        short_view = at_most(view);
        view = &short_view;
    }
    if (output->struct_size < int64_t(sizeof *output)) {
        short_output = at_most(output);
        o = &short_output;
    }
    return evaluate_law<L>(instance, view, output, o, std::integral_constant<bool, Instance<L>::value>());
}

template <class L> int32_t create(const wl_host *, const char *options, void **instance, char *text, int64_t size) {
    const char *reason = "an exception of unknown type";
    try {
        *instance = new L(options ? options : "");
        return WL_OK;
    } catch (const std::exception &e) {
        reason = e.what();
        if (text && size > 0) {
            say(text, std::size_t(size), "%s", reason);
        }
    } catch (...) {
        if (text && size > 0) {
            say(text, std::size_t(size), "%s", reason);
        }
    }
    return WL_FAILED;
}
template <class L> void destroy(void *instance) { delete static_cast<L *>(instance); }
template <class L> void instance_functions(wl_law &law, std::true_type) {
    law.create = create<L>;
    law.destroy = destroy<L>;
}
template <class L> void instance_functions(wl_law &, std::false_type) {}

template <class Q> const Described *described(const Q &q) { return reinterpret_cast<const Described *>(&q); }

template <class L> int32_t describe(int32_t kind, int64_t index, wl_quantity *quantity) {
    typedef Batch<L> B;
    const typename L::template Constants<Described> constants{};
    const typename L::template State<Described> state{};
    const typename L::template Inputs<Described> inputs{};
    const Described *rows = kind == WL_KIND_CONSTANT ? described(constants)
                            : kind == WL_KIND_STATE  ? described(state)
                                                     : described(inputs);
    const int64_t count = kind == WL_KIND_CONSTANT ? B::constant_count
                          : kind == WL_KIND_STATE  ? B::state_count
                          : kind == WL_KIND_INPUT  ? B::input_count
                                                   : 0;
    Described row(nullptr, number, any, required, "");
    if (kind == WL_KIND_FIELD && index >= 0 && index < 63) {
        row.name = Columns<typename L::Reads>::name(int64_t(1) << index);
        row.name = row.name ? row.name : Columns<typename L::Uses>::name(int64_t(1) << index);
    } else if (index >= 0 && index < count) {
        row = rows[index];
    }
    if (!row.name) {
        return WL_NO_MORE;
    }
    wl_quantity full;
    std::memset(&full, 0, sizeof full);
    say(full.name, sizeof full.name, "%s", row.name);
    say(full.summary, sizeof full.summary, "%s", row.summary);
    full.metre = row.unit.metre;
    full.kilogram = row.unit.kilogram;
    full.second = row.unit.second;
    full.kelvin = row.unit.kelvin;
    full.minimum = row.bounds.minimum;
    full.maximum = row.bounds.maximum;
    full.flags = row.bounds.flags;
    full.default_value = row.preset;
    give(quantity, full);
    return WL_OK;
}

template <class L> void fill(wl_law *law) {
    typedef Batch<L> B;
    const About about = L::about();
    const typename L::template Constants<Described> constants{};
    wl_law full;
    std::memset(&full, 0, sizeof full);
    full.abi_minor = WL_ABI_MINOR;
    say(full.name, sizeof full.name, "%s", about.name);
    say(full.version, sizeof full.version, "%s", about.version);
    say(full.summary, sizeof full.summary, "%s", about.summary);
    say(full.source, sizeof full.source, "%s", about.source);
    full.reads = Columns<typename L::Reads>::bits();
    full.uses = Columns<typename L::Uses>::bits();
    full.writes = L::writes | (B::state_count ? WL_OUT_STATE : 0) | WL_OUT_STATUS;
    full.claims = L::claims;
    full.flags = L::flags;
    full.constant_count = B::constant_count;
    full.state_count = B::state_count;
    full.input_count = B::input_count;
    full.pressure_degree = L::pressure_degree();
    full.pressure_degree_constant = -1;
    for (int64_t j = 0; j < B::constant_count; ++j) {
        if (std::strcmp(described(constants)[j].name, L::pressure_degree_constant()) == 0) {
            full.pressure_degree_constant = j;
        }
    }
    full.describe = describe<L>;
    full.evaluate = evaluate<L>;
    instance_functions<L>(full, std::integral_constant<bool, Instance<L>::value>());
    give(law, full);
}

template <class...> struct Entry {
    static int32_t fill(int32_t, wl_law *) { return WL_NO_MORE; }
};
template <class L, class... Rest> struct Entry<L, Rest...> {
    static int32_t fill(int32_t index, wl_law *law) {
        if (index != 0) {
            return Entry<Rest...>::fill(index - 1, law);
        }
        if (!WEARLAW_COVERS(law, wl_law, extension)) { /* less than the 1.0 table */
            return WL_FAILED;
        }
        detail::fill<L>(law);
        return WL_OK;
    }
};

} // namespace detail
} // namespace wearlaw

#endif /* WEARLAW_ENTRY_HPP */
