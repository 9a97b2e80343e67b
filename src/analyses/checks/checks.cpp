#include "analyses/checks/checks.h"

#include "model/variants.h"
#include "operation/doubt.h"
#include "operation/level1_verdict.h"
#include "operation/limits.h"
#include "operation/margins.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

namespace whirl::analyses {

namespace {

namespace as = results::as;
using operation::Doubt;
using operation::doubt_of_rotor;
using results::Check;
using results::Interval;
using results::Measure;
using results::OperatingWorst;
using results::place_in_words;
using results::Sentence;
using results::SeparationMargin;

constexpr double infinite = std::numeric_limits<double>::infinity();

Check not_judged(const char *name, const Sentence &why, const std::string &source = "",
                 const Sentence &where = {}) {
    Check check;
    check.name = name;
    check.source = source;
    check.why = why;
    check.where = where;
    return check;
}

void reset(Check &check, const Sentence &why) {
    check.pass.reset();
    check.why = why;
}

Sentence or_else(const Sentence &reason, const char *otherwise) {
    return reason.empty() ? Sentence(otherwise) : reason;
}

const char *const margin_name = "separation margin";
const char *const factor_name = "amplification factor of a critical speed at operating speeds";
const char *const api617 = "API 617";

Check check_of(const SeparationMargin &margin) {
    Check check;
    check.source = api617;
    check.pass = margin.passes;
    check.where = Sentence("{} at {}", margin.source == "damping" ? "critical speed" : "peak",
                           as::speed(margin.speed));
    if (margin.z)
        check.where += Sentence(", {}", place_in_words(margin.of == "probe" ? "probe" : "station",
                                                       margin.name, *margin.z));
    if (margin.side == results::MarginSide::inside) {
        check.name = factor_name;
        check.value = margin.amplification.value_or(infinite);
        check.limit = results::Damping::least_amplification;
        return check;
    }
    check.name = margin_name;
    check.percent = check.at_least = true;
    check.value = margin.found / 100;
    if (margin.required)
        check.limit = *margin.required / 100;
    if (!margin.passes && check.limit && *check.value >= *check.limit)
        check.where += margin.grows ? Sentence(", where a free motion grows")
                                    : Sentence(", which the machine reaches before it trips");
    return check;
}

/// Peaks were looked for wherever one could be too near.
bool speeds_cover(const model::Case &scene) {
    const model::Operation &operation = *scene.operation;
    constexpr double rounding = 1e-9;
    return scene.speeds && scene.speeds->count > 1 &&
           scene.speeds->from <= operation::lowest_relevant_speed(operation) * (1 + rounding) &&
           scene.speeds->to >= operation::highest_relevant_speed(operation) * (1 - rounding);
}

void apply(const Doubt &doubt, Check &check) {
    if (!doubt.why.empty() && (doubt.either_way || check.pass.value_or(false)))
        reset(check, doubt.why);
}

/// Whether a margin belongs to a critical speed: a damped peak is some way off, the farther the
/// more it is damped.
bool covers(const SeparationMargin &margin, const results::CriticalSpeed &critical) {
    constexpr double near = 0.05;
    const double width =
        critical.damping.amplification ? 0.5 / *critical.damping.amplification : 0.0;
    return std::abs(margin.speed - critical.speed) <= (near + width) * critical.speed;
}

/// Where critical speeds may be missing in a list.
void add_missing_criticals(std::vector<Check> &checks, const results::CriticalResult &critical,
                           double highest) {
    if (critical.complete.to < highest)
        checks.push_back(not_judged(margin_name,
                                    {"critical speeds are known up to {}, and could be too near up "
                                     "to {}",
                                     as::speed(critical.complete.to), as::speed(highest)},
                                    api617));
    for (const Interval &doubtful : critical.doubtful)
        if (doubtful.to > 0 && doubtful.from < highest)
            checks.push_back(not_judged(margin_name,
                                        {"critical speeds from {} may be missing",
                                         as::speed.range(doubtful.from, doubtful.to)},
                                        api617));
}

/// How bad a check is: fails, is not judged, passes; then what is left up to the limit.
std::pair<int, double> badness(const Check &check) {
    const int rank = !check.pass ? 1 : *check.pass ? 2 : 0;
    return {rank, check.margin().value_or(rank == 0 ? -infinite : infinite)};
}

/// A response that is judged: that of the case, or a standard run.
struct Run {
    model::Case scene;
    Sentence name; ///< empty: there are no others
    model::BearingFit fit = model::BearingFit::given;
    const std::vector<SeparationMargin> *margins = nullptr;
    const std::vector<results::ResponsePeak> *peaks = nullptr;
    const std::vector<results::CriticalSpeed> *critical_speeds = nullptr;
    const results::OperatingResponse *operating = nullptr;
};

/// The response of the case, and its standard runs. That of the case is none of its own where it
/// only has the imbalances of a run.
std::vector<Run> runs_of(const model::Case &scene, const Computed &computed) {
    std::vector<Run> runs;
    const results::ResponseResult *response = computed.response;
    const bool several = response != nullptr && !response->runs.empty();
    if (!several || !response->of_first_run) {
        Run &own = runs.emplace_back();
        own.scene = scene;
        if (several)
            own.name = {"imbalance of the case"};
        if (response != nullptr && response->margins)
            own.margins = &*response->margins;
        else if (computed.critical != nullptr && computed.critical->margins)
            own.margins = &*computed.critical->margins;
        if (response != nullptr) {
            own.peaks = &response->peaks;
            own.operating = response->operating ? &*response->operating : nullptr;
        }
        if (computed.critical != nullptr)
            own.critical_speeds = &computed.critical->critical_speeds;
    }
    if (!several)
        return runs;
    for (const results::StandardRun &one : response->runs) {
        Run &run = runs.emplace_back();
        run.scene = scene;
        run.scene.rotor = model::with_fit(scene.rotor, one.fit);
        run.scene.rotor.imbalances = one.unbalance;
        run.fit = one.fit;
        run.name = results::run_name(one);
        run.margins = &one.margins;
        run.peaks = &one.peaks;
        run.critical_speeds = &one.critical_speeds;
        run.operating = &one.operating;
    }
    return runs;
}

void name_run(Check &check, const Run &run) {
    if (!run.name.empty())
        check.where += Sentence("{}{}", check.where.empty() ? "" : ", ", run.name);
}

/// The margins of all runs: of each critical speed and place that of the worst.
class WorstMargins {
  public:
    void add(const SeparationMargin &margin, const Check &check, const Run &run) {
        constexpr double near = 0.05; // peaks of one critical speed in several runs
        Group *best = nullptr;
        const auto off = [&margin](const Group &group) {
            return std::abs(group.margin.speed - margin.speed);
        };
        for (Group &group : _groups)
            if (group.last != &run && same_place(group.margin, margin) &&
                off(group) <= near * margin.speed && (!best || off(group) < off(*best)))
                best = &group;
        if (best == nullptr) {
            _groups.push_back({margin, check, &run});
            return;
        }
        best->last = &run;
        if (badness(check) < badness(best->check))
            best->check = check;
    }

