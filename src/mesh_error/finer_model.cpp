#include "mesh_error/finer_model.h"

#include "assembly/planar_part.h"
#include "results/formulation.h"
#include "results/whirl.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace whirl::mesh_error {

namespace {

constexpr double unknown = std::numeric_limits<double>::infinity();

double relative(std::complex<double> coarse, std::complex<double> fine) {
    const double size = std::abs(coarse);
    return size == 0 ? 0 : estimate_safety * std::abs(coarse - fine) / size;
}

/// Modes of one sense, by their place; in real symmetric form all are of one kind.
std::vector<std::complex<double>> of_sense(const modes::Spectrum &spectrum, bool planar,
                                           results::Whirl sense) {
    std::vector<std::complex<double>> out;
    for (const modes::WhirlMode &mode : spectrum.modes)
        if (!planar || mode.whirl == sense)
            out.push_back(mode.eigenvalue);
    std::ranges::sort(out, {}, [](const auto &value) { return value.imag(); });
    return out;
}

/// Distance to the partner among candidates (likeness, eigenvalue of the finer model). Where one of
/// them is far nearer than all others, and not much less like it, that is the mode (damped modes,
/// and those on cross-coupled bearings, are not orthogonal: their shapes resemble each other). Else
/// the farthest counts: where shapes do not identify the counterpart, the larger error is stated.
double error_among(std::complex<double> value,
                   std::vector<std::pair<double, std::complex<double>>> candidates) {
    // Of the next one's distance: a mode converges with the mesh, the distance of others stays.
    constexpr double far_nearer = 0.02;
    // Of the best likeness: modes that are not orthogonal resemble each other.
    constexpr double not_much_less = 0.7;
    const auto distance_of = [value](const auto &candidate) {
        return std::abs(candidate.second - value);
    };
    std::ranges::sort(candidates, {}, distance_of);
    const auto likeness_of = [](const auto &candidate) { return candidate.first; };
    const double best = std::ranges::max(candidates, {}, likeness_of).first;
    const auto distance = [&](std::size_t i) { return distance_of(candidates[i]); };
    const bool clear = candidates.size() == 1 || (distance(0) <= far_nearer * distance(1) &&
                                                  candidates[0].first >= not_much_less * best);
    return relative(value, clear ? candidates.front().second : candidates.back().second);
}

} // namespace

FinerModel::FinerModel(const model::Rotor &rotor, const modes::SpectrumSolver &coarse,
                       int refinement)
    : _coarse(coarse), _fine(std::make_unique<modes::SpectrumSolver>(
                           rotor, coarse.form(), finer_order(coarse.discretization().order()),
                           refinement, modes::SpectrumSolver::hill_harmonics + 2)),
      _places(coarse.discretization().places_in(_fine->discretization())),
      _mass(assembly::planar_part(_fine->discretization(), assembly::Term::mass)) {}

std::vector<double> FinerModel::errors(const modes::Spectrum &coarse) const {
    const results::Form form = _coarse.form();
    return form == results::Form::planar || form == results::Form::hyperbolic
               ? errors_by_place(coarse)
               : errors_by_shape(coarse);
}

std::vector<double> FinerModel::errors_by_place(const modes::Spectrum &coarse) const {
    const bool planar = _coarse.form() == results::Form::planar;
    modes::Spectrum fine;
    const auto enough = [&](results::Whirl sense) {
        return of_sense(fine, planar, sense).size() >= of_sense(coarse, planar, sense).size();
    };
    // The lowest modes of the finer model may have another share of either sense.
    for (auto ask = coarse.modes.size();; ask *= 2) {
        fine = _fine->at(coarse.speed, static_cast<int>(ask));
        if ((enough(results::Whirl::forward) && enough(results::Whirl::backward)) ||
            fine.modes.size() < ask)
            break;
    }
    std::vector<double> errors;
    for (const modes::WhirlMode &mode : coarse.modes) {
        const auto ours = of_sense(coarse, planar, mode.whirl);
        const auto theirs = of_sense(fine, planar, mode.whirl);
        const auto place =
            static_cast<std::size_t>(std::ranges::find(ours, mode.eigenvalue) - ours.begin());
        errors.push_back(place < theirs.size() ? relative(mode.eigenvalue, theirs[place])
                                               : unknown);
    }
    return errors;
}

