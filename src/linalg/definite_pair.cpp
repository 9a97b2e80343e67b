#include "linalg/definite_pair.h"

#include "linalg/symmetric_eigen.h"

#include <Eigen/Dense>
#include <Eigen/SparseCholesky>

#include <algorithm>
#include <cmath>
#include <limits>

namespace whirl::linalg {

struct DefinitePair::Factors {
    using Sparse = Eigen::SparseMatrix<double>;
    Sparse K, A, absK, absA, L, Lt;
    mutable Eigen::SimplicialLDLT<Sparse> inertia;

    [[nodiscard]] Eigen::VectorXd apply(const Eigen::VectorXd &z) const {
        const Eigen::VectorXd t = Lt.triangularView<Eigen::Upper>().solve(z);
        return L.triangularView<Eigen::Lower>().solve(Eigen::VectorXd(A * t));
    }

    [[nodiscard]] RealPair pair_from(double mu, const Eigen::VectorXd &z) const {
        RealPair pair;
        pair.value = 1 / std::sqrt(mu);
        // dw/w = 1/2 dmu/mu
        pair.residual = (apply(z) - mu * z).norm() / (2 * z.norm() * mu);
        pair.vector = Lt.triangularView<Eigen::Upper>().solve(z) / z.norm();
        const Eigen::VectorXd x = pair.vector.cwiseAbs();
        pair.rounding = std::numeric_limits<double>::epsilon() / 2 *
                        (x.dot(absK * x) + pair.value * pair.value * x.dot(absA * x));
        return pair;
    }

    /// The matrix with the eigenvalues 1/w^2.
    [[nodiscard]] SymmetricOperator inverse() const {
        const auto n = static_cast<int>(K.rows());
        return {n,
                [this, n](const double *z, double *y) {
                    Eigen::Map<Eigen::VectorXd>(y, n) =
                        apply(Eigen::Map<const Eigen::VectorXd>(z, n));
                },
                deterministic_vector(n)};
    }

    /// Positive eigenvalues by the dense solver.
    [[nodiscard]] std::vector<RealPair> dense() const {
        const auto solver = symmetric_eigenpairs(matrix_of(inverse()));
        // A singular A has eigenvalues zero (speeds at infinity) only up to rounding.
        const double zero = 1e-13 * solver.eigenvalues().cwiseAbs().maxCoeff();
        std::vector<RealPair> pairs;
        for (Eigen::Index i = K.rows() - 1; i >= 0 && solver.eigenvalues()(i) > zero; --i)
            pairs.push_back(pair_from(solver.eigenvalues()(i), solver.eigenvectors().col(i)));
        return pairs;
    }
};

DefinitePair::DefinitePair(const Matrix &K, const Matrix &A)
    : _factors(std::make_unique<Factors>()) {
    Factors &f = *_factors;
    f.K = K.view();
    f.A = A.view();
    f.absK = f.K.cwiseAbs();
    f.absA = f.A.cwiseAbs();
    const Eigen::SimplicialLLT<Factors::Sparse, Eigen::Lower, Eigen::NaturalOrdering<int>> cholesky(
        f.K);
    if (cholesky.info() != Eigen::Success)
        throw SolverError("the stiffness matrix is not positive definite");
    f.L = cholesky.matrixL();
    f.Lt = f.L.transpose();
    f.inertia.analyzePattern(f.absK + f.absA);
}

DefinitePair::~DefinitePair() = default;

int DefinitePair::count_below(double bound) const {
    const Factors::Sparse Q = _factors->K - (bound * bound) * _factors->A;
    _factors->inertia.factorize(Q);
    return negative_pivots(_factors->inertia);
}

bool DefinitePair::confirmed(const std::vector<RealPair> &pairs, std::size_t count) const {
    const double last = pairs[count - 1].value;
    const double above = count < pairs.size() ? pairs[count].value : 1.01 * last;
    if (above - last < 1e-8 * last)
        return true; // two in one: no room for a shift between them
    // Beside very stiff springs a pivot can be rounding at one shift; it is not at all three.
    for (const double part : {0.5, 0.25, 0.75})
        if (count_below(last + part * (above - last)) == static_cast<int>(count))
            return true;
    return false;
}

std::vector<RealPair> DefinitePair::smallest(int wanted) const {
    const Factors &f = *_factors;
    const auto n = static_cast<int>(f.K.rows());
    std::vector<RealPair> pairs;
    const auto lowest = [&pairs, wanted] {
        std::sort(pairs.begin(), pairs.end(),
                  [](const RealPair &a, const RealPair &b) { return a.value < b.value; });
        return std::min(pairs.size(), static_cast<std::size_t>(wanted));
    };
    bool failed = false;
    constexpr int few_unknowns = 150; // the dense solver is the faster one
    if (n <= few_unknowns || 3 * wanted > n) {
        pairs = f.dense();
    } else {
        try {
            pairs = iterated(wanted);
        } catch (const SolverError &) {
            failed = true;
        }
    }
    std::size_t keep = lowest();
    if (failed || (keep > 0 && !confirmed(pairs, keep))) {
        // With supports (or shear) many orders stiffer than an element bends the count is
        // rounding, and so is what the iteration waits for. The dense solver has all eigenvalues:
        // none can be missing. Of few unknowns it was them that were counted: the caller's pencil
        // about another shift finds the near ones.
        constexpr int largest_dense = 1200; // some seconds
        // Relative to the eigenvalue: six digits are what a critical speed is wanted to.
        constexpr double resolved = 1e-6;
        if (n > largest_dense || n <= few_unknowns)
            throw SolverError("critical speeds are missing against the inertia count");
        pairs = f.dense();
        keep = lowest();
        for (std::size_t i = 0; i < keep; ++i)
            if (!(pairs[i].residual + pairs[i].rounding < resolved))
                throw Unresolved("rounding of supports or shear that are many orders stiffer than "
                                 "the shaft leaves fewer than six digits of the critical speeds: "
                                 "give the stiffness of the real supports");
    }
    pairs.resize(keep);
    return pairs;
}

std::vector<RealPair> DefinitePair::iterated(int wanted) const {
    const Factors &f = *_factors;
    const SymmetricOperator op = f.inverse();
    std::vector<RealPair> pairs;
    std::vector<Eigen::VectorXd> found;
    for (int attempt = 0; attempt < 4; ++attempt) {
        for (const auto &[mu, z] : largest_positive(op, wanted + 2, found)) {
            found.push_back(z);
            if (mu > 0)
                pairs.push_back(f.pair_from(mu, z));
        }
        const double last = pairs.empty() ? 0 : pairs.back().value;
        if (!pairs.empty() && count_below(last * (1 - 1e-7)) <= static_cast<int>(pairs.size()))
            break;
    }
    return pairs;
}

} // namespace whirl::linalg
