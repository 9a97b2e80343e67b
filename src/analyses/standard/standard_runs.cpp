#include "analyses/standard/standard_runs.h"

#include "analyses/critical.h"
#include "analyses/modes.h"
#include "analyses/response.h"
#include "linalg/check.h"
#include "model/errors.h"
#include "model/variants.h"
#include "operation/doubt.h"
#include "operation/margins.h"
#include "process/progress.h"
#include "results/resonances.h"

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

namespace whirl::analyses {

namespace {

namespace as = results::as;
using model::BearingFit;
using operation::PlacedUnbalance;
using results::Sentence;
using results::StandardRun;

/// A shape in the direction, x or y, in which it moves most, at the moment when it does.
operation::PlaneShape in_its_plane(const results::ModeShape &shape, const std::vector<double> &z) {
    const auto largest = [](const std::vector<std::complex<double>> &values) {
        return *std::ranges::max_element(values, {}, [](const auto &v) { return std::abs(v); });
    };
    operation::PlaneShape out{shape.at, z, {}};
    const std::complex<double> x = largest(shape.x);
    const std::complex<double> y = largest(shape.y);
    const bool along_x = std::abs(x) >= std::abs(y);
    const std::complex<double> most = along_x ? x : y;
    for (const std::complex<double> &value : along_x ? shape.x : shape.y)
        out.w.push_back((value / most).real());
    return out;
}

/// The critical speeds from rest to that up to which they matter, with their shapes, and of the
/// lowest whirl modes where none is that low.
model::Case for_shapes(model::Case scene) {
    constexpr int lowest = 4; // a forward one among them
    scene.speeds = model::SpeedRange{0, operation::highest_relevant_speed(*scene.operation), 2};
    scene.modes.speed.reset();
    scene.campbell.modes = lowest;
    return scene;
}

/// With the nodes that the weights of a run make.
void find_critical_speeds(const model::Case &scene, StandardRun &run) {
    try {
        run.critical_speeds = listed_critical_speeds(scene);
    } catch (const model::AnalysisFailure &failure) {
        run.notes.emplace_back("margins of the peaks alone: {}", failure.sentence());
    } catch (const linalg::SolverError &failure) {
        run.notes.emplace_back("margins of the peaks alone: {}", failure.sentence());
    }
}

/// The imbalances of all runs; the case's own without [standard] unbalance.
std::vector<PlacedUnbalance> wanted_unbalance(const model::Case &scene) {
    if (scene.standard->api617)
        return standard_unbalance(scene);
    return {{"imbalance of the case", scene.rotor.imbalances, {}}};
}

void add_runs(results::ResponseResult &result, const model::Case &scene,
              const std::vector<PlacedUnbalance> &wanted) {
    const auto &fits = scene.standard->fits;
    const auto all = static_cast<double>(fits.size() * wanted.size());
    std::size_t done = 0;
    for (const BearingFit fit : fits) {
        for (const PlacedUnbalance &placed : wanted) {
            StandardRun run;
            run.name = placed.name;
            run.fit = fit;
            run.placed_by = placed.critical_speeds;
            run.unbalance = placed.imbalances;
            const model::Case own_scene = scene_of_run(scene, run);
            const process::Stage stage(Sentence("{}", run.name), static_cast<double>(done) / all,
                                       static_cast<double>(done + 1) / all);
            ++done;
            find_critical_speeds(own_scene, run);
            results::ResponseResult own = response_in_operation(own_scene, run.critical_speeds);
            run.peaks = std::move(own.peaks);
            static_cast<void>(results::resonances_of(run.peaks));
            if (own.margins)
                run.margins = std::move(*own.margins);
            run.notes.insert(run.notes.end(), own.model.notes.begin(), own.model.notes.end());
            if (own.operating)
                run.operating = std::move(*own.operating);
            result.runs.push_back(std::move(run));
        }
    }
}

/// Of limits broken or kept, with what share of it is used.
struct Used {
    bool fails = false;
    double share = -1;
    const results::OperatingWorst *worst = nullptr; ///< none: there are no limits
    double amplitude = -1;
    const results::OperatingRow *row = nullptr;

