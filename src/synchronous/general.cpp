#include "synchronous/general.h"

#include "assembly/frequency_scales.h"
#include "assembly/planes.h"
#include "assembly/rotating_system.h"
#include "linalg/check.h"
#include "linalg/quadratic/quadratic_eigen.h"
#include "modes/zero_modes.h"
#include "results/formulation.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>

namespace whirl::synchronous {

namespace {

using assembly::Discretization;
using linalg::Matrix;

using assembly::i_unit;

/// The doubled problem has the eigenvalues of the complex one and their conjugates. Of each
/// vector (u1, u2), u1 + i u2 is the part that belongs to the complex problem.
bool belongs(const Eigen::VectorXcd &u, Eigen::VectorXcd &shape) {
    const Eigen::Index n = u.size() / 2;
    shape = u.head(n) + i_unit * u.tail(n);
    const double rest = (u.head(n) - i_unit * u.tail(n)).norm();
    return shape.norm() > 1e-5 * (shape.norm() + rest);
}

/// Roots of the diagonal of K + speed^2 M: shapes times them are in one unit.
struct Weights {
    Weights(const Matrix &K, const Matrix &M)
        : k(Eigen::SparseMatrix<double>(K.view()).diagonal().cwiseAbs()),
          m(Eigen::SparseMatrix<double>(M.view()).diagonal().cwiseAbs()) {}
    Eigen::VectorXd k, m;

