#include "modes/following/followed_modes.h"

#include "modes/following/sorted_modes.h"

#include <cmath>

namespace whirl::modes {

namespace {

WhirlMode mode_of(const SymmetricProblem &problem, const FollowedSpeed &followed, std::size_t i) {
    const SymmetricPair &pair = followed.pairs[i];
    WhirlMode mode;
    mode.eigenvalue = {pair.value.real(), std::abs(pair.value.imag())};
    mode.shape = problem.to_form(pair.vector);
    mode.residual = pair.error;
    mode.rounding = pair.rounding;
    mode.followed = static_cast<int>(i);
    if (problem.form() == results::Form::planar_damped)
        set_planar_whirl(mode, pair.value, pair.value.imag() > 0, followed.speed);
    return mode;
}

} // namespace

GeneralSpectrum::Modes modes_of(const SymmetricProblem &problem, const FollowedSpeed &followed) {
    GeneralSpectrum::Modes out;
    out.complete_radius = followed.radius;
    for (std::size_t i = 0; i < followed.pairs.size(); ++i)
        if (!followed.pairs[i].counted_only && std::abs(followed.pairs[i].value) < followed.radius)
            sort_in(followed.pairs[i].value, mode_of(problem, followed, i), out);
    return out;
}

std::vector<WhirlMode> modes_near(const SymmetricProblem &problem, double speed,
                                  const std::vector<WhirlMode> &guesses) {
    const bool planar = problem.form() == results::Form::planar_damped;
    std::vector<SymmetricPair> pairs(guesses.size());
    for (std::size_t i = 0; i < guesses.size(); ++i) {
        pairs[i].value = planar ? guesses[i].rotating_value : guesses[i].eigenvalue;
        pairs[i].vector = problem.from_form(guesses[i].shape);
    }
    std::optional<std::vector<SymmetricPair>> found =
        pairs_near(problem, speed, std::move(pairs), static_cast<int>(guesses.size()));
    std::vector<WhirlMode> out;
    if (!found)
        return out;
    const FollowedSpeed all{speed, std::move(*found), 0, false};
    for (std::size_t i = 0; i < guesses.size(); ++i)
        out.push_back(mode_of(problem, all, i));
    return out;
}

ModeBasis basis_of(const SymmetricProblem &problem, const FollowedSpeed &followed,
                   const std::vector<WhirlMode> &modes) {
    const Eigen::Index n = problem.size();
    const auto count = std::ssize(modes);
    ModeBasis out;
    out.complex_left.resize(2 * n, count);
    out.complex_right.resize(2 * n, count);
    out.rate_below.resize(count);
    bool close = false;
    for (Eigen::Index i = 0; i < count; ++i) {
        const auto place = static_cast<std::size_t>(modes[static_cast<std::size_t>(i)].followed);
        const SymmetricPair &pair = followed.pairs[place];
        // x^T (K - l^2 M) x with x^T Q(l) x = 0.
        const std::complex<double> norm = -pair.value * pair.derivative;
        out.complex_left.col(i) << problem.covector_to_form(pair.Kx) / norm,
            problem.covector_to_form(pair.Mx) * (-pair.value / norm);
        const Eigen::VectorXcd shape = problem.to_form(pair.vector);
        out.complex_right.col(i) << shape, shape * pair.value;
        out.rate_below(i) = pair.value.imag() < 0 ? std::conj(pair.rate) : pair.rate;
        for (std::size_t j = 0; j < place; ++j)
            close = close ||
                    std::norm(followed.pairs[j].value - pair.value) < 1e-8 * std::norm(pair.value);
    }
    out.rate_above = out.rate_below;
    if (close)
        separate(out);
    return out;
}

StartingPairs starting_pairs(const GeneralSpectrum::Modes &found, results::Form form) {
    StartingPairs out;
    for (const WhirlMode &mode : found.modes)
        out.whirls.emplace_back(form == results::Form::planar_damped ? mode.rotating_value
                                                                     : mode.eigenvalue,
                                mode.shape);
    out.real = found.overdamped;
    out.radius = found.complete_radius;
    return out;
}

} // namespace whirl::modes
