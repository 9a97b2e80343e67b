#include "report/html_show.h"

#include "report/html.h"
#include "report/plot_style.h"
#include "results/show.h"

#include <fmt/format.h>

#include <cmath>

namespace whirl::report {

namespace {

using Rows = std::vector<std::vector<std::string>>;

std::string cell(const std::optional<double> &value, const char *unit = "") {
    if (!value)
        return "–";
    return std::isfinite(*value) ? readable(*value, 8) + unit : "∞";
}

std::string cell(const std::optional<results::Interval> &interval, const char *unit = "") {
    return interval ? readable(interval->first, 8) + " … " + readable(interval->second, 8) + unit
                    : "–";
}

std::string position_text(const std::vector<double> &angles) {
    std::string text;
    for (const double angle : angles) {
        if (text.size() > 200)
            return text + " …";
        text += (text.empty() ? "" : ", ") + fmt::format("{:.5g}°", angle * 180 / pi);
    }
    return text.empty() ? "–" : text;
}

std::string composite_table(const results::BalancerNumbers &balancer) {
    const auto real = balancer.D ? std::optional(balancer.D->real()) : std::nullopt;
    const auto imaginary = balancer.D ? std::optional(balancer.D->imag()) : std::nullopt;
    return html_table(
        {"Quantity", "Value"},
        {{"Place, z", readable(balancer.z, 8) + " m"},
         {"Capacity E", cell(balancer.E)},
         {"Balanced position of the balls", position_text(balancer.position)},
         {"Second harmonic D: cosine part", cell(real)},
         {"Second harmonic D: sine part", cell(imaginary)},
         {"|D| over all balanced positions", cell(balancer.D_interval)},
         {"Anisotropy |A_m0 + A_m D|/2", cell(balancer.dA, " kg m²")},
         {"over all balanced positions", cell(balancer.dA_interval, " kg m²")},
         {"with the unsigned |D|", cell(balancer.dA_paper, " kg m²")},
         {"Mass of the rest of the rotor", readable(balancer.bare.mass, 8) + " kg"},
         {"its diametral inertia", readable(balancer.bare.Id, 8) + " kg m²"},
         {"its polar inertia", readable(balancer.bare.Ip, 8) + " kg m²"},
         {"from its centre of mass to the balancer", readable(balancer.bare.z_GA, 8) + " m"}});
}

std::string dimensionless_table(const results::DimensionlessNumbers &d) {
    return html_table(
        {"C", "A", "A_m", "A_m0", "m", "z_A", "p²", "c_y", "h_x", "h_β", "h_y", "h_s"},
        {{cell(d.C), cell(d.A), cell(d.A_m), cell(d.A_m0), cell(d.m), cell(d.z_A), cell(d.p2),
          cell(d.c_y), cell(d.h_x), cell(d.h_beta), cell(d.h_y), cell(d.h_s)}});
}

std::string chart_table(const results::AnisotropyChart &chart) {
    Rows rows{{"Polar over mean diametral inertia, C", cell(chart.C)},
              {"Anisotropy over the mean diametral inertia", cell(chart.anisotropy)},
              {"Natural frequency of tilt at rest, p", cell(chart.p, " rad/s")},
              {"Tilt damping over the mean diametral inertia, h", cell(chart.h, " 1/s")}};
    for (const double speed : chart.critical_speeds)
        rows.push_back({"Critical speed without damping", cell(speed, " rad/s")});
    if (chart.unstable)
        rows.push_back({"Unstable", cell(chart.unstable->from) + " … " +
                                        (chart.unstable->to ? cell(chart.unstable->to) : "∞") +
                                        " rad/s"});
    rows.push_back({"Largest anisotropy stable at every speed", cell(chart.permissible)});
    rows.push_back({"least at", chart.permissible_speed ? cell(chart.permissible_speed, " rad/s")
                                                        : "infinite speed"});
    return html_table({"Quantity", "Value"}, rows);
}

} // namespace

std::vector<std::pair<std::string, std::string>> show_sections(const results::ShowResult &result) {
    std::vector<std::pair<std::string, std::string>> sections;
    for (std::size_t i = 0; i < result.balancers.size(); ++i) {
        const results::BalancerNumbers &balancer = result.balancers[i];
        const std::string name =
            balancer.name.empty() ? fmt::format("balancer {}", i + 1) : balancer.name;
        sections.emplace_back("Composite rotor: " + name,
                              composite_table(balancer) +
                                  dimensionless_table(balancer.dimensionless));
    }
    if (result.anisotropy)
        sections.emplace_back("Anisotropy: tilt of the rigid rotor",
                              chart_table(*result.anisotropy));
    return sections;
}

} // namespace whirl::report
