#include "report/stability/bands.h"

#include "report/common/html.h"
#include "report/common/units.h"
#include "report/common/words.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <tuple>

namespace whirl::report {

using results::StabilityResult;
using results::Verdict;

namespace {

double width(const BandLine &line) { return *line.to - *line.from; }

/// Of the file, and of the tables of bands.
Columns<BandLine> band_columns(bool with_errors) {
    Columns<BandLine> columns{{InCsv("kind"), &BandLine::kind},
                              {InCsv("from"), OnPage("From", "{:.8g}").and_si("{:.10g}"),
                               InText("from").and_si(precise), Quantity::speed, &BandLine::from},
                              {InCsv("to"), OnPage("to", "{:.8g}").and_si("{:.10g}"),
                               InText("to").and_si(precise), Quantity::speed, &BandLine::to},
                              {OnPage("width", "{:.4g}"), InText("width"), Quantity::speed, width},
                              {InCsv("growth"), Quantity::rate, &BandLine::growth},
                              {InCsv("verdict"), &BandLine::verdict}};
    if (with_errors) {
        columns.push_back({InCsv("error of from"), OnPage("error of from", "{:.2g}"),
                           InText("error of from", rough), Quantity::speed, &BandLine::from_error});
        columns.push_back({InCsv("error of to"), OnPage("error of to", "{:.2g}"),
                           InText("error of to", rough), Quantity::speed, &BandLine::to_error});
    }
    return columns;
}

} // namespace

Columns<BandLine> file_columns(const results::StabilityResult &result) {
    Columns<BandLine> columns = band_columns(true);
    if (!result.log_dec.empty())
        columns.push_back({InCsv("log_dec"), Quantity::number, &BandLine::log_dec});
    if (result.resolved_up_to) {
        columns.push_back({InCsv("resolved growth"), Quantity::rate, &BandLine::resolved_growth});
        columns.push_back({InCsv("resolved verdict"), &BandLine::resolved_verdict});
        columns.push_back(
            {InCsv("unresolved growth"), Quantity::rate, &BandLine::unresolved_growth});
    }
    if (const auto &map = result.map) {
        columns.push_back({InCsv("x: " + axis_name(map->x)), map->x.quantity, &BandLine::x});
        columns.push_back({InCsv("y: " + axis_name(map->y)), map->y.quantity, &BandLine::y});
    }
    return columns;
}

std::vector<BandLine> band_lines(const std::string &kind, const Bands &bands,
                                 const BandErrors *errors) {
    std::vector<BandLine> all;
    for (std::size_t i = 0; i < bands.size(); ++i) {
        all.push_back({kind, bands[i].from, bands[i].to});
        if (errors && i < errors->size())
            std::tie(all.back().from_error, all.back().to_error) = (*errors)[i];
    }
    return all;
}

std::vector<BandLine> speed_lines(const std::string &kind, const std::vector<double> &speeds) {
    std::vector<BandLine> all;
    for (const double speed : speeds)
        all.push_back({kind, speed, speed});
    return all;
}

std::vector<BandLine> growth_lines(const results::StabilityResult &result) {
    std::vector<BandLine> all;
    for (std::size_t i = 0; i < result.speeds.size() && i < result.growth.size(); ++i) {
        all.push_back({"growth", result.speeds[i], result.speeds[i], result.growth[i],
                       i < result.verdict.size() ? results::verdict_name(result.verdict[i]) : ""});
        if (i < result.log_dec.size())
            all.back().log_dec = result.log_dec[i];
        if (i >= result.resolved_growth.size())
            continue;
        all.back().resolved_growth = result.resolved_growth[i];
        all.back().resolved_verdict = results::verdict_name(result.resolved_verdict[i]);
        all.back().unresolved_growth = result.unresolved_growth[i];
    }
    return all;
}

std::vector<BandLine> map_lines(const results::StabilityMap &map) {
    std::vector<BandLine> all;
    for (std::size_t j = 0; j < map.growth.size(); ++j)
        for (std::size_t i = 0; i < map.growth[j].size(); ++i)
            all.push_back({.kind = "map",
                           .growth = map.growth[j][i],
                           .x = map.x.values[i],
                           .y = map.y.values[j]});
    return all;
}

namespace {

/// Bands, and the verdicts at the speeds that they are to explain.
struct Told {
    std::string title;
    const Bands &bands;
    const BandErrors &errors;
    const std::vector<Verdict> &verdicts;
};

/// All that is told apart: of one rotor all motions, or those that are resolved and all of them.
std::vector<Told> told(const StabilityResult &result, const Units &units) {
    const Told all{"Unstable", result.unstable, result.unstable_error, result.verdict};
    if (!result.resolved_up_to)
        return {all};
    std::vector<Told> out{{fmt::format("Unstable, motions up to frequencies of {}, which the "
                                       "elements resolve",
                                       units.text(Quantity::frequency, *result.resolved_up_to)),
                           result.resolved_unstable, result.resolved_unstable_error,
                           result.resolved_verdict}};
    if (result.unstable != result.resolved_unstable) {
        out.push_back(all);
        out.back().title = "Unstable with the faster motions of these elements";
    }
    return out;
}

/// What the bands do not say of the speeds: growth outside of them, speeds without an answer.
std::string not_in_bands(const Told &of, const std::vector<double> &speeds) {
    std::size_t growing = 0;
    std::size_t unknown = 0;
    for (std::size_t i = 0; i < of.verdicts.size() && i < speeds.size(); ++i) {
        const bool inside = std::any_of(of.bands.begin(), of.bands.end(), [&](const auto &band) {
            return speeds[i] >= band.from && speeds[i] <= band.to;
        });
        const bool grows =
            of.verdicts[i] == Verdict::unstable || of.verdicts[i] == Verdict::diverges;
        growing += grows && !inside ? 1 : 0;
        unknown += of.verdicts[i] == Verdict::unknown && !inside ? 1 : 0;
    }
    std::string text;
    if (growing > 0)
        text = fmt::format("at {} of {} speeds a motion grows that no band was found for", growing,
                           speeds.size());
    if (unknown > 0)
        text += fmt::format("{}at {} of {} speeds it is not known whether a motion grows",
                            text.empty() ? "" : "; ", unknown, speeds.size());
    return text;
}

/// The motions that are faster than what the elements resolve; nothing where all are resolved.
std::string faster_motions(const StabilityResult &result, const Units &units) {
    if (!result.resolved_up_to)
        return "";
    const std::vector<double> &growth = result.unresolved_growth;
    const std::size_t n = growth.size();
    const auto at = [n](std::size_t count) {
        return n == 1       ? std::string()
               : count == n ? fmt::format(" at all {} speeds", n)
                            : fmt::format(" at {} of {} speeds", count, n);
    };
    const auto growing = static_cast<std::size_t>(
        std::count_if(growth.begin(), growth.end(), [](double value) { return value > 0; }));
    const auto unknown = static_cast<std::size_t>(std::count_if(
        growth.begin(), growth.end(), [](double value) { return std::isnan(value); }));
    std::string text = "faster motions, which the elements do not resolve: ";
    if (growing == 0 && unknown == 0)
        return text +
               (n == 1 ? "none grows" : fmt::format("none grows at any of the {} speeds", n));
    if (growing > 0)
        text += fmt::format(
            "growing{}, by up to {}", at(growing),
            units.text(Quantity::rate,
                       *std::max_element(growth.begin(), growth.end(),
                                         [](double a, double b) { return std::isnan(a) || a < b; }),
                       4));
    if (unknown > 0)
        text += (growing > 0 ? "; " : "") + ("not known" + at(unknown));
    return text;
}

/// Of one speed.
std::string becomes(Verdict verdict, double growth, const Units &units) {
    const std::string rate = units.text(Quantity::rate, growth);
    switch (verdict) {
    case Verdict::stable:
        return "Stable: every motion dies out, the slowest with " + rate;
    case Verdict::neutral:
        return "Neither stable nor unstable: no motion grows, some do not die out either (no "
               "damping)";
    case Verdict::unstable:
        return "Unstable: a whirl grows with " + rate;
    case Verdict::diverges:
        return "Unstable: it diverges, a real root of +" + rate;
    default:
        return "No answer at this speed";
    }
}

/// The same of the motions that are resolved, and of the others.
std::vector<std::string> sentences_at_one_speed(const StabilityResult &result, const Units &units) {
    if (!result.resolved_up_to)
        return {becomes(result.verdict.front(), result.growth.front(), units)};
    return {fmt::format("Motions up to frequencies of {}, which the elements resolve: ",
                        units.text(Quantity::frequency, *result.resolved_up_to)) +
                becomes(result.resolved_verdict.front(), result.resolved_growth.front(), units),
            "The " + faster_motions(result, units)};
}

std::string lines_of(const std::vector<std::string> &sentences, const char *before,
                     const char *after) {
    std::string text;
    for (const std::string &sentence : sentences)
        text += before + sentence + after;
    return text;
}

} // namespace

std::string bands_text(const std::string &title, const Bands &bands, const Units &units,
                       const BandErrors *errors) {
    return bands.empty() ? title + ": none in this range\n"
                         : title + ":\n" +
                               text_table(band_columns(errors != nullptr),
                                          band_lines("", bands, errors), units);
}

std::string bands_section(const Bands &bands, const Units &units, const BandErrors *errors) {
    return bands.empty()
               ? "<p>None in this range.</p>\n"
               : page_table(band_columns(errors != nullptr), band_lines("", bands, errors), units);
}

model::Sentence stability_answer(const StabilityResult &result) {
    namespace as = model::as;
    const bool apart = result.resolved_up_to.has_value();
    const Bands &bands = apart ? result.resolved_unstable : result.unstable;
    const std::vector<Verdict> &verdicts = apart ? result.resolved_verdict : result.verdict;
    if (result.speeds.empty() || verdicts.empty())
        return {};
    const auto among = [&verdicts](Verdict verdict) {
        return std::ranges::count(verdicts, verdict);
    };
    const auto growing = among(Verdict::unstable) + among(Verdict::diverges);
    const model::Sentence where =
        result.speeds.size() == 1
            ? model::Sentence("at {}", as::speed(result.speeds.front(), 5))
            : model::Sentence("from {}",
                              as::speed.range(result.speeds.front(), result.speeds.back(), 5));
    model::Sentence answer;
    if (!bands.empty()) {
        std::vector<model::Sentence> all;
        for (const results::Interval &band : bands)
            all.emplace_back("{}", as::speed.range(band.from, band.to, 5));
        answer = model::Sentence("unstable from {}", model::joined(all, ", "));
    } else if (growing > 0) {
        answer = result.speeds.size() == 1 ? model::Sentence("unstable {}", where)
                                           : model::Sentence("unstable at {} of {} speeds {}",
                                                             growing, result.speeds.size(), where);
    } else if (among(Verdict::unknown) > 0) {
        answer = model::Sentence("nothing unstable was found {}, but not every speed has an answer",
                                 where);
    } else {
        answer = among(Verdict::neutral) > 0
                     ? model::Sentence("no motion grows {}; without damping some do not die out "
                                       "either",
                                       where)
                     : model::Sentence("stable {}: every motion dies out", where);
    }
    return apart ? answer += model::Sentence(" (motions up to frequencies of {}, which the "
                                             "elements resolve)",
                                             as::frequency(*result.resolved_up_to, 4))
                 : answer;
}

std::string headline_text(const StabilityResult &result, const Units &units) {
    if (result.speeds.size() == 1)
        return lines_of(sentences_at_one_speed(result, units), "", "\n");
    std::string text;
    for (const Told &of : told(result, units)) {
        const std::string more = not_in_bands(of, result.speeds);
        if (of.bands.empty() && !more.empty())
            text += of.title + ": " + more + "\n";
        else
            text += bands_text(of.title, of.bands, units, &of.errors) +
                    (more.empty() ? "" : "  " + more + "\n");
        if (&of.bands == &result.resolved_unstable)
            text += "The " + faster_motions(result, units) + "\n";
    }
    return text;
}

std::vector<Section> headline_sections(const StabilityResult &result, const Units &units) {
    if (result.speeds.size() == 1)
        return {{"Stability at this speed",
                 lines_of(sentences_at_one_speed(result, units), "<p>", ".</p>\n")}};
    std::vector<Section> sections;
    for (const Told &of : told(result, units)) {
        const std::string more = not_in_bands(of, result.speeds);
        const std::string sentence = more.empty() ? "" : "<p>" + more + ".</p>\n";
        sections.push_back({of.title == "Unstable" ? "Unstable spin speeds" : of.title,
                            of.bands.empty() && !more.empty()
                                ? sentence
                                : bands_section(of.bands, units, &of.errors) + sentence});
        if (&of.bands == &result.resolved_unstable)
            sections.back().html += "<p>The " + faster_motions(result, units) + ".</p>\n";
    }
    return sections;
}

} // namespace whirl::report
