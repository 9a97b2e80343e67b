#pragma once

#include "model/shaft.h"
#include "results/whirl.h"

#include <Eigen/Core>

#include <algorithm>
#include <complex>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

namespace whirl::modes {

/// An eigenvalue whose imaginary part is below this share of its modulus is no whirl: the damping
/// ratio is above 0.9998, the motion dies out by a factor of 1e130 within one turn of it. (Real
/// eigenvalues that nearly meet are moved off the axis by rounding, and gyroscopic coupling gives
/// overdamped motion of an isotropic rotor a minute frequency.) `campbell` draws no line of such
/// motions and lists no crossings of theirs, and says so (docs/theory.md, Real eigenvalues).
inline constexpr double real_axis = 0.02;
/// The damping ratio above which a motion counts as overdamped, sqrt(1 - real_axis^2).
inline constexpr double overdamped_ratio = 0.99979998;
static_assert(overdamped_ratio * overdamped_ratio + real_axis * real_axis > 1 - 1e-8 &&
              overdamped_ratio * overdamped_ratio + real_axis * real_axis < 1 + 1e-8);

/// How the damping of a shaft's material, stress E (strain + tau strain rate), lets motions die
/// out: at the rate 1/tau it holds nothing, and the fast motions of the shaft, infinitely many of
/// them, come to rest there, internal damping (`internal_damping`) in the rotor, what does not turn
/// (`beta`) in the fixed axes, both together in axes between. Seen from these axes the motion is
/// overdamped; where they turn it has an imaginary part in the fixed ones, and is no whirl.
struct Relaxation {
    double rate = std::numeric_limits<double>::infinity(); ///< 1/tau, 1/s
    double turning = 0; ///< of the spin speed, how fast the axes turn in which it comes to rest

    [[nodiscard]] static Relaxation of(const model::Shaft &shaft) {
        const double tau = shaft.rigid ? 0 : shaft.internal_damping + shaft.beta;
        return tau > 0 ? Relaxation{1 / tau, shaft.internal_damping / tau} : Relaxation{};
    }
    /// A real shift from which whirl up to three times the rate is nearer than what comes to rest:
    /// |shift - i w| < shift + rate.
    [[nodiscard]] double shift() const { return 4 * rate; }
    /// An eigenvalue as seen from these axes, Im >= 0.
    [[nodiscard]] std::complex<double> in_rotating_axes(std::complex<double> l,
                                                        double speed) const {
        return {l.real(), std::abs(std::abs(l.imag()) - turning * std::abs(speed))};
    }
    /// The shaft's damping, where it turns, may bring it to rest: beyond half the rate, as seen
    /// from there the pair of eigenvalues of a motion of the shaft alone becomes real at -1/tau to
    /// -2/tau. (A whirl that crosses the spin speed, and is real in the rotor for that moment, dies
    /// out far less fast.)
    [[nodiscard]] bool relaxes(std::complex<double> l) const {
        constexpr double beyond = 0.5; // half the rate, as said above
        return turning > 0 && -l.real() > beyond * rate;
    }
    /// It does not whirl as seen from there: the damping ratio is above 0.995, it dies out by a
    /// factor of e^60 within one turn. (Among infinitely many such motions those that are hardly
    /// coupled to the supports have ratios of 0.9998 and more at any speed, the slowest not.)
    [[nodiscard]] bool stands(std::complex<double> l, double speed) const {
        constexpr double hardly = 0.1; // Im over modulus: a damping ratio of sqrt(1 - 0.01) = 0.995
        const std::complex<double> there = in_rotating_axes(l, speed);
        return relaxes(l) && there.imag() <= hardly * std::abs(there);
    }
};

/// Whether errors are judged by the left vectors too, a factorisation each: for those that are of
/// results, not for initial guesses, names and lines that are followed.
enum class Errors { with_left_vectors, of_right_vectors };

/// One whirl mode at one spin speed.
struct WhirlMode {
    std::complex<double> eigenvalue; ///< Im >= 0, 1/s
    /// Over the unknowns of the form. Planar: real w with w(t) = w exp(i s t), s = +-Im by
    /// `whirl`. Planar damped: complex w with w(t) = w exp(rotating_value t). Hyperbolic: real
    /// (x, y') with y = i y'. General: complex (x, y).
    Eigen::VectorXcd shape;
    results::Whirl whirl = results::Whirl::mixed;
    double forward_fraction = 0.5;
    std::optional<double> plane;   ///< of nearly straight orbits, rad (orbit_plane())
    double frequency_rotating = 0; ///< seen in rotating axes, rad/s; in rotating forms only
    /// Form rotating: of the two frequencies in the fixed frame the other one, rad/s, where the
    /// deflections of that whirl are at least a tenth as large.
    std::optional<double> other_frequency;
    /// What can be followed: forms rotating and hill, the eigenpair in rotating axes (over
    /// terms of Hill's series, of as many harmonics as are known); form planar_damped, the
    /// eigenvalue with the direction of whirl as the sign of its Im. In no other form.
    std::complex<double> rotating_value;
    Eigen::VectorXcd rotating_vector;
    Eigen::VectorXcd left; ///< forms general and rotating: of the matrices; empty: not known
    double residual = 0;
    double rounding = 0;
    /// False in form hill: of a series cut off, or of a reduced rotor that was not found with all
    /// unknowns. Such a value may be off by anything.
    bool confirmed = true;
};

/// The whirl modes at one spin speed with the lowest frequencies, with what else was met.
struct Spectrum {
    double speed = 0; ///< rad/s
    /// Of a solver ascending by frequency, no more than wanted; of a form by itself in any order,
    /// and there may be more.
    std::vector<WhirlMode> modes;
    std::vector<double> overdamped; ///< real eigenvalues met on the way, and standing ones, 1/s
    std::vector<double> growing;    ///< those of them above zero by more than their error
    double complete_radius = 0;     ///< all eigenvalues of smaller modulus are known, 1/s
    Relaxation relaxation{};        ///< what stands in its axes is no whirl

