#include "report/html_balance.h"

#include "report/drawing.h"
#include "report/html.h"
#include "report/plot_style.h"

#include <fmt/format.h>

namespace whirl::report {

namespace {

using Rows = std::vector<std::vector<std::string>>;

std::string bands_text(const std::vector<results::SpeedBand> &bands) {
    std::string text;
    for (const auto &band : bands)
        text += (text.empty() ? "" : "; ") + readable(band.from, 8) + " … " + readable(band.to, 8);
    return text.empty() ? "none" : text;
}

std::vector<std::string> bands_row(const std::string &name, const results::BalanceBands &of) {
    return {name, bands_text(of.bands), of.rigid_bands ? bands_text(*of.rigid_bands) : "–"};
}

std::string plane_name(const results::BalancePlane &plane, std::size_t index) {
    return (plane.name.empty() ? "plane " + std::to_string(index + 1) : plane.name) +
           ", z = " + readable(plane.z) + " m";
}

void add_ends(Rows &rows, const std::string &name, const results::BalanceBands &of) {
    for (const auto &end : of.ends)
        rows.push_back({name, end.upper ? "upper" : "lower", readable(end.speed, 10),
                        readable(end.speed * rpm, 8), end.error ? readable(*end.error, 2) : "–",
                        end.pinned ? readable(*end.pinned, 10) : "–",
                        end.rigid ? readable(*end.rigid, 10) : "–",
                        end.relative_difference ? readable(*end.relative_difference, 3) : "–"});
}

std::string findings(const std::vector<std::string> &sentences) {
    std::string html;
    for (const std::string &sentence : sentences)
        html += "<p>" + escape_markup(sentence) + "</p>\n";
    return html.empty() ? "<p>Nothing beyond the bands.</p>\n" : html;
}

std::string placement(const results::Placement &map) {
    Rows rows;
    for (const auto &[name, place] :
         {std::pair("one plane", &map.best), std::pair("two planes", &map.best_pair)}) {
        std::string z;
        for (const double at : place->z)
            z += (z.empty() ? "" : ", ") + readable(at);
        rows.push_back({name, z, readable(100 * place->share, 4), readable(place->margin, 4)});
    }
    return html_table({"Best", "z (m)", "Share of the speeds (%)", "Margin"}, rows) +
           "<p>Margin: mean over the speeds of the largest eigenvalue, times −1 and the mass of "
           "the "
           "rotor, each cut to ±1.</p>\n";
}

} // namespace

std::vector<std::pair<std::string, std::string>>
balance_sections(const results::BalanceResult &result) {
    std::vector<std::pair<std::string, std::string>> sections;
    sections.emplace_back("What it says", findings(result.findings));
    Rows bands;
    Rows ends;
    for (std::size_t i = 0; i < result.planes.size(); ++i) {
        const std::string name = plane_name(result.planes[i], i);
        bands.push_back(bands_row(name, result.planes[i].bands));
        add_ends(ends, name, result.planes[i].bands);
    }
    if (result.planes.size() > 1) {
        bands.push_back(bands_row("all together", result.joint.bands));
        add_ends(ends, "all together", result.joint.bands);
    }
    sections.emplace_back("Bands of spin speed (rad/s)",
                          html_table({"Planes", "Flexible", "Rigid closed form"}, bands));
    if (!ends.empty())
        sections.emplace_back("Ends of the bands",
                              html_table({"Planes", "End", "rad/s", "rpm", "Error (rad/s)",
                                          "Pinned critical speed", "Rigid", "Relative difference"},
                                         ends));
    if (result.placement)
        sections.emplace_back("Best places", placement(*result.placement));
    Rows pendulums;
    for (const auto &p : result.pendulum)
        pendulums.push_back({readable(p.z), readable(p.rho, 6), readable(p.threshold, 6),
                             readable(p.limit, 6), readable(p.mass, 6), readable(p.omega_0, 8),
                             readable(p.external_damping), readable(p.hinge_damping)});
    if (!pendulums.empty())
        sections.emplace_back("Four-pendulum balancers",
                              html_table({"z (m)", "ρ", "Threshold ratio", "Limit of n", "M_Σ (kg)",
                                          "ω₀ (rad/s)", "H", "h"},
                                         pendulums));
    return sections;
}

} // namespace whirl::report
