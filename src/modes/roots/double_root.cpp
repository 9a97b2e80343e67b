#include "modes/roots/double_root.h"

#include "linalg/sparse_factor.h"
#include "linalg/unit_scales.h"

#include <Eigen/LU>

#include <cmath>
#include <limits>
#include <type_traits>
#include <vector>

namespace whirl::modes {

namespace {

using Complex = std::complex<double>;
template <class Scalar> using SparseOf = Eigen::SparseMatrix<Scalar>;
template <class Scalar> using VectorOf = Eigen::Matrix<Scalar, Eigen::Dynamic, 1>;
template <class Scalar> using MatrixOf = Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic>;

/// [Q b; c^H 0], factorised; of a reduced rotor, whose matrices are full, as such.
template <class Scalar> class Bordered {
  public:
    using Sparse = SparseOf<Scalar>;
    using Vector = VectorOf<Scalar>;

    Bordered(const Sparse &Q, const Vector &b, const Vector &c) : _n(Q.rows()) {
        if (3 * Q.nonZeros() > _n * _n) {
            MatrixOf<Scalar> A = MatrixOf<Scalar>::Zero(_n + 1, _n + 1);
            A.topLeftCorner(_n, _n) = Q;
            A.col(_n).head(_n) = b;
            A.row(_n).head(_n) = c.adjoint();
            _full.emplace(A);
            _regular = true; // else what it solves is no number
            return;
        }
        std::vector<Eigen::Triplet<Scalar>> entries;
        for (Eigen::Index column = 0; column < _n; ++column)
            for (typename Sparse::InnerIterator entry(Q, column); entry; ++entry)
                entries.emplace_back(entry.row(), column, entry.value());
        for (Eigen::Index i = 0; i < _n; ++i) {
            entries.emplace_back(i, _n, b(i));
            entries.emplace_back(_n, i, Eigen::numext::conj(c(i)));
        }
        Sparse A(_n + 1, _n + 1);
        A.setFromTriplets(entries.begin(), entries.end());
        _regular = _factors.factorize(A);
    }

    [[nodiscard]] bool regular() const { return _regular; }
    /// x and g for a right-hand side [f; last].
    [[nodiscard]] Vector solve(const Vector &f, Scalar last) const {
        Vector rhs(_n + 1);
        rhs << f, last;
        if (_full)
            return _full->solve(rhs);
        return _factors.solution(std::move(rhs));
    }
    /// The same of the adjoint, for [0; 1].
    [[nodiscard]] Vector adjoint() const {
        const Vector rhs = Vector::Unit(_n + 1, _n);
        if (_full)
            return _full->adjoint().solve(rhs);
        return _factors.adjoint_solution(rhs);
    }

  private:
    Eigen::Index _n;
    linalg::SparseFactor<Scalar> _factors;
    std::optional<Eigen::PartialPivLU<MatrixOf<Scalar>>> _full;
    bool _regular = false;
};

/// The direction of the line that l is on.
template <class Scalar> Scalar along_line() {
    if constexpr (std::is_same_v<Scalar, double>)
        return 1;
    else
        return {0, 1};
}

/// Q and its derivatives at one place, l by the way along its line, over scaled unknowns.
template <class Scalar> struct Derivatives {
    SparseOf<Scalar> Q, l, ll, s, ls;
    SparseOf<double> sizes; ///< the moduli of what Q is a sum of
    Eigen::VectorXd scales;
};

template <class Scalar>
Derivatives<Scalar> derivatives(const QuadraticAt &p, Scalar value, double scale) {
    const Eigen::VectorXd d = linalg::scales_at(scale, p.M.diagonal(), p.K.diagonal());
    const auto sum = [&d](Scalar m, const SparseOf<double> &M, Scalar c, const SparseOf<double> &C,
                          Scalar k, const SparseOf<double> &K) {
        const SparseOf<Scalar> all =
            m * M.cast<Scalar>() + c * C.cast<Scalar>() + k * K.cast<Scalar>();
        return SparseOf<Scalar>(d.asDiagonal() * all * d.asDiagonal());
    };
    const Scalar u = along_line<Scalar>();
    const double size = std::abs(value);
    return {
        sum(value * value, p.M, value, p.D, 1, p.K),
        sum(2.0 * value * u, p.M, u, p.D, 0, p.K),
        sum(2.0 * u * u, p.M, 0, p.D, 0, p.K),
        sum(0, p.M, value, p.above.D, 1, p.above.K),
        sum(0, p.M, u, p.above.D, 0, p.above.K),
        linalg::scaled(size * size * p.M.cwiseAbs() + size * p.D.cwiseAbs() + p.K.cwiseAbs(), d),
        d};
}

/// g and dg/dl with their derivatives.
struct Fold {
    Eigen::Vector2d values = Eigen::Vector2d::Zero();   ///< g, g_l
    Eigen::Matrix2d jacobian = Eigen::Matrix2d::Zero(); ///< over the way of l, speed
    double rounding = 0;                                ///< of g, by that of the entries of Q
};

template <class Scalar> class FoldSearch {
  public:
    using Vector = VectorOf<Scalar>;

    FoldSearch(const std::function<QuadraticAt(double)> &problem_at, const Vector &shape)
        : _problem_at(problem_at), _b(shape.normalized()), _c(_b) {}

    /// Borders are the vectors found last: next to the root the best there are.
    std::optional<Fold> at(double speed, Scalar value, double scale) {
        const Derivatives<Scalar> Q = derivatives(_problem_at(speed), value, scale);
        const Bordered<Scalar> system(Q.Q, _b, _c);
        if (!system.regular())
            return std::nullopt;
        const Eigen::Index n = Q.Q.rows();
        const Vector x = system.solve(Vector::Zero(n), 1);
        const Vector w = system.adjoint().head(n);
        const auto v = x.head(n);
        const Vector Ql = Q.l * v;
        const Vector Qs = Q.s * v;
        const Vector x_l = system.solve(-Ql, 0).head(n);
        const Vector x_s = system.solve(-Qs, 0).head(n);
        Fold out;
        const auto product = [&w](const Vector &forces) { // of a Hermitian Q real but for rounding
            return -Eigen::numext::real(w.dot(forces));
        };
        const double g_l = product(Ql);
        out.values << Eigen::numext::real(x(n)), g_l;
        out.jacobian << g_l, product(Qs), product(Q.ll * v + 2.0 * (Q.l * x_l)),
            product(Q.ls * v + Q.l * x_s + Q.s * x_l);
        out.rounding =
            std::numeric_limits<double>::epsilon() * w.cwiseAbs().dot(Q.sizes * v.cwiseAbs());
        if (!out.values.allFinite() || !out.jacobian.allFinite() || !(w.norm() > 0))
            return std::nullopt;
        _c = v.normalized();
        _b = w.normalized();
        _shape = Q.scales.asDiagonal() * _c;
        return out;
    }

    [[nodiscard]] const Vector &shape() const { return _shape; }

  private:
    const std::function<QuadraticAt(double)> &_problem_at;
    Vector _b, _c, _shape;
};

} // namespace

template <class Scalar>
std::optional<DoubleRoot<Scalar>> double_root(const std::function<QuadraticAt(double)> &problem_at,
                                              double speed, Scalar value,
                                              const VectorOf<Scalar> &shape, double reach) {
    // A guard: Newton's method is quadratic, steps limited to `reach` at first.
    constexpr int most = 30;
    constexpr double converged = 3e-13; // of the speed: some thousand units of rounding
    constexpr double hidden = 1e-5;     // of the speed: noise that leaves five digits
    const double scale = std::abs(speed);
    FoldSearch<Scalar> search(problem_at, shape);
    double s = speed;
    Scalar l = value;
    double last = std::numeric_limits<double>::infinity();
    double last_turned = last;
    for (int k = 0; k < most; ++k) {
        const std::optional<Fold> fold = search.at(s, l, scale);
        if (!fold)
            return std::nullopt;
        Eigen::Vector2d step = -fold->jacobian.fullPivLu().solve(fold->values);
        if (!step.allFinite())
            return std::nullopt;
        step *= std::min(1.0, reach / std::max(std::abs(step(1)), 1e-300));
        l += along_line<Scalar>() * step(0);
        s += step(1);
        if (std::abs(s - speed) > 2 * reach || s * speed <= 0)
            return std::nullopt;
        const double moved = std::abs(step(1));
        const double turned = std::abs(step(0));
        // g = g_s ds + g_ll dl^2 / 2, g_l = g_ll dl + g_ls ds: of g alone, at the double root.
        const Eigen::Matrix2d &J = fold->jacobian;
        const double noise = fold->rounding / std::abs(J(0, 1));
        // At the rounding of the root itself steps no longer shrink. Where motions hardly feel each
        // other the value settles after the speed.
        const bool there =
            moved <= converged * scale ||
            (moved < std::max(1e-10 * scale, std::min(noise, hidden * scale)) && moved >= last / 4);
        if (there && (turned <= 1e-12 * scale || turned >= last_turned / 4))
            return DoubleRoot<Scalar>{s, l, noise, J(0, 1) * J(1, 0) < 0, search.shape()};
        last = moved;
        last_turned = turned;
    }
    return std::nullopt;
}

template std::optional<DoubleRoot<double>> double_root(const std::function<QuadraticAt(double)> &,
                                                       double, double, const Eigen::VectorXd &,
                                                       double);
template std::optional<DoubleRoot<Complex>> double_root(const std::function<QuadraticAt(double)> &,
                                                        double, Complex, const Eigen::VectorXcd &,
                                                        double);

} // namespace whirl::modes
