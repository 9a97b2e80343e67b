#include "synchronous/critical_error.h"

#include "assembly/planes.h"
#include "linalg/check.h"
#include "modes/orbits.h"
#include "results/formulation.h"
#include "results/sentence.h"
#include "synchronous/branch.h"
#include "synchronous/problem.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <tuple>

namespace whirl::synchronous {

namespace {

using Partners = std::vector<std::optional<std::size_t>>;

/// Which root it is: whirl (planar form), eigenvalue of K - W^2 A, and which of its passages.
std::vector<std::tuple<int, int, int>> names_of(const SynchronousModes &list, results::Form form) {
    std::vector<std::tuple<int, int, int>> names;
    std::map<std::pair<int, int>, int> passages;
    for (std::size_t i = 0; i < list.modes.size(); ++i) {
        const int whirl = form == results::Form::planar ? static_cast<int>(list.modes[i].whirl) : 0;
        const std::pair<int, int> branch{whirl, list.branches[i]};
        names.emplace_back(whirl, list.branches[i], passages[branch]++);
    }
    return names;
}

Partners by_branch(const SynchronousModes &modes, const SynchronousModes &finer,
                   results::Form form) {
    std::map<std::tuple<int, int, int>, std::size_t> places;
    const auto finer_names = names_of(finer, form);
    for (std::size_t j = 0; j < finer_names.size(); ++j)
        places[finer_names[j]] = j;
    Partners partners;
    for (const auto &name : names_of(modes, form)) {
        const auto found = places.find(name);
        partners.push_back(found == places.end() ? std::nullopt : std::optional(found->second));
    }
    return partners;
}

/// Deflections in x and y at the stations of the shaft, length 1.
Eigen::VectorXcd deflections(const modes::Stations &stations, const modes::WhirlMode &mode) {
    const assembly::Planes planes(mode.shape);
    const Eigen::VectorXcd x = stations.deflections(planes.x);
    Eigen::VectorXcd both(2 * x.size());
    both << x, stations.deflections(planes.y);
    const double length = both.norm();
    return length > 0 ? Eigen::VectorXcd(both / length) : both;
}

std::vector<Eigen::VectorXcd> all_deflections(const assembly::Discretization &d,
                                              const SynchronousModes &list) {
    const modes::Stations stations = modes::Stations::for_orbits(d);
    std::vector<Eigen::VectorXcd> out;
    for (const modes::WhirlMode &mode : list.modes)
        out.push_back(deflections(stations, mode));
    return out;
}

/// Pairs by likeness, the best first; each mode has one partner.
Partners by_shape(const assembly::Discretization &coarse, const SynchronousModes &modes,
                  const assembly::Discretization &finer, const SynchronousModes &finer_modes) {
    // Of two vectors of a double eigenvalue one is at least 1/2; the same mode is near 1.
    constexpr double alike = 0.25;
    const auto shapes = all_deflections(coarse, modes);
    const auto finer_shapes = all_deflections(finer, finer_modes);
    std::vector<std::tuple<double, std::size_t, std::size_t>> likeness;
    for (std::size_t i = 0; i < shapes.size(); ++i)
        for (std::size_t j = 0; j < finer_shapes.size(); ++j) {
            const std::complex<double> a = modes.modes[i].eigenvalue;
            const std::complex<double> b = finer_modes.modes[j].eigenvalue;
            const double cosine = std::norm(shapes[i].dot(finer_shapes[j]));
            likeness.emplace_back(cosine / (1 + std::abs(a - b) / std::abs(b)), i, j);
        }
    std::sort(likeness.rbegin(), likeness.rend());
    Partners partners(shapes.size());
    std::vector<bool> taken(finer_shapes.size(), false);
    for (const auto &[value, i, j] : likeness)
        if (!partners[i] && !taken[j] && value > alike) {
            partners[i] = j;
            taken[j] = true;
        }
    return partners;
}

/// Relative error of a mode against the same one of a finer model.
/// @param other  its eigenvalue there, with a residual and rounding of `noise`
results::ErrorParts error_against(const modes::WhirlMode &mode, std::complex<double> other,
                                  double noise) {
    const double apart = std::abs(mode.eigenvalue - other) / other.imag();
    return {mesh_error::estimate_safety * apart + noise, 0, mode.residual + mode.rounding};
}

/// The motion of a rotor on a finer model of the same mesh, whose functions contain its own.
/// @param places  Discretization::places_in()
Eigen::VectorXcd embedded(const Eigen::VectorXcd &shape, const std::vector<int> &places,
                          int unknowns, bool pairs) {
    const Eigen::Index width = pairs ? 2 : 1;
    Eigen::VectorXcd out = Eigen::VectorXcd::Zero(width * unknowns);
    for (std::size_t i = 0; i < places.size(); ++i)
        out.segment(width * places[i], width) =
            shape.segment(width * static_cast<Eigen::Index>(i), width);
    return out;
}

/// Roots of the finer model, each next to one of the rotor's; none where one is not found, or found
/// twice, or where the finer model has others between them.
struct FinerRoots {
    std::vector<modes::WhirlMode> modes;
    bool matched = true; ///< which belongs to which
};

bool found_before(const std::vector<modes::WhirlMode> &modes, const BranchPoint &point) {
    return std::ranges::any_of(modes, [&](const modes::WhirlMode &other) {
        const double cosine =
            std::abs(other.shape.dot(point.shape)) / (other.shape.norm() * point.shape.norm());
        return std::abs(other.eigenvalue - point.eigenvalue) < 1e-8 * std::abs(point.eigenvalue) &&
               cosine > 0.99;
    });
}

/// @param modes  ascending, of one problem
FinerRoots finer_roots(const std::vector<modes::WhirlMode> &modes,
                       const assembly::Discretization &rotor, const SynchronousProblem &finer) {
    FinerRoots out;
    const std::vector<int> places = rotor.places_in(finer.rotor());
    const WholeRoots roots(finer);
    int passages = 0; // of eigenvalues of K - W^2 M through zero, downwards
    for (const modes::WhirlMode &mode : modes) {
        const auto point =
            roots.near(mode.eigenvalue,
                       embedded(mode.shape, places, finer.rotor().planar_size(), finer.pairs()));
        if (!point || found_before(out.modes, *point)) {
            out.matched = false;
            return out;
        }
        modes::WhirlMode found;
        found.eigenvalue = point->eigenvalue;
        found.shape = point->shape;
        found.residual = point->residual;
        found.rounding = point->rounding;
        passages += point->downwards() ? 1 : -1;
        out.modes.push_back(std::move(found));
    }
    const auto speed = [](const modes::WhirlMode &mode) { return mode.eigenvalue.imag(); };
    if (finer.conservative()) {
        // In the order of the rotor's own and none other up to the last: by Courant and Fischer
        // each eigenvalue's passage is then that of the same eigenvalue.
        constexpr double offset = 1e-7; // of the speed: far above rounding
        const double first = speed(out.modes.front());
        const double last = speed(out.modes.back());
        out.matched = std::ranges::is_sorted(out.modes, {}, speed) &&
                      roots.negative_eigenvalues(last * (1 + offset)) -
                              roots.negative_eigenvalues(1e-3 * first) ==
                          passages;
        return out;
    }
    const modes::Stations own = modes::Stations::for_orbits(rotor);
    const modes::Stations others = modes::Stations::for_orbits(finer.rotor());
    for (std::size_t i = 0; i < modes.size() && out.matched; ++i) {
        constexpr double alike = 0.5; // of one motion at the most, among those across each other
        out.matched =
            std::norm(deflections(own, modes[i]).dot(deflections(others, out.modes[i]))) > alike;
    }
    return out;
}

/// Errors against the roots of a finer model next to these; none where it is not clear which of
/// them belong together.
std::vector<std::optional<results::ErrorParts>>
errors_by_roots(const SynchronousModes &list, const assembly::Discretization &rotor,
                const assembly::Discretization &finer, results::Form form) {
    std::vector<std::optional<results::ErrorParts>> errors(list.modes.size());
    const bool planar = form == results::Form::planar;
    for (const results::Whirl whirl : {results::Whirl::forward, results::Whirl::backward}) {
        std::vector<modes::WhirlMode> own;
        std::vector<std::size_t> places;
        for (std::size_t i = 0; i < list.modes.size(); ++i)
            if (!planar || list.modes[i].whirl == whirl) {
                own.push_back(list.modes[i]);
                places.push_back(i);
            }
        if (own.empty())
            continue;
        const SynchronousProblem problem(finer, form, list.spin,
                                         whirl == results::Whirl::backward ? -1 : 1);
        const FinerRoots found = finer_roots(own, rotor, problem);
        if (!found.matched)
            return {};
        for (std::size_t i = 0; i < own.size(); ++i) {
            const modes::WhirlMode &other = found.modes[i];
            errors[places[i]] =
                error_against(own[i], other.eigenvalue, other.residual + other.rounding);
        }
        if (!planar)
            break;
    }
    return errors;
}

} // namespace

std::vector<std::optional<results::ErrorParts>>
critical_errors(const assembly::Discretization &coarse, results::Form form,
                const SynchronousModes &modes, const assembly::Discretization &finer,
                const SynchronousModes &finer_modes) {
    const bool counted = modes.branches.size() == modes.modes.size() &&
                         finer_modes.branches.size() == finer_modes.modes.size();
    const Partners partners =
        counted ? by_branch(modes, finer_modes, form) : by_shape(coarse, modes, finer, finer_modes);
    std::vector<std::optional<results::ErrorParts>> errors;
    for (std::size_t i = 0; i < partners.size(); ++i) {
        errors.emplace_back();
        if (!partners[i])
            continue;
        const modes::WhirlMode &other = finer_modes.modes[*partners[i]];
        errors.back() =
            error_against(modes.modes[i], other.eigenvalue, other.residual + other.rounding);
    }
    return errors;
}

std::vector<results::ErrorParts> errors_by_finer_model(const assembly::Discretization &rotor,
                                                       results::Form form,
                                                       const SynchronousModes &list,
                                                       std::vector<results::Sentence> &notes) {
    constexpr results::ErrorParts unknown{std::numeric_limits<double>::infinity(), 0, 0};
    std::vector<results::ErrorParts> errors(list.modes.size(), unknown);
    if (list.modes.empty())
        return errors;
    if (rotor.rotor().shaft.rigid) {
        for (std::size_t i = 0; i < errors.size(); ++i)
            errors[i] = {0, 0, list.modes[i].residual + list.modes[i].rounding};
        return errors;
    }
    try {
        const assembly::Discretization finer(rotor.rotor(), mesh_error::finer_order(rotor.order()));
        std::vector<std::optional<results::ErrorParts>> found =
            errors_by_roots(list, rotor, finer, form);
        if (found.empty())
            found = critical_errors(
                rotor, form, list, finer,
                all_synchronous_modes(finer, form, static_cast<int>(list.modes.size()) + 2,
                                      list.modes.back().eigenvalue.imag(), nullptr, list.spin));
        for (std::size_t i = 0; i < errors.size(); ++i) {
            errors[i] = found[i].value_or(unknown);
            if (!found[i])
                notes.emplace_back(model::Weight::warning,
                                   "the critical speed of {} has no counterpart on a finer mesh "
                                   "(order {}): it may be spurious, and its error is not known",
                                   results::as::speed(list.spin * list.modes[i].eigenvalue.imag()),
                                   finer.order());
        }
    } catch (const linalg::SolverError &) {
        notes.emplace_back(model::Weight::warning,
                           "the errors of the critical speeds are not known, as the finer "
                           "mesh could not be solved");
    }
    return errors;
}

} // namespace whirl::synchronous
