#include "linalg/shifted_pencil.h"

#include "linalg/check.h"
#include "linalg/sparse_factor.h"
#include "linalg/symmetric_eigen.h"
#include "linalg/unit_scales.h"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <Eigen/QR>
#include <Eigen/SparseCholesky>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace whirl::linalg {

namespace {

using Sparse = Eigen::SparseMatrix<double>;

/// L with A = L L^T, A positive definite.
Sparse factor(const Sparse &A) {
    const Eigen::SimplicialLLT<Sparse, Eigen::Lower, Eigen::NaturalOrdering<int>> llt(A);
    if (llt.info() != Eigen::Success)
        throw SolverError("a mass or stiffness matrix is not positive definite");
    return llt.matrixL();
}

/// L with K = L L^T for a positive semidefinite K whose null space N is known: as many unknowns as
/// N has columns, those by which its motions differ most, depend on the others in what strains, K =
/// B K_rr B^T with B = [1; W], W = -N_p^-T N_r^T. Small pivots need not be distinguished from
/// zeros.
Sparse semidefinite_factor(const Sparse &K, const Eigen::MatrixXd &N) {
    if (N.cols() == 0)
        return factor(K);
    const Eigen::Index n = K.rows();
    const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(N.transpose());
    std::vector<Eigen::Index> pinned;
    std::vector<int> place(static_cast<std::size_t>(n), 0); // among the others, or -1
    for (Eigen::Index i = 0; i < N.cols(); ++i) {
        pinned.push_back(qr.colsPermutation().indices()(i));
        place[static_cast<std::size_t>(pinned.back())] = -1;
    }
    std::vector<Eigen::Index> others;
    for (Eigen::Index i = 0; i < n; ++i)
        if (place[static_cast<std::size_t>(i)] == 0) {
            place[static_cast<std::size_t>(i)] = static_cast<int>(others.size());
            others.push_back(i);
        }
    std::vector<Eigen::Triplet<double>> entries;
    for (Eigen::Index j = 0; j < n; ++j)
        for (Sparse::InnerIterator it(K, j); it; ++it) {
            const int row = place[static_cast<std::size_t>(it.row())];
            const int column = place[static_cast<std::size_t>(j)];
            if (row >= 0 && column >= 0)
                entries.emplace_back(row, column, it.value());
        }
    Sparse Krr(std::ssize(others), std::ssize(others));
    Krr.setFromTriplets(entries.begin(), entries.end());
    const Sparse Lrr = factor(Krr);
    const Eigen::MatrixXd W = -Eigen::MatrixXd(N(pinned, Eigen::all))
                                   .transpose()
                                   .partialPivLu()
                                   .solve(Eigen::MatrixXd(N(others, Eigen::all)).transpose());
    const Eigen::MatrixXd dependent = W * Lrr;
    entries.clear();
    for (Eigen::Index j = 0; j < Lrr.cols(); ++j) {
        const auto column = static_cast<int>(others[static_cast<std::size_t>(j)]);
        for (Sparse::InnerIterator it(Lrr, j); it; ++it)
            entries.emplace_back(static_cast<int>(others[static_cast<std::size_t>(it.row())]),
                                 column, it.value());
        for (std::size_t i = 0; i < pinned.size(); ++i)
            entries.emplace_back(static_cast<int>(pinned[i]), column,
                                 dependent(static_cast<Eigen::Index>(i), j));
    }
    Sparse L(n, n);
    L.setFromTriplets(entries.begin(), entries.end());
    return L;
}

/// Scales of the unknowns that make the diagonal of K 1: pivots are then not chosen by units.
Eigen::VectorXd unit_diagonal(const Matrix &K) {
    const Sparse stiffness = K.view();
    return stiffness.diagonal().cwiseMax(1e-300).cwiseSqrt().cwiseInverse();
}

Sparse scaled(const Eigen::VectorXd &d, const Matrix &A) {
    return linalg::scaled(Sparse(A.view()), d);
}

class Shifted {
  public:
    Shifted(const Matrix &K, const Matrix &M, const Matrix &S, const ShiftedOptions &options)
        : _scale(unit_diagonal(K)), _K(scaled(_scale, K)), _M(scaled(_scale, M)),
          _S(scaled(_scale, S)), _s(options.s), _shift(options.shift),
          _L(semidefinite_factor(_K, _scale.cwiseInverse().asDiagonal() * options.null_space)),
          _F(factor(_M)), _Lt(_L.transpose()), _Ft(_F.transpose()) {
        if (!_lu.factorize(at(_shift)))
            throw SolverError("the matrix at the shift is singular");
    }

    [[nodiscard]] Eigen::Index size() const { return _K.rows(); }

    void apply(const double *z, double *y) const {
        const Eigen::Index n = size();
        const Eigen::Map<const Eigen::VectorXd> f(z, n);
        const Eigen::Map<const Eigen::VectorXd> g(z + n, n);
        const Eigen::VectorXd w = _lu.solution(_shift * (_F * f) + _L * g);
        Eigen::Map<Eigen::VectorXd>(y, n) = _Ft * w;
        Eigen::Map<Eigen::VectorXd>(y + n, n) = (_Lt * w - g) / _shift;
    }

    /// The matrix with the eigenvalues 1/(w - shift).
    [[nodiscard]] SymmetricOperator inverse() const {
        const auto all = static_cast<int>(2 * size());
        return {all, [this](const double *z, double *y) { apply(z, y); },
                deterministic_vector(all)};
    }