std::vector<double> FinerModel::errors_by_refinement(const modes::Spectrum &some) const {
    std::vector<modes::WhirlMode> guesses = some.modes;
    for (modes::WhirlMode &mode : guesses) {
        mode.shape = embedded(mode.shape);
        if (_coarse.form() == results::Form::general && mode.left.size() > 0)
            mode.left = embedded(mode.left);
        if (_coarse.form() == results::Form::rotating)
            mode.rotating_vector = embedded(mode.rotating_vector);
        else if (_coarse.form() == results::Form::hill)
            mode.rotating_vector = embedded_terms(mode.rotating_vector);
    }
    const std::vector<modes::WhirlMode> fine = _fine->near(some.speed, guesses);
    std::vector<double> errors;
    for (std::size_t i = 0; i < fine.size(); ++i)
        errors.push_back(relative(some.modes[i].eigenvalue, fine[i].eigenvalue));
    return errors;
}

/// Modes of the finer model that resemble a mode nearly as much as the one most like it count.
std::vector<double> FinerModel::errors_by_shape(const modes::Spectrum &coarse) const {
    if (_coarse.refines() || results::in_rotating_axes(_coarse.form()))
        if (std::vector<double> errors = errors_by_refinement(coarse); !errors.empty())
            return errors;
    // Of the largest likeness: two modes that mix share it in halves at worst.
    constexpr double nearly = 0.5;
    const modes::Spectrum fine = _fine->at(
        coarse.speed, static_cast<int>(coarse.modes.size() + coarse.modes.size() / 4 + 2));
    const int planes = results::is_planar(_coarse.form()) ? 1 : 2;
    const auto plane = [this, planes](const Eigen::VectorXcd &shape, int which) {
        return Eigen::VectorXcd(shape(Eigen::seqN(which, _mass.rows(), planes)));
    };
    const auto product = [&](const Eigen::VectorXcd &a, const Eigen::VectorXcd &b) {
        std::complex<double> sum = 0;
        for (int which = 0; which < planes; ++which)
            sum += plane(a, which).dot(Eigen::VectorXcd(_mass * plane(b, which)));
        return sum;
    };
    std::vector<double> size;
    for (const modes::WhirlMode &mode : fine.modes)
        size.push_back(std::abs(product(mode.shape, mode.shape)));
    std::vector<double> errors;
    for (const modes::WhirlMode &mode : coarse.modes) {
        const Eigen::VectorXcd shape = embedded(mode.shape);
        std::vector<double> likeness;
        for (std::size_t i = 0; i < fine.modes.size(); ++i)
            likeness.push_back(size[i] > 0 && (planes == 2 || fine.modes[i].whirl == mode.whirl)
                                   ? std::norm(product(shape, fine.modes[i].shape)) / size[i]
                                   : 0);
        const double best =
            likeness.empty() ? 0 : *std::max_element(likeness.begin(), likeness.end());
        std::vector<std::pair<double, std::complex<double>>> candidates;
        for (std::size_t i = 0; i < likeness.size() && best > 0; ++i)
            if (likeness[i] > nearly * best)
                candidates.emplace_back(likeness[i], fine.modes[i].eigenvalue);
        errors.push_back(candidates.empty() ? unknown : error_among(mode.eigenvalue, candidates));
    }
    return errors;
}

/// Of Hill's series each term.
Eigen::VectorXcd FinerModel::embedded_terms(const Eigen::VectorXcd &vector) const {
    const Eigen::Index n = _coarse.unknowns();
    const Eigen::Index blocks = vector.size() / n;
    const Eigen::Index fine = n + 2 * (_mass.rows() - std::ssize(_places));
    Eigen::VectorXcd out(fine * blocks);
    for (Eigen::Index block = 0; block < blocks; ++block)
        out.segment(block * fine, fine) = embedded(vector.segment(block * n, n));
    return out;
}

Eigen::VectorXcd FinerModel::embedded(const Eigen::VectorXcd &shape) const {
    const int planes = results::is_planar(_coarse.form()) ? 1 : 2;
    const auto attached = shape.size() - planes * std::ssize(_places); // balls
    Eigen::VectorXcd out = Eigen::VectorXcd::Zero(planes * _mass.rows() + attached);
    out.tail(attached) = shape.tail(attached);
    for (std::size_t i = 0; i < _places.size(); ++i)
        for (int which = 0; which < planes; ++which)
            out(planes * _places[i] + which) = shape(planes * static_cast<Eigen::Index>(i) + which);
    return out;
}

} // namespace whirl::mesh_error
