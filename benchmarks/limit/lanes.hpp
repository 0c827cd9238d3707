// Arithmetic on one, four or eight numbers at a time: as many runs side by side.
#pragma once
#include <bit>
#include <cmath>
#include <cstdint>

template <int W> struct Lanes {
    typedef double Real __attribute__((vector_size(8 * W)));
    typedef long long Mask __attribute__((vector_size(8 * W)));
    typedef unsigned long long Bits __attribute__((vector_size(8 * W)));
};
template <> struct Lanes<1> {
    using Real = double;
    using Mask = bool;
    using Bits = std::uint64_t;
};

inline double get(const double &x, int) { return x; }
inline bool get(const bool &x, int) { return x; }
inline void set(double &x, int, double value) { x = value; }
inline void set(bool &x, int, bool value) { x = value; }
template <class T> inline auto get(const T &x, int lane) { return x[lane]; }
template <class T, class S> inline void set(T &x, int lane, S value) {
    x[lane] = std::is_same_v<S, bool> ? -static_cast<long long>(value) : value;
}

inline bool any(bool m) { return m; }
template <class M> inline bool any(M m) {
    long long found = 0;
    for (unsigned i = 0; i < sizeof(M) / 8; ++i)
        found |= m[i];
    return found != 0;
}

inline double root(double x) { return std::sqrt(x); }
template <class V> inline V root(V x) {
    for (unsigned i = 0; i < sizeof(V) / 8; ++i)
        x[i] = std::sqrt(x[i]);
    return x;
}
template <class V> inline V larger(V a, V b) { return a > b ? a : b; }
template <class V> inline V smaller(V a, V b) { return a < b ? a : b; }
template <class V> inline V magnitude(V x) { return larger(x, -x); }

// log2 x of a normal x > 0 and 2^x of |x| < 1000, to four and five digits, which is enough for the
// length of a step: interpolated at Chebyshev's nodes of [1, 2] and of [-1/2, 1/2].
template <int W> inline typename Lanes<W>::Real coarse_log2(typename Lanes<W>::Real x) {
    using V = typename Lanes<W>::Real;
    using Bits = typename Lanes<W>::Bits;
    const Bits bits = std::bit_cast<Bits>(x);
    const V exponent = std::bit_cast<V>((bits >> 52) | 0x4330000000000000ULL) - (0x1p52 + 1023.0);
    const V m = std::bit_cast<V>((bits & 0x000fffffffffffffULL) | 0x3ff0000000000000ULL);
    const V cubic = -2.07833517 + m * (0.62603218 - 0.07844068 * m);
    return exponent + (-2.49835315 + m * (4.02921139 + m * cubic));
}
template <int W> inline typename Lanes<W>::Real coarse_exp2(typename Lanes<W>::Real x) {
    using V = typename Lanes<W>::Real;
    using Bits = typename Lanes<W>::Bits;
    const double rounding = 0x1.8p52;
    const V shifted = x + rounding, f = x - (shifted - rounding);
    const V power = 1.0 + f * (0.69312105 + f * (0.24022349 + f * (0.05592198 + f * 0.00966637)));
    return std::bit_cast<V>(std::bit_cast<Bits>(power) + (std::bit_cast<Bits>(shifted) << 52));
}

template <class V> struct Direction {
    V cosine, sine;
};
// The direction turned on by a small angle: Taylor series, to rounding up to 0.2 rad.
template <class V> inline Direction<V> turned(const Direction<V> &from, V angle) {
    const V z = angle * angle;
    const V cubed = -1.0 / 6 + z * (1.0 / 120 + z * (-1.0 / 5040 + z * (1.0 / 362880)));
    const V fourth = 1.0 / 24 + z * (-1.0 / 720 + z * (1.0 / 40320 - z * (1.0 / 3628800)));
    const V sine = angle + angle * z * cubed, versed = z * (-0.5 + z * fourth);
    return {from.cosine + (from.cosine * versed - from.sine * sine),
            from.sine + (from.sine * versed + from.cosine * sine)};
}
