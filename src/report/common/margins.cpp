#include "report/common/margins.h"

#include "report/common/words.h"

#include <fmt/format.h>

namespace whirl::report {

using results::SeparationMargin;

namespace {

std::string where(const SeparationMargin &margin) {
    if (!margin.z)
        return "";
    const std::string at = margin.of + ", " + place(margin.name, *margin.z);
    return margin.angle && margin.name.empty() // which of two at one place
               ? fmt::format("{}, {:.4g}°", at, *margin.angle * degrees)
               : at;
}

std::string verdict(const SeparationMargin &margin) { return margin.passes ? "passes" : "fails"; }

std::string side(const SeparationMargin &margin) {
    return results::margin_side_name(margin.side) + " the range";
}

const Columns<SeparationMargin> columns{
    {"speed", &SeparationMargin::speed},
    {ForReaders("rpm", "{:.8g}"), in(rpm, &SeparationMargin::speed)},
    {"whirl", OnPage("Whirl"), InText("whirl"), &SeparationMargin::whirl},
    {"amplification", OnPage("Amplification factor", "{:.4g}"), InText("AF", "{:.4g}"),
     &SeparationMargin::amplification},
    {"source", ForReaders("from"), &SeparationMargin::source},
    {"of", &SeparationMargin::of},
    {"z", &SeparationMargin::z},
    {"name", &SeparationMargin::name},
    {"angle", &SeparationMargin::angle},
    {OnPage("Peak at"), InText("peak at"), where},
    {"side", [](const auto &margin) { return results::margin_side_name(margin.side); }},
    {OnPage("Lies"), InText("lies"), side},
    {"found", OnPage("Margin found (%)", "{:.4g}"), InText("found %", "{:.4g}"),
     &SeparationMargin::found},
    {"required", OnPage("Margin required (%)", "{:.4g}"), InText("required %", "{:.4g}"),
     &SeparationMargin::required},
    {"passes", &SeparationMargin::passes},
    {OnPage("Verdict"), InText(""), verdict}};

} // namespace

void add_margins(Json &json, const Margins &margins) {
    if (margins)
        json["margins"] = json_rows(columns, *margins);
}

std::string margins_page(const std::vector<SeparationMargin> &margins) {
    return margins.empty() ? "<p>No critical speed with an amplification factor of 2.5 or more.</p>"
                           : page_table(columns, margins);
}

std::string margins_text(const Margins &margins) {
    if (!margins)
        return "";
    return std::string("\n") + margins_heading + ":\n" +
           (margins->empty() ? "  no critical speed with an amplification factor of 2.5 or more\n"
                             : text_table(columns, *margins));
}

} // namespace whirl::report
