/*
 * wearlaw_loop.hpp: the second half of wearlaw.hpp, which includes it: the batch loop.
 *
 * Scalars are read at unit step: where the host's column has another step, a block of it is laid out in a buffer
 * first, so that one loop serves uniform and strided fields and the compiler vectorises it.
 *
 * SPDX-License-Identifier: MIT OR Apache-2.0
 */

#if !defined(WEARLAW_HPP)
#include "wearlaw.hpp" /* which includes this file in its place */
#elif !defined(WEARLAW_LOOP_HPP)
#define WEARLAW_LOOP_HPP

namespace wearlaw {
namespace detail {

constexpr int64_t block = 256;

/* Number of quantities in a Constants, State or Inputs. */
template <class Q> struct Count {
    static constexpr int64_t value = std::is_empty<Q>::value ? 0 : int64_t(sizeof(Q) / sizeof(Value));
};
template <class Q> WEARLAW_INLINE Value *values(Q &q) { return reinterpret_cast<Value *>(&q); }
template <class Q> WEARLAW_INLINE const Value *values(const Q &q) { return reinterpret_cast<const Value *>(&q); }

inline const double *absent(const wl_column &) {
    static const double nothing[3] = {required, required, required};
    return nothing;
}
inline const int64_t *absent(const wl_index_column &) {
    static const int64_t nothing = -1;
    return &nothing;
}

inline const double *spread(const wl_column &q, int64_t at, int64_t m, double *buffer) {
    if (q.step == 1) {
        return q.ptr + at;
    }
    if (q.step == 0) {
        const double value = q.ptr[0];
        for (int64_t j = 0; at == 0 && j < m; ++j) {
            buffer[j] = value;
        }
    } else {
        for (int64_t j = 0; j < m; ++j) {
            buffer[j] = q.ptr[(at + j) * q.step];
        }
    }
    return buffer;
}

/* The columns of a list of fields, as one struct that the compiler can take apart. */
template <class List> struct Columns;
template <> struct Columns<Fields<>> {
    static constexpr int64_t count = 0;
    static constexpr int64_t bits() { return 0; }
    int64_t open(const wl_view &, bool) { return 0; }
    bool at_unit_step() const { return true; }
    void block_of(const Columns &, int64_t, int64_t, double (*)[block]) {}
    template <class I> WEARLAW_INLINE void unit(I &, int64_t) const {}
    template <class I> WEARLAW_INLINE void strided(I &, int64_t) const {}
    static const char *name(int64_t) { return nullptr; }
};
template <class Tag, class... Rest> struct Columns<Fields<Tag, Rest...>> {
    typedef typename Tag::Meta Meta;
    typedef Columns<Fields<Rest...>> Tail;
    typename Meta::Column column;
    Tail tail;
    static constexpr int64_t count = 1 + Tail::count;
    static constexpr int64_t bits() { return Meta::bit() | Tail::bits(); }
    /* Answers the bits of what is absent; an absent optional field reads as NaN (-1 for indices). */
    int64_t open(const wl_view &v, bool optional) {
        column = Meta::of(v);
        int64_t missing = 0;
        if (!column.ptr) {
            missing = Meta::bit();
            if (optional) {
                column.ptr = absent(column);
                column.step = 0;
            }
        }
        return missing | tail.open(v, optional);
    }
    bool at_unit_step() const { return (!Meta::scalar() || column.step == 1) && tail.at_unit_step(); }
    void lay_out(const Columns &from, int64_t at, int64_t m, double *buffer, std::true_type) {
        column.ptr = spread(from.column, at, m, buffer);
    }
    void lay_out(const Columns &from, int64_t at, int64_t, double *, std::false_type) {
        column.ptr = from.column.ptr + at * from.column.step;
    }
    void block_of(const Columns &from, int64_t at, int64_t m, double (*buffer)[block]) {
        lay_out(from, at, m, *buffer, std::integral_constant<bool, Meta::scalar()>());
        tail.block_of(from.tail, at, m, buffer + 1);
    }
    template <class I> WEARLAW_INLINE void unit(I &in, int64_t i) const {
        Meta::put(in, column.ptr + (Meta::scalar() ? i : i * column.step));
        tail.unit(in, i);
    }
    template <class I> WEARLAW_INLINE void strided(I &in, int64_t i) const {
        Meta::put(in, column.ptr + i * column.step);
        tail.strided(in, i);
    }
    static const char *name(int64_t bit) { return bit == Meta::bit() ? Meta::name() : Tail::name(bit); }
};

template <class L> WEARLAW_INLINE void put_slope(double *slope, int64_t i, const Out<L> &out, std::true_type) {
    if (slope) {
        slope[i] = out.d_pressure;
    }
}
template <class L> WEARLAW_INLINE void put_slope(double *, int64_t, const Out<L> &, std::false_type) {}
template <class L> WEARLAW_INLINE void preset_direction(const In<L> &in, Out<L> &out, std::true_type) {
    for (int j = 0; j < 3; ++j) {
        out.direction[j] = -in.normal[j]; /* a law that writes directions reads Normal */
    }
}
template <class L> WEARLAW_INLINE void preset_direction(const In<L> &, Out<L> &, std::false_type) {}
template <class L> WEARLAW_INLINE void put_direction(double *direction, int64_t i, const Out<L> &out, std::true_type) {
    if (direction) {
        for (int j = 0; j < 3; ++j) {
            direction[3 * i + j] = out.direction[j];
        }
    }
}
template <class L> WEARLAW_INLINE void put_direction(double *, int64_t, const Out<L> &, std::false_type) {}

template <class L> struct Batch {
    static constexpr int64_t constant_count = Count<typename L::template Constants<Value>>::value;
    static constexpr int64_t state_count = Count<typename L::template State<Value>>::value;
    static constexpr int64_t input_count = Count<typename L::template Inputs<Value>>::value;
    typedef std::integral_constant<bool, (L::writes & WL_OUT_D_PRESSURE) != 0> HasSlope;
    typedef std::integral_constant<bool, (L::writes & WL_OUT_DIRECTION) != 0> HasDirection;
    typedef typename L::template Inputs<Value> Inputs;

    Columns<typename L::Reads> reads;
    Columns<typename L::Uses> uses;
    wl_column inputs[input_count + 1];
    wl_column state;

    /* The law's procedure; what it throws becomes WL_FAILED with its text. */
    static WEARLAW_INLINE int32_t call(const L &law, const In<L> &in, const Constants<L> &c, Out<L> &out) noexcept {
        const State<L> start = out.state;
        try {
            return law.point(in, c, start, out);
        } catch (const std::exception &e) {
            return out.refuse(WL_FAILED, "%s", e.what());
        } catch (...) {
            return out.refuse(WL_FAILED, "an exception of unknown type");
        }
    }

    static WEARLAW_INLINE void preset(Out<L> &out, char *text, std::size_t text_size) {
        out.increment = 0;
        out.dt_factor = 0.5;
        out.text = text;
        out.text_size = text_size;
        clear(out, HasSlope());
    }
    static WEARLAW_INLINE void clear(Out<L> &out, std::true_type) { out.d_pressure = 0; }
    static WEARLAW_INLINE void clear(Out<L> &, std::false_type) {}

    /* m points whose scalars and state are at unit step and whose constants are uniform; 0 if all are WL_OK. */
    static WEARLAW_INLINE int32_t unit_block(const L &law, const Batch &b, In<L> in, const Constants<L> c, int64_t m,
                                             double *WEARLAW_RESTRICT increment, double *WEARLAW_RESTRICT slope,
                                             double *WEARLAW_RESTRICT direction, double *WEARLAW_RESTRICT end) {
        int32_t worst = 0;
        WEARLAW_NO_OVERLAP
        for (int64_t i = 0; i < m; ++i) {
            Out<L> out;
            b.reads.unit(in, i);
            b.uses.unit(in, i);
            for (int64_t j = 0; j < input_count; ++j) {
                values(static_cast<Inputs &>(in))[j] = b.inputs[j].ptr[i];
            }
            for (int64_t j = 0; j < state_count; ++j) {
                values(out.state)[j] = b.state.ptr[i * state_count + j];
            }
            preset(out, nullptr, 0);
            preset_direction<L>(in, out, HasDirection());
            worst |= call(law, in, c, out);
            increment[i] = out.increment;
            put_slope<L>(slope, i, out, HasSlope());
            put_direction<L>(direction, i, out, HasDirection());
            for (int64_t j = 0; j < state_count; ++j) {
                end[i * state_count + j] = values(out.state)[j];
            }
        }
        return worst;
    }

    /* One point at any step; an unknown status counts as WL_FAILED. */
    WEARLAW_INLINE int32_t one(const L &law, const wl_column *constants, In<L> &in, int64_t i, Out<L> &out) const {
        Constants<L> c;
        for (int64_t j = 0; j < constant_count; ++j) {
            values(c)[j] = constants[j].ptr[i * constants[j].step];
        }
        reads.strided(in, i);
        uses.strided(in, i);
        for (int64_t j = 0; j < input_count; ++j) {
            values(static_cast<Inputs &>(in))[j] = inputs[j].ptr[i * inputs[j].step];
        }
        for (int64_t j = 0; j < state_count; ++j) {
            values(out.state)[j] = state.ptr[i * state.step + j];
        }
        preset_direction<L>(in, out, HasDirection());
        const int32_t status = call(law, in, c, out);
        return status < WL_OK || status > WL_FAILED ? WL_FAILED : status;
    }

    int32_t general(const L &law, const wl_column *constants, In<L> in, int64_t points, const wl_output *o,
                    int64_t *first_bad, double *dt_factor) const {
        int32_t worst = WL_OK;
        for (int64_t i = 0; i < points; ++i) {
            Out<L> out;
            preset(out, nullptr, 0);
            const int32_t status = one(law, constants, in, i, out);
            o->increment[i] = out.increment;
            put_slope<L>(o->d_pressure, i, out, HasSlope());
            put_direction<L>(o->direction, i, out, HasDirection());
            for (int64_t j = 0; o->state && j < state_count; ++j) {
                o->state[i * state_count + j] = values(out.state)[j];
            }
            if (o->status) {
                o->status[i] = status;
            }
            if (status == WL_CUT_STEP && (*dt_factor == 0 || out.dt_factor < *dt_factor)) {
                *dt_factor = out.dt_factor;
            }
            if (status > worst) {
                worst = status;
                *first_bad = i;
            }
        }
        if (worst != WL_OK && o->text && o->text_size > 0) { /* once more, for its text */
            Out<L> out;
            o->text[0] = '\0';
            preset(out, o->text, std::size_t(o->text_size));
            (void)one(law, constants, in, *first_bad, out);
        }
        return worst;
    }

    /* All points, block by block; one block if every column has unit step. */
    int32_t blocks(const L &law, const Constants<L> &c, const In<L> &in, int64_t points, const wl_output *o) const {
        constexpr int64_t slots = Columns<typename L::Reads>::count + Columns<typename L::Uses>::count + input_count;
        double buffer[slots + 1][block];
        bool unit = reads.at_unit_step() && uses.at_unit_step();
        for (int64_t j = 0; j < input_count; ++j) {
            unit = unit && inputs[j].step == 1;
        }
        const int64_t most = unit ? points : block;
        int32_t worst = 0;
        Batch b = *this;
        for (int64_t at = 0; at < points; at += most) {
            const int64_t m = points - at < most ? points - at : most;
            double(*room)[block] = buffer;
            b.reads.block_of(reads, at, m, room);
            b.uses.block_of(uses, at, m, room + Columns<typename L::Reads>::count);
            for (int64_t j = 0; j < input_count; ++j) {
                b.inputs[j].ptr = spread(inputs[j], at, m, room[slots - input_count + j]);
            }
            b.state.ptr = state_count ? state.ptr + state_count * at : nullptr;
            double *direction = o->direction ? o->direction + 3 * at : nullptr;
            double *end = o->state ? o->state + state_count * at : nullptr;
            if (HasSlope::value && o->d_pressure) {
                worst |= unit_block(law, b, in, c, m, o->increment + at, o->d_pressure + at, direction, end);
            } else {
                worst |= unit_block(law, b, in, c, m, o->increment + at, nullptr, direction, end);
            }
        }
        return worst;
    }
};

} // namespace detail
} // namespace wearlaw

#endif /* WEARLAW_LOOP_HPP */
