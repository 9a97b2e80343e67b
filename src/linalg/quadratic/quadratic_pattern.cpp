#include "linalg/quadratic/quadratic_pattern.h"

#include <cmath>

namespace whirl::linalg {

QuadraticPattern::QuadraticPattern(const Sparse &M, const Sparse &D, const Sparse &K) {
    Sparse pattern = M.cwiseAbs() + D.cwiseAbs();
    pattern = (pattern + K.cwiseAbs()).eval();
    Sparse diagonal(K.rows(), K.cols());
    diagonal.setIdentity();
    pattern = (pattern + Sparse(pattern.transpose()) + diagonal).eval();
    pattern.makeCompressed();
    const auto entries_of = [&pattern](const Sparse &A) -> Eigen::VectorXd {
        const Sparse on_pattern = 0 * pattern + A; // entries that are zero stay
        return Eigen::Map<const Eigen::VectorXd>(on_pattern.valuePtr(), on_pattern.nonZeros());
    };
    _M = entries_of(M);
    _D = entries_of(D);
    _K = entries_of(K);
    _Q = pattern.cast<std::complex<double>>();
}

const QuadraticPattern::ComplexSparse &QuadraticPattern::at(std::complex<double> l) {
    const std::complex<double> square = l * l;
    std::complex<double> *values = _Q.valuePtr();
    for (Eigen::Index i = 0; i < _K.size(); ++i)
        values[i] = {square.real() * _M(i) + l.real() * _D(i) + _K(i),
                     square.imag() * _M(i) + l.imag() * _D(i)};
    return _Q;
}

namespace {

Complex4 four(const QuadraticPattern::Four &values, double factor) {
    Complex4 out;
    for (int lane = 0; lane < lanes; ++lane)
        out.set(lane, factor * values[static_cast<std::size_t>(lane)]);
    return out;
}

} // namespace

void QuadraticPattern::set_values(const Four &l, Vector4 &out) const {
    const Complex4 once = four(l, 1);
    Complex4 twice;
    set_product(twice, once, once);
    out.resize(static_cast<std::size_t>(_K.size()));
    in_lanes([&]() __attribute__((always_inline)) {
        for (std::size_t i = 0; i < out.size(); ++i) {
            const auto at = static_cast<Eigen::Index>(i);
            out[i].re = twice.re * _M(at) + once.re * _D(at) + _K(at);
            out[i].im = twice.im * _M(at) + once.im * _D(at);
        }
    });
}

void QuadraticPattern::set_slopes(const Four &l, Vector4 &out) const {
    const Complex4 twice = four(l, 2);
    out.resize(static_cast<std::size_t>(_K.size()));
    in_lanes([&]() __attribute__((always_inline)) {
        for (std::size_t i = 0; i < out.size(); ++i) {
            const auto at = static_cast<Eigen::Index>(i);
            out[i].re = twice.re * _M(at) + _D(at);
            out[i].im = twice.im * _M(at);
        }
    });
}

void QuadraticPattern::multiply(const Vector4 &entries, const Vector4 &x, Vector4 &out) const {
    out.assign(x.size(), Complex4{});
    in_lanes([&]() __attribute__((always_inline)) {
        const int *first = _Q.outerIndexPtr();
        const int *rows = _Q.innerIndexPtr();
        for (std::size_t column = 0; column < x.size(); ++column)
            for (int p = first[column]; p < first[column + 1]; ++p)
                add_product(out[static_cast<std::size_t>(rows[p])],
                            entries[static_cast<std::size_t>(p)], x[column]);
    });
}

void QuadraticPattern::multiply_transposed(const Vector4 &entries, const Vector4 &x,
                                           Vector4 &out) const {
    out.resize(x.size());
    in_lanes([&]() __attribute__((always_inline)) {
        const int *first = _Q.outerIndexPtr();
        const int *rows = _Q.innerIndexPtr();
        for (std::size_t column = 0; column < x.size(); ++column) {
            Complex4 sum{};
            for (int p = first[column]; p < first[column + 1]; ++p)
                add_product(sum, entries[static_cast<std::size_t>(p)],
                            x[static_cast<std::size_t>(rows[p])]);
            out[column] = sum;
        }
    });
}

double QuadraticPattern::size(const Eigen::VectorXcd &y, double l,
                              const Eigen::VectorXcd &x) const {
    const Eigen::VectorXd a = y.cwiseAbs();
    const Eigen::VectorXd b = x.cwiseAbs();
    const int *first = _Q.outerIndexPtr();
    const int *rows = _Q.innerIndexPtr();
    double out = 0;
    for (Eigen::Index column = 0; column < b.size(); ++column) {
        double sum = 0;
        for (int p = first[column]; p < first[column + 1]; ++p)
            sum += a(rows[p]) * (l * (l * std::abs(_M(p)) + std::abs(_D(p))) + std::abs(_K(p)));
        out += sum * b(column);
    }
    return out;
}

} // namespace whirl::linalg
