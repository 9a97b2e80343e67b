#include "analyses/notes/campbell_notes.h"

#include "results/formulation.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <set>

namespace whirl::analyses {

namespace {

using results::Sentence;
namespace as = results::as;

/// What the absence of modes at some speeds means.
Sentence absence_note(tracking::Absence why, const std::string &labels, bool several) {
    const std::string who = (several ? "modes " : "mode ") + labels;
    const std::string they = several ? "they" : "it";
    const auto verb = [several](const char *one, const char *more) { return several ? more : one; };
    switch (why) {
    case tracking::Absence::overdamped:
        return Sentence("{} {} overdamped at some speeds and {} no whirl frequency there", who,
                        verb("is", "are"), verb("has", "have"));
    case tracking::Absence::divergent:
        return Sentence("{} {} at some speeds: the eigenvalue is real and positive there, {} {} "
                        "without whirling",
                        who, verb("diverges", "diverge"), they, verb("grows", "grow"));
    case tracking::Absence::beyond:
        return Sentence("{} {} beyond the computed modes at some speeds", who, verb("lies", "lie"));
    default:
        return Sentence("{} could not be followed to some speeds: {} {} on there as {}", who, they,
                        verb("goes", "go"), verb("another line", "other lines"));
    }
}

void note_absent(results::CampbellResult &result, const std::vector<tracking::Line> &lines) {
    for (const tracking::Absence why : {tracking::Absence::overdamped, tracking::Absence::divergent,
                                        tracking::Absence::beyond, tracking::Absence::lost}) {
        std::string labels;
        int count = 0;
        for (std::size_t i = 0; i < lines.size(); ++i)
            if (std::ranges::count(lines[i].absence, why) > 0)
                labels += (count++ > 0 ? ", " : "") + result.modes[i].label;
        if (count > 0)
            result.model.notes.push_back(absence_note(why, labels, count > 1));
    }
}

/// Lines on which motion grows, in one note.
void note_growing(results::CampbellResult &result) {
    std::vector<Sentence> lines;
    for (const results::CampbellMode &mode : result.modes) {
        std::vector<double> at;
        for (std::size_t k = 0; k < mode.real.size(); ++k) {
            constexpr double always = 1e-9; // of the frequency: rounding
            if (!mode.real[k] || !mode.frequency[k])
                continue;
            const double noise = (always + 10 * mode.residual[k].value_or(0)) *
                                 std::max(*mode.frequency[k], std::abs(result.speeds[k]));
            if (*mode.real[k] > noise)
                at.push_back(result.speeds[k]);
        }
        if (!at.empty())
            lines.emplace_back("{} ({})", mode.label, as::speed.range(at.front(), at.back()));
    }
    constexpr std::size_t listed = 4; // by name: a longer list is not read
    if (lines.empty())
        return;
    const std::size_t more = lines.size() - std::min(listed, lines.size());
    lines.resize(std::min(listed, lines.size()));
    result.model.notes.emplace_back(model::Weight::warning,
                                    "unstable: motion grows (negative damping) at speeds of {}{}; "
                                    "`stability` finds where it begins",
                                    joined(lines, ", "),
                                    more > 0 ? fmt::format(" and {} more modes", more) : "");
}

/// `critical` has no answer where the equations stay periodic.
bool critical_knows(const results::CampbellResult &result) {
    return result.model.formulation.form != results::Form::hill;
}

/// Speeds so far apart that lines exchange their places between them.
void note_far_apart(results::CampbellResult &result) {
    constexpr int most = 4; // of two pairs of modes
    int largest = 0;
    std::size_t at = 0;
    for (std::size_t k = 1; k < result.speeds.size(); ++k) {
        const auto inside = static_cast<int>(
            std::ranges::count_if(result.crossings, [&](const results::Crossing &c) {
                return c.multiple == result.crossings.front().multiple &&
                       c.speed > result.speeds[k - 1] && c.speed <= result.speeds[k];
            }));
        if (inside > largest) {
            largest = inside;
            at = k;
        }
    }
    if (largest > most)
        result.model.notes.emplace_back(
            "{} crossings lie within one step of speed, {}: a crossing and "
            "its return within it would be missed; raise speeds.count{}",
            largest, as::speed.range(result.speeds[at - 1], result.speeds[at]),
            critical_knows(result) ? ", or `critical`, which needs none" : "");
}

/// Real eigenvalues: those that die out are overdamped motion, those that grow are divergence.
void note_real(results::CampbellResult &result, const std::vector<modes::Spectrum> &spectra) {
    const auto &divergence = result.divergence;
    const auto diverging = std::ranges::count_if(divergence, &std::optional<double>::has_value);
    if (diverging > 0) {
        const auto worst = std::ranges::max_element(divergence); // none is less than any
        result.model.notes.emplace_back(
            model::Weight::warning,
            "divergence (static instability) at {} of {} speeds, with a "
            "real eigenvalue of {} at {}",
            diverging, spectra.size(), as::rate(**worst).with_sign(),
            as::speed(result.speeds[static_cast<std::size_t>(worst - divergence.begin())]));
    }
    std::size_t overdamped = 0;
    for (const modes::Spectrum &spectrum : spectra)
        overdamped = std::max(overdamped, spectrum.overdamped.size() - spectrum.growing.size());
    if (overdamped > 0)
        result.model.notes.emplace_back(
            model::Weight::information,
            "up to {} modes at a speed are overdamped (real eigenvalue, or "
            "damping ratio above {}) and have no line and no crossings",
            overdamped, as::number(modes::overdamped_ratio, 4));
}

/// Crossings that are no critical speeds: the damping of these beats every peak.
void note_no_peaks(results::CampbellResult &result) {
    std::vector<double> speeds;
    for (const results::Crossing &c : result.crossings)
        if (c.multiple == 1 && c.damping.ratio && *c.damping.ratio > 1 / std::numbers::sqrt2)
            speeds.push_back(c.speed);
    if (!speeds.empty())
        result.model.notes.emplace_back(
            "1x crossings with a damping ratio above 1/sqrt(2), at {}, "
            "give no response peak{}",
            as::speed.list(speeds), critical_knows(result) ? "; `critical` leaves them out" : "");
}

/// Of a Hill series at every speed ends of such intervals are looked for in the steps that show a
/// change; by monodromy matrices all of 1x are searched for.
/// @param by_steps  as the first
void note_short_bands(results::ModelSummary &model, bool by_steps,
                      const std::vector<double> &multiples) {
    if (model.formulation.form != results::Form::hill)
        return;
    if (by_steps)
        model.notes.push_back("a mode locked on a multiple of the spin speed for less than "
                              "one step of speed may not be listed");
    else if (std::ranges::any_of(multiples, [](double m) { return m != 1; }))
        model.notes.push_back("a mode locked on a multiple of the spin speed other than 1x "
                              "for less than a 200th of the range may not be listed");
}

void note_few(results::ModelSummary &model, const std::vector<modes::Spectrum> &spectra,
              int wanted) {
    const bool few = std::ranges::any_of(spectra, [wanted](const modes::Spectrum &s) {
        return static_cast<int>(s.modes.size()) < wanted;
    });
    if (!few)
        return;
    const bool followed = model.formulation.form == results::Form::hill;
    model.notes.emplace_back(model::Weight::information,
                             "at some speeds fewer than the {} whirl modes asked for exist{} or "
                             "are resolved in double precision: all found are listed",
                             wanted,
                             followed ? ", are slow enough to be followed over half a turn" : "");
}

/// Stretches of speed in which something was not found, each by itself while they are few.
void note_gaps(results::ModelSummary &model, const std::vector<tracking::Gap> &gaps,
               const char *what) {
    using tracking::Gap;
    constexpr std::size_t few = 3; // named one by one: a longer list is not read
    if (gaps.size() <= few) {
        for (const Gap &gap : gaps)
            model.notes.emplace_back("from {} {} (frequency near {})",
                                     as::speed.range(gap.from, gap.to), what,
                                     as::frequency(gap.frequency));
        return;
    }
    const auto [lowest, highest] = std::ranges::minmax(gaps, {}, &Gap::frequency);
    model.notes.emplace_back("in {} short ranges of speed from {} {} (frequencies from {})",
                             gaps.size(),
                             as::speed.range(std::ranges::min(gaps, {}, &Gap::from).from,
                                             std::ranges::max(gaps, {}, &Gap::to).to),
                             what, as::frequency.range(lowest.frequency, highest.frequency));
}

/// Whirl modes of a rotor whose equations stay periodic in time that are not confirmed
/// (modes::WhirlMode), next to rest.
/// @param reduced  they are those of the reduced rotor, else of a series cut off
void note_unconfirmed(results::ModelSummary &model, const std::vector<modes::Spectrum> &spectra,
                      bool reduced) {
    std::vector<double> speeds;
    for (const modes::Spectrum &spectrum : spectra)
        if (std::ranges::any_of(spectrum.modes,
                                [](const modes::WhirlMode &mode) { return !mode.confirmed; }))
            speeds.push_back(std::abs(spectrum.speed));
    if (speeds.empty())
        return;
    model.notes.emplace_back("at {} of {} speeds, up to {}, the spin speed is far below the "
                             "natural frequencies: whirl speeds without an error bar there "
                             "come from {} and may be wrong, and modes may be missing",
                             speeds.size(), spectra.size(),
                             as::speed(*std::ranges::max_element(speeds)),
                             reduced ? "the reduced rotor, not confirmed on the full model"
                                     : "a Hill series with too few harmonics");
}

/// Crossings and intervals that are listed at some of these speeds (Crossings::unconfirmed).
void note_unconfirmed(results::CampbellResult &result, const std::vector<double> &speeds) {
    std::set<double> listed;
    const auto is = [&speeds](double speed) { return std::ranges::count(speeds, speed) > 0; };
    for (const results::Crossing &crossing : result.crossings)
        if (is(crossing.speed))
            listed.insert(crossing.speed);
    for (const results::Locked &band : result.locked)
        for (const double end : {band.from, band.to})
            if (is(end))
                listed.insert(end);
    if (!listed.empty())
        result.model.notes.emplace_back(
            "crossings and ends of locked intervals at {} come from the "
            "reduced rotor and are not confirmed on the full model",
            as::speed.list({listed.begin(), listed.end()}, 10));
}

} // namespace

void add_campbell_notes(const model::CampbellSettings &settings,
                        const tracking::FollowedLines &found, const tracking::Crossings &crossed,
                        bool periodic, results::CampbellResult &result) {
    note_absent(result, found.tracking.lines);
    note_growing(result);
    note_far_apart(result);
    note_real(result, found.spectra);
    note_no_peaks(result);
    note_short_bands(result.model, !periodic, settings.multiples);
    note_few(result.model, found.spectra, settings.modes);
    note_gaps(result.model, found.tracking.gaps, "a mode could not be followed");
    note_gaps(result.model, crossed.unsettled,
              "a mode passes a multiple of the spin speed, but its crossing "
              "could not be verified");
    note_unconfirmed(result.model, found.spectra, periodic);
    note_unconfirmed(result, crossed.unconfirmed);
}

} // namespace whirl::analyses
