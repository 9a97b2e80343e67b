#include "report/common/margins.h"

#include "report/common/words.h"

#include <fmt/format.h>

namespace whirl::report {

using results::SeparationMargin;

namespace {

std::string where(const SeparationMargin &margin, const Units &units) {
    if (!margin.z)
        return "";
    const std::string at = margin.of + ", " + place(margin.name, *margin.z, units);
    return margin.angle && margin.name.empty() // which of two at one place
               ? at + ", " + units.text(Quantity::angle, *margin.angle, 4)
               : at;
}

std::string verdict(const SeparationMargin &margin) {
    return margin.passes ? "passes" : margin.grows ? "fails: grows" : "fails";
}

std::string side(const SeparationMargin &margin) {
    return results::margin_side_name(margin.side) + " the range";
}

const Columns<SeparationMargin> columns{
    {"speed", ForReaders("", "{:.8g}"), Quantity::speed, &SeparationMargin::speed},
    {"whirl", &SeparationMargin::whirl},
    {"plane", Quantity::angle, &SeparationMargin::plane},
    {Titled("Whirl"), whirl_of},
    {"amplification", OnPage("Amplification factor", "{:.4g}"), InText("AF", "{:.4g}"),
     Quantity::number, &SeparationMargin::amplification},
    {"source", ForReaders("from"), &SeparationMargin::source},
    {"of", &SeparationMargin::of},
    {"z", Quantity::length, &SeparationMargin::z},
    {"name", &SeparationMargin::name},
    {"angle", Quantity::angle, &SeparationMargin::angle},
    {Titled("Peak at"), where},
    {"side", [](const auto &margin) { return results::margin_side_name(margin.side); }},
    {Titled("Lies"), side},
    {"found", OnPage("Margin found (%)", "{:.4g}"), InText("found %", "{:.4g}"), Quantity::number,
     &SeparationMargin::found},
    {"required", OnPage("Margin required (%)", "{:.4g}"), InText("required %", "{:.4g}"),
     Quantity::number, &SeparationMargin::required},
    {"passes", &SeparationMargin::passes},
    {OnPage("Verdict"), InText(""), verdict}};

} // namespace

void add_margins(Json &json, const Margins &margins, const Units &units) {
    if (margins)
        json["margins"] = json_rows(columns, *margins, units);
}

std::string margins_page(const std::vector<SeparationMargin> &margins, const Units &units) {
    return margins.empty() ? "<p>No critical speed with an amplification factor of 2.5 or more.</p>"
                           : page_table(columns, margins, units);
}

std::string margins_text(const Margins &margins, const Units &units) {
    if (!margins)
        return "";
    return std::string("\n") + margins_heading + ":\n" +
           (margins->empty() ? "  no critical speed with an amplification factor of 2.5 or more\n"
                             : text_table(columns, *margins, units));
}

} // namespace whirl::report
