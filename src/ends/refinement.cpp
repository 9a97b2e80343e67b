#include "ends/refinement.h"

#include "linalg/sparse_factor.h"
#include "linalg/sparse_sum.h"
#include "linalg/unit_scales.h"
#include "modes/roots/double_root.h"

#include <cmath>
#include <limits>

namespace whirl::ends {

namespace {

using Complex = std::complex<double>;
using Sparse = Eigen::SparseMatrix<double>;
using ComplexSparse = Eigen::SparseMatrix<Complex>;

/// Relative change of speed and frequency: some hundred units of rounding.
constexpr double converged = 1e-13;

/// Converged: the step is within tolerance, or rounding no longer shrinks it, or the next one will
/// be, as errors are squared.
class Settled {
  public:
    /// @param change    of this step, relative
    /// @param rounding  () -> how much rounding can change, relative
    template <class Rounding> bool operator()(double change, const Rounding &rounding) {
        constexpr double small = 1e-5; // where errors are squared
        const bool squared = change <= small && _before <= 1 &&
                             change / _before * (change / _before) * change <= 0.01 * converged;
        const bool shrinks = change < 0.3 * _before;
        const bool out = change <= converged || squared ||
                         (!shrinks && (change <= 1e-9 || change <= rounding()));
        _before = change;
        return out;
    }

