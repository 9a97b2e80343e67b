#include "analyses/samples/answers.h"

#include "analyses/critical.h"
#include "analyses/response.h"
#include "analyses/simulate.h"
#include "analyses/stability.h"
#include "assembly/discretization.h"
#include "balancers/balanced_position.h"
#include "linalg/check.h"
#include "mesh_error/estimate.h"
#include "model/errors.h"
#include "model/variants.h"
#include "modes/formulation.h"
#include "modes/spectrum.h"
#include "process/processes.h"
#include "results/critical.h"
#include "results/damping.h"
#include "results/simulate.h"
#include "stability/rotor_at_speeds.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace whirl::analyses {

namespace {

using model::Quantity;

/// A rotor that is changed may have its n-th forward critical speed behind more backward ones: so
/// many more are looked for than the case asks for.
constexpr int spare_modes = 4;

constexpr double not_known = std::numeric_limits<double>::quiet_NaN();

/// Numbers what comes one after the other: of all, or of those of its kind.
class Names {
  public:
    explicit Names(Naming naming) : _naming(naming) {}

    std::string next(const std::string &kind) {
        return _naming == Naming::by_order ? fmt::format("{}", ++_count[""])
                                           : fmt::format("{} {}", kind, ++_count[kind]);
    }

  private:
    Naming _naming;
    std::map<std::string, int> _count;
};

/// Directions of asymmetric rotors count one by one.
std::vector<Answer> answers_of(const results::CriticalResult &result, const model::Case &scene,
                               Naming naming) {
    const bool directions = result.model.formulation.form == results::Form::rotating;
    const int modes = (directions ? 2 : 1) * scene.campbell.modes;
    const model::SpeedRange range = scene.speeds.value_or(model::SpeedRange{});
    const bool both_signs = range.from < 0 && range.to > 0;
    std::vector<results::CriticalSpeed> slowest_first = result.critical_speeds;
    std::ranges::stable_sort(slowest_first, {},
                             [](const auto &critical) { return std::abs(critical.speed); });
    std::vector<Answer> out;
    std::map<bool, Names> names{{false, Names(naming)}, {true, Names(naming)}}; // of negative ones
    std::map<bool, int> count;
    for (const results::CriticalSpeed &critical : slowest_first) {
        const bool negative = critical.speed < 0;
        const std::string name = (both_signs && negative ? "negative " : "") +
                                 names.at(negative).next(results::whirl_name(critical.whirl));
        const bool asked_for = count[negative]++ < modes || (negative ? critical.speed >= range.from
                                                                      : critical.speed <= range.to);
        out.push_back({.key = "critical " + name,
                       .of = "critical",
                       .name = name,
                       .quantity = Quantity::speed,
                       .value = critical.speed,
                       .asked_for = asked_for});
    }
    return out;
}

/// How far each critical speed that needs a margin is from the operating speeds, %; the least of
/// them first.
std::vector<Answer> margins_of(const results::CriticalResult &result, Naming naming) {
    std::vector<Answer> out;
    if (!result.margins || result.margins->empty())
        return out;
    const auto add = [&out](const std::string &name, double found) {
        out.push_back({.key = "margins " + name,
                       .of = "margins",
                       .name = name,
                       .behind = ", %",
                       .value = found});
    };
    add("the nearest",
        std::ranges::min(*result.margins, {}, &results::SeparationMargin::found).found);
    Names names(naming);
    for (const results::SeparationMargin &margin : *result.margins)
        add(names.next(margin.whirl ? results::whirl_name(*margin.whirl) : "peak"), margin.found);
    return out;
}

/// Errors of the speeds that `critical` lists.
void take_errors(const std::vector<results::CriticalSpeed> &judged, std::vector<Answer> &answers) {
    for (Answer &answer : answers)
        for (const results::CriticalSpeed &critical : judged)
            if (std::abs(critical.speed - answer.value) <= 1e-8 * std::abs(critical.speed))
                answer.error = critical.error;
}

std::vector<Answer> answers_of(const std::vector<results::ResponsePeak> &peaks) {
    std::vector<Answer> out;
    std::map<std::pair<std::string, int>, int> count;
    for (const results::ResponsePeak &peak : peaks) {
        const int number = ++count[{peak.of, peak.place}];
        const std::string key = fmt::format("peaks {} {} {}", peak.of, peak.place, number);
        const bool named = !peak.name.empty();
        const auto add = [&](const char *what, Quantity quantity, double value, double error) {
            out.push_back({fmt::format("{} {}", key, what), "peaks",
                           peak.of + " " + (named ? peak.name : "z = "),
                           named ? std::nullopt : std::optional(peak.z),
                           fmt::format(", peak {}, {}", number, what), quantity, value, true,
                           error});
        };
        add("speed", Quantity::speed, peak.speed, peak.speed_error);
        add("value", peak.of == "bearing" ? Quantity::force : Quantity::amplitude, peak.value,
            peak.error);
    }
    return out;
}

/// The machine at its operating speeds, which are all that is looked at.
results::ResponseResult operating_alone(model::Case scene) {
    const process::Alone alone; // each process has rotors of its own
    scene.limits.reset();
    scene.speeds = model::SpeedRange{scene.operation->to, scene.operation->to, 1};
    results::ResponseResult result = unbalance_response(scene);
    if (!result.operating || result.operating->rows.empty())
        throw model::BadInput(
            "imbalance: expected something that drives the rotor, as an [[imbalance]], "
            "for \"operating\", got a rotor without");
    return result;
}

std::vector<Answer> answers_of(const results::OperatingResponse &operating) {
    std::vector<Answer> out;
    std::map<std::string, int> count; // of the places at a speed
    for (const results::OperatingRow &row : operating.rows) {
        const std::string key = fmt::format("operating {} {}", row.at, ++count[row.at]);
        const bool named = !row.name.empty();
        // A bearing always is against what holds it; a probe where it is asked to be.
        const bool against = row.of == "probe" && row.relative;
        const auto add = [&](const char *what, Quantity quantity, double value) {
            out.push_back({fmt::format("{} {}", key, what), "operating",
                           row.of + " " + (named ? row.name : "z = "),
                           named ? std::nullopt : std::optional(row.z),
                           fmt::format("{}, {} speed, {}", against ? " against its pedestal" : "",
                                       row.at, what),
                           quantity, value, true, row.error});
        };
        add("amplitude", Quantity::amplitude, row.amplitude);
        if (row.force)
            add("force", Quantity::force, *row.force);
    }
    return out;
}

/// The border of the range is no end.
std::vector<Answer> answers_of(const UnstableBands &found, const model::SpeedRange &range) {
    std::vector<Answer> out;
    const auto add = [&](std::size_t band, const char *side, double speed, double error) {
        const std::string name = fmt::format("band {} {}", band + 1, side);
        if (speed > range.from && speed < range.to)
            out.push_back({.key = "ends " + name,
                           .of = "ends",
                           .name = name,
                           .quantity = Quantity::speed,
                           .value = speed,
                           .error = std::abs(error / speed)});
    };
    for (std::size_t i = 0; i < found.bands.size(); ++i) {
        const bool judged = i < found.errors.size();
        add(i, "from", found.bands[i].from, judged ? found.errors[i].first : not_known);
        add(i, "to", found.bands[i].to, judged ? found.errors[i].second : not_known);
    }
    return out;
}

/// What is left at the end of the motion in time.
std::vector<Answer> answers_of(const results::SimulateResult &motion) {
    std::vector<Answer> out;
    if (motion.residual_ratio)
        out.push_back({.key = "residual ratio",
                       .of = "residual",
                       .name = "amplitude over that without balls",
                       .value = *motion.residual_ratio});
    for (std::size_t i = 0; i < motion.balancers.size(); ++i) {
        const results::BalancerMotion &b = motion.balancers[i];
        const bool named = !b.name.empty();
        out.push_back({fmt::format("residual amplitude {}", i), "residual",
                       "amplitude at " + (named ? b.name : "z = "),
                       named ? std::nullopt : std::optional(b.z), "", Quantity::amplitude,
                       b.amplitude, true, not_known});
    }
    return out;
}

void append(std::vector<Answer> &all, const std::vector<Answer> &more) {
    all.insert(all.end(), more.begin(), more.end());
}

/// An order that is to be found is that of the case as it is.
model::Case with_order(model::Case scene, int order) {
    scene.rotor = model::with_order(std::move(scene.rotor), order);
    return scene;
}

/// Logarithmic decrements of the whirl modes with the lowest frequencies.
struct WhirlDamping {
    results::ModelSummary model;
    std::vector<Answer> answers;
};

/// @param order  of the elements; 0: to be found
/// @param at     spin speeds, rad/s
WhirlDamping damping_at(const model::Case &scene, int order, const std::vector<double> &at,
                        Naming naming) {
    WhirlDamping out;
    out.model.formulation = modes::choose_formulation(scene);
    out.model.order = order > 0 ? order : mesh_error::resolve_order(scene, out.model.formulation);
    const modes::SpectrumSolver solver(scene.rotor, out.model.formulation.form, out.model.order);
    if (!scene.reduction)
        solver.take_all_unknowns();
    out.model.elements = static_cast<int>(solver.discretization().shaft_mesh().spans.size());
    out.model.unknowns = solver.unknowns();
    for (const double speed : at) {
        Names names(naming);
        std::optional<double> least;
        const auto add = [&](const std::string &name, double log_dec) {
            out.answers.push_back({fmt::format("damping {} {}", speed, name), "damping",
                                   name + ", log dec at ", speed, "", Quantity::number, log_dec,
                                   true, not_known, Quantity::speed});
        };
        for (const modes::WhirlMode &mode : solver.at(speed, scene.campbell.modes).modes)
            if (const auto log_dec = results::damping_of(mode.eigenvalue).log_dec) {
                add("mode " + names.next(results::whirl_name(mode.whirl)), *log_dec);
                least = std::min(least.value_or(*log_dec), *log_dec);
            }
        if (least)
            add("least damped mode", *least);
    }
    return out;
}

/// By what the ends are looked for.
results::ModelSummary model_of_ends(const model::Case &scene) {
    const stability::StabilityModel used =
        stability::stability_model(scene, stability::search_speeds(model::required_speeds(scene)));
    results::ModelSummary model;
    model.formulation = used.formulation;
    model.order = used.order;
    const assembly::Discretization d(scene.rotor, used.order);
    model.elements = static_cast<int>(d.shaft_mesh().spans.size());
    model.unknowns = 2 * d.planar_size();
    return model;
}

} // namespace