    [[nodiscard]] std::vector<Check> checks() const {
        std::vector<Check> out;
        for (const Group &group : _groups)
            out.push_back(group.check);
        return out;
    }

  private:
    struct Group {
        SeparationMargin margin;
        Check check;
        const Run *last;
    };
    std::vector<Group> _groups;

    static bool same_place(const SeparationMargin &a, const SeparationMargin &b) {
        return a.side == b.side && a.of == b.of && a.z == b.z && a.name == b.name &&
               a.angle == b.angle;
    }
};

/// Critical speeds that could be too near and have no margin of their own: their damping is not
/// known, or the peak that was seen next to them is that of another, broader motion. A backward one
/// that no peak shows needs none.
void add_uncovered_criticals(std::vector<Check> &checks, const std::vector<Run> &runs,
                             const Run &of, double lowest, double highest) {
    const auto covered = [&](const results::CriticalSpeed &one) {
        return std::ranges::any_of(runs, [&](const Run &run) {
            return run.fit == of.fit && run.margins != nullptr &&
                   std::ranges::any_of(*run.margins,
                                       [&one](const auto &margin) { return covers(margin, one); });
        });
    };
    for (const results::CriticalSpeed &one : *of.critical_speeds) {
        const bool known = one.damping.known();
        if (one.speed < lowest || one.speed > highest || (known && one.damping.heavy()) ||
            (known && one.whirl == results::Whirl::backward) || covered(one))
            continue;
        checks.push_back(not_judged(
            margin_name,
            known ? Sentence("the {} critical speed {} is little damped (amplification factor {}), "
                             "and no peak of its own was seen",
                             results::whirl_name(one.whirl), as::speed(one.speed),
                             one.damping.amplification
                                 ? Sentence("{}", as::number(*one.damping.amplification, 4))
                                 : Sentence("without limit"))
                  : Sentence("the damping of the {} critical speed {} is not known, and no peak of "
                             "its own was seen",
                             results::whirl_name(one.whirl), as::speed(one.speed)),
            api617));
        if (of.fit != model::BearingFit::given)
            checks.back().where = {"clearance {}", model::fit_name(of.fit)};
    }
}
/// Of each clearance once.
void add_uncovered_criticals(std::vector<Check> &checks, const std::vector<Run> &runs,
                             double lowest, double highest) {
    std::vector<model::BearingFit> done;
    for (const Run &run : runs)
        if (run.critical_speeds != nullptr && std::ranges::find(done, run.fit) == done.end()) {
            done.push_back(run.fit);
            add_uncovered_criticals(checks, runs, run, lowest, highest);
        }
}

/// Another run with this clearance has the margin of the peak: a resonance that one run hardly
/// excites has its factor from one that does.
bool known_elsewhere(const results::ResponsePeak &peak, const std::vector<Run> &runs,
                     const Run &run) {
    constexpr double near = 0.05; // as of WorstMargins
    return std::ranges::any_of(runs, [&](const Run &other) {
        return &other != &run && other.fit == run.fit && other.margins != nullptr &&
               std::ranges::any_of(*other.margins, [&peak](const SeparationMargin &margin) {
                   return margin.of == peak.of && margin.z == peak.z && margin.name == peak.name &&
                          margin.angle == peak.angle &&
                          std::abs(margin.speed - peak.speed) <= near * peak.speed;
               });
    });
}

/// Peaks whose margin would count and is not known.
void add_peaks_without_factor(std::vector<Check> &checks, const std::vector<Run> &runs,
                              const Run &run, const model::Operation &operation) {
    if (run.critical_speeds == nullptr || run.peaks == nullptr)
        return;
    for (const results::ResponsePeak *peak :
         operation::peaks_without_factor(operation, *run.critical_speeds, *run.peaks)) {
        if (known_elsewhere(*peak, runs, run))
            continue;
        checks.push_back(not_judged(
            margin_name,
            {"the curve does not come down to the half-power points on both sides of the peak, "
             "and without them it has no amplification factor"},
            api617,
            {"peak at {}, {}", as::speed(peak->speed),
             place_in_words(peak->of, peak->name, peak->z)}));
        name_run(checks.back(), run);
    }
}

void add_margins(std::vector<Check> &checks, const model::Case &scene, const Computed &computed) {
    const std::vector<Run> runs = runs_of(scene, computed);
    if (runs.front().margins == nullptr) {
        checks.push_back(not_judged(
            margin_name,
            or_else(computed.no_critical.empty() ? computed.no_response : computed.no_critical,
                    "critical speeds were not computed"),
            api617));
        return;
    }
    const model::Operation &operation = *scene.operation;
    const double highest = operation::highest_relevant_speed(operation);
    const double lowest = operation::lowest_relevant_speed(operation);
    WorstMargins worst;
    bool none = true;
    Doubt doubt;
    for (const Run &run : runs) {
        const Doubt of_run = doubt_of_rotor(run.scene, lowest, highest);
        if (doubt.why.empty() || of_run.either_way)
            doubt = of_run;
        if (run.margins == nullptr)
            continue;
        none = none && run.margins->empty();
        for (const SeparationMargin &margin : *run.margins) {
            Check check = check_of(margin);
            apply(of_run, check);
            name_run(check, run);
            worst.add(margin, check, run);
        }
    }
    std::vector<Check> own = worst.checks();
    if (own.empty()) {
        Check &check = own.emplace_back();
        check.name = margin_name;
        check.source = api617;
        check.pass = true;
        check.where = Sentence("no critical speed with an amplification factor of {} or more",
                               as::number(results::Damping::least_amplification));
        apply(doubt, check);
    }
    if (computed.critical == nullptr)
        own.push_back(not_judged(margin_name,
                                 or_else(computed.no_critical, "critical speeds were not computed"),
                                 api617));
    else {
        add_missing_criticals(own, *computed.critical, highest);
        add_uncovered_criticals(own, runs, lowest, highest);
        // What is not known is not none.
        if (own.size() > 1 && none)
            own.erase(own.begin());
    }
    const bool driven = computed.response != nullptr && !computed.response->nodes.empty();
    if (driven && !speeds_cover(scene))
        own.push_back(not_judged(
            margin_name,
            {"peaks were not looked for at all speeds {}, where one could be too near: [speeds] "
             "must reach beyond both",
             as::speed.range(lowest, highest)},
            api617));
    if (driven)
        for (const Run &run : runs)
            add_peaks_without_factor(own, runs, run, operation);
    checks.insert(checks.end(), own.begin(), own.end());
}

const char *const growth_check = "growth of free motions";

/// With those of other arrangements of the balancers.
std::vector<Interval> all_unstable(const results::StabilityResult &result) {
    std::vector<Interval> bands = results::unstable_speeds(result);
    if (result.family)
        bands.insert(bands.end(), result.family->unstable.begin(), result.family->unstable.end());
    return bands;
}

/// Growth of free motions, over all operating speeds. @param result  none: not computed
Check of_stability(const model::Case &scene, const results::StabilityResult *result,
                   const Sentence &no_stability) {
    Check check;
    check.name = growth_check;
    check.quantity = model::Quantity::rate;
    check.limit = 0;
    check.source = "stability";
    const auto undecided = [&check](const Sentence &why) {
        reset(check, why);
        return check;
    };
    if (result == nullptr)
        return undecided(or_else(no_stability, "stability was not computed"));
    const double low = scene.operation->from;
    const double high = operation::top_speed(*scene.operation);
    const bool resolved = result->resolved_up_to.has_value();
    const auto &growth =
        resolved && !result->resolved_growth.empty() ? result->resolved_growth : result->growth;
    const auto &verdict =
        resolved && !result->resolved_verdict.empty() ? result->resolved_verdict : result->verdict;
    using results::Verdict;
    bool neutral = false;
    bool unknown = false;
    bool unresolved = false;
    bool any = false;
    for (std::size_t i = 0; i < result->speeds.size(); ++i) {
        const double speed = result->speeds[i];
        if (speed < low || speed > high)
            continue;
        any = true;
        const Verdict one = i < verdict.size() ? verdict[i] : Verdict::unknown;
        const double rate = i < growth.size() ? growth[i] : std::nan("");
        neutral = neutral || one == Verdict::neutral;
        unknown = unknown || one == Verdict::unknown || !std::isfinite(rate);
        if (i < result->unresolved_growth.size())
            unresolved = unresolved || !(result->unresolved_growth[i] <= 0);
        if (one == Verdict::unstable || one == Verdict::diverges)
            check.pass = false;
        if (std::isfinite(rate) && (!check.value || rate > *check.value)) {
            check.value = rate;
            check.where = Sentence("at {}", as::speed(speed));
        }
    }
    const std::vector<Interval> bands = all_unstable(*result);
    const auto &errors = resolved ? result->resolved_unstable_error : result->unstable_error;
    bool near = false;
    for (std::size_t i = 0; i < bands.size(); ++i) {
        const auto error = [&](double of) { return std::isfinite(of) ? of : infinite; };
        const double below = i < errors.size() ? error(errors[i].first) : 0;
        const double above = i < errors.size() ? error(errors[i].second) : 0;
        if (bands[i].to >= low && bands[i].from <= high) {
            check.pass = false;
            check.where = Sentence("unstable at {}", as::speed.range(bands[i].from, bands[i].to));
        } else if (bands[i].to + above >= low && bands[i].from - below <= high) {
            near = true;
        }
    }
    if (check.pass)
        return check; // it grows
    constexpr double rounding = 1e-9;
    if (!any || result->speeds.size() < 2 || result->speeds.front() > low * (1 + rounding) ||
        result->speeds.back() < high * (1 - rounding))
        return undecided({"stability was not looked at over all operating speeds, {}",
                          as::speed.range(low, high)});
    if (unknown)
        return undecided("at some operating speed it is not known whether a motion grows");
    if (unresolved)
        return undecided("motions too fast for the elements may grow");
    if (neutral)
        return undecided("some motion has no damping and neither grows nor dies out");
    if (near)
        return undecided("an unstable range is nearer than the error of its end");
    check.pass = check.value && *check.value < 0 ? std::optional(true) : std::nullopt;
    if (!check.pass)
        return undecided("some motion does not die out");
    apply({doubt_of_rotor(scene).either_way ? Sentence() : doubt_of_rotor(scene).why}, check);
    return check;
}

void add_level1(std::vector<Check> &checks, const model::Case &scene,
                const results::StabilityResult *result, const Sentence &no_stability) {
    if (!scene.level1)
        return;
    const char *const source = "API 617, level I";
    const results::Level1 *found = result != nullptr && result->level1 ? &*result->level1 : nullptr;
    Sentence why;
    if (found == nullptr)
        why = result == nullptr ? or_else(no_stability, "stability was not computed")
                                : Sentence("added cross coupling was not computed");
    else if (!found->anticipated)
        why = "the case does not say which cross coupling is anticipated";
    if (!why.empty()) {
        checks.push_back(not_judged(operation::level1_decrement, why, source));
        checks.push_back(not_judged(operation::level1_ratio, why, source));
        return;
    }
    for (const results::Level1Check &own : found->checks) {
        // Region A of the standard asks for nothing beyond the ratio.
        if (own.passes == true && own.value && *own.value < own.limit)
            continue;
        Check check;
        check.name = own.name;
        check.value = own.value;
        check.limit = own.limit;
        check.at_least = true;
        check.source = source;
        check.where =
            Sentence("cross coupling at z = {}, {}", as::length(found->z), as::speed(found->speed));
        check.pass = own.passes;
        check.why = own.passes ? Sentence() : own.why;
        apply(doubt_of_rotor(scene), check);
        checks.push_back(std::move(check));
    }
}

/// Growth and level I of one clearance of the bearings.
std::vector<Check> of_free_motions(const model::Case &scene, const results::StabilityResult *result,
                                   const Sentence &no_stability) {
    std::vector<Check> checks{of_stability(scene, result, no_stability)};
    add_level1(checks, scene, result, no_stability);
    return checks;
}

/// Of two of one kind; where the limit is 0, of which there is no share, by the value.
bool worse(const Check &one, const Check &other) {
    if (badness(one) != badness(other))
        return badness(one) < badness(other);
    const double a = one.value.value_or(-infinite);
    const double b = other.value.value_or(-infinite);
    return one.at_least ? a < b : a > b;
}

/// Of each the worst of all clearances, named where there are several.
void add_free_motions(std::vector<Check> &checks, model::Case scene, const Computed &computed) {
    std::vector<Check> worst = of_free_motions(scene, computed.stability, computed.no_stability);
    const model::Rotor rotor = scene.rotor;
    const bool several = computed.stability != nullptr && !computed.stability->clearances.empty();
    const auto name = [several](std::vector<Check> &all, model::BearingFit fit) {
        for (Check &check : all)
            if (several)
                check.where += Sentence("{}clearance {}", check.where.empty() ? "" : ", ",
                                        model::fit_name(fit));
    };
    name(worst, model::BearingFit::given);
    for (std::size_t k = 0; several && k < computed.stability->clearances.size(); ++k) {
        const results::StabilityResult &one = computed.stability->clearances[k];
        scene.rotor = model::with_fit(rotor, one.fit);
        std::vector<Check> own = of_free_motions(scene, &one, {});
        name(own, one.fit);
        // What level I asks for differs with what it finds (region B): by name.
        for (Check &check : own) {
            const auto same = std::ranges::find(worst, check.name, &Check::name);
            if (same == worst.end())
                worst.push_back(std::move(check));
            else if (worse(check, *same))
                *same = std::move(check);
        }
    }
    checks.insert(checks.end(), worst.begin(), worst.end());
}

const char *const shaft_name = "vibration of the shaft";
const char *const pedestal_name = "vibration of a pedestal";
const char *const clearance_name = "share of the clearance";

Check check_of(const OperatingWorst &worst) {
    Check check;
    check.name = worst.what == Measure::clearance_share ? clearance_name
                 : worst.of == "pedestal"               ? pedestal_name
                                                        : shaft_name;
    check.value = worst.value;
    check.limit = worst.limit;
    check.quantity = results::measure_quantity(worst.what);
    check.percent = worst.what == Measure::clearance_share;
    check.source = worst.source;
    const bool rms = worst.what == Measure::velocity_rms || worst.what == Measure::amplitude_rms;
    if (worst.what != Measure::clearance_share)
        check.reading = rms ? "rms" : "peak";
    check.pass = worst.pass;
    check.why = worst.why;
    check.where = place_in_words(worst.of, worst.name, worst.z);
    if (worst.angle && worst.name.empty())
        check.where += Sentence(", {}", as::angle(*worst.angle, 4));
    if (worst.of == "probe" && worst.relative)
        check.where += ", against the pedestal";
    check.where += Sentence(", {}", as::speed(worst.speed));
    if (worst.scale != 1)
        check.where += Sentence(", imbalance times {}", as::number(worst.scale, 4));
    return check;
}

/// Of each limit and place the worst of all runs.
void add_worst_of_runs(std::vector<Check> &checks, const std::vector<Run> &runs) {
    std::vector<std::pair<const OperatingWorst *, Check>> all;
    const auto same = [](const OperatingWorst &a, const OperatingWorst &b) {
        return a.of == b.of && a.name == b.name && a.z == b.z && a.angle == b.angle &&
               a.relative == b.relative && a.what == b.what && a.source == b.source;
    };
    for (const Run &run : runs) {
        if (run.operating == nullptr)
            continue;
        std::vector<const OperatingWorst *> taken; // places of one run may look the same
        for (const OperatingWorst &worst : run.operating->worst) {
            Check check = check_of(worst);
            name_run(check, run);
            const auto found = std::ranges::find_if(all, [&](const auto &other) {
                return same(*other.first, worst) &&
                       std::ranges::find(taken, other.first) == taken.end();
            });
            if (found == all.end()) {
                all.emplace_back(&worst, std::move(check));
                taken.push_back(&worst);
                continue;
            }
            taken.push_back(found->first);
            if (badness(check) < badness(found->second))
                found->second = std::move(check);
        }
    }
    for (auto &[worst, check] : all)
        checks.push_back(std::move(check));
}

void add_vibration(std::vector<Check> &checks, const model::Case &scene, const Computed &computed) {
    if (!scene.limits)
        return;
    const model::Rotor &rotor = scene.rotor;
    const auto shaft = operation::shaft_limits(*scene.limits, *scene.operation);
    const auto pedestal = operation::pedestal_limits(*scene.limits, *scene.operation);
    const bool clearance = scene.limits->clearance.has_value();
    const bool known = computed.response != nullptr && computed.response->operating;
    Sentence missing;
    if (!known)
        missing = computed.response == nullptr
                      ? or_else(computed.no_response, "the response was not computed")
                      : Sentence("nothing drives the rotor that the response is computed to");
    const auto source_of = [](const std::vector<operation::VibrationLimit> &limits) {
        return limits.empty() ? std::string() : limits.front().source;
    };
    if (known)
        add_worst_of_runs(checks, runs_of(scene, computed));
    if (computed.response != nullptr && !computed.response->no_runs.empty())
        checks.push_back(not_judged("standard runs", computed.response->no_runs, api617));
    const bool probes =
        std::ranges::any_of(rotor.probes, [](const auto &probe) { return !probe.on_pedestal; });
    if (!shaft.empty() && (!known || !probes))
        checks.push_back(not_judged(shaft_name,
                                    known ? Sentence("no [[probe]] reads the shaft") : missing,
                                    source_of(shaft)));
    if (!pedestal.empty() && !known)
        checks.push_back(not_judged(pedestal_name, missing, source_of(pedestal)));
    if (!pedestal.empty() && known) {
        if (rotor.supports().empty())
            checks.push_back(
                not_judged(pedestal_name, {"there is no bearing"}, source_of(pedestal)));
        for (const model::Bearing &bearing : rotor.supports())
            if (!bearing.pedestal) {
                checks.push_back(not_judged(
                    pedestal_name, {"the bearing has no pedestal: what holds it stands still"},
                    source_of(pedestal), place_in_words("bearing", bearing.name, bearing.z)));
            }
    }
    if (clearance && !known)
        checks.push_back(not_judged(clearance_name, missing, "case"));
    if (clearance && known) {
        if (rotor.bearings.empty())
            checks.push_back(
                not_judged(clearance_name, {"there is neither bearing nor seal"}, "case"));
        for (const model::Bearing &bearing : rotor.bearings)
            if (!bearing.clearance) {
                checks.push_back(not_judged(
                    clearance_name, {"its clearance is not given"}, "case",
                    place_in_words(bearing.seal ? "seal" : "bearing", bearing.name, bearing.z)));
            }
    }
}

/// What touches fails, whether the case limits the share of clearances or not.
void add_touching(std::vector<Check> &checks, const model::Case &scene, const Computed &computed) {
    if (computed.response == nullptr || !computed.response->operating ||
        (scene.limits && scene.limits->clearance))
        return;
    struct Touching {
        const results::OperatingRow *row;
        Check check;
    };
    std::vector<Touching> own; // of each place the worst
    for (const Run &run : runs_of(scene, computed)) {
        if (run.operating == nullptr)
            continue;
        for (const results::OperatingRow &row : run.operating->rows) {
            if (!(row.clearance_share.value_or(0) >= 1))
                continue;
            const auto before = std::ranges::find_if(own, [&row](const Touching &other) {
                return other.row->of == row.of && other.row->name == row.name &&
                       other.row->z == row.z;
            });
            if (before != own.end() && *before->check.value >= *row.clearance_share)
                continue;
            Check check;
            check.name = clearance_name;
            check.value = row.clearance_share;
            check.limit = 1;
            check.percent = true;
            check.pass = false;
            check.source = "clearance of the case";
            check.where = place_in_words(row.of, row.name, row.z);
            check.where += Sentence(", {}", as::speed(row.speed));
            name_run(check, run);
            apply(doubt_of_rotor(scene), check);
            if (before != own.end())
                *before = {&row, std::move(check)};
            else
                own.push_back({&row, std::move(check)});
        }
    }
    for (Touching &one : own)
        checks.push_back(std::move(one.check));
}

/// Without operating speeds nothing is judged; where motions grow is said all the same, first of
/// all.
void add_without_operation(std::vector<Check> &checks, const results::StabilityResult *stability) {
    if (stability != nullptr) {
        std::vector<Interval> bands = all_unstable(*stability);
        std::ranges::sort(bands, {}, &Interval::from);
        std::vector<Interval> apart; // bands of several positions of balancers overlap
        for (const Interval &band : bands)
            if (!apart.empty() && band.from <= apart.back().to)
                apart.back().to = std::max(apart.back().to, band.to);
            else
                apart.push_back(band);
        std::vector<Sentence> ranges;
        for (const Interval &band : apart)
            ranges.emplace_back("{}", as::speed.range(band.from, band.to, 5));
        if (!ranges.empty()) {
            checks.push_back(not_judged(
                growth_check,
                {"unstable from {}, where the machine must not run; the case does not say where "
                 "it runs",
                 model::joined(ranges, ", ")},
                "stability"));
        }
    }
    checks.push_back(not_judged("operating speeds",
                                {"the case does not say at which speeds the machine runs: it needs "
                                 "[operation] with from and to, and [limits] for its vibration"}));
}

/// A value as it is compared: "4.2 m/s", "12.4 %".
Sentence number_of(const Check &check, const std::optional<double> &value) {
    if (!value || std::isnan(*value))
        return {"not known"};
    if (std::isinf(*value))
        return {"without limit"};
    constexpr int digits = 4;
    return check.percent ? Sentence("{} %", as::number(100 * *value, digits))
                         : Sentence("{}", model::ValueOf{check.quantity}(*value, digits));
}

Sentence about(const Check &check) {
    Sentence out("{}", check.name);
    if (!check.where.empty())
        out += Sentence(" ({})", check.where);
    return out;
}

Sentence verdict_of(const results::Assessment &assessment, const model::Case &scene) {
    const std::vector<Check> &checks = assessment.checks;
    const auto count = [&checks](std::optional<bool> pass) {
        return static_cast<int>(std::ranges::count(checks, pass, &Check::pass));
    };
    const Check &first = checks.front();
    switch (assessment.verdict) {
    case results::Judgement::fails:
        return {"{} of {} checks fail, first {}: {}, {} {} {}",
                count(false),
                static_cast<int>(checks.size()),
                about(first),
                number_of(first, first.value),
                first.at_least ? "at least" : "at most",
                number_of(first, first.limit),
                first.reading.empty() ? "" : first.reading.c_str()};
    case results::Judgement::incomplete:
        return {"no check fails, but {} of {} could not be judged, first {}: {}",
                count(std::nullopt), static_cast<int>(checks.size()), about(first), first.why};
    case results::Judgement::passes:
        break;
    }
    Sentence out("all {} checks pass", static_cast<int>(checks.size()));
    if (!scene.limits)
        out += "; the case gives no limits of vibration";
    return out;
}

} // namespace

model::Case over_operation(model::Case scene) {
    constexpr int speeds = 11;
    scene.speeds =
        model::SpeedRange{scene.operation->from, operation::top_speed(*scene.operation), speeds};
    return scene;
}

results::Assessment assess(const model::Case &scene, const Computed &computed) {
    results::Assessment out;
    if (scene.operation) {
        add_margins(out.checks, scene, computed);
        add_vibration(out.checks, scene, computed);
        add_touching(out.checks, scene, computed);
        add_free_motions(out.checks, scene, computed);
    } else {
        add_without_operation(out.checks, computed.stability);
    }
    // What is not a number passes nothing, wherever it came from.
    for (Check &check : out.checks)
        if (check.pass.value_or(false) && ((check.value && std::isnan(*check.value)) ||
                                           (check.limit && std::isnan(*check.limit))))
            reset(check, "the value is not a number");
    std::ranges::stable_sort(out.checks, {}, badness);
    const int worst = badness(out.checks.front()).first;
    out.verdict = worst == 0   ? results::Judgement::fails
                  : worst == 1 ? results::Judgement::incomplete
                               : results::Judgement::passes;
    out.sentence = verdict_of(out, scene);
    return out;
}

} // namespace whirl::analyses
