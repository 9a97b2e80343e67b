#include "report/drawing.h"

#include <fmt/format.h>

#include <cmath>

namespace whirl::report {

namespace {

std::string svg_shape(const DrawShape &shape) {
    std::string points;
    for (const DrawPoint &point : shape.points)
        points += fmt::format("{:.2f},{:.2f} ", point.x, point.y);
    return fmt::format("<{} points=\"{}\" fill=\"{}\" stroke=\"{}\" stroke-width=\"{}\"{}/>\n",
                       shape.closed ? "polygon" : "polyline", points,
                       shape.fill.empty() ? "none" : shape.fill,
                       shape.stroke.empty() ? "none" : shape.stroke, shape.width,
                       shape.dashed ? " stroke-dasharray=\"6 4\"" : "");
}

std::string svg_text(const DrawText &text) {
    static constexpr const char *anchors[] = {"start", "middle", "end"};
    return fmt::format("<text x=\"{:.2f}\" y=\"{:.2f}\" font-size=\"{}\" text-anchor=\"{}\" "
                       "fill=\"{}\">{}</text>\n",
                       text.at.x, text.at.y, text.size, anchors[static_cast<int>(text.anchor)],
                       text.colour, escape_markup(text.text));
}

} // namespace

std::string to_svg(const Drawing &drawing) {
    std::string svg = fmt::format(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0:.0f} {1:.0f}\" "
        "width=\"{0:.0f}\" "
        "height=\"{1:.0f}\" font-family=\"DejaVu Sans, Arial, sans-serif\" role=\"img\">\n"
        "<rect width=\"100%\" height=\"100%\" fill=\"#ffffff\"/>\n",
        drawing.width, drawing.height);
    for (const DrawShape &shape : drawing.shapes)
        svg += svg_shape(shape);
    for (const DrawText &text : drawing.texts)
        svg += svg_text(text);
    return svg + "</svg>\n";
}

Figure to_figure(const Drawing &drawing) {
    Figure figure;
    figure.width = static_cast<int>(std::ceil(drawing.width));
    figure.height = static_cast<int>(std::ceil(drawing.height));
    std::string &script = figure.script;
    script =
        fmt::format("unset border\nunset tics\nunset key\nset lmargin at screen 0\n"
                    "set rmargin at screen 1\nset bmargin at screen 0\nset tmargin at screen 1\n"
                    "set xrange [0:{}]\nset yrange [{}:0]\n",
                    figure.width, figure.height);
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
    static constexpr const char *anchors[] = {"left", "center", "right"};
    for (const DrawText &text : drawing.texts)
        // gnuplot centres a label on its point, so the baseline moves up by a third of the size.
        script +=
            fmt::format("set label {} at {},{} {} font ',{:.1f}' textcolor '{}' front\n",
                        plot_text(text.text), text.at.x, text.at.y - 0.35 * text.size,
                        anchors[static_cast<int>(text.anchor)], 0.75 * text.size, text.colour);
    plots += "NaN notitle"; // a plot command needs at least one element
    script += "plot " + plots + "\n";
    return figure;
}

std::string escape_markup(const std::string &text) {
    std::string escaped;
    for (const char letter : text)
        switch (letter) {
        case '&':
            escaped += "&amp;";
            break;
        case '<':
            escaped += "&lt;";
            break;
        case '>':
            escaped += "&gt;";
            break;
        case '"':
            escaped += "&quot;";
            break;
        case '\'':
            escaped += "&#39;";
            break;
        default:
            escaped += static_cast<unsigned char>(letter) < 0x20 ? ' ' : letter;
        }
    return escaped;
}

} // namespace whirl::report
