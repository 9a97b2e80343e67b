#include "forced/quadratic_resolvent.h"

#include "linalg/dense/complex_schur.h"
#include "linalg/dense/products.h"

#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

namespace whirl::forced {

namespace {

/// (m - T)^-1 v of an upper triangular T, column by column.
void solve_shifted_triangle(const Eigen::MatrixXcd &T, std::complex<double> m,
                            Eigen::MatrixXcd &v) {
    for (Eigen::Index k = T.rows() - 1; k >= 0; --k) {
        v.row(k) /= m - T(k, k);
        v.topRows(k) += T.col(k).head(k) * v.row(k);
    }
}

/// An orthonormal basis of start, C start, C^2 start, ... in which (m - C)^-1 start and
/// (m - C)^-2 start are exact to rounding at some m (block Arnoldi). Poles far from these m take
/// few of its columns together.
Eigen::MatrixXcd krylov_basis(const Eigen::MatrixXcd &C, const Eigen::MatrixXcd &start,
                              const std::vector<std::complex<double>> &places) {
    constexpr Eigen::Index between_checks = 8; // columns: a check costs about as much as these
    constexpr double nothing_new = 1e-14;      // of the length: rounding
    constexpr double exact = 1e-15;            // of C and m times the solution, as in a Schur form
    const Eigen::Index n = C.rows();
    Eigen::MatrixXcd Q(n, n);
    Eigen::MatrixXcd images(n, n);
    Eigen::Index found = 0;
    const auto take_in = [&](Eigen::VectorXcd v) {
        const double length = v.norm();
        for (int pass = 0; pass < 2; ++pass) {
            const Eigen::VectorXcd known = Q.leftCols(found).adjoint() * v;
            v.noalias() -= Q.leftCols(found) * known;
        }
        if (found < n && v.norm() > nothing_new * length)
            Q.col(found++) = v.normalized();
    };
    for (const auto &column : start.colwise())
        take_in(column);
    Eigen::Index used = 0;
    while (used < found) {
        for (Eigen::Index k = 0; k < between_checks && used < found; ++k) {
            images.col(used).noalias() = C * Q.col(used);
            take_in(images.col(used++));
        }
        if (used == found || used < start.cols())
            continue;
        const Eigen::MatrixXcd basis = Q.leftCols(used);
        const Eigen::MatrixXcd moved = images.leftCols(used);
        const Eigen::MatrixXcd H = linalg::adjoint_times(basis, moved);
        const Eigen::MatrixXcd rest = moved - linalg::times(basis, H);
        const Eigen::MatrixXcd loads = linalg::adjoint_times(basis, start);
        const bool enough = std::ranges::all_of(places, [&](const std::complex<double> &m) {
            Eigen::MatrixXcd A = -H;
            A.diagonal().array() += m;
            const Eigen::PartialPivLU<Eigen::MatrixXcd> lu(A);
            const Eigen::MatrixXcd once = linalg::solved(lu, loads);
            const Eigen::MatrixXcd twice = linalg::solved(lu, once);
            const auto small = [&](const Eigen::MatrixXcd &y) {
                const Eigen::MatrixXcd left = linalg::times(rest, y);
                return (left.colwise().norm().array() <=
                        exact * (std::abs(m) + H.norm()) * y.colwise().norm().array())
                    .all();
            };
            return small(once) && small(twice);
        });
        if (enough)
            return basis;
    }
    return Q.leftCols(found);
}

} // namespace

QuadraticResolvent::QuadraticResolvent(const QuadraticTerms &terms, const Eigen::MatrixXcd &b,
                                       const Eigen::MatrixXd &rows, double from, double to,
                                       bool all_poles)
    : _width(std::max(to - from, 0.1 * std::max(std::abs(from), std::abs(to)))),
      _shift((from + to) / 2, 0.3 * _width) {
    const Eigen::PartialPivLU<Eigen::MatrixXcd> at_shift(terms.at(_shift));
    const Eigen::Index m = b.rows();
    Eigen::MatrixXcd companion = Eigen::MatrixXcd::Zero(2 * m, 2 * m);
    const Eigen::MatrixXcd slope = terms.P1 + 2.0 * _shift * terms.P2;
    const Eigen::MatrixXcd left = linalg::solved(at_shift, slope);
    const Eigen::MatrixXcd right = linalg::solved(at_shift, terms.P2);
    companion.topLeftCorner(m, m) = -_width * left;
    companion.topRightCorner(m, m) = -_width * _width * right;
    companion.bottomLeftCorner(m, m).setIdentity();
    Eigen::MatrixXcd start = Eigen::MatrixXcd::Zero(2 * m, b.cols());
    start.topRows(m) = linalg::solved(at_shift, b);
    Eigen::MatrixXcd basis = Eigen::MatrixXcd::Identity(2 * m, 2 * m);
    const bool all = all_poles || start.isZero(0);
    if (!all) {
        std::vector<std::complex<double>> places;
        for (int quarter = 0; quarter <= 4; ++quarter)
            places.push_back(m_at(from + (to - from) * quarter / 4));
        basis = krylov_basis(companion, start, places);
        companion = linalg::adjoint_times(basis, linalg::times(companion, basis));
    }
    linalg::ComplexSchurForm schur = linalg::complex_schur(std::move(companion));
    _T = std::move(schur.T);
    const Eigen::MatrixXcd vectors = all ? schur.Q : linalg::times(basis, schur.Q);
    const Eigen::MatrixXcd read = rows.cast<std::complex<double>>();
    const Eigen::MatrixXcd lower = vectors.bottomRows(m);
    _lower = linalg::times(read, lower);
    _h = linalg::adjoint_times(vectors, start);
    find_residues();
}

void QuadraticResolvent::find_residues() {
    // Columns of X are eigenvectors of T; nearer poles than rounding distinguishes are held that
    // far apart: their terms cancel, and T is solved.
    const double least = std::numeric_limits<double>::epsilon() * _T.cwiseAbs().maxCoeff();
    Eigen::MatrixXcd X = Eigen::MatrixXcd::Identity(_T.rows(), _T.rows());
    for (Eigen::Index k = 1; k < _T.rows(); ++k) {
        auto x = X.col(k);
        x.head(k) = _T.col(k).head(k);
        for (Eigen::Index i = k - 1; i >= 0; --i) {
            const std::complex<double> apart = _T(k, k) - _T(i, i);
            x(i) /= std::abs(apart) > least ? apart : least;
            x.head(i) += x(i) * _T.col(i).head(i);
        }
    }
    const Eigen::MatrixXcd parts = X.triangularView<Eigen::UnitUpper>().solve(_h);
    const Eigen::MatrixXcd numbers = linalg::times(_lower, X);
    for (const auto &part : parts.colwise()) {
        Eigen::MatrixXcd of = numbers * part.asDiagonal();
        Eigen::MatrixXd sizes = of.cwiseAbs();
        _residues.push_back({std::move(of), std::move(sizes)});
    }
}

std::vector<std::complex<double>> QuadraticResolvent::poles() const {
    std::vector<std::complex<double>> out;
    for (const std::complex<double> &root : _T.diagonal())
        if (std::abs(root) > 1e-9) // else farther than any s
            out.push_back(_shift + _width / root);
    return out;
}

QuadraticResolvent::Solution QuadraticResolvent::at(double s, Eigen::Index first,
                                                    Eigen::Index count) const {
    constexpr double cancels = 1e3; // and rounding of the terms costs three digits
    const std::complex<double> m = m_at(s);
    const Eigen::ArrayXcd away = m - _T.diagonal().array();
    const Eigen::VectorXcd once = away.conjugate() / away.abs2();
    const Eigen::VectorXcd twice = once.cwiseProduct(once);
    Eigen::MatrixXcd v(count, _h.cols());
    Eigen::MatrixXcd w(count, _h.cols());
    for (Eigen::Index j = 0; j < _h.cols(); ++j) {
        const Residues &residues = _residues[static_cast<std::size_t>(j)];
        v.col(j) = residues.of.middleRows(first, count) * once;
        const Eigen::VectorXd sizes = residues.sizes.middleRows(first, count) * once.cwiseAbs();
        if (!(sizes.array() <= cancels * v.col(j).cwiseAbs().array()).all())
            return by_triangle(m, first, count);
        w.col(j) = residues.of.middleRows(first, count) * twice;
    }
    return solution(m, v, w);
}

QuadraticResolvent::Solution QuadraticResolvent::by_triangle(std::complex<double> m,
                                                             Eigen::Index first,
                                                             Eigen::Index count) const {
    Eigen::MatrixXcd v = _h;
    solve_shifted_triangle(_T, m, v);
    Eigen::MatrixXcd w = v;
    solve_shifted_triangle(_T, m, w);
    return solution(m, _lower.middleRows(first, count) * v, _lower.middleRows(first, count) * w);
}

QuadraticResolvent::Solution QuadraticResolvent::solution(std::complex<double> m,
                                                          const Eigen::MatrixXcd &v,
                                                          const Eigen::MatrixXcd &w) const {
    // u = m^2 v; d(m^2 v)/dm = 2 m v - m^2 w, dm/ds = -m^2 / width.
    const std::complex<double> square = m * m;
    return {square * v, (-square / _width) * (2.0 * m * v - square * w)};
}

} // namespace whirl::forced
