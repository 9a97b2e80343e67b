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

/// The lower triangles of K, S and M on the pattern of all three.
class Triangles {
  public:
    void take(const Sparse &K, const Sparse &S, const Sparse &M) {
        const Sparse all = Sparse(K.cwiseAbs()) + Sparse(S.cwiseAbs()) + Sparse(M.cwiseAbs());
        _Q = all.triangularView<Eigen::Lower>();
        _Q.makeCompressed();
        _K = on_pattern(K);
        _S = on_pattern(S);
        _M = on_pattern(M);
    }

    /// K + a S - b M
    const Sparse &sum(double a, double b) {
        _Q.coeffs() = _K + a * _S - b * _M;
        return _Q;
    }

    /// x^T |K| x + b x^T |M| x, no entry of x negative.
    [[nodiscard]] double absolute_form(double b, const Eigen::VectorXd &x) const {
        double twice = 0; // below the diagonal
        double once = 0;
        const int *rows = _Q.innerIndexPtr();
        for (int j = 0; j < static_cast<int>(x.size()); ++j) {
            double column = 0;
            int p = _Q.outerIndexPtr()[j];
            const auto entry = [&] { return (std::abs(_K(p)) + b * std::abs(_M(p))) * x(rows[p]); };
            const int last = _Q.outerIndexPtr()[j + 1];
            if (p < last && rows[p] == j) {
                once += entry() * x(j);
                ++p;
            }
            for (; p < last; ++p)
                column += entry();
            twice += column * x(j);
        }
        return once + 2 * twice;
    }

  private:
    Sparse _Q;
    Eigen::ArrayXd _K, _S, _M;

    [[nodiscard]] Eigen::ArrayXd on_pattern(const Sparse &A) const {
        Eigen::ArrayXd out = Eigen::ArrayXd::Zero(_Q.nonZeros());
        for (Eigen::Index j = 0; j < A.outerSize(); ++j) {
            int p = _Q.outerIndexPtr()[j];
            for (Sparse::InnerIterator entry(A, j); entry; ++entry) {
                if (entry.row() < j)
                    continue;
                while (_Q.innerIndexPtr()[p] < entry.row())
                    ++p;
                out(p) = entry.value();
            }
        }
        return out;
    }
};

} // namespace

struct DefinitePencil::Factors {
    Sparse K, M, S;
    mutable Triangles triangles;
    Sparse L, Lt, F, Ft;
    mutable Eigen::SimplicialLDLT<Sparse> inertia;
    // Small problems: the same operator in the modes at rest, L^-1 F = U sigma V^T, where it is
    // [-s A, sigma; sigma, 0] with A = U^T L^-1 S L^-T U, one small product instead of solves.
    bool modal = false;
    RepeatedEigensolver solver;
    int asked = 0;       ///< speeds asked for so far, or announced
    Eigen::MatrixXd LtU; ///< L^-T U: modes at rest
    Eigen::MatrixXd A;
    Eigen::VectorXd sigma;

    void make_modal() {
        const LeftSingular modes =
            left_singular(L.triangularView<Eigen::Lower>().solve(Eigen::MatrixXd(F)));
        sigma = modes.values;
        LtU = Lt.triangularView<Eigen::Upper>().solve(modes.vectors);
        A = LtU.transpose() * (S * LtU);
        A = ((A + A.transpose()) / 2).eval();
        modal = true;
    }

    /// y = H(s) z, z = (a, b).
    void apply(double s, const double *z, double *y) const {
        const Eigen::Index n = K.rows();
        const Eigen::Map<const Eigen::VectorXd> a(z, n);
        const Eigen::Map<const Eigen::VectorXd> b(z + n, n);
        Eigen::Map<Eigen::VectorXd> top(y, n);
        Eigen::Map<Eigen::VectorXd> bottom(y + n, n);
        if (modal) {
            top = sigma.cwiseProduct(b);
            bottom = sigma.cwiseProduct(a);
            if (s != 0)
                top.noalias() -= s * (A * a);
            return;
        }
        const Eigen::VectorXd t = Lt.triangularView<Eigen::Upper>().solve(a);
        bottom.noalias() = Ft * t;
        Eigen::VectorXd r = F * b;
        if (s != 0)
            r.noalias() -= s * (S * t);
        top = L.triangularView<Eigen::Lower>().solve(r);
    }

    /// H(s).
    [[nodiscard]] SymmetricOperator at(double s) const {
        return {static_cast<int>(2 * K.rows()),
                [this, s](const double *z, double *y) { apply(s, z, y); }, start()};
    }

    /// x from the first half of z.
    [[nodiscard]] Eigen::VectorXd shape(const Eigen::VectorXd &a) const {
        if (modal)
            return LtU * a;
        return Lt.triangularView<Eigen::Upper>().solve(a);
    }

    /// Rich in the low modes, and the same for every speed and process.
    [[nodiscard]] Eigen::VectorXd start() const {
        const Eigen::Index n = K.rows();
        Eigen::VectorXd z = deterministic_vector(static_cast<int>(2 * n));
        if (modal) {
            z.head(n).array() *= sigma.array() / sigma(0);
            z.tail(n).array() *= sigma.array() / sigma(0);
        }
        return z;
    }
};

DefinitePencil::DefinitePencil(const Matrix &K, const Matrix &M, const Matrix &S)
    : _factors(std::make_unique<Factors>()) {
    Factors &f = *_factors;
    f.K = K.view();
    f.M = with_positive_diagonal(M.view(), f.K);
    f.S = S.view();
    f.triangles.take(f.K, f.S, f.M);
    using Cholesky = Eigen::SimplicialLLT<Sparse, Eigen::Lower, Eigen::NaturalOrdering<int>>;
    const Cholesky of_K(f.K);
    const Cholesky of_M(f.M);
    if (of_K.info() != Eigen::Success || of_M.info() != Eigen::Success)
        throw SolverError("the stiffness or mass matrix is not positive definite");
    f.L = of_K.matrixL();
    f.Lt = f.L.transpose();
    f.F = of_M.matrixL();
    f.Ft = f.F.transpose();
    f.inertia.analyzePattern(f.triangles.sum(0, 0));
}

DefinitePencil::~DefinitePencil() = default;

void DefinitePencil::expect(int values) { _factors->asked += values; }

int DefinitePencil::size() const { return static_cast<int>(_factors->K.rows()); }

int DefinitePencil::count_below(double s, double bound) const {
    int count = 0;
    for (const double w : {bound, -bound}) {
        _factors->inertia.factorize(_factors->triangles.sum(w * s, w * w));
        count += negative_pivots(_factors->inertia);
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
                    f.triangles.absolute_form(pair.value * pair.value, x);
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
        const auto more = attempt == 0 ? _factors->solver.largest_magnitude(op, missing)
                                       : largest_magnitude(op, missing, found);
        for (const auto &[mu, z] : more) {
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
    // Diagonalising at rest costs as much as some ten speeds of a small problem: it waits until
    // there are that many. Results of both ways differ by rounding only.
    if (!_factors->modal && size() <= 200 && ++_factors->asked > 8)
        _factors->make_modal();
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