    [[nodiscard]] Eigen::VectorXd at(double speed) const {
        return (k + speed * speed * m).cwiseSqrt();
    }
};

/// The mode is one of the list, or a mixture of those that share its eigenvalue.
bool present(const std::vector<modes::WhirlMode> &modes, const modes::WhirlMode &mode,
             const Weights &weights) {
    const Eigen::VectorXd at = weights.at(std::abs(mode.eigenvalue));
    Eigen::VectorXcd rest = at.cwiseProduct(mode.shape).normalized();
    std::vector<Eigen::VectorXcd> basis;
    for (const modes::WhirlMode &other : modes) {
        // What rounding can move either apart is no difference: of a stiff shaft on soft bearings
        // one pair may be found twice.
        const double blur =
            1e-7 + 10 * (mode.residual + mode.rounding + other.residual + other.rounding);
        if (std::abs(other.eigenvalue - mode.eigenvalue) >= blur * std::abs(mode.eigenvalue))
            continue;
        Eigen::VectorXcd direction = at.cwiseProduct(other.shape).normalized();
        for (const Eigen::VectorXcd &known : basis)
            direction -= known.dot(direction) * known;
        if (direction.norm() > 1e-6) {
            basis.push_back(direction.normalized());
            rest -= basis.back().dot(rest) * basis.back();
        }
    }
    constexpr double new_part = 0.14; // an angle whose cosine is 0.99
    return !basis.empty() && rest.norm() < new_part;
}

/// Largest Im l up to which a disc about a real shift holds all l with Im l > steepness |Re l|.
double height_within(double radius, double shift, double steepness) {
    // (w / s + shift)^2 + w^2 = radius^2
    const double a = 1 + 1 / (steepness * steepness);
    const double b = shift / steepness;
    const double c = shift * shift - radius * radius;
    return std::isinf(radius) ? radius : c >= 0 ? 0 : (-b + std::sqrt(b * b - a * c)) / a;
}

/// The same where the shift stands on the axis of W = l / i.
double reach_within(double radius, double shift, double steepness) {
    // (W - shift)^2 + (W / s)^2 = radius^2
    const double a = 1 + 1 / (steepness * steepness);
    const double c = shift * shift - radius * radius;
    return std::isinf(radius) ? radius : c > 0 ? 0 : (shift + std::sqrt(shift * shift - a * c)) / a;
}

/// Enough modes where the list is complete.
bool enough(const SynchronousModes &found, int wanted, double top) {
    const auto sure = std::ranges::count_if(
        found.modes, [&](const auto &mode) { return mode.eigenvalue.imag() <= found.complete_to; });
    return std::isinf(found.complete_to) || (sure >= wanted && found.complete_to > top);
}

ComplexQuadratic::Sparse complex(const Matrix &A) {
    return Eigen::SparseMatrix<double>(A.view()).cast<std::complex<double>>();
}

} // namespace

SynchronousModes GeneralSynchronous::fixed(double bearing_speed, int wanted, double top,
                                           double steepness) const {
    const assembly::FixedSystem system = assembly::assemble_fixed(_d, bearing_speed);
    const Matrix M = doubled(system.M, &system.G);
    const Matrix D = doubled(system.C, &system.Kc);
    const Matrix K = doubled(system.K, nullptr);
    const modes::ZeroModes zeros = modes::zero_modes(_d, results::Form::general, bearing_speed, 0);
    const Weights weights(system.K, system.M);
    linalg::QuadraticOptions options;
    options.zeros = 2 * zeros.eigenvalues;
    if (zeros.eigenvalues > 0)
        options.shift = 0.3 * assembly::elastic_scale(_d);
    // Backward motions turn at twice the spin speed through the internal damping of the rotor: they
    // come to rest in it at half its rate.
    const model::Shaft &shaft = _d.rotor().shaft;
    const double tau = shaft.rigid ? 0 : 2 * shaft.internal_damping + shaft.beta;
    const double shapes = wanted / 2.0 + 1; // as in GeneralSpectrum
    if (tau > 0 && 1 < tau * std::max(top, shapes * shapes * assembly::elastic_scale(_d)))
        options.shift = modes::Relaxation{1 / tau}.shift();
    const auto solver_at = [&](double shift) {
        return std::make_unique<linalg::QuadraticSolver>(
            Eigen::SparseMatrix<double>(M.view()), Eigen::SparseMatrix<double>(D.view()),
            Eigen::SparseMatrix<double>(K.view()), shift);
    };
    std::unique_ptr<linalg::QuadraticSolver> solver;
    SynchronousModes out;
    // Each mode of the complex problem brings a conjugate partner into the doubled one.
    for (int ask = std::max(_ask, 5 * wanted / 2 + 6 + 2 * zeros.eigenvalues);; ask = ask * 7 / 5) {
        options.wanted = std::min(ask, M.size());
        linalg::QuadraticResult found;
        const auto solve = [&] {
            if (!solver)
                solver = solver_at(options.shift);
            return solver->solve(options);
        };
        try {
            found = solve();
        } catch (const linalg::SolverError &) {
            if (out.complete_to > top)
                return out; // no more can be resolved beside these
            // As in GeneralSpectrum: creeping motions against strong dampers want a shift. The near
            // ones are known where those far above, as of a shaft without mass, drown in rounding.
            if (options.shift == 0) {
                options.shift = 0.3 * assembly::elastic_scale(_d);
                solver.reset();
            } else {
                options.fewest = 1;
            }
            try {
                found = solve();
            } catch (const linalg::SolverError &) {
                if (options.fewest == 1)
                    throw;
                options.fewest = 1;
                found = solve();
            }
        }
        out.modes.clear();
        for (const linalg::ComplexPair &pair : found.pairs) {
            modes::WhirlMode mode;
            const double size = std::abs(pair.value);
            const bool zero = zeros.eigenvalues > 0 && size < 1e-3 * options.shift;
            if (pair.value.imag() <= steepness * std::abs(pair.value.real()) || zero ||
                !belongs(pair.vector, mode.shape))
                continue;
            mode.eigenvalue = pair.value;
            mode.residual = pair.residual;
            mode.rounding = pair.rounding;
            if (!present(out.modes, mode, weights))
                out.modes.push_back(mode);
        }
        out.complete_to = height_within(found.complete_radius, options.shift, steepness);
        _ask = std::min(ask, M.size());
        const bool no_more =
            options.fewest > 0 && static_cast<int>(found.pairs.size()) < options.wanted;
        if (enough(out, wanted, top) || options.wanted == M.size() || no_more)
            break;
    }
    return out;
}

SynchronousModes GeneralSynchronous::rotating(double bearing_speed, int wanted, double top,
                                              double steepness) const {
    const assembly::RotatingSystem system = held_in_rotating_axes(_d, bearing_speed);
    const Weights weights(system.K, system.Kss);
    linalg::QuadraticOptions options;
    options.shift = 0.3 * assembly::support_scale(_d);
    options.fewest = 1;
    SynchronousModes out;
    for (int ask = 2 * wanted + 4;; ask *= 2) {
        options.wanted = std::min(ask, 2 * system.K.size());
        const linalg::QuadraticResult found =
            linalg::solve_quadratic(system.Kss, system.Ks, system.K, options);
        out.modes.clear();
        for (const linalg::ComplexPair &pair : found.pairs) {
            modes::WhirlMode mode;
            // W and its conjugate solve the real problem; (x, y) ~ (1, -i) belongs to x + i y.
            const assembly::Planes planes(pair.vector);
            const bool own = planes.towards().norm() >= planes.against().norm();
            mode.eigenvalue = i_unit * (own ? pair.value : std::conj(pair.value));
            mode.shape = own ? pair.vector : Eigen::VectorXcd(pair.vector.conjugate());
            mode.residual = pair.residual;
            mode.rounding = pair.rounding;
            const bool zero = std::abs(pair.value) <= 1e-3 * options.shift;
            const bool peaks =
                mode.eigenvalue.imag() > steepness * std::abs(mode.eigenvalue.real());
            if (peaks && !zero && !present(out.modes, mode, weights))
                out.modes.push_back(mode);
        }
        out.complete_to = reach_within(found.complete_radius, options.shift, steepness);
        if (enough(out, wanted, top) || options.wanted == 2 * system.K.size())
            break;
    }
    return out;
}

SynchronousModes GeneralSynchronous::lowest(double bearing_speed, int wanted, double top,
                                            double steepness) const {
    SynchronousModes out = _form == results::Form::rotating
                               ? rotating(bearing_speed, wanted, top, steepness)
                               : fixed(bearing_speed, wanted, top, steepness);
    std::ranges::stable_sort(out.modes, {},
                             [](const modes::WhirlMode &mode) { return mode.eigenvalue.imag(); });
    return out;
}

ComplexQuadratic GeneralSynchronous::problem(double bearing_speed) const {
    if (_form == results::Form::rotating) {
        const assembly::RotatingSystem system = held_in_rotating_axes(_d, bearing_speed);
        return {-complex(system.Kss), -i_unit * complex(system.Ks), complex(system.K)};
    }
    const assembly::FixedSystem system = assembly::assemble_fixed(_d, bearing_speed);
    return {complex(system.M) - i_unit * complex(system.G),
            complex(system.C) - i_unit * complex(system.Kc), complex(system.K)};
}

} // namespace whirl::synchronous