Answers::Answers(const model::Case &scene, model::WantedAnswers wanted, Naming naming)
    : _wanted(std::move(wanted)), _naming(naming) {
    // The model of the first of them is shown; the notes are those of all.
    const auto take = [this](const results::ModelSummary &model,
                             const std::vector<Answer> &answers) {
        if (_model.order == 0)
            _model = model;
        else
            for (const results::Sentence &note : model.notes)
                if (std::ranges::find(_model.notes, note) == _model.notes.end())
                    _model.notes.push_back(note);
        append(_nominal, answers);
        return model.order;
    };
    if (_wanted.critical || _wanted.margins) {
        const results::CriticalResult result = critical_speeds(scene);
        std::vector<Answer> answers;
        if (_wanted.critical) {
            answers = answers_of(unjudged_critical_speeds(with_order(scene, result.model.order)),
                                 scene, naming);
            take_errors(result.critical_speeds, answers);
        }
        if (const auto &speeds = result.critical_speeds; !speeds.empty())
            _shapes = shapes_for_samples(scene, result.model.order,
                                         std::max(-speeds.front().speed, speeds.back().speed));
        append(answers, _wanted.margins ? margins_of(result, naming) : std::vector<Answer>{});
        _critical_order = take(result.model, answers);
    }
    if (_wanted.peaks) {
        const results::ResponseResult result = response_peaks(scene, true);
        _peaks_order = take(result.model, answers_of(result.peaks));
    }
    if (_wanted.operating) {
        const results::ResponseResult result = operating_alone(scene);
        _operating_order = take(result.model, answers_of(*result.operating));
    }
    if (_wanted.damping) {
        const WhirlDamping found = damping_at(scene, 0, _wanted.at, naming);
        _damping_order = take(found.model, found.answers);
    }
    if (_wanted.ends)
        _ends_order =
            take(model_of_ends(scene), answers_of(unstable_bands_of(scene, true), *scene.speeds));
    if (_wanted.residual) {
        if (scene.rotor.balancers.empty())
            throw model::BadInput("balancer: expected a [[balancer]] whose residual to look at, "
                                  "got a rotor without");
        const results::SimulateResult motion = simulate_alone(scene);
        _motion_order = take(motion.model, answers_of(motion));
    }
}