    [[nodiscard]] std::tuple<bool, double, double> order() const {
        return {fails, share, amplitude};
    }
};

Used used_by(const StandardRun &run) {
    Used used;
    for (const results::OperatingWorst &worst : run.operating.worst) {
        const double share = worst.value / worst.limit;
        const bool fails = worst.pass.has_value() && !*worst.pass;
        if (std::isnan(share) || std::pair(fails, share) <= std::pair(used.fails, used.share))
            continue;
        used.fails = fails;
        used.share = share;
        used.worst = &worst;
    }
    for (const results::OperatingRow &row : run.operating.rows)
        if (row.amplitude > used.amplitude) {
            used.amplitude = row.amplitude;
            used.row = &row;
        }
    return used;
}

Sentence place_of(const results::OperatingPlace &place) {
    return results::place_in_words(place.of.c_str(), place.name, place.z);
}

/// The run that breaks or uses most of a limit; without limits that which moves the rotor most.
void name_worst(results::ResponseResult &result) {
    Used most;
    for (std::size_t i = 0; i < result.runs.size(); ++i)
        if (const Used used = used_by(result.runs[i]);
            used.row != nullptr && (!result.worst_run || used.order() > most.order())) {
            most = used;
            result.worst_run = i;
        }
    if (!result.worst_run)
        return;
    const Sentence name = results::run_name(result.runs[*result.worst_run]);
    if (most.worst != nullptr) {
        const model::ValueOf as_value{results::measure_quantity(most.worst->what)};
        const auto said = [&](double value) {
            if (std::isinf(value))
                return Sentence("without limit");
            return most.worst->what == results::Measure::clearance_share
                       ? Sentence("{} %", as::number(100 * value, 4))
                       : Sentence("{}", as_value(value, 4));
        };
        result.worst_run_text = {
            "{}: {}, {} {} of {} at {}",    name,
            place_of(*most.worst),          results::measure_name(most.worst->what),
            said(most.worst->value),        said(most.worst->limit),
            as::speed(most.worst->speed, 5)};
        return;
    }
    result.worst_run_text = {"{}: {} moves most, {} at {}", name, place_of(*most.row),
                             std::isinf(most.amplitude)
                                 ? Sentence("without limit")
                                 : Sentence("{}", as::amplitude(most.amplitude, 4)),
                             as::speed(most.row->speed, 5)};
}

void add_notes(results::ResponseResult &result, const model::Case &scene) {
    auto &notes = result.model.notes;
    if (scene.standard->api617)
        notes.emplace_back(
            model::Weight::information, "{}",
            result.of_first_run
                ? Sentence("the case has no [[imbalance]]: curves, tables and pictures beside the "
                           "standard runs are those of the first, {}",
                           result.runs.front().name)
                : Sentence("the imbalances of the case are not in the standard runs"));
}

} // namespace

std::vector<PlacedUnbalance> standard_unbalance(const model::Case &scene) {
    const results::ModesResult modes = mode_shapes(for_shapes(scene));
    const double highest = operation::highest_relevant_speed(*scene.operation);
    const bool backward_too = !scene.rotor.bearings_rotation_invariant();
    std::vector<operation::PlaneShape> shapes;
    std::vector<operation::PlaneShape> above;
    for (const results::ModeShape &shape : modes.critical)
        if (shape.at > 0 && (backward_too || shape.whirl != results::Whirl::backward))
            (shape.at <= highest ? shapes : above).push_back(in_its_plane(shape, modes.z));
    if (shapes.empty() && !above.empty())
        shapes.push_back(*std::ranges::min_element(above, {}, &operation::PlaneShape::speed));
    return operation::api617_unbalance(scene.rotor, scene.operation->to, shapes);
}

model::Case scene_of_run(model::Case scene, const StandardRun &run) {
    scene.rotor = model::with_fit(std::move(scene.rotor), run.fit);
    scene.rotor.imbalances = run.unbalance;
    return scene;
}

results::ResponseResult response_with_runs(const model::Case &scene) {
    if (!scene.standard)
        return unbalance_response(scene);
    std::vector<PlacedUnbalance> wanted;
    {
        const process::Stage stage("imbalances of the standard runs", 0, 0.1);
        wanted = wanted_unbalance(scene);
    }
    model::Case own = scene;
    const bool of_first_run = own.rotor.imbalances.empty() && !wanted.empty();
    if (of_first_run)
        own.rotor.imbalances = wanted.front().imbalances;
    results::ResponseResult result;
    {
        const process::Stage stage("response", 0.1, 0.5);
        result = unbalance_response(own);
    }
    if (result.speeds.empty())
        return result; // not process 0
    result.of_first_run = of_first_run;
    if (wanted.empty()) {
        result.no_runs = {"no shape of a critical speed was found that imbalances could be placed "
                          "by"};
        result.model.notes.emplace_back("no standard runs: {}", result.no_runs);
        return result;
    }
    const process::Stage stage("standard runs", 0.5, 1);
    add_runs(result, scene, wanted);
    name_worst(result);
    add_notes(result, scene);
    return result;
}

} // namespace whirl::analyses
