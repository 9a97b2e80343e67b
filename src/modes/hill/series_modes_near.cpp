#include "modes/hill/series_modes_near.h"

#include "assembly/hill_system.h"
#include "modes/hill/series_pair.h"
#include "reduction/projection.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <optional>

namespace whirl::modes {

namespace {

using Complex = std::complex<double>;

/// A whole multiple of the spin speed, up to rounding.
bool on_multiple(double frequency, double speed) {
    return std::abs(std::remainder(frequency, std::abs(speed))) <= 1e-11 * std::abs(speed);
}

std::optional<linalg::ComplexPair> pair_near(const RotatingSpectrum &rotor,
                                             const periodic::WholeRotor &whole, double speed,
                                             const WhirlMode &mode) {
    constexpr double farthest = 0.03; // of a mode that the guesses' mesh hardly resolves
    const Complex guess = mode.rotating_value;
    const Eigen::Index n = rotor.system().M.size();
    const auto root = whole.next_to(speed, guess, 0,
                                    mode.rotating_vector.size() > 0
                                        ? assembly::hill_terms(mode.rotating_vector, n)
                                        : Eigen::MatrixXcd());
    if (!root)
        return std::nullopt;
    const double size = std::max(std::abs(root->value), 1e-300);
    if (!(std::abs(root->value - guess) <= farthest * std::max(size, std::abs(speed))))
        return std::nullopt;
    Complex value = root->value;
    if (on_multiple(guess.imag(), speed)) {
        if (std::abs(value.imag() - guess.imag()) > 1e-9 * std::abs(speed) + 10 * root->noise)
            return std::nullopt;
        value.imag(guess.imag());
    }
    const Eigen::Map<const Eigen::MatrixXcd> terms(root->terms.data(), n, root->terms.size() / n);
    linalg::ComplexPair pair = series_pair(rotor, speed, value, terms, terms.cols() / 2);
    pair.rounding = root->noise / size;
    return pair;
}

bool opposite(results::Whirl a, results::Whirl b) {
    return a != b && a != results::Whirl::mixed && b != results::Whirl::mixed;
}

} // namespace

WhirlMode over_all_unknowns(WhirlMode mode, const Eigen::MatrixXd *shapes, int unknowns) {
    if (shapes == nullptr)
        return mode;
    const reduction::Projection projection(*shapes);
    const Eigen::Index few = unknowns;
    const Eigen::Index blocks = mode.rotating_vector.size() / few;
    const Eigen::Index n = few + 2 * (shapes->rows() - shapes->cols());
    Eigen::VectorXcd all(n * blocks);
    for (Eigen::Index block = 0; block < blocks; ++block)
        all.segment(block * n, n) =
            projection.lifted(mode.rotating_vector.segment(block * few, few));
    mode.rotating_vector = all;
    return mode;
}

std::vector<WhirlMode> series_modes_near(const RotatingSpectrum &rotor,
                                         const periodic::WholeRotor &whole, double speed,
                                         const std::vector<WhirlMode> &guesses) {
    if (speed == 0)
        return {};
    std::vector<WhirlMode> out;
    std::vector<Complex> before;
    std::vector<Complex> after;
    for (const WhirlMode &guess : guesses) {
        const auto pair = pair_near(rotor, whole, speed, guess);
        if (!pair)
            return {};
        out.push_back(rotor.in_fixed_frame(*pair, speed));
        out.back().eigenvalue = determined_value(out.back());
        if (opposite(out.back().whirl, guess.whirl))
            return {};
        before.push_back(guess.rotating_value);
        after.push_back(pair->value);
    }
    return met_twice(before, after) ? std::vector<WhirlMode>() : out;
}

} // namespace whirl::modes
