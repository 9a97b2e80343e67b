#include "report/html.h"

#include "report/drawing.h"
#include "report/json.h"
#include "report/plot_scene.h"
#include "report/plot_style.h"
#include "report/plotly.h"
#include "results/formulation.h"
#include "results/model_summary.h"

#include <fmt/format.h>

namespace whirl::report {

namespace {

constexpr const char *style_sheet = R"(
body{font:15px/1.5 "Segoe UI","DejaVu Sans",Arial,sans-serif;color:#1d2733;background:#fff;
 max-width:1120px;margin:0 auto;padding:1.2rem}
h1{font-size:1.6rem;margin:.2rem 0}h2{font-size:1.15rem;margin:1.8rem 0 .5rem;
 border-bottom:1px solid #d5dbe1;padding-bottom:.2rem}
.sub{color:#5a6775;margin:0}table{border-collapse:collapse;font-variant-numeric:tabular-nums}
th,td{padding:.25rem .8rem;border-bottom:1px solid #e3e8ed;text-align:right}
th{background:#f3f6f8;font-weight:600}td:first-child,th:first-child{text-align:left}
.scroll{overflow-x:auto}svg{max-width:100%;height:auto}#plot{width:100%}
.formula{font-family:"STIX Two Math","Cambria Math","DejaVu Serif",serif;font-size:1.1rem;
 margin:.4rem 0 .4rem 1.5rem}.note{background:#fff7e0;border-left:4px solid #d9a400;
 padding:.4rem .8rem;margin:.4rem 0}footer{color:#5a6775;margin-top:2rem;font-size:.85rem}
@media print{.note{border:1px solid #d9a400}}
)";

/// JSON for a script element: no markup can end the element early.
std::string json_for_script(const std::string &json) {
    std::string safe;
    for (const char letter : json)
        safe += letter == '<' ? std::string("\\u003c") : std::string(1, letter);
    return safe;
}

std::string notes(const std::vector<std::string> &lines) {
    std::string html;
    for (const std::string &line : lines)
        html += "<p class=\"note\">" + escape_markup(line) + "</p>\n";
    return html;
}

/// "planar form, in the fixed frame".
std::string form_and_frame(results::Form form) {
    return fmt::format("{} form, in {}", results::form_name(form),
                       results::in_rotating_axes(form) ? "axes that turn with the rotor"
                                                       : "the fixed frame");
}

std::string formulation(const results::ModelSummary &model) {
    return fmt::format("<h2>Formulation</h2>\n<p>{}: {}.</p>\n"
                       "<div class=\"formula\">{}</div>\n<p>Shaft elements of order {}{}, {} of "
                       "them, {} unknowns; "
                       "computed in {} s.</p>\n",
                       escape_markup(form_and_frame(model.formulation.form)),
                       escape_markup(model.formulation.why), form_formula(model.formulation.form),
                       model.order, model.order == 1 ? " (classical)" : "", model.elements,
                       model.unknowns, readable(model.seconds, 3));
}

} // namespace

std::string html_table(const std::vector<std::string> &head,
                       const std::vector<std::vector<std::string>> &rows) {
    std::string html = "<div class=\"scroll\"><table><thead><tr>";
    for (const std::string &name : head)
        html += "<th>" + escape_markup(name) + "</th>";
    html += "</tr></thead><tbody>\n";
    for (const auto &row : rows) {
        html += "<tr>";
        for (const std::string &value : row)
            html += "<td>" + escape_markup(value) + "</td>";
        html += "</tr>\n";
    }
    return html + "</tbody></table></div>\n";
}

std::string form_formula(results::Form form) {
    switch (form) {
    case results::Form::planar:
        return "<b>M</b> ẅ − iΩ<b>G</b> ẇ + <b>K</b> w = 0, w = x + iy; with w = ŵ "
               "e<sup>iωt</sup>: "
               "(−ω²<b>M</b> + ωΩ<b>G</b> + <b>K</b>) ŵ = 0";
    case results::Form::hyperbolic:
        return "(ω²<b>M</b> + ωΩ<b>S</b> − <b>K</b>) q = 0, <b>S</b> = [0 <b>G</b>; <b>G</b> 0], "
               "with λ = iω and y → iy";
    case results::Form::rotating:
        return "<b>M</b> q̈ + (<b>C</b> + Ω<b>C</b><sub>1</sub>) q̇ + (<b>K</b> + Ω<b>K</b>"
               "<sub>1</sub> + Ω²<b>K</b><sub>2</sub>) q = 0 in axes that turn with the rotor";
    case results::Form::hill:
        return "the same in axes that turn with the rotor, with supports in cos 2Ωt and sin 2Ωt: "
               "q = e<sup>λt</sup> Σ q<sub>k</sub> e<sup>2ikΩt</sup>";
    case results::Form::general:
        break;
    }
    return "<b>M</b> q̈ + (<b>C</b><sub>e</sub> + <b>C</b><sub>i</sub> + Ω<b>G</b>) q̇ + "
           "(<b>K</b> + Ω<b>K</b><sub>c</sub>) q = 0, q = q̂ e<sup>λt</sup>";
}

std::string page(const model::Case &scene, const results::ModelSummary &model,
                 const PageContent &content) {
    const bool interactive = !plotly_bundle().empty() && !content.script.empty();
    std::string html = fmt::format(
        "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">\n"
        "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
        "<title>{0}: {1}</title>\n<link rel=\"icon\" href=\"data:,\">\n<style>{2}</style></head>\n"
        "<body>\n<h1>{1}</h1>\n<p class=\"sub\">{0} · case {3}</p>\n",
        escape_markup(content.heading), escape_markup(title_of(scene)), style_sheet,
        escape_markup(scene.name));
    html += notes(model.notes);
    if (content.command != "show")
        html += "<h2>Rotor</h2>\n" + to_svg(scene_drawing(scene));
    html += "<h2>" + escape_markup(content.heading) + "</h2>\n";
    if (interactive)
        html += "<div id=\"plot\"></div>\n";
    else
        html += content.picture;
    if (!interactive && !content.script.empty())
        html +=
            "<p class=\"note\">This build has no Plotly, so the diagram is a still picture.</p>\n";
    for (const auto &[heading, text] : content.sections)
        html += "<h2>" + escape_markup(heading) + "</h2>\n" + text;
    html += formulation(model);
    html += fmt::format("<footer>Whirl {}. Tables and hover texts give their units; the data below "
                        "the page, as in {}.json, are SI with angles in rad.</footer>\n",
                        program_version(), content.command);
    html += "<script id=\"result\" type=\"application/json\">" + json_for_script(content.json) +
            "</script>\n";
    if (interactive)
        html.append("<script>")
            .append(plotly_bundle())
            .append("</script>\n<script>" + content.script + "</script>\n");
    return html + "</body></html>\n";
}

} // namespace whirl::report
