#include "linalg/definite_pencil.h"

#include "linalg/check.h"
#include "linalg/symmetric_eigen.h"

#include <Eigen/Dense>
#include <Eigen/SparseCholesky>

#include <algorithm>
#include <cmath>
#include <limits>

namespace whirl::linalg {

namespace {

using Sparse = Eigen::SparseMatrix<double>;

/// M may have empty rows (a support without mass); they get a mass that is below rounding in every
/// mode: against the stiffness of the row, as the slowest unknown's.
Sparse with_positive_diagonal(Sparse M, const Sparse &K) {
    const Eigen::VectorXd stiffness = K.diagonal();
    const double slowest = M.diagonal().cwiseQuotient(stiffness).maxCoeff();
    for (Eigen::Index i = 0; i < M.rows(); ++i)
        if (M.coeff(i, i) == 0)
            M.coeffRef(i, i) = 1e-15 * slowest * stiffness(i);
    return M;
}

} // namespace

struct DefinitePencil::Factors {
    Sparse K, M, S;
    Sparse absK, absM;
    Sparse L, Lt, F, Ft;
    mutable Eigen::SimplicialLDLT<Sparse> inertia;

    /// y = H(s) z, z = (a, b).
    void apply(double s, const double *z, double *y) const {
        const Eigen::Index n = K.rows();
        const Eigen::Map<const Eigen::VectorXd> a(z, n);
        const Eigen::Map<const Eigen::VectorXd> b(z + n, n);
        Eigen::Map<Eigen::VectorXd> top(y, n);
        Eigen::Map<Eigen::VectorXd> bottom(y + n, n);
        const Eigen::VectorXd t = shape(a);
        bottom.noalias() = Ft * t;
        Eigen::VectorXd r = F * b;
        if (s != 0)
            r.noalias() -= s * (S * t);
        top = L.triangularView<Eigen::Lower>().solve(r);
    }

    /// H(s).
    [[nodiscard]] SymmetricOperator at(double s) const {
        const auto both = static_cast<int>(2 * K.rows());
        return {both, [this, s](const double *z, double *y) { apply(s, z, y); },
                deterministic_vector(both)};
    }

    /// x from the first half of z.
    [[nodiscard]] Eigen::VectorXd shape(const Eigen::VectorXd &a) const {
        return Lt.triangularView<Eigen::Upper>().solve(a);
    }
};

DefinitePencil::DefinitePencil(const Matrix &K, const Matrix &M, const Matrix &S)
    : _factors(std::make_unique<Factors>()) {
    Factors &f = *_factors;
    f.K = K.view();
    f.M = with_positive_diagonal(M.view(), f.K);
    f.S = S.view();
    f.absK = f.K.cwiseAbs();
    f.absM = f.M.cwiseAbs();
    using Cholesky = Eigen::SimplicialLLT<Sparse, Eigen::Lower, Eigen::NaturalOrdering<int>>;
    const Cholesky of_K(f.K);
    const Cholesky of_M(f.M);
    if (of_K.info() != Eigen::Success || of_M.info() != Eigen::Success)
        throw SolverError("the stiffness or mass matrix is not positive definite");
    f.L = of_K.matrixL();
    f.Lt = f.L.transpose();
    f.F = of_M.matrixL();
    f.Ft = f.F.transpose();
    f.inertia.analyzePattern(f.absK + Sparse(f.S.cwiseAbs()) + f.absM);
}

DefinitePencil::~DefinitePencil() = default;

int DefinitePencil::size() const { return static_cast<int>(_factors->K.rows()); }

int DefinitePencil::count_below(double s, double bound) const {
    const Factors &f = *_factors;
    int count = 0;
    for (const double w : {bound, -bound}) {
        f.inertia.factorize(Sparse(f.K + (w * s) * f.S - (w * w) * f.M));
        count += negative_pivots(f.inertia);
    }
    return count;
}

RealPair DefinitePencil::pair_from(double s, double mu, const Eigen::VectorXd &z) const {
    const Factors &f = *_factors;
    const Eigen::Index n = f.K.rows();
    Eigen::VectorXd Hz(2 * n);
    f.apply(s, z.data(), Hz.data());
    RealPair pair;
    pair.value = 1 / mu;
    // H is symmetric: some eigenvalue lies within |H z - mu z| of mu for a unit vector z.
    pair.residual = (Hz - mu * z).norm() / (z.norm() * std::abs(mu));
    // (a, b) = (L^T x, w F^T x) up to a factor; the norm of (a, b) fixes x^T K x + w^2 x^T M x = 1.
    pair.vector = f.shape(z.head(n)) / z.norm();
    const Eigen::VectorXd x = pair.vector.cwiseAbs();
    // d(w)/w = x^T dQ x / (w x^T Q' x), and w x^T Q' x = -1 in this norm.
    pair.rounding = std::numeric_limits<double>::epsilon() *
                    (x.dot(f.absK * x) + pair.value * pair.value * x.dot(f.absM * x));
    return pair;
}

std::vector<RealPair> DefinitePencil::dense(double s) const {
    const Factors &f = *_factors;
    const auto solver = symmetric_eigenpairs(matrix_of(f.at(s)));
    std::vector<RealPair> pairs;
    for (Eigen::Index i = 0; i < 2 * size(); ++i)
        pairs.push_back(pair_from(s, solver.eigenvalues()(i), solver.eigenvectors().col(i)));
    return pairs;
}

std::vector<RealPair> DefinitePencil::iterate(double s, int wanted) const {
    const Factors &f = *_factors;
    const SymmetricOperator op = f.at(s);
    std::vector<RealPair> pairs;
    std::vector<Eigen::VectorXd> found;
    // Eigenvalues that coincide can hide behind each other: the found ones are deflated and the
    // rest is asked for again until the count agrees.
    for (int attempt = 0; attempt < 4; ++attempt) {
        const int missing = std::max(2, wanted + 2 - static_cast<int>(found.size()));
        for (const auto &[mu, z] : largest_magnitude(op, missing, found)) {
            found.push_back(z);
            pairs.push_back(pair_from(s, mu, z));
        }
        if (confirmed(s, pairs, wanted))
            return pairs;
    }
    throw SolverError("the iteration missed eigenvalues that the inertia count shows");
}

bool DefinitePencil::confirmed(double s, std::vector<RealPair> &pairs, int wanted) const {
    // Relative: bounds of the inertia count lie this far from all pairs found, above their
    // errors.
    constexpr double room = 1e-7;
    return keep_confirmed(pairs, wanted, room, [&](double bound) { return count_below(s, bound); });
}

std::vector<RealPair> DefinitePencil::smallest(double s, int wanted) const {
    const int all = 2 * size();
    // Where a large part of the spectrum is wanted, or the matrix is small, dense is faster and
    // finds everything.
    if (all <= 40 || 3 * (wanted + 2) > all) {
        std::vector<RealPair> pairs = dense(s);
        if (wanted + 1 >= all || !confirmed(s, pairs, wanted))
            sort_by_modulus(pairs);
        return pairs;
    }
    return iterate(s, wanted);
}

} // namespace whirl::linalg
