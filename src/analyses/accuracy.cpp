#include "analyses/accuracy.h"

#include "assembly/discretization.h"
#include "mesh_error/safety.h"
#include "model/case.h"
#include "model/errors.h"
#include "model/mass.h"
#include "modes/formulation.h"
#include "modes/spectrum.h"
#include "process/progress.h"
#include "results/accuracy.h"
#include "results/formulation.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <complex>
#include <map>
#include <utility>

namespace whirl::analyses {

namespace {

using Eigenvalues = std::vector<std::complex<double>>;

/// Unknowns that a row of the ladder and the reference take at most.
struct Limits {
    int row, reference;
};

/// A shaft of hardly any mass has elastic motions so fast that in rotating axes the slow ones can
/// be told from them by full matrices alone: their cost rises with the cube of the unknowns.
bool by_full_matrices(const model::Rotor &rotor, results::Form form) {
    constexpr double hardly = 1e-6;
    return results::in_rotating_axes(form) &&
           model::mass_of(rotor.shaft) < hardly * model::mass_of_shaft_and_discs(rotor);
}

/// The scene at one speed, on any mesh.
struct Study {
    const model::Rotor &rotor;
    results::Form form;
    double speed;
    int modes;
    /// Those found before, by order and refinement: a finer mesh of one row is another row.
    mutable std::map<std::pair<int, int>, Eigenvalues> known = {};

    /// Eigenvalues with the lowest frequencies, ascending by frequency.
    [[nodiscard]] Eigenvalues eigenvalues(const modes::SpectrumSolver &solver, double at) const {
        Eigenvalues values;
        for (const modes::WhirlMode &mode : solver.at(at, modes).modes)
            values.push_back(mode.eigenvalue);
        values.resize(std::min(values.size(), static_cast<std::size_t>(modes)));
        return values;
    }

    [[nodiscard]] const Eigenvalues &eigenvalues(int order, int refinement) const {
        const std::pair mesh(order, refinement);
        const auto found = known.find(mesh);
        if (found != known.end())
            return found->second;
        const modes::SpectrumSolver solver(rotor, form, order, refinement);
        solver.take_all_unknowns();
        return known.emplace(mesh, eigenvalues(solver, speed)).first->second;
    }

    [[nodiscard]] Limits limits() const {
        return by_full_matrices(rotor, form) ? Limits{110, 180} : Limits{12000, 36000};
    }

    /// Whether a row, and the finer mesh that tells its error, are within the limits.
    [[nodiscard]] bool affordable(int order, int refinement) const {
        return unknowns(order, refinement) <= limits().row &&
               unknowns(mesh_error::finer_order(order), refinement) <= limits().reference;
    }

    [[nodiscard]] int spans(int refinement) const {
        return static_cast<int>(mesh::make_mesh(rotor, refinement).spans.size());
    }

