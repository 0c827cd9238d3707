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
// The direction of any angle up to 1e6 rad, to rounding, as the product has it: Cody and Waite's
// reduction to an eighth of a turn, and FDLIBM's polynomials.
template <int W> inline Direction<typename Lanes<W>::Real> towards(typename Lanes<W>::Real angle) {
    using V = typename Lanes<W>::Real;
    using Bits = typename Lanes<W>::Bits;
    const double rounding = 0x1.8p52;
    const V shifted = angle * 0.6366197723675814 + rounding, quarters = shifted - rounding;
    const V r = (angle - quarters * 1.5707963267341256) - quarters * 6.0771005065061922e-11;
    const V z = r * r, w = z * z;
    const V cubed = (-1.66666666666666324348e-01 + 8.33333333332248946124e-03 * z) +
                    w * (-1.98412698298579493134e-04 + 2.75573137070700676789e-06 * z) +
                    (w * w) * (-2.50507602534068634195e-08 + 1.58969099521155010221e-10 * z);
    const V fourth = (4.16666666666666019037e-02 + -1.38888888888741095749e-03 * z) +
                     w * (2.48015872894767294178e-05 + -2.75573143513906633035e-07 * z) +
                     (w * w) * (2.08757232129817482790e-09 + -1.13596475577881948265e-11 * z);
    const V sine = r + (r * z) * cubed, cosine = (1.0 - 0.5 * z) + w * fourth;
    const Bits turns = std::bit_cast<Bits>(shifted);
    const auto odd = (turns & 1) != 0;
    const V ahead = odd ? sine : cosine, aside = odd ? cosine : sine;
    return {std::bit_cast<V>(std::bit_cast<Bits>(ahead) ^ (((turns + 1) & 2) << 62)),
            std::bit_cast<V>(std::bit_cast<Bits>(aside) ^ ((turns & 2) << 62))};
}
// The direction turned on by a small angle: Taylor series, to rounding up to 0.2 rad.
template <class V> inline Direction<V> turned(const Direction<V> &from, V angle) {
    const V z = angle * angle;
    const V cubed = -1.0 / 6 + z * (1.0 / 120 + z * (-1.0 / 5040 + z * (1.0 / 362880)));
    const V fourth = 1.0 / 24 + z * (-1.0 / 720 + z * (1.0 / 40320 - z * (1.0 / 3628800)));
    const V sine = angle + angle * z * cubed, versed = z * (-0.5 + z * fourth);
    return {from.cosine + (from.cosine * versed - from.sine * sine),
            from.sine + (from.sine * versed + from.cosine * sine)};
}
