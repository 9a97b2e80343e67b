#include "modes/following/followed_modes.h"

#include "linalg/lanes/vector_products.h"
#include "results/whirl.h"

#include <algorithm>
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

/// Left and right vectors as states, from the right ones of the problem.
void set_states(const SymmetricProblem &problem, double speed, const Eigen::VectorXcd &values,
                const ModeBasis &basis) {
    const Eigen::Index n = problem.size();
    basis.complex_left.resize(2 * n, values.size());
    basis.complex_right.resize(2 * n, values.size());
    const SymmetricProblem::ColumnProducts of = problem.products(speed, basis.alike);
    for (Eigen::Index i = 0; i < values.size(); ++i) {
        const std::complex<double> l = values(i);
        // x^T (K - l^2 M) x
        const std::complex<double> norm =
            linalg::product_of_columns(basis.alike, i, of.K, i) -
            l * l * linalg::product_of_columns(basis.alike, i, of.M, i);
        basis.complex_left.col(i) << problem.covector_to_form(of.K.col(i)) / norm,
            problem.covector_to_form(of.M.col(i)) * (-l / norm);
        const Eigen::VectorXcd shape = problem.to_form(basis.alike.col(i));
        basis.complex_right.col(i) << shape, shape * l;
    }
}

} // namespace

void set_planar_whirl(WhirlMode &mode, std::complex<double> value, bool positive, double speed) {
    const bool forward = positive == (speed >= 0);
    mode.rotating_value = value;
    mode.whirl = forward ? results::Whirl::forward : results::Whirl::backward;
    mode.forward_fraction = forward ? 1 : 0;
}

Spectrum modes_of(const SymmetricProblem &problem, const FollowedSpeed &followed) {
    Spectrum out;
    out.speed = followed.speed;
    out.relaxation = problem.relaxation();
    out.complete_radius = followed.radius;
    out.modes.reserve(followed.pairs.size());
    for (std::size_t i = 0; i < followed.pairs.size(); ++i)
        if (!followed.pairs[i].counted_only && std::abs(followed.pairs[i].value) < followed.radius)
            out.add(followed.pairs[i].value, mode_of(problem, followed, i));
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
    const auto count = std::ssize(modes);
    ModeBasis out;
    out.alike.resize(problem.size(), count);
    out.rate_below.resize(count);
    Eigen::VectorXcd values(count);
    bool close = false;
    for (Eigen::Index i = 0; i < count; ++i) {
        const auto place = static_cast<std::size_t>(modes[static_cast<std::size_t>(i)].followed);
        const SymmetricPair &pair = followed.pairs[place];
        out.alike.col(i) =
            pair.vector * (1 / std::sqrt(linalg::dot(pair.vector, pair.vector).real()));
        values(i) = pair.value;
        out.rate_below(i) = pair.value.imag() < 0 ? std::conj(pair.rate) : pair.rate;
        for (std::size_t j = 0; j < place; ++j)
            close = close ||
                    std::norm(followed.pairs[j].value - pair.value) < 1e-8 * std::norm(pair.value);
    }
    out.rate_above = out.rate_below;
    out.later = [&problem, values, close, speed = followed.speed](const ModeBasis &basis) {
        set_states(problem, speed, values, basis);
        if (close)
            separate(basis);
    };
    return out;
}

StartingPairs starting_pairs(const Spectrum &found, results::Form form) {
    StartingPairs out;
    for (const WhirlMode &mode : found.modes)
        out.whirls.emplace_back(form == results::Form::planar_damped ? mode.rotating_value
                                                                     : mode.eigenvalue,
                                mode.shape);
    out.real = found.overdamped;
    out.radius = found.complete_radius;
    return out;
}

StartingPairs starting_pairs(const std::vector<WhirlMode> &undamped, double speed) {
    StartingPairs out;
    out.speed = speed;
    for (const WhirlMode &mode : undamped) {
        Eigen::VectorXcd shape = mode.shape; // y = i y'
        for (Eigen::Index k = 1; k < shape.size(); k += 2)
            shape(k) *= std::complex<double>(0, 1);
        out.whirls.emplace_back(mode.eigenvalue, std::move(shape));
        out.radius = std::max(out.radius, std::abs(mode.eigenvalue));
    }
    return out;
}

} // namespace whirl::modes