    /// Unknowns of the eigenproblem, pedestals aside.
    [[nodiscard]] int unknowns(int order, int refinement) const {
        const int inside = order == 1 ? 0 : 2 * order - 1;
        const int planar = spans(refinement) * (2 + inside) + 2;
        return results::is_planar(form) ? planar : 2 * planar;
    }
};

/// Largest relative difference of two lists of eigenvalues ascending by frequency; empty where
/// the first has fewer than the second. Damped modes of nearly equal frequency may stand in
/// different order: neighbours are exchanged where that brings them closer. Zero frequencies
/// (free motions) are measured by the lowest other one.
std::optional<double> largest_difference(Eigenvalues values, const Eigenvalues &exact) {
    if (values.size() < exact.size())
        return std::nullopt;
    for (std::size_t i = 0; i + 1 < exact.size(); ++i) {
        const double as_is =
            std::abs(values[i] - exact[i]) + std::abs(values[i + 1] - exact[i + 1]);
        const double other =
            std::abs(values[i + 1] - exact[i]) + std::abs(values[i] - exact[i + 1]);
        if (other < as_is)
            std::swap(values[i], values[i + 1]);
    }
    double lowest = 0;
    for (const std::complex<double> &value : exact)
        if (std::abs(value) > 0 && (lowest == 0 || std::abs(value) < lowest))
            lowest = std::abs(value);
    double largest = 0;
    for (std::size_t i = 0; i < exact.size(); ++i) {
        const double size = std::max(std::abs(exact[i]), lowest);
        if (size > 0)
            largest = std::max(largest, std::abs(values[i] - exact[i]) / size);
    }
    return largest;
}

/// Modes that stand still in rotating axes, with or without damping: their frequency is the spin
/// speed. Where balls are free to turn there are several, and two real eigenvalues stand for one
/// mode: rounding says which of them.
bool stands_still(const Study &study, std::complex<double> value) {
    constexpr double still = 1e-6;
    return results::in_rotating_axes(study.form) &&
           std::abs(value.imag() - std::abs(study.speed)) < still * std::abs(study.speed);
}

/// How many of them are no measure of an error: all, where there is more than one.
std::size_t left_out(const Study &study, const Eigenvalues &values) {
    const auto count = std::ranges::count_if(
        values, [&](const auto &value) { return stands_still(study, value); });
    return count > 1 ? static_cast<std::size_t>(count) : 0;
}

/// largest_difference() of the modes that are the same ones on every mesh.
std::optional<double> difference(const Study &study, Eigenvalues values, Eigenvalues exact) {
    if (left_out(study, exact) > 0)
        for (Eigenvalues *list : {&values, &exact})
            std::erase_if(*list, [&](const auto &value) { return stands_still(study, value); });
    return largest_difference(std::move(values), exact);
}

/// Of the order that tells the error of another one, on the same elements: from an order so much
/// higher than the row's they are those of halved elements long before the row's are.
/// @param values  of the row
const Eigenvalues &finer_eigenvalues(const Study &study, int order, int refinement,
                                     const Eigenvalues &values) {
    constexpr double settled = 1e-3; // of the difference from the row
    const int finer = mesh_error::finer_order(order);
    for (int coarse = 2; coarse < refinement; coarse *= 2) {
        const Eigenvalues &here = study.eigenvalues(finer, coarse);
        const auto change = difference(study, study.eigenvalues(finer, coarse / 2), here);
        const auto distance = difference(study, values, here);
        if (change && distance && *change < settled * *distance)
            return here;
    }
    return study.eigenvalues(finer, refinement);
}

/// Best of three: the others were disturbed by the machine. Long runs, of which it takes little
/// away, are not repeated.
results::AccuracyRow timed_row(const Study &study, int order, int refinement) {
    results::AccuracyRow row{
        order == 1 ? "classical" : "order-p", order, study.spans(refinement), "full", 0, 0, {}, {}};
    constexpr double long_run = 0.05;
    for (int run = 0; run < 3 && row.seconds < long_run; ++run) {
        const auto start = std::chrono::steady_clock::now();
        const modes::SpectrumSolver solver(study.rotor, study.form, order, refinement);
        solver.take_all_unknowns();
        study.known[{order, refinement}] = study.eigenvalues(solver, study.speed);
        const double seconds =
            std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
        row.seconds = run == 0 ? seconds : std::min(row.seconds, seconds);
        row.unknowns = solver.unknowns();
    }
    return row;
}

struct Reference {
    int order = 0;
    int refinement = 0;
    Eigenvalues values;
    std::optional<double> converged; ///< difference from the run two orders lower
};

results::AccuracyRow measured_row(const Study &study, int order, int refinement,
                                  const Reference &reference) {
    results::AccuracyRow row = timed_row(study, order, refinement);
    const Eigenvalues &values = study.eigenvalues(order, refinement);
    row.error_estimate =
        difference(study, values, finer_eigenvalues(study, order, refinement, values));
    if (row.error_estimate)
        *row.error_estimate *= mesh_error::estimate_safety;
    // Against an order-p mesh as fine as the reference itself a difference says nothing.
    const int of_reference = study.unknowns(reference.order, reference.refinement);
    if (order == 1 || study.unknowns(order, refinement) < of_reference)
        row.true_error = difference(study, values, reference.values);
    return row;
}

/// The same mesh by few shapes over a sweep, refined, as `campbell` does: the time of one of its
/// speeds. None where the form is not solved so.
std::optional<results::AccuracyRow> refined_row(const Study &study,
                                                const std::vector<double> &speeds,
                                                const results::AccuracyRow &full, int refinement,
                                                const Reference &reference) {
    const auto start = std::chrono::steady_clock::now();
    const modes::SpectrumSolver solver(study.rotor, study.form, full.order, refinement);
    if (!solver.refines())
        return std::nullopt;
    solver.expect(speeds, study.modes);
    Eigenvalues values;
    for (const double speed : speeds) {
        Eigenvalues here = study.eigenvalues(solver, speed);
        if (speed == study.speed)
            values = std::move(here);
    }
    const std::chrono::duration<double> passed = std::chrono::steady_clock::now() - start;
    results::AccuracyRow row = full;
    row.method = "reduced";
    row.seconds = passed.count() / static_cast<double>(speeds.size());
    if (full.true_error)
        row.true_error = difference(study, std::move(values), reference.values);
    return row;
}

/// Speeds of the range, with its ends; none where it is one speed.
std::vector<double> sweep_of(model::SpeedRange range) {
    constexpr int most = 25; // enough for what is done once to be a small part
    range.count = std::min(range.count, most);
    return range.count > 1 ? range.values() : std::vector<double>();
}

Reference reference_at(const Study &study, int order, int refinement) {
    Reference reference{order, refinement, study.eigenvalues(order, refinement), {}};
    reference.converged =
        difference(study, study.eigenvalues(order - 2, refinement), reference.values);
    return reference;
}

/// The finest mesh that the limit of unknowns allows and the eigensolver masters; order 16 on
/// halved elements as a rule.
Reference make_reference(const Study &study) {
    for (const auto &[order, refinement] : {std::pair(16, 2), std::pair(12, 2), std::pair(16, 1),
                                            std::pair(12, 1), std::pair(8, 1), std::pair(6, 1)}) {
        if (study.unknowns(order, refinement) > study.limits().reference)
            continue;
        try {
            return reference_at(study, order, refinement);
        } catch (const model::AnalysisFailure &) { // a smaller one may do
        }
    }
    return reference_at(study, 4, 1);
}

/// Order and refinement of every row. The coarsest of each family stays whatever its size.
std::vector<std::pair<int, int>> ladder(const Study &study) {
    std::vector<std::pair<int, int>> rungs{{1, 1}};
    for (int refinement = 2; refinement <= 64; refinement *= 2)
        if (study.unknowns(1, 2 * refinement) <= study.limits().row &&
            study.affordable(1, refinement))
            rungs.emplace_back(1, refinement);
    for (const int refinement : {1, 2})
        for (const int order : {2, 3, 4, 6, 8, 10, 12})
            if (study.affordable(order, refinement))
                rungs.emplace_back(order, refinement);
    return rungs;
}

void describe(results::AccuracyResult &result, const Study &study, const Reference &reference) {
    result.model.order = reference.order;
    result.model.elements = study.spans(reference.refinement);
    result.model.unknowns = study.unknowns(reference.order, reference.refinement);
    result.reference = fmt::format("order {} on {} elements ({} unknowns)", reference.order,
                                   result.model.elements, result.model.unknowns);
    if (reference.converged)
        result.reference += fmt::format("; order {} differs from it by {:.1e}", reference.order - 2,
                                        *reference.converged);
    if (const std::size_t still = left_out(study, reference.values); still > 0)
        result.model.notes.emplace_back(
            "errors are those of the other {} modes: {} stand still in the rotor, as balls do that "
            "are free to turn in it",
            reference.values.size() - still, still);
    for (const std::complex<double> &value : reference.values)
        result.reference_frequencies.push_back(value.imag());
}

} // namespace

results::AccuracyResult accuracy(const model::Case &scene) {
    constexpr int most_refined = 450; // unknowns: more would only cost a study its time

    if (scene.rotor.shaft.rigid)
        throw model::BadInput(fmt::format("{}: shaft.rigid: expected false for a study of the "
                                          "discretisation error, got true",
                                          scene.file.string()));
    const model::SpeedRange &range = model::required_speeds(scene);
    results::AccuracyResult result;
    result.model.formulation = modes::choose_formulation(scene);
    result.speed = range.count == 1 ? range.from : range.to;
    const Study study{scene.rotor, result.model.formulation.form, result.speed,
                      scene.campbell.modes};
    const Reference reference = make_reference(study);
    describe(result, study, reference);
    if (by_full_matrices(scene.rotor, study.form))
        result.model.notes.emplace_back(
            "meshes of more than {} unknowns are left out: with a shaft of hardly any mass each "
            "takes, in rotating axes, the eigenvalues of a full matrix",
            study.limits().row);
    const std::vector<double> sweep = sweep_of(range);
    const std::vector<std::pair<int, int>> rungs = ladder(study);
    for (std::size_t i = 0; i < rungs.size(); ++i) {
        const auto &[order, refinement] = rungs[i];
        try {
            result.rows.push_back(measured_row(study, order, refinement, reference));
            if (!sweep.empty() && (order == 1 || refinement == 1) &&
                result.rows.back().unknowns <= most_refined)
                if (auto row = refined_row(study, sweep, result.rows.back(), refinement, reference))
                    result.rows.push_back(std::move(*row));
        } catch (const model::AnalysisFailure &failure) {
            result.model.notes.emplace_back("order {}, refinement {} left out: {}", order,
                                            refinement, failure.sentence());
        }
        process::report_progress(static_cast<double>(i + 1) / static_cast<double>(rungs.size()));
    }
    return result;
}

} // namespace whirl::analyses