  private:
    double _before = HUGE_VAL;
};

Eigen::VectorXcd times(const Sparse &A, const Eigen::VectorXcd &x) {
    Eigen::VectorXcd out(x.size());
    out.real() = A * x.real();
    out.imag() = A * x.imag();
    return out;
}

Complex product(const Eigen::VectorXcd &y, const Sparse &A, const Eigen::VectorXcd &x) {
    return y.dot(times(A, x));
}

/// |y|^T |A| |x|.
double size(const Eigen::VectorXcd &y, const Sparse &A, const Eigen::VectorXcd &x) {
    return y.cwiseAbs().dot(A.cwiseAbs() * x.cwiseAbs());
}

/// Units of rounding of all entries' moduli together: chosen large, as ends are errors' bounds.
constexpr double rounding_unit = 30 * std::numeric_limits<double>::epsilon();

/// What the rounding of the matrix entries makes of y^H Q(l) x.
double rounding_of(const modes::QuadraticAt &p, const WholeMotion &m) {
    const double l = std::abs(m.value);
    return rounding_unit * (l * l * size(m.left, p.M, m.right) + l * size(m.left, p.D, m.right) +
                            size(m.left, p.K, m.right));
}

/// Error of the eigenvalue by it.
double noise_of(const modes::QuadraticAt &p, const WholeMotion &m, Complex by_root) {
    return rounding_of(p, m) / std::abs(by_root) + rounding_unit * std::abs(m.value);
}

/// y^H Q(l) x and its derivatives.
struct Forms {
    Complex value, by_root, by_speed;
};

Forms forms(const modes::QuadraticAt &p, Complex l, const WholeMotion &m) {
    const Complex mass = product(m.left, p.M, m.right);
    const Complex damping = product(m.left, p.D, m.right);
    return {l * l * mass + l * damping + product(m.left, p.K, m.right), 2.0 * l * mass + damping,
            l * product(m.left, p.above.D, m.right) + product(m.left, p.above.K, m.right)};
}

using Factors = linalg::SparseFactor<Complex>;

/// Better vectors of the root next to l: Q(l)^-1 Q'(l) x, and the same from the left.
/// @param at_zero  l is zero and the speed is the eigenvalue: Q' by the speed. By l it would be
///                  skew without damping, y^H Q' x = 0, and lead away from the vectors wanted.
/// @returns whether Q(l) could be factorised
bool iterate(const modes::QuadraticAt &p, Complex l, bool at_zero, WholeMotion &m, Factors &lu) {
    const Eigen::VectorXd d =
        linalg::scales_at(std::max(std::abs(l), 1e-300), p.M.diagonal(), p.K.diagonal());
    const ComplexSparse whole = linalg::sum(l * l, p.M, l, p.D, 1, p.K);
    ComplexSparse Q = d.asDiagonal() * whole * d.asDiagonal();
    Q.makeCompressed();
    if (!lu.factorize(Q))
        return false;
    const Sparse &slope = at_zero ? p.above.K : p.D; // beside 2 l M
    const Eigen::VectorXcd to_right = 2.0 * l * times(p.M, m.right) + times(slope, m.right);
    const Eigen::VectorXcd to_left =
        2.0 * std::conj(l) * times(p.M.transpose(), m.left) + times(slope.transpose(), m.left);
    const Eigen::VectorXcd x = lu.solution(d.asDiagonal() * to_right);
    const Eigen::VectorXcd y = lu.adjoint_solution(d.asDiagonal() * to_left);
    if (!x.allFinite() || !y.allFinite())
        return false;
    m.right = d.asDiagonal() * x.normalized();
    m.left = d.asDiagonal() * y.normalized();
    return true;
}

} // namespace

/// Newton's method, with better vectors at each step.
std::optional<EndOfGrowth> on_the_axis(const modes::FormMatrices &whole, const WholeMotion &guess,
                                       bool at_zero) {
    constexpr int most_steps = 25; // a guard: quadratic, linear at double roots
    EndOfGrowth m{guess};
    m.kind = at_zero ? results::EndKind::zero : results::EndKind::pair;
    m.value = {0, at_zero ? 0 : guess.value.imag()};
    const double scale = std::max(std::abs(guess.speed), std::abs(m.value));
    Settled settled;
    Factors factors;
    for (int step = 0; step < most_steps; ++step) {
        const modes::QuadraticAt problem = whole.at(m.speed);
        // At an eigenvalue itself the factorisation can fail: a little beside it does as well.
        if (!iterate(problem, m.value, at_zero, m, factors) &&
            !iterate(problem, m.value + 1e-10 * scale, at_zero, m, factors))
            return std::nullopt;
        const Forms f = forms(problem, m.value, m);
        const Complex of_w = Complex(0, 1) * f.by_root;
        double change = 0;
        double change_w = 0;
        if (at_zero) {
            change = -(f.value / f.by_speed).real();
        } else { // value + of_w dw + by_speed dspeed = 0
            const double determinant = (std::conj(of_w) * f.by_speed).imag();
            change = -(std::conj(of_w) * f.value).imag() / determinant;
            change_w = (std::conj(f.by_speed) * f.value).imag() / determinant;
        }
        m.speed += change;
        m.value = {0, m.value.imag() + change_w};
        const double relative =
            std::max(std::abs(change / m.speed), std::abs(change_w) / (100 * scale));
        if (!(std::abs(m.speed - guess.speed) <= 0.5 * std::abs(guess.speed)) ||
            !std::isfinite(relative))
            return std::nullopt;
        m.rate = -f.by_speed / f.by_root;
        // Of a root that is zero without damping the rate is infinite: its square has one.
        const auto blur = [&] {
            return at_zero ? rounding_of(problem, m) / std::abs(f.by_speed)
                           : noise_of(problem, m, f.by_root) / std::abs(m.rate.real());
        };
        const auto rounding = [&] { return blur() / std::abs(m.speed); };
        if (settled(relative, rounding)) {
            m.noise = noise_of(problem, m, f.by_root);
            m.inward = m.rate.real() > 0 ? 1 : -1;
            m.blur = blur();
            return m;
        }
    }
    return std::nullopt;
}

std::optional<EndOfGrowth> collision(const modes::FormMatrices &whole, const WholeMotion &guess,
                                     double reach) {
    const auto found =
        modes::double_root<Complex>([&whole](double speed) { return whole.at(speed); }, guess.speed,
                                    Complex(0, guess.value.imag()), guess.right, reach);
    if (!found)
        return std::nullopt;
    EndOfGrowth out;
    out.speed = found->speed;
    out.value = found->value;
    out.right = out.left = found->shape; // Q is Hermitian
    out.kind = results::EndKind::collision;
    out.inward = found->opens ? -1 : 1;
    out.blur = found->noise;
    return out;
}

std::optional<WholeMotion> at_its_speed(const modes::QuadraticAt &whole, const WholeMotion &guess,
                                        modes::WholePencil<double> &pencil) {
    pencil.set(whole, std::max(std::abs(guess.value), 1e-300));
    auto found = pencil.refined({guess.value, guess.right, guess.left});
    if (!found)
        return std::nullopt;
    WholeMotion out{
        guess.speed, found->value, std::move(found->right), std::move(found->left), 0, 0};
    if (guess.value.imag() == 0) // of a real root both vectors are real but for rounding
        out.value = out.value.real();
    const Forms f = forms(whole, out.value, out);
    out.rate = -f.by_speed / f.by_root;
    out.noise = noise_of(whole, out, f.by_root);
    return out;
}

} // namespace whirl::ends
