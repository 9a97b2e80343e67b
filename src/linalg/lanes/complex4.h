#pragma once

#include <Eigen/Core>

#include <array>
#include <cmath>
#include <complex>
#include <cstring>
#include <vector>

namespace whirl::linalg {

/// Numbers of four problems side by side, which vector instructions take in one step.
using Real4 = double __attribute__((vector_size(32)));

/// Complex numbers of four problems, the real and imaginary parts apart.
struct Complex4 {
    Real4 re, im;

    void set(int lane, std::complex<double> value) {
        re[lane] = value.real();
        im[lane] = value.imag();
    }
    [[nodiscard]] std::complex<double> at(int lane) const { return {re[lane], im[lane]}; }
};
constexpr int lanes = 4; ///< doubles in a register of 256 bits, Real4

/// Four complex vectors, entry by entry.
using Vector4 = std::vector<Complex4>;

/// @param vectors  of one size
inline void set(Vector4 &out, const std::array<const Eigen::VectorXcd *, lanes> &vectors) {
    const auto size = static_cast<std::size_t>(vectors[0]->size());
    out.resize(size);
    for (std::size_t lane = 0; lane < lanes; ++lane) {
        const std::complex<double> *in = vectors[lane]->data();
        for (std::size_t k = 0; k < size; ++k)
            out[k].set(static_cast<int>(lane), in[k]);
    }
}

[[nodiscard]] inline Eigen::VectorXcd vector_of(const Vector4 &four, int lane) {
    Eigen::VectorXcd out(static_cast<Eigen::Index>(four.size()));
    for (std::size_t k = 0; k < four.size(); ++k)
        out.data()[k] = four[k].at(lane);
    return out;
}

// Inlined into each of the versions for one kind of machine.
#define WHIRL_INLINED inline __attribute__((always_inline))

WHIRL_INLINED void load(Real4 &to, const double *from) { std::memcpy(&to, from, sizeof to); }
WHIRL_INLINED void store(const Real4 &from, double *to) { std::memcpy(to, &from, sizeof from); }

/// Work on so many columns, many vectors at a time; what does not fill a vector is left.
/// @returns from where on
template <int most = 8, class Work>
WHIRL_INLINED Eigen::Index along_row(Eigen::Index from, Eigen::Index columns, const Work &work) {
    for (; from + most * lanes <= columns; from += most * lanes)
        work.template operator()<most>(from);
    if constexpr (most > 1)
        return along_row<most / 2>(from, columns, work);
    return from;
}

/// a += f b
WHIRL_INLINED void add_product(Complex4 &a, const Complex4 &f, const Complex4 &b) {
    a.re += f.re * b.re - f.im * b.im;
    a.im += f.re * b.im + f.im * b.re;
}
/// a -= f b
WHIRL_INLINED void subtract_product(Complex4 &a, const Complex4 &f, const Complex4 &b) {
    a.re -= f.re * b.re - f.im * b.im;
    a.im -= f.re * b.im + f.im * b.re;
}
/// out = f b
WHIRL_INLINED void set_product(Complex4 &out, const Complex4 &f, const Complex4 &b) {
    const Real4 re = f.re * b.re - f.im * b.im;
    out.im = f.re * b.im + f.im * b.re;
    out.re = re;
}

/// out = 1 / a
WHIRL_INLINED void set_inverse(Complex4 &out, const Complex4 &a) {
    const Real4 square = a.re * a.re + a.im * a.im;
    out.re = a.re / square;
    out.im = -a.im / square;
}

/// In each lane whether all numbers are finite.
[[nodiscard]] inline std::array<bool, lanes> finite(const Vector4 &four) {
    std::array<bool, lanes> out{true, true, true, true};
    for (const Complex4 &entry : four)
        for (int lane = 0; lane < lanes; ++lane)
            out[static_cast<std::size_t>(lane)] = out[static_cast<std::size_t>(lane)] &&
                                                  std::isfinite(entry.re[lane]) &&
                                                  std::isfinite(entry.im[lane]);
    return out;
}

#if defined(__x86_64__)
template <class Work> __attribute__((target("avx2,fma"))) void on_wide_machine(const Work &work) {
    work();
}
/// Vectors of four numbers, as on most machines: twice as fast as those that any has.
[[nodiscard]] inline bool wide() {
    static const bool found = __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
    return found;
}
#else
template <class Work> void on_wide_machine(const Work &work) { work(); }
[[nodiscard]] inline bool wide() { return false; }
#endif

/// Runs work, a lambda that is WHIRL_INLINED, in the instructions that suit this machine.
template <class Work> void in_lanes(const Work &work) {
    if (wide())
        on_wide_machine(work);
    else
        work();
}

} // namespace whirl::linalg