    /// Whether each of the modes is among the `count` of lowest frequency. Zero ones (free rigid
    /// motions) are, beside these.
    [[nodiscard]] std::vector<char> lowest(int count) const {
        std::vector<std::pair<double, std::size_t>> moving;
        for (std::size_t i = 0; i < modes.size(); ++i)
            if (modes[i].eigenvalue != 0.0)
                moving.emplace_back(modes[i].eigenvalue.imag(), i);
        std::ranges::sort(moving);
        std::vector<char> out(modes.size(), 1);
        for (auto k = static_cast<std::size_t>(count); k < moving.size(); ++k)
            out[moving[k].second] = 0;
        return out;
    }
    /// Drops all but these, and orders them by frequency.
    void keep_lowest(int count) {
        std::ranges::stable_sort(modes, {},
                                 [](const WhirlMode &mode) { return mode.eigenvalue.imag(); });
        // At rest both whirls have one frequency: which comes first is not left to rounding.
        constexpr double one = 1e-9; // of it
        for (std::size_t i = 0; speed == 0 && i + 1 < modes.size(); ++i)
            if (modes[i].eigenvalue != 0.0 && modes[i].whirl == results::Whirl::forward &&
                modes[i + 1].whirl == results::Whirl::backward &&
                modes[i + 1].eigenvalue.imag() <= (1 + one) * modes[i].eigenvalue.imag())
                std::swap(modes[i], modes[i + 1]);
        const std::vector<char> low = lowest(count);
        std::size_t next = 0;
        std::erase_if(modes, [&](const WhirlMode &) { return low[next++] == 0; });
    }

    /// Takes the real part of motion without whirl.
    /// @param error  of it that its residual and rounding explain, 1/s
    void add_without_whirl(double rate, double error) {
        overdamped.push_back(rate);
        if (rate > 10 * error)
            growing.push_back(rate);
    }
    /// Takes a mode of an eigenvalue, or motion without whirl.
    /// @param value  of the mode, with the sign of its whirl where the form has one
    void add(std::complex<double> value, WhirlMode mode) {
        const double size = std::abs(value);
        if (std::abs(value.imag()) > std::max(real_axis, 10 * mode.residual) * size &&
            !relaxation.stands(value, speed))
            modes.push_back(std::move(mode));
        else
            add_without_whirl(value.real(), (mode.residual + mode.rounding) * size);
    }
};

/// Two eigenvalues that were apart have come to the same one.
[[nodiscard]] inline bool met_twice(const std::vector<std::complex<double>> &before,
                                    const std::vector<std::complex<double>> &after) {
    const auto apart = [](std::complex<double> a, std::complex<double> b) {
        return std::abs(a - b) > 1e-8 * std::abs(a);
    };
    for (std::size_t i = 0; i < after.size(); ++i)
        for (std::size_t j = 0; j < i; ++j)
            if (!apart(after[i], after[j]) && apart(before[i], before[j]))
                return true;
    return false;
}

/// The eigenvalue of a mode. A real part that the eigensolver does not distinguish from zero is
/// none: without damping the forms that allow for it would otherwise show damping of either sign.
[[nodiscard]] inline std::complex<double> determined_value(const WhirlMode &mode) {
    const double error = (mode.residual + mode.rounding) * std::abs(mode.eigenvalue);
    const bool damped = std::abs(mode.eigenvalue.real()) > error;
    return {damped ? mode.eigenvalue.real() : 0, mode.eigenvalue.imag()};
}

} // namespace whirl::modes
