#include "linalg/lanes/vector_products.h"

#include <cstring>

namespace whirl::linalg {

namespace {

/// Sums of products of the numbers of two complex vectors: of those at one place, and of each with
/// the other one of its pair; of first and of second ones of a pair in turn.
struct Sums {
    Real4 along{};
    Real4 across{};
};

Sums sums_of(const std::complex<double> *a, const std::complex<double> *b, Eigen::Index size) {
    Sums out;
    const auto *x = reinterpret_cast<const double *>(a);
    const auto *y = reinterpret_cast<const double *>(b);
    const Eigen::Index whole = 2 * size / lanes * lanes;
    in_lanes([&]() __attribute__((always_inline)) {
        Real4 one{};
        Real4 other{};
        for (Eigen::Index k = 0; k < whole; k += lanes) {
            Real4 p;
            Real4 q;
            std::memcpy(&p, x + k, sizeof p);
            std::memcpy(&q, y + k, sizeof q);
            one += p * q;
            other += p * __builtin_shufflevector(q, q, 1, 0, 3, 2);
        }
        out.along = one;
        out.across = other;
    });
    for (Eigen::Index k = whole; k < 2 * size; k += 2)
        for (int part = 0; part < 2; ++part) {
            out.along[part] += x[k + part] * y[k + part];
            out.across[part] += x[k + part] * y[k + 1 - part];
        }
    return out;
}

} // namespace

std::complex<double> dot(const Eigen::Ref<const Eigen::VectorXcd> &a,
                         const Eigen::Ref<const Eigen::VectorXcd> &b) {
    const auto [along, across] = sums_of(a.data(), b.data(), a.size());
    return {along[0] + along[1] + along[2] + along[3],
            across[0] - across[1] + across[2] - across[3]};
}

std::complex<double> product_of_columns(const Eigen::MatrixXcd &A, Eigen::Index i,
                                        const Eigen::MatrixXcd &B, Eigen::Index j) {
    const auto [along, across] = sums_of(A.col(i).data(), B.col(j).data(), A.rows());
    return {along[0] - along[1] + along[2] - along[3],
            across[0] + across[1] + across[2] + across[3]};
}

void add_multiple(std::complex<double> f, const Eigen::VectorXcd &x, Eigen::VectorXcd &y) {
    const auto *in = reinterpret_cast<const double *>(x.data());
    auto *out = reinterpret_cast<double *>(y.data());
    const Eigen::Index whole = 2 * x.size() / lanes * lanes;
    in_lanes([&]() __attribute__((always_inline)) {
        const Real4 re{f.real(), f.real(), f.real(), f.real()};
        const Real4 im{-f.imag(), f.imag(), -f.imag(), f.imag()};
        for (Eigen::Index k = 0; k < whole; k += lanes) {
            Real4 p;
            Real4 to;
            std::memcpy(&p, in + k, sizeof p);
            std::memcpy(&to, out + k, sizeof to);
            to += re * p + im * __builtin_shufflevector(p, p, 1, 0, 3, 2);
            std::memcpy(out + k, &to, sizeof to);
        }
    });
    for (Eigen::Index k = whole / 2; k < x.size(); ++k)
        y(k) += f * x(k);
}

Eigen::VectorXcd sum_of(const std::vector<RealMultiple> &terms) {
    constexpr Eigen::Index block = 4 * lanes; // numbers that stay in registers
    const Eigen::Index size = 2 * terms.front().x->size();
    Eigen::VectorXcd sum(terms.front().x->size());
    auto *out = reinterpret_cast<double *>(sum.data());
    in_lanes([&]() __attribute__((always_inline)) {
        const RealMultiple *first = terms.data();
        const RealMultiple *last = first + terms.size();
        for (Eigen::Index k = 0; k < size / block * block; k += block) {
            std::array<Real4, 4> all{};
            for (const RealMultiple *term = first; term != last; ++term) {
                std::array<Real4, 4> some;
                std::memcpy(some.data(), reinterpret_cast<const double *>(term->x->data()) + k,
                            sizeof some);
                all[0] += term->f * some[0];
                all[1] += term->f * some[1];
                all[2] += term->f * some[2];
                all[3] += term->f * some[3];
            }
            std::memcpy(out + k, all.data(), sizeof all);
        }
        for (Eigen::Index k = size / block * block; k < size; ++k) {
            double one = 0;
            for (const RealMultiple *term = first; term != last; ++term)
                one += term->f * reinterpret_cast<const double *>(term->x->data())[k];
            out[k] = one;
        }
    });
    return sum;
}

std::array<Eigen::VectorXcd, lanes> vectors_of(const Vector4 &four, const Complex4 &factors) {
    std::array<Eigen::VectorXcd, lanes> out;
    std::array<double *, lanes> to{};
    for (std::size_t lane = 0; lane < lanes; ++lane) {
        out[lane].resize(std::ssize(four));
        to[lane] = reinterpret_cast<double *>(out[lane].data());
    }
    in_lanes([&]() __attribute__((always_inline)) {
        for (std::size_t k = 0; k < four.size(); ++k) {
            Complex4 z;
            set_product(z, factors, four[k]);
            // Pairs of lanes 0 and 2, and of 1 and 3.
            const Real4 even = __builtin_shufflevector(z.re, z.im, 0, 4, 2, 6);
            const Real4 odd = __builtin_shufflevector(z.re, z.im, 1, 5, 3, 7);
            std::memcpy(to[0] + 2 * k, &even, 16);
            std::memcpy(to[1] + 2 * k, &odd, 16);
            const Real4 even_high = __builtin_shufflevector(even, even, 2, 3, 2, 3);
            const Real4 odd_high = __builtin_shufflevector(odd, odd, 2, 3, 2, 3);
            std::memcpy(to[2] + 2 * k, &even_high, 16);
            std::memcpy(to[3] + 2 * k, &odd_high, 16);
        }
    });
    return out;
}

} // namespace whirl::linalg
