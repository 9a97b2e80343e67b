#include "linalg/harmonic_solve.h"

#include "linalg/check.h"
#include "linalg/unit_scales.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace whirl::linalg {

namespace {

/// Signs without a pattern, the same at every call (a linear congruential generator, Knuth).
Eigen::VectorXd signs(Eigen::Index size) {
    Eigen::VectorXd out(size);
    unsigned long long state = 1;
    for (Eigen::Index i = 0; i < size; ++i) {
        state = state * 6364136223846793005ULL + 1442695040888963407ULL;
        out(i) = (state >> 63U) != 0 ? 1 : -1;
    }
    return out;
}

/// Moduli of real and imaginary parts, as parts.
Eigen::VectorXcd moduli(const Eigen::VectorXcd &x) {
    Eigen::VectorXcd out(x.size());
    out.real() = x.real().cwiseAbs();
    out.imag() = x.imag().cwiseAbs();
    return out;
}

/// Largest modulus of a real or imaginary part.
double largest_part(const Eigen::VectorXcd &x) {
    return std::max(x.real().lpNorm<Eigen::Infinity>(), x.imag().lpNorm<Eigen::Infinity>());
}

} // namespace

HarmonicSolver::HarmonicSolver(const HarmonicTerms &terms)
    : _scales(unit_scales(terms.K, terms.M)) {
    using RealSparse = Eigen::SparseMatrix<double>;
    std::array<RealSparse, factor_count> of;
    of[one] = terms.K.view();
    of[spin_once] = terms.Kc.view();
    of[spin_squared] =
        terms.Kss.size() > 0 ? RealSparse(terms.Kss.view()) : RealSparse(size(), size());
    of[minus_frequency_squared] = terms.M.view();
    of[i_frequency] = terms.C.view();
    of[i_frequency_spin] = terms.G.view();
    RealSparse pattern(size(), size());
    for (RealSparse &term : of) {
        term.prune(0.0);
        term = scaled(term, _scales);
        pattern = RealSparse(pattern + term.cwiseAbs());
    }
    for (std::size_t i = 0; i < factor_count; ++i) {
        const RealSparse on_pattern = 0 * pattern + of[i];
        _terms[i] = on_pattern.coeffs();
    }
    _A = pattern.cast<std::complex<double>>();
    _sizes = _A;
}

void HarmonicSolver::set(double spin, double frequency) {
    const std::array<double, factor_count> factors{
        1, spin, spin * spin, -frequency * frequency, frequency, frequency * spin};
    _A.coeffs().setZero();
    _sizes.coeffs().setZero();
    const auto add = [&](Factor f, auto &&A, auto &&sizes) {
        if (factors[f] != 0) {
            A += factors[f] * _terms[f];
            sizes += std::abs(factors[f]) * _terms[f].abs();
        }
    };
    for (const Factor f : {one, spin_once, spin_squared, minus_frequency_squared})
        add(f, _A.coeffs().real(), _sizes.coeffs().real());
    for (const Factor f : {i_frequency, i_frequency_spin})
        add(f, _A.coeffs().imag(), _sizes.coeffs().imag());
}

/// |A| |q| + |f| of real and imaginary parts: what K and s^2 M lose against each other counts as
/// rounding.
Eigen::VectorXcd HarmonicSolver::sizes_of(const Eigen::VectorXcd &f,
                                          const Eigen::VectorXcd &q) const {
    const Eigen::VectorXcd x = moduli(q);
    Eigen::VectorXcd out = moduli(f);
    out.real() += (_sizes * x.conjugate()).real();
    out.imag() += (_sizes * x).imag();
    return out;
}

double HarmonicSolver::solved(const Eigen::MatrixXcd &f, Eigen::MatrixXcd &q) {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    if (!_lu.factorize(_A))
        return infinity;
    q = f;
    _lu.solve(q);
    if (!q.allFinite())
        return infinity;
    double out = 0;
    for (Eigen::Index column = 0; column < q.cols(); ++column) {
        const Eigen::VectorXcd rest = f.col(column) - _A * q.col(column);
        const double size = largest_part(sizes_of(f.col(column), q.col(column)));
        if (size > 0)
            out = std::max(out, largest_part(rest) / size);
    }
    return out;
}

Eigen::MatrixXcd HarmonicSolver::solve(double spin, double frequency,
                                       const Eigen::MatrixXcd &forces) {
    // A backward stable solution leaves some 1e-15. With the pivots of the A before, which serve
    // as long as A changes little, it may be more: then A gets its own.
    constexpr double residual_of_old_pivots = 1e-14;
    // Far more means that elimination went wrong.
    constexpr double residual_allowed = 1e-8;
    set(spin, frequency);
    const Eigen::MatrixXcd f = _scales.asDiagonal() * forces;
    Eigen::MatrixXcd q;
    double residual = solved(f, q);
    if (!(residual <= residual_of_old_pivots)) {
        _lu.forget_pivots();
        residual = solved(f, q);
    }
    if (std::isinf(residual))
        throw SolverError("the dynamic stiffness matrix is singular");
    if (!(residual <= residual_allowed))
        throw SolverError("the linear system of the forced motion left a large residual");
    return _scales.asDiagonal() * q;
}

double HarmonicSolver::rounding(const Eigen::VectorXcd &forces,
                                const Eigen::VectorXcd &displacements) const {
    const Eigen::VectorXcd q = _scales.cwiseInverse().asDiagonal() * displacements;
    if (q.isZero(0))
        return 0;
    // Rounding of the entries of A changes each row of A q by about epsilon times its size.
    Eigen::VectorXcd change = sizes_of(_scales.asDiagonal() * forces, q);
    Eigen::Map<Eigen::VectorXd>(reinterpret_cast<double *>(change.data()), 2 * change.size())
        .array() *= std::numeric_limits<double>::epsilon() * signs(2 * change.size()).array();
    return _lu.solution(change).norm() / q.norm();
}

double HarmonicSolver::absolute_form(const Eigen::VectorXcd &displacements) const {
    const Eigen::VectorXcd q = (_scales.cwiseInverse().asDiagonal() * displacements)
                                   .cwiseAbs()
                                   .cast<std::complex<double>>();
    const std::complex<double> form = q.dot(_sizes * q);
    return form.real() + form.imag();
}

bool HarmonicSolver::conserves() const {
    return _terms[i_frequency].isZero(0) && _terms[spin_once].isZero(0);
}

} // namespace whirl::linalg
