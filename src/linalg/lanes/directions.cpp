#include "linalg/lanes/directions.h"

#include "linalg/lanes/complex4.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <numbers>

namespace whirl::linalg {

namespace {

using Whole4 = std::int64_t __attribute__((vector_size(32)));

/// Beyond it multiples of a quarter turn no longer have the bits that the parts of it leave free.
constexpr double largest = 1e6;

// Vectors are handed over by reference: by value they would pass differently on each machine.

template <class To, class From> WHIRL_INLINED void copy_bits(const From &from, To &to) {
    static_assert(sizeof to == sizeof from);
    std::memcpy(&to, &from, sizeof to);
}

/// a where no bit of `which` is set, else b; with this sign.
WHIRL_INLINED void choose(const Whole4 &which, const Real4 &a, const Real4 &b, const Whole4 &sign,
                          Real4 &out) {
    Whole4 bits_a;
    Whole4 bits_b;
    copy_bits(a, bits_a);
    copy_bits(b, bits_b);
    const Whole4 bits = ((bits_a & ~which) | (bits_b & which)) ^ sign;
    copy_bits(bits, out);
}

/// sin and cos on [-pi/4, pi/4]: minimax polynomials of degrees 13 and 14 (W. J. Cody and W. Waite,
/// Software Manual for the Elementary Functions, 1980; coefficients of K. C. Ng in fdlibm).
WHIRL_INLINED void set_sine(const Real4 &r, Real4 &out) {
    const Real4 z = r * r;
    const Real4 tail =
        8.33333333332248946124e-03 +
        z * (-1.98412698298579493134e-04 +
             z * (2.75573137070700676789e-06 +
                  z * (-2.50507602534068634195e-08 + z * 1.58969099521155010221e-10)));
    out = r + r * z * (-1.66666666666666324348e-01 + z * tail);
}
WHIRL_INLINED void set_cosine(const Real4 &r, Real4 &out) {
    const Real4 z = r * r;
    const Real4 tail =
        4.16666666666666019037e-02 +
        z * (-1.38888888888741095749e-03 +
             z * (2.48015872894767294178e-05 +
                  z * (-2.75573143513906633035e-07 +
                       z * (2.08757232129817482790e-09 + z * -1.13596475577881948265e-11))));
    const Real4 half = 0.5 * z;
    const Real4 first = 1.0 - half;
    out = first + ((1.0 - first) - half + z * z * tail);
}

WHIRL_INLINED void set_four(const double *angles, double *cosines, double *sines) {
    // A quarter turn in three parts of 33 bits: products with whole numbers below 2^20 are exact.
    constexpr double first = 1.57079632673412561417e+00;
    constexpr double second = 6.07710050630396597660e-11;
    constexpr double third = 2.02226624879595063154e-21;
    constexpr double rounds = 6755399441055744; // 1.5 2^52: adding it rounds to a whole number
    Real4 angle;
    std::memcpy(&angle, angles, sizeof angle);
    const Real4 raised = angle * (2 / std::numbers::pi) + rounds;
    const Real4 quarters = raised - rounds;
    Whole4 number;
    copy_bits(raised, number);
    const Real4 r = ((angle - quarters * first) - quarters * second) - quarters * third;
    Real4 s;
    Real4 c;
    set_sine(r, s);
    set_cosine(r, c);
    const Whole4 odd = -(number & 1);
    Real4 sine;
    Real4 cosine;
    choose(odd, s, c, (number & 2) << 62, sine);
    choose(odd, c, s, ((number + 1) & 2) << 62, cosine);
    std::memcpy(cosines, &cosine, sizeof cosine);
    std::memcpy(sines, &sine, sizeof sine);
}

} // namespace

void set_directions(const double *angles, int count, double *cosines, double *sines) {
    in_lanes([&]() __attribute__((always_inline)) {
        int i = 0;
        for (; i + lanes <= count; i += lanes)
            set_four(angles + i, cosines + i, sines + i);
        if (i == count)
            return;
        std::array<double, lanes> in{};
        std::array<double, lanes> c;
        std::array<double, lanes> s;
        std::copy(angles + i, angles + count, in.begin());
        set_four(in.data(), c.data(), s.data());
        std::copy_n(c.begin(), count - i, cosines + i);
        std::copy_n(s.begin(), count - i, sines + i);
    });
    for (int i = 0; i < count; ++i)
        if (!(std::abs(angles[i]) < largest)) {
            cosines[i] = std::cos(angles[i]);
            sines[i] = std::sin(angles[i]);
        }
}

} // namespace whirl::linalg
