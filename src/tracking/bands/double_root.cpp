#include "tracking/bands/double_root.h"

#include "linalg/sparse_factor.h"
#include "linalg/unit_scales.h"

#include <Eigen/LU>

#include <cmath>
#include <limits>
#include <vector>

namespace whirl::tracking {

namespace {

using Sparse = Eigen::SparseMatrix<double>;

/// [Q b; c^T 0], factorised; of a reduced rotor, whose matrices are full, as such.
class Bordered {
  public:
    Bordered(const Sparse &Q, const Eigen::VectorXd &b, const Eigen::VectorXd &c) : _n(Q.rows()) {
        if (3 * Q.nonZeros() > _n * _n) {
            Eigen::MatrixXd A = Eigen::MatrixXd::Zero(_n + 1, _n + 1);
            A.topLeftCorner(_n, _n) = Q;
            A.col(_n).head(_n) = b;
            A.row(_n).head(_n) = c;
            _full.emplace(A);
            _regular = true; // else what it solves is no number
            return;
        }
        std::vector<Eigen::Triplet<double>> entries;
        for (Eigen::Index column = 0; column < _n; ++column)
            for (Sparse::InnerIterator entry(Q, column); entry; ++entry)
                entries.emplace_back(entry.row(), column, entry.value());
        for (Eigen::Index i = 0; i < _n; ++i) {
            entries.emplace_back(i, _n, b(i));
            entries.emplace_back(_n, i, c(i));
        }
        Sparse A(_n + 1, _n + 1);
        A.setFromTriplets(entries.begin(), entries.end());
        _regular = _factors.factorize(A);
    }

    [[nodiscard]] bool regular() const { return _regular; }
    /// x and g for a right-hand side [f; last].
    [[nodiscard]] Eigen::VectorXd solve(const Eigen::VectorXd &f, double last) const {
        Eigen::VectorXd rhs(_n + 1);
        rhs << f, last;
        if (_full)
            return _full->solve(rhs);
        _factors.solve(rhs);
        return rhs;
    }
    /// The same of the transpose, for [0; 1].
    [[nodiscard]] Eigen::VectorXd transposed() const {
        Eigen::VectorXd rhs = Eigen::VectorXd::Unit(_n + 1, _n);
        if (_full)
            return _full->transpose().solve(rhs);
        _factors.solve_transposed(rhs);
        return rhs;
    }

  private:
    Eigen::Index _n;
    linalg::SparseFactor<double> _factors;
    std::optional<Eigen::PartialPivLU<Eigen::MatrixXd>> _full;
    bool _regular = false;
};

/// Q and its derivatives at one place, over scaled unknowns.
struct Derivatives {
    Sparse Q, l, ll, s, ls;
    Sparse sizes; ///< the moduli of what Q is a sum of
    Eigen::VectorXd scales;
};

Derivatives derivatives(const modes::QuadraticAt &p, double value, double scale) {
    const Eigen::VectorXd d = linalg::scales_at(scale, p.M.diagonal(), p.K.diagonal());
    const auto of = [&d](const Sparse &A) { return linalg::scaled(A, d); };
    return {of(value * value * p.M + value * p.D + p.K),
            of(2 * value * p.M + p.D),
            of(2 * p.M),
            of(value * p.above.D + p.above.K),
            of(p.above.D),
            of(value * value * p.M.cwiseAbs() + std::abs(value) * p.D.cwiseAbs() + p.K.cwiseAbs()),
            d};
}

/// g and dg/dl with their derivatives.
struct Fold {
    Eigen::Vector2d values = Eigen::Vector2d::Zero();   ///< g, g_l
    Eigen::Matrix2d jacobian = Eigen::Matrix2d::Zero(); ///< over l, speed
    double rounding = 0;                                ///< of g, by that of the entries of Q
};

class FoldSearch {
  public:
    FoldSearch(const std::function<modes::QuadraticAt(double)> &problem_at,
               const Eigen::VectorXd &shape)
        : _problem_at(problem_at), _b(shape.normalized()), _c(_b) {}

    /// Borders are the vectors found last: next to the root the best there are.
    std::optional<Fold> at(double speed, double value, double scale) {
        const Derivatives Q = derivatives(_problem_at(speed), value, scale);
        Bordered system(Q.Q, _b, _c);
        if (!system.regular())
            return std::nullopt;
        const Eigen::Index n = Q.Q.rows();
        const Eigen::VectorXd zero = Eigen::VectorXd::Zero(n);
        const Eigen::VectorXd x = system.solve(zero, 1);
        const Eigen::VectorXd w = system.transposed().head(n);
        const auto v = x.head(n);
        const Eigen::VectorXd Ql = Q.l * v;
        const Eigen::VectorXd Qs = Q.s * v;
        const Eigen::VectorXd x_l = system.solve(-Ql, 0).head(n);
        const Eigen::VectorXd x_s = system.solve(-Qs, 0).head(n);
        Fold out;
        const double g_l = -w.dot(Ql);
        out.values << x(n), g_l;
        out.jacobian << g_l, -w.dot(Qs), -w.dot(Q.ll * v + 2.0 * (Q.l * x_l)),
            -w.dot(Q.ls * v + Q.l * x_s + Q.s * x_l);
        out.rounding =
            std::numeric_limits<double>::epsilon() * w.cwiseAbs().dot(Q.sizes * v.cwiseAbs());
        if (!out.values.allFinite() || !out.jacobian.allFinite() || !(w.norm() > 0))
            return std::nullopt;
        _c = v.normalized();
        _b = w.normalized();
        _shape = Q.scales.asDiagonal() * _c;
        return out;
    }

    [[nodiscard]] const Eigen::VectorXd &shape() const { return _shape; }

  private:
    const std::function<modes::QuadraticAt(double)> &_problem_at;
    Eigen::VectorXd _b, _c, _shape;
};

} // namespace

std::optional<DoubleRoot> double_root(const std::function<modes::QuadraticAt(double)> &problem_at,
                                      double speed, double value, const Eigen::VectorXd &shape,
                                      double reach) {
    // A guard: Newton's method is quadratic, steps limited to `reach` at first.
    constexpr int most = 30;
    constexpr double converged = 3e-13; // of the speed: some thousand units of rounding
    constexpr double hidden = 1e-5;     // of the speed: noise that leaves five digits
    const double scale = std::abs(speed);
    FoldSearch search(problem_at, shape);
    double s = speed;
    double l = value;
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
        l += step(0);
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
            return DoubleRoot{s, l, noise, J(0, 1) * J(1, 0) < 0, search.shape()};
        last = moved;
        last_turned = turned;
    }
    return std::nullopt;
}

} // namespace whirl::tracking
