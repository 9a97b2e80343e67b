#include "report/stability/band_lines.h"

#include "report/common/units.h"

namespace whirl::report {

namespace {

template <class Pair> auto first(std::optional<Pair> BandLine::*of) {
    return [of](const BandLine &line) { return line.*of ? Json((line.*of)->first) : Json(); };
}
template <class Pair> auto second(std::optional<Pair> BandLine::*of) {
    return [of](const BandLine &line) { return line.*of ? Json((line.*of)->second) : Json(); };
}
double width(const BandLine &line) { return line.to - line.from; }

const Columns<BandLine> plain_columns{
    {InCsv("kind"), &BandLine::kind},
    {InCsv("from"), OnPage("From (rad/s)", "{:.10g}"), InText("from rad/s", precise),
     &BandLine::from},
    {InCsv("to"), OnPage("to (rad/s)", "{:.10g}"), InText("to rad/s", precise), &BandLine::to},
    {OnPage("from (rpm)", "{:.8g}"), InText("from rpm"), in(rpm, &BandLine::from)},
    {OnPage("to (rpm)", "{:.8g}"), InText("to rpm"), in(rpm, &BandLine::to)},
    {OnPage("width (rad/s)", "{:.4g}"), InText("width rad/s"), width},
    {InCsv("growth [1/s]"), &BandLine::growth},
    {InCsv("verdict"), &BandLine::verdict}};

} // namespace

const Columns<BandLine> &band_line_columns() { return plain_columns; }

Columns<BandLine> band_columns_with_errors() {
    Columns<BandLine> more = plain_columns;
    more.push_back({InCsv("error of from"), OnPage("error of from (rad/s)", "{:.2g}"),
                    InText("error of from", rough), first(&BandLine::errors)});
    more.push_back({InCsv("error of to"), OnPage("error of to (rad/s)", "{:.2g}"),
                    InText("error of to", rough), second(&BandLine::errors)});
    return more;
}

Columns<BandLine> file_columns(const results::StabilityResult &result) {
    Columns<BandLine> more = band_columns_with_errors();
    if (!result.resolved_up_to)
        return more;
    more.push_back({InCsv("resolved growth [1/s]"), &BandLine::resolved_growth});
    more.push_back({InCsv("resolved verdict"), &BandLine::resolved_verdict});
    more.push_back({InCsv("unresolved growth [1/s]"), &BandLine::unresolved_growth});
    return more;
}

std::vector<BandLine> band_lines(const std::string &kind, const SpeedPairs &bands,
                                 const SpeedPairs &errors) {
    std::vector<BandLine> all;
    for (std::size_t i = 0; i < bands.size(); ++i) {
        all.push_back({kind, bands[i].first, bands[i].second});
        if (i < errors.size())
            all.back().errors = errors[i];
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
            all.push_back({"map", map.x_values[i], map.y_values[j], map.growth[j][i]});
    return all;
}

} // namespace whirl::report
