#include "cli/summary_show.h"

#include "cli/table.h"
#include "results/show.h"

#include <fmt/format.h>

#include <cmath>

namespace whirl::cli {

namespace {

std::string number(const std::optional<double> &value) {
    if (!value)
        return "-";
    return std::isfinite(*value) ? fmt::format("{:.6g}", *value) : "infinite";
}

std::string range(const std::optional<results::Interval> &interval) {
    if (!interval)
        return "-";
    return fmt::format("{:.6g} ... {:.6g}", interval->first, interval->second);
}

std::string balancers_text(const results::ShowResult &result) {
    Table table({"balancer", "z (m)", "E", "D_c", "D_s", "|D| of the family", "dA (kg m2)",
                 "dA of the family"});
    for (std::size_t i = 0; i < result.balancers.size(); ++i) {
        const results::BalancerNumbers &b = result.balancers[i];
        const auto real = b.D ? std::optional(b.D->real()) : std::nullopt;
        const auto imaginary = b.D ? std::optional(b.D->imag()) : std::nullopt;
        table.add({b.name.empty() ? std::to_string(i + 1) : b.name, number(b.z), number(b.E),
                   number(real), number(imaginary), range(b.D_interval), number(b.dA),
                   range(b.dA_interval)});
    }
    Table numbers({"balancer", "C", "A", "A_m", "A_m0", "m", "z_A", "p2", "c_y", "h_x", "h_s"});
    for (std::size_t i = 0; i < result.balancers.size(); ++i) {
        const results::DimensionlessNumbers &d = result.balancers[i].dimensionless;
        const std::string &name = result.balancers[i].name;
        numbers.add({name.empty() ? std::to_string(i + 1) : name, number(d.C), number(d.A),
                     number(d.A_m), number(d.A_m0), number(d.m), number(d.z_A), number(d.p2),
                     number(d.c_y), number(d.h_x), number(d.h_s)});
    }
    return table.text() + "\n" + numbers.text() + "\n";
}

std::string chart_text(const results::AnisotropyChart &chart) {
    std::string text = "  tilt as a rigid rotor: critical speeds";
    for (const double speed : chart.critical_speeds)
        text += fmt::format(" {:.7g}", speed);
    text += chart.critical_speeds.empty() ? " none" : " rad/s";
    if (!chart.unstable)
        text += ", stable at every speed";
    else if (chart.unstable->to)
        text += fmt::format(", unstable from {:.7g} to {:.7g} rad/s", chart.unstable->from,
                            *chart.unstable->to);
    else
        text += fmt::format(", unstable above {:.7g} rad/s", chart.unstable->from);
    return text + fmt::format("\n  largest anisotropy dI/Id stable at every speed: {:.5g} (the "
                              "case has {:.5g})\n\n",
                              chart.permissible, chart.anisotropy);
}

} // namespace

std::string rotating_parts_text(const results::ShowResult &result) {
    std::string text;
    if (!result.balancers.empty())
        text += balancers_text(result);
    if (result.anisotropy)
        text += chart_text(*result.anisotropy);
    return text;
}

} // namespace whirl::cli
