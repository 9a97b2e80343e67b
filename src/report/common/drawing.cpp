#include "report/common/drawing.h"

#include "report/common/html.h"
#include "report/common/text_width.h"

#include <fmt/format.h>
#include <pugixml.hpp>

#include <cmath>

namespace whirl::report {

namespace {

void add_shape(pugi::xml_node parent, const DrawShape &shape) {
    std::string points;
    for (const DrawPoint &point : shape.points)
        points += fmt::format("{:.2f},{:.2f} ", point.x, point.y);
    pugi::xml_node node = parent.append_child(shape.closed ? "polygon" : "polyline");
    node.append_attribute("points") = points.c_str();
    node.append_attribute("fill") = shape.fill.empty() ? "none" : shape.fill.c_str();
    node.append_attribute("stroke") = shape.stroke.empty() ? "none" : shape.stroke.c_str();
    node.append_attribute("stroke-width") = fmt::format("{}", shape.width).c_str();
    if (shape.dashed)
        node.append_attribute("stroke-dasharray") = "6 4";
}

void add_text(pugi::xml_node parent, const DrawText &text) {
    pugi::xml_node node = parent.append_child("text");
    node.append_attribute("x") = fmt::format("{:.2f}", text.at.x).c_str();
    node.append_attribute("y") = fmt::format("{:.2f}", text.at.y).c_str();
    node.append_attribute("font-size") = fmt::format("{}", text.size).c_str();
    node.append_attribute("text-anchor") = "middle";
    node.append_attribute("fill") = text.colour.c_str();
    node.text().set(printable(text.text).c_str());
}

} // namespace

std::string to_svg(const Drawing &drawing) {
    const std::string width = fmt::format("{:.0f}", drawing.width);
    const std::string height = fmt::format("{:.0f}", drawing.height);
    pugi::xml_document document;
    pugi::xml_node svg = document.append_child("svg");
    svg.append_attribute("xmlns") = "http://www.w3.org/2000/svg";
    svg.append_attribute("viewBox") = fmt::format("0 0 {} {}", width, height).c_str();
    svg.append_attribute("width") = width.c_str();
    svg.append_attribute("height") = height.c_str();
    svg.append_attribute("font-family") = "DejaVu Sans, Arial, sans-serif";
    svg.append_attribute("role") = "img";
    pugi::xml_node paper = svg.append_child("rect");
    paper.append_attribute("width") = "100%";
    paper.append_attribute("height") = "100%";
    paper.append_attribute("fill") = "#ffffff";
    for (const DrawShape &shape : drawing.shapes)
        add_shape(svg, shape);
    for (const DrawText &text : drawing.texts)
        add_text(svg, text);
    return markup(document);
}

Figure to_figure(const Drawing &drawing) {
    const int width = static_cast<int>(std::ceil(drawing.width));
    const int height = static_cast<int>(std::ceil(drawing.height));
    std::string script =
        fmt::format("unset border\nunset tics\nunset key\nset lmargin at screen 0\n"
                    "set rmargin at screen 1\nset bmargin at screen 0\nset tmargin at screen 1\n"
                    "set xrange [0:{}]\nset yrange [{}:0]\n",
                    width, height);
    std::string plots;
    for (std::size_t i = 0; i < drawing.shapes.size(); ++i) {
        const DrawShape &shape = drawing.shapes[i];
        script += fmt::format("$s{} << EOD\n", i);
        for (const DrawPoint &point : shape.points)
            script += fmt::format("{:.2f} {:.2f}\n", point.x, point.y);
        if (shape.closed && !shape.points.empty())
            script += fmt::format("{:.2f} {:.2f}\n", shape.points[0].x, shape.points[0].y);
        script += "EOD\n";
        if (!shape.fill.empty())
            plots += fmt::format("$s{} with filledcurves closed fs solid 1 noborder fc rgb '{}', ",
                                 i, shape.fill);
        if (!shape.stroke.empty())
            plots += fmt::format("$s{} with lines lw {} dt {} lc rgb '{}', ", i, shape.width,
                                 shape.dashed ? "(9,6)" : "1", shape.stroke);
    }
    for (const DrawText &text : drawing.texts)
        // gnuplot centres a label on its point, so the baseline moves up by a third of the size.
        script += fmt::format("set label {} at {},{} center font ',{:.1f}' textcolor '{}' front\n",
                              plot_text(text.text), text.at.x, text.at.y - 0.35 * text.size,
                              text.size, text.colour);
    plots += "NaN notitle"; // a plot command needs at least one element
    return {script + "plot " + plots + "\n", width, height};
}

} // namespace whirl::report
