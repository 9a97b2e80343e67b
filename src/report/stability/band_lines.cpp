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
    {"", "kind", {}, {}, &BandLine::kind},
    {"", "from", {"From (rad/s)", "{:.10g}"}, {"from rad/s", precise}, &BandLine::from},
    {"", "to", {"to (rad/s)", "{:.10g}"}, {"to rad/s", precise}, &BandLine::to},
    {"",
     "",
     {"from (rpm)", "{:.8g}"},
     {"from rpm"},
     [](const BandLine &line) { return line.from * rpm; }},
    {"",
     "",
     {"to (rpm)", "{:.8g}"},
     {"to rpm"},
     [](const BandLine &line) { return line.to * rpm; }},
    {"", "", {"width (rad/s)", "{:.4g}"}, {"width rad/s"}, width},
    {"", "growth [1/s]", {}, {}, &BandLine::growth},
    {"", "verdict", {}, {}, &BandLine::verdict}};

} // namespace

const Columns<BandLine> &band_line_columns() { return plain_columns; }

Columns<BandLine> band_columns_with_errors() {
    Columns<BandLine> more = plain_columns;
    more.push_back({"",
                    "error of from",
                    {"error of from (rad/s)", "{:.2g}"},
                    {"error of from", rough},
                    first(&BandLine::errors)});
    more.push_back({"",
                    "error of to",
                    {"error of to (rad/s)", "{:.2g}"},
                    {"error of to", rough},
                    second(&BandLine::errors)});
    return more;
}

Columns<BandLine> file_columns(const results::StabilityResult &result) {
    Columns<BandLine> more = band_columns_with_errors();
    if (!result.resolved_up_to)
        return more;
    more.push_back({"", "resolved growth [1/s]", {}, {}, &BandLine::resolved_growth});
    more.push_back({"", "resolved verdict", {}, {}, &BandLine::resolved_verdict});
    more.push_back({"", "unresolved growth [1/s]", {}, {}, &BandLine::unresolved_growth});
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
