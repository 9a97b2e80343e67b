#include "ends/coupling.h"

#include <algorithm>
#include <cmath>

namespace whirl::ends {

namespace {

using Scalar = std::complex<double>;

/// A^T x: x^H A, conjugated.
Eigen::VectorXcd transposed_times(const Eigen::MatrixXd &A, const Eigen::VectorXcd &x) {
    Eigen::VectorXcd out(A.cols());
    out.real() = A.transpose() * Eigen::VectorXd(x.real());
    out.imag() = A.transpose() * Eigen::VectorXd(x.imag());
    return out;
}

/// (K + l D) x.
Eigen::VectorXcd times(const Eigen::MatrixXd &K, const Eigen::VectorXcd &x, Scalar l,
                       const Eigen::MatrixXd &D) {
    const Eigen::VectorXd real = x.real();
    const Eigen::VectorXd imag = x.imag();
    Eigen::VectorXcd by_D(D.rows());
    by_D.real() = D * real;
    by_D.imag() = D * imag;
    Eigen::VectorXcd out = l * by_D;
    out.real() += K * real;
    out.imag() += K * imag;
    return out;
}

/// Coupling of the motions of a spectrum per unit of speed: w_a^H A' v_b, with A the matrix of the
/// equations of first order and w_a^H v_a = 1.
class Couplings {
  public:
    /// @param K_rate  of either end of a step, inside of which it is linear
    Couplings(const Spectrum &at, const Eigen::MatrixXd &K_rate) : _at(at), _K_rate(K_rate) {}

    /// An upper bound of the coupling by a change of speed, to second order.
    [[nodiscard]] double most(const Root &a, const Root &b, double change) const {
        const Eigen::VectorXcd from_K = transposed_times(_K_rate, a.left);
        const Eigen::VectorXcd from_D = transposed_times(_at.problem.D_rate, a.left);
        const Eigen::VectorXcd to_b = times(_K_rate, b.right, b.value, _at.problem.D_rate);
        Scalar by_others = 0;
        for (const Root &c : _at.roots)
            if (&c != &a && &c != &b)
                by_others += (from_K.dot(c.right) + c.value * from_D.dot(c.right)) / a.slope *
                             c.left.dot(to_b) / c.slope / (b.value - c.value);
        return std::abs(change) * std::abs(a.left.dot(to_b) / a.slope) +
               change * change * std::abs(by_others);
    }

  private:
    const Spectrum &_at;
    const Eigen::MatrixXd &_K_rate;
};

} // namespace

bool weakly_coupled(const Branch &a, const Branch &b, double t, const Spectrum &from,
                    const Spectrum &to) {
    // At 1 growth is possible to first order; a twentieth leaves room for higher orders.
    constexpr double far_below = 0.05;
    const double allowed = far_below * std::abs(a.at(t).real() * b.at(t).real());
    for (const Eigen::MatrixXd *K_rate : {&from.problem.K_rate, &to.problem.K_rate}) {
        const Couplings before(from, *K_rate);
        const Couplings after(to, *K_rate);
        const double passed = t * a.step;
        const double left = (1 - t) * a.step;
        if (!(before.most(*a.from, *b.from, passed) * before.most(*b.from, *a.from, passed) <=
              allowed) ||
            !(after.most(*a.to, *b.to, left) * after.most(*b.to, *a.to, left) <= allowed))
            return false;
    }
    return true;
}

} // namespace whirl::ends
