#include "report/stability/headline.h"

#include "report/common/html.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace whirl::report {

using results::StabilityResult;
using results::Verdict;

namespace {

/// Bands, and the verdicts at the speeds that they are to explain.
struct Told {
    std::string title;
    const SpeedPairs &bands, &errors;
    const std::vector<Verdict> &verdicts;
};

/// All that is told apart: of one rotor all motions, or those that are resolved and all of them.
std::vector<Told> told(const StabilityResult &result) {
    const Told all{"Unstable", result.unstable, result.unstable_error, result.verdict};
    if (!result.resolved_up_to)
        return {all};
    std::vector<Told> out{{fmt::format("Unstable, motions up to frequencies of {:.6g} rad/s, "
                                       "which the elements resolve",
                                       *result.resolved_up_to),
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
            return speeds[i] >= band.first && speeds[i] <= band.second;
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
std::string faster_motions(const StabilityResult &result) {
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
        text += fmt::format("growing{}, by up to {:.4g} 1/s", at(growing),
                            *std::max_element(growth.begin(), growth.end(), [](double a, double b) {
                                return std::isnan(a) || a < b;
                            }));
    if (unknown > 0)
        text += (growing > 0 ? "; " : "") + ("not known" + at(unknown));
    return text;
}

/// Of one speed.
std::string becomes(Verdict verdict, double growth) {
    switch (verdict) {
    case Verdict::stable:
        return fmt::format("Stable: every motion dies out, the slowest with {:.6g} 1/s", growth);
    case Verdict::neutral:
        return "Neither stable nor unstable: no motion grows, some do not die out either (no "
               "damping)";
    case Verdict::unstable:
        return fmt::format("Unstable: a whirl grows with {:.6g} 1/s", growth);
    case Verdict::diverges:
        return fmt::format("Unstable: it diverges, a real root of +{:.6g} 1/s", growth);
    default:
        return "No answer at this speed";
    }
}

/// The same of the motions that are resolved, and of the others.
std::vector<std::string> sentences_at_one_speed(const StabilityResult &result) {
    if (!result.resolved_up_to)
        return {becomes(result.verdict.front(), result.growth.front())};
    return {fmt::format("Motions up to frequencies of {:.6g} rad/s, which the elements resolve: ",
                        *result.resolved_up_to) +
                becomes(result.resolved_verdict.front(), result.resolved_growth.front()),
            "The " + faster_motions(result)};
}

std::string lines_of(const std::vector<std::string> &sentences, const char *before,
                     const char *after) {
    std::string text;
    for (const std::string &sentence : sentences)
        text += before + sentence + after;
    return text;
}

} // namespace

std::string bands_text(const std::string &title, const std::vector<BandLine> &bands,
                       const Columns<BandLine> &shown_columns) {
    return bands.empty() ? title + ": none in this range\n"
                         : title + ":\n" + text_table(shown_columns, bands);
}

std::string bands_section(const std::vector<BandLine> &bands,
                          const Columns<BandLine> &shown_columns) {
    return bands.empty() ? "<p>None in this range.</p>\n" : page_table(shown_columns, bands);
}

std::string headline_text(const StabilityResult &result) {
    if (result.speeds.size() == 1)
        return lines_of(sentences_at_one_speed(result), "", "\n");
    std::string text;
    for (const Told &of : told(result)) {
        const std::string more = not_in_bands(of, result.speeds);
        if (of.bands.empty() && !more.empty())
            text += of.title + ": " + more + "\n";
        else
            text += bands_text(of.title, band_lines("", of.bands, of.errors),
                               band_columns_with_errors()) +
                    (more.empty() ? "" : "  " + more + "\n");
        if (&of.bands == &result.resolved_unstable)
            text += "The " + faster_motions(result) + "\n";
    }
    return text;
}

std::vector<Section> headline_sections(const StabilityResult &result) {
    if (result.speeds.size() == 1)
        return {{"Stability at this speed",
                 lines_of(sentences_at_one_speed(result), "<p>", ".</p>\n")}};
    std::vector<Section> sections;
    for (const Told &of : told(result)) {
        const std::string more = not_in_bands(of, result.speeds);
        const std::string sentence = more.empty() ? "" : "<p>" + more + ".</p>\n";
        sections.push_back(
            {of.title == "Unstable" ? "Unstable spin speeds" : of.title,
             of.bands.empty() && !more.empty()
                 ? sentence
                 : bands_section(band_lines("", of.bands, of.errors), band_columns_with_errors()) +
                       sentence});
        if (&of.bands == &result.resolved_unstable)
            sections.back().html += "<p>The " + faster_motions(result) + ".</p>\n";
    }
    return sections;
}

} // namespace whirl::report
