#include "operation/level1_verdict.h"

#include <algorithm>
#include <cmath>

namespace whirl::operation {

namespace {

using results::Level1;
using results::Level1Check;
using results::Sentence;

// Limits of API 617.
constexpr double least_log_dec = 0.1;
constexpr double least_ratio = 2;
constexpr double enough_ratio = 10; ///< from there on the density of the gas does not matter

/// The standard asks of axial stages for the decrement alone.
bool only_axial(const Level1 &level1) {
    return !level1.stages.empty() &&
           std::ranges::all_of(level1.stages, &results::Level1Stage::axial);
}

Level1Check log_dec_check(const Level1 &level1) {
    Level1Check check{level1_decrement, level1.anticipated_log_dec, least_log_dec, {}, {}};
    if (check.value && std::isfinite(*check.value))
        check.passes = *check.value >= check.limit;
    else
        check.why = "with it the motion does not swing, or was not found";
    return check;
}

/// Whether a value that is at least its limit is so by more than its relative error; none: it is
/// not known.
std::optional<bool> reaches(double value, double limit, double error) {
    if (value < limit)
        return false;
    return value - std::abs(error) * value >= limit ? std::optional(true) : std::nullopt;
}

/// Why it is not known.
Sentence near_limit(double error) {
    return std::isfinite(error) ? "it is nearer to its limit than its error"
                                : "the error of the critical cross coupling is not known";
}

Level1Check ratio_check(const Level1 &level1, const Searched &searched) {
    Level1Check check{level1_ratio, {}, least_ratio, {}, {}};
    if (level1.critical_cross_coupling) {
        check.value = *level1.critical_cross_coupling / *level1.anticipated;
        check.passes = reaches(*check.value, check.limit, level1.error);
        if (!check.passes)
            check.why = near_limit(level1.error);
        if (searched.grows_with) { // perhaps with less: not judged, or known to be too little
            check.passes = *searched.grows_with < check.limit * *level1.anticipated
                               ? std::optional(false)
                               : std::nullopt;
            check.why = {"not all motions could be followed, and one grows with {}",
                         results::as::stiffness(*searched.grows_with, 4)};
        }
        return check;
    }
    check.why = level1.no_critical;
    if (searched.never_below == 0) { // it grows without
        check.value = 0;
        check.passes = false;
    } else if (searched.never_below >= check.limit * *level1.anticipated)
        check.passes = true;
    return check;
}

/// Whether region B of the standard's figure: above a critical speed ratio that is level up to a
/// mean density of the gas of 16.5 kg/m3 and falls to 2 at 60, beyond which all is region B. As
/// read off the figure (API 684 SP6.8.5.10) by ross-report
/// (github.com/ross-rotordynamics/ross-report, report/analysis.py).
bool in_region_b(double density, double speed_ratio) {
    constexpr double level = 2.5;
    constexpr double densest = 60;
    return density > densest || speed_ratio > std::min(level, 2.69 - 0.0115 * density);
}

/// Where the ratio of couplings is between the two limits the gas and the first critical speed
/// decide.
Level1Check region_check(const Level1Check &ratio, const Level1 &level1, const Searched &searched) {
    Level1Check check{
        "critical over anticipated in region B of the standard", ratio.value, enough_ratio, {}, {}};
    const std::optional<bool> enough =
        ratio.value ? reaches(*ratio.value, enough_ratio, level1.error)
                    : searched.never_below >= enough_ratio * *level1.anticipated;
    if (enough == true) {
        check.passes = true;
        return check;
    }
    if (!level1.gas_density) {
        check.why = "between 2 and 10 the density of the gas decides, and the case gives no "
                    "gas_density";
        return check;
    }
    if (!level1.critical_speed_ratio) {
        check.why = "between 2 and 10 the first critical speed on rigid supports decides, and none "
                    "was found";
        return check;
    }
    const bool dense = in_region_b(*level1.gas_density, *level1.critical_speed_ratio);
    if (dense && !enough) {
        check.why = near_limit(level1.error);
        return check;
    }
    check.passes = !dense;
    check.why = {"region {}: gas of {}, critical speed ratio {}", dense ? "B" : "A",
                 results::as::density(*level1.gas_density, 4),
                 results::as::number(*level1.critical_speed_ratio, 4)};
    return check;
}

/// "x is 0.05, below 0.1"
Sentence said(const Level1Check &check) {
    if (!check.value)
        return {"{}: {}", check.name, check.why};
    if (check.passes == true && !check.why.empty())
        return check.why;
    Sentence out("{} is {}, {} {}", check.name, results::as::number(*check.value, 4),
                 *check.value < check.limit ? "below" : "at least",
                 results::as::number(check.limit));
    if (!check.why.empty())
        out += Sentence(" ({})", check.why);
    return out;
}

Sentence joined_checks(const Level1 &level1, std::optional<bool> passes) {
    std::vector<Sentence> parts;
    for (const Level1Check &check : level1.checks)
        if (check.passes == passes)
            parts.push_back(passes ? said(check) : Sentence("{}: {}", check.name, check.why));
    return results::joined(parts, "; ");
}

} // namespace

results::Level1Stage stage_of(const model::Stage &stage, double fastest) {
    constexpr double impeller = 3;
    constexpr double blades = 1.5;
    results::Level1Stage out{
        stage.name,     stage.axial, stage.power, stage.speed.value_or(fastest),
        stage.diameter, stage.width, {},          0};
    if (!stage.axial)
        out.density_ratio = stage.density_ratio;
    const double torque = stage.power / out.speed;
    out.cross_coupling = (stage.axial ? blades : impeller) * torque /
                         (stage.diameter * stage.width) * stage.density_ratio;
    return out;
}

void add_verdict(Level1 &level1, const Searched &searched) {
    if (!level1.anticipated) {
        level1.verdict =
            "level II not judged: the case gives neither the anticipated cross coupling nor "
            "stages";
        return;
    }
    level1.checks.push_back(log_dec_check(level1));
    if (!only_axial(level1)) {
        const Level1Check ratio = ratio_check(level1, searched);
        level1.checks.push_back(ratio);
        if (ratio.passes == true)
            level1.checks.push_back(region_check(ratio, level1, searched));
    }
    const auto any = [&](std::optional<bool> passes) {
        return std::ranges::any_of(level1.checks,
                                   [&](const auto &check) { return check.passes == passes; });
    };
    if (any(false)) {
        level1.level_two = true;
        level1.verdict = {"level II required: {}", joined_checks(level1, false)};
    } else if (any(std::nullopt)) {
        level1.verdict = {"level II not judged: {}", joined_checks(level1, std::nullopt)};
    } else {
        level1.level_two = false;
        level1.verdict = {"level II not required: {}", joined_checks(level1, true)};
    }
}

} // namespace whirl::operation
