#include "report/common/html.h"
#include "report/common/json.h"
#include "report/common/plot_jobs.h"
#include "report/common/words.h"
#include "report/pictures/figures.h"
#include "report/report.h"
#include "results/formulation.h"
#include "results/model_summary.h"

#include <fmt/format.h>

#include <map>
#include <sstream>

namespace whirl::report {

namespace {

/// The equations of the form, as HTML.
std::string form_formula(results::Form form) {
    switch (form) {
    case results::Form::planar:
        return "<b>M</b> ẅ − iΩ<b>G</b> ẇ + <b>K</b> w = 0, w = x + iy; with w = ŵ "
               "e<sup>iωt</sup>: (−ω²<b>M</b> + ωΩ<b>G</b> + <b>K</b>) ŵ = 0";
    case results::Form::planar_damped:
        return "<b>M</b> ẅ + (<b>C</b> + i<b>C</b><sub>x</sub> − iΩ<b>G</b>) ẇ + (<b>K</b> + "
               "i<b>K</b><sub>x</sub> − iΩ<b>K</b><sub>c</sub>) w = 0, w = x + iy; with w = ŵ "
               "e<sup>λt</sup> the sign of Im λ is the direction of whirl";
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

/// "planar form, in the fixed frame: why", the equations and the mesh.
std::string formulation(const results::ModelSummary &model, const Units &readers) {
    if (model.none)
        return element("h2", "Formulation") + element("p", model.formulation.why + ".");
    const results::Form form = model.formulation.form;
    const std::string axes =
        results::in_rotating_axes(form) ? "axes that turn with the rotor" : "the fixed frame";
    return element("h2", "Formulation") +
           element("p", fmt::format("{} form, in {}: {}.", results::form_name(form), axes,
                                    model.formulation.why)) +
           "<div class=\"formula\">" + form_formula(form) + "</div>\n" +
           element("p",
                   fmt::format("Shaft elements of order {}{}, {} of them, {} unknowns; "
                               "computed in {}.",
                               model.order, model.order == 1 ? " (classical)" : "", model.elements,
                               model.unknowns, readers.text(Quantity::time, model.seconds, 3)));
}

std::string escaped_attribute(const std::string &text) {
    std::string out;
    for (const char letter : escaped(text))
        out += letter == '"' ? std::string("&quot;") : std::string(1, letter);
    return out;
}

/// @param pictures  in the units that were asked for
std::string sections_of(const Report &report, const std::string &pictures) {
    std::vector<Section> sections = report.sections(Units::of_readers(report.scene->units));
    if (!pictures.empty())
        sections.insert(sections.begin() + static_cast<std::ptrdiff_t>(report.pictures_after),
                        {report.pictures_heading, pictures});
    std::string html;
    for (const Section &section : sections)
        html += element("h2", section.heading) + section.html;
    return html;
}

/// The text with its line ends, escaped.
std::string escaped_lines(const std::string &text) {
    std::istringstream lines(text);
    std::string html;
    for (std::string line; std::getline(lines, line);)
        html += escaped(line) + "\n";
    return html;
}

/// Comments in front of the case.
std::string overrides_of(const Provenance &provenance) {
    return joined(provenance.set, "",
                  [](const std::string &entry) { return "# --set \"" + entry + "\"\n"; });
}

/// What stands between the head of a page and its foot, by the names in page.html.
/// @param still, pictures  as of to_html
std::map<std::string, std::string> main_of(const Report &report, const std::string &still,
                                           const std::string &pictures) {
    const Units readers = Units::of_readers(report.scene->units);
    const std::string title = title_of(*report.scene);
    std::string notes;
    for (const model::Sentence &note : report.model->notes)
        notes += element("p", readers.text(note),
                         note.weight() == model::Weight::information ? "note quiet" : "note");
    const bool is_drawing = static_cast<bool>(report.drawing) || // the rotor itself
                            !model::has_shaft(*report.scene);
    return {{"heading", escaped(report.heading)},
            {"notes", notes},
            {"rotor", is_drawing
                          ? ""
                          : element("h2", "Rotor") +
                                picture_element(to_svg(scene_drawing(*report.scene, readers)),
                                                "Side view of the rotor: " + title)},
            {"plot", report.chart ? page_diagram(report.heading + ": " + title, still) : still},
            {"sections", sections_of(report, pictures)},
            {"model", formulation(*report.model, readers)}};
}

/// The main picture of a page that does not draw it itself; nothing without gnuplot.
std::string still_picture(const Report &report) {
    const Units readers = Units::of_readers(report.scene->units);
    const std::string label = report.heading + ": " + title_of(*report.scene);
    if (report.drawing)
        return picture_element(to_svg(report.drawing(readers)), label);
    PlotJobs jobs;
    if (moves(report) || !jobs.start(chart_figure(report.chart(readers), *report.scene, readers),
                                     PictureFormat::svg, report.command + ".svg"))
        return "";
    return picture_element(jobs.finish().begin()->second, label);
}

} // namespace

bool moves(const Report &report) { return report.chart && !plotly_bundle().empty(); }

std::string page_diagram(const std::string &label, const std::string &still) {
    if (plotly_bundle().empty())
        return still +
               element("p", "This build has no Plotly, so the diagram is a still picture.", "note");
    return fmt::format("<figure aria-label=\"{}; the numbers are in the tables below\">"
                       "<div id=\"plot\"></div></figure>\n",
                       escaped_attribute(label));
}

std::string page_scripts(bool chart, const std::string &own) {
    const std::string_view plotly = chart ? plotly_bundle() : "";
    const auto script = [](std::string_view text) {
        return std::string("<script>").append(text).append("</script>\n");
    };
    if (plotly.empty() && own.empty())
        return "";
    // In a function of its own: names such as `top` belong to the window outside.
    return (plotly.empty() ? "" : script(plotly)) +
           script("(function () {\n" + embedded("common.js") + own +
                  (plotly.empty() ? "" : embedded("chart.js")) + "})();\n");
}

std::string to_html(const Report &report, const std::string &still, const std::string &pictures,
                    const std::vector<std::string> &files) {
    std::map<std::string, std::string> values = main_of(report, still, pictures);
    values.insert({{"title", escaped(title_of(*report.scene))},
                   {"case", escaped(report.scene->name)},
                   {"command", report.command},
                   {"version", program_version()},
                   {"style", embedded("page.css")},
                   {"files", file_links(files)},
                   {"page_script", embedded("page.js") + embedded("tables.js")},
                   {"date", report.provenance.date},
                   {"case_text",
                    escaped_lines(overrides_of(report.provenance) + report.provenance.case_text)},
                   {"json", json_for_script(to_page_json(report))},
                   {"scripts", page_scripts(static_cast<bool>(report.chart),
                                            embedded(report.command + "_space.js"))}});
    return with_contents(filled(embedded("page.html"), values));
}

std::string page_parts(const Report &report) {
    const std::string main =
        filled("@notes@@plot@@sections@@rotor@@model@", main_of(report, still_picture(report), ""));
    return json_text(Json{{"main", main}, {"result", to_page_json(report)}});
}

} // namespace whirl::report
