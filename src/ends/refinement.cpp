#include "ends/refinement.h"

#include "modes/roots/double_root.h"

#include <cmath>
#include <limits>

namespace whirl::ends {

namespace {

using Complex = std::complex<double>;
using Sparse = Eigen::SparseMatrix<double>;

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

/// The speed next to that of the guess at which zero is a root, K(speed) x = 0, as far as K is
/// linear in it.
std::optional<WholeMotion> at_zero_of(const modes::QuadraticAt &p, const WholeMotion &guess,
                                      modes::WholePencil<double> &pencil) {
    const Sparse none(p.K.rows(), p.K.cols());
    pencil.set({none, p.above.K, p.K - guess.speed * p.above.K, {}, {}}, std::abs(guess.speed));
    auto found = pencil.refined({guess.speed, guess.right, guess.left});
    if (!found)
        return std::nullopt;
    WholeMotion out{found->value.real(), 0, std::move(found->right), std::move(found->left), 0, 0};
    const Forms f = forms(p, 0, out);
    out.rate = -f.by_speed / f.by_root;
    out.noise = noise_of(p, out, f.by_root);
    return out;
}

} // namespace

std::optional<EndOfGrowth> on_the_axis(const modes::FormMatrices &whole, const WholeMotion &guess,
                                       bool at_zero) {
    constexpr int most_steps = 25;      // a guard: quadratic, linear at double roots
    constexpr double converged = 1e-13; // of the speed: some hundred units of rounding
    constexpr double shrinking = 0.3;   // of the step before; else it is rounding
    constexpr double no_better = 1e-9;  // of the speed, if steps no longer shrink
    EndOfGrowth m{guess};
    m.kind = at_zero ? results::EndKind::zero : results::EndKind::pair;
    m.value = {0, at_zero ? 0 : guess.value.imag()};
    modes::WholePencil<double> pencil;
    double before = HUGE_VAL;
    for (int step = 0; step < most_steps; ++step) {
        const modes::QuadraticAt problem = whole.at(m.speed);
        auto found = at_zero ? at_zero_of(problem, m, pencil) : at_its_speed(problem, m, pencil);
        if (!found)
            return std::nullopt;
        const double change =
            at_zero ? found->speed - m.speed : -found->value.real() / found->rate.real();
        found->speed = m.speed + change;
        if (!at_zero)
            found->value = {0, found->value.imag() + found->rate.imag() * change};
        static_cast<WholeMotion &>(m) = *std::move(found);
        const double relative = std::abs(change / m.speed);
        if (!(std::abs(m.speed - guess.speed) <= 0.5 * std::abs(guess.speed)) ||
            !std::isfinite(relative))
            return std::nullopt;
        m.blur = at_zero ? rounding_of(problem, m) / std::abs(forms(problem, 0, m).by_speed)
                         : m.noise / std::abs(m.rate.real());
        const bool stays = relative >= shrinking * before &&
                           relative <= std::max(no_better, m.blur / std::abs(m.speed));
        if (relative <= converged || stays) {
            m.inward = m.rate.real() > 0 ? 1 : -1;
            return m;
        }
        before = relative;
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