std::vector<Answer> Answers::of(const model::Case &scene) const {
    std::vector<Answer> out;
    if (_wanted.critical || _wanted.margins) {
        const model::Case own = with_order(scene, _critical_order);
        model::Case more = own;
        more.campbell.modes += spare_modes;
        results::CriticalResult result =
            unjudged_critical_speeds(more, _shapes ? &*_shapes : nullptr);
        if (_wanted.margins)
            add_separation_margins(own, result);
        if (_wanted.critical)
            append(out, answers_of(result, scene, _naming));
        append(out, margins_of(result, _naming));
    }
    if (_wanted.peaks) {
        const model::Case own = with_order(scene, _peaks_order);
        append(out, answers_of(response_peaks(own, false).peaks));
    }
    if (_wanted.operating)
        append(out, answers_of(*operating_alone(with_order(scene, _operating_order)).operating));
    if (_wanted.damping)
        append(out, damping_at(scene, _damping_order, _wanted.at, _naming).answers);
    if (_wanted.ends) {
        const model::Case own = with_order(scene, _ends_order);
        append(out, answers_of(unstable_bands_of(own, false), model::required_speeds(own)));
    }
    if (_wanted.residual)
        append(out, answers_of(simulate_alone(with_order(scene, _motion_order))));
    return out;
}

} // namespace whirl::analyses