    /// Eigenvalues between -bound and bound, zeros with their multiplicity.
    [[nodiscard]] int count_below(double bound) const {
        int count = 0;
        for (const double w : {bound, -bound})
            count += negative_pivots(Eigen::SimplicialLDLT<Sparse>(at(w)));
        return count;
    }

    [[nodiscard]] RealPair pair_from(double theta, const Eigen::VectorXd &z) const {
        const Eigen::Index n = size();
        RealPair pair;
        pair.value = _shift + 1 / theta;
        Eigen::VectorXd Tz(2 * n);
        apply(z.data(), Tz.data());
        // d(theta)/theta = d(w)/(w - shift)
        const double theta_error = (Tz - theta * z).norm() / (z.norm() * std::abs(theta));
        const double size = std::max(std::abs(pair.value), 1e-300);
        pair.residual = theta_error * std::abs(pair.value - _shift) / size;
        // A zero of K alone, (0, g) with L g = 0: there is no motion behind it, only its place
        // among the eigenvalues.
        if (z.head(n).squaredNorm() < 1e-16 * z.squaredNorm()) {
            pair.value = 0;
            pair.vector = Eigen::VectorXd::Zero(n);
            return pair;
        }
        // One step of the inverse iteration gives x from (F^T x, L^T y).
        const Eigen::VectorXd x = _lu.solution(_shift * (_F * z.head(n)) + _L * z.tail(n));
        const double mass = x.dot(_M * x);
        if (mass > 0)
            pair.value = rayleigh(x, mass, pair.value);
        const double energy = x.dot(_K * x) + pair.value * pair.value * mass;
        const double length = std::sqrt(energy > 1e-20 * _shift * _shift * mass ? energy : mass);
        const Eigen::VectorXd a = x.cwiseAbs() / length;
        // The factorisation at the shift is indefinite: its rounding grows beyond that of the
        // entries, by measurement up to some ten times.
        pair.rounding = 16 * std::numeric_limits<double>::epsilon() * a.dot(_K.cwiseAbs() * a);
        pair.vector = _scale.cwiseProduct(x) / length;
        return pair;
    }

  private:
    Eigen::VectorXd _scale;
    Sparse _K, _M, _S;
    double _s, _shift;
    Sparse _L, _F, _Lt, _Ft;
    SparseFactor<double> _lu;

    /// The root near w of x^T Q(w) x: its error is the square of that of x, so the rounding in the
    /// factors L and F, which split K and M only nearly, drops out.
    [[nodiscard]] double rayleigh(const Eigen::VectorXd &x, double mass, double w) const {
        const double linear = _s * x.dot(_S * x) / 2;
        const double root = std::sqrt(linear * linear + mass * std::max(0.0, x.dot(_K * x)));
        const double upper = (linear + root) / mass;
        const double lower = (linear - root) / mass;
        return std::abs(upper - w) < std::abs(lower - w) ? upper : lower;
    }

    [[nodiscard]] Sparse at(double w) const { return _K + (w * _s) * _S - (w * w) * _M; }
};

std::vector<RealPair> dense(const Shifted &problem) {
    const SymmetricOperator op = problem.inverse();
    const auto solver = symmetric_eigenpairs(matrix_of(op));
    // Infinite w, of unknowns without mass, come as zero up to rounding.
    const double zero = 1e-14 * solver.eigenvalues().cwiseAbs().maxCoeff();
    std::vector<RealPair> pairs;
    for (Eigen::Index i = 0; i < op.size; ++i)
        if (std::abs(solver.eigenvalues()(i)) > zero)
            pairs.push_back(
                problem.pair_from(solver.eigenvalues()(i), solver.eigenvectors().col(i)));
    return pairs;
}

} // namespace

std::vector<RealPair> solve_shifted(const Matrix &K, const Matrix &M, const Matrix &S,
                                    const ShiftedOptions &options) {
    constexpr double room = 1e-6; // relative, as in definite_pencil.cpp; the shift costs a digit
    const Shifted problem(K, M, S, options);
    const auto all = static_cast<int>(2 * problem.size());
    if (all <= 60 || 3 * options.wanted > all) {
        std::vector<RealPair> pairs = dense(problem);
        sort_by_modulus(pairs);
        return pairs;
    }
    const SymmetricOperator op = problem.inverse();
    std::vector<RealPair> pairs;
    std::vector<Eigen::VectorXd> found;
    const int wanted = std::min(options.wanted, all - 1);
    for (int attempt = 0; attempt < 8 && static_cast<int>(found.size()) < all; ++attempt) {
        const int missing = std::max(4, wanted + 4 - static_cast<int>(found.size()));
        for (const auto &[theta, z] : largest_magnitude(op, missing, found)) {
            found.push_back(z);
            pairs.push_back(problem.pair_from(theta, z));
        }
        if (keep_confirmed(pairs, wanted, room,
                           [&](double bound) { return problem.count_below(bound); }))
            return pairs;
        pairs.clear();
        for (const Eigen::VectorXd &z : found) {
            Eigen::VectorXd Tz(all);
            problem.apply(z.data(), Tz.data());
            pairs.push_back(problem.pair_from(z.dot(Tz) / z.squaredNorm(), z));
        }
    }
    throw SolverError("the iteration missed eigenvalues that the inertia count shows");
}

} // namespace whirl::linalg
