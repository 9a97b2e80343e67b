#include "svg_plot.h"

#include <pugixml.hpp>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>

namespace whirl::tests {

double Axis::value(double pixel) const {
    const Tick &a = ticks.front();
    const Tick &b = ticks.back();
    return a.value + (b.value - a.value) * (pixel - a.pixel) / (b.pixel - a.pixel);
}

double Axis::pixel(double value) const {
    const Tick &a = ticks.front();
    const Tick &b = ticks.back();
    return a.pixel + (b.pixel - a.pixel) * (value - a.value) / (b.value - a.value);
}

bool PlottedCurve::in_legend(const std::vector<PlotPixel> &line) const {
    constexpr double half_a_line = 9; // pixels
    return name_at && line.size() <= 6 && std::ranges::all_of(line, [&](const PlotPixel &at) {
               return std::abs(at.y - *name_at) < half_a_line;
           });
}

namespace {

/// The polylines of a path of capital M and L.
std::vector<std::vector<PlotPixel>> lines_of(const char *path) {
    std::vector<std::vector<PlotPixel>> lines;
    for (const char *at = path; *at != '\0';) {
        if (*at == 'M')
            lines.emplace_back();
        if ((std::isdigit(static_cast<unsigned char>(*at)) != 0 || *at == '-') && !lines.empty()) {
            char *end = nullptr;
            const double x = std::strtod(at, &end);
            const double y = std::strtod(end + 1, &end);
            lines.back().push_back({x, y});
            at = end;
        } else {
            ++at;
        }
    }
    return lines;
}

std::string all_text(pugi::xml_node text) {
    std::string out = text.text().get();
    for (const pugi::xml_node span : text.children("tspan"))
        out += span.text().get();
    const std::size_t first = out.find_first_not_of(' ');
    return first == std::string::npos ? "" : out.substr(first);
}

/// Reads an SVG from top to bottom: gnuplot writes of each panel the marks of its axes with their
/// numbers, its frame, names and labels, then curves.
class Reader {
  public:
    void walk(pugi::xml_node node) {
        for (const pugi::xml_node child : node.children()) {
            const std::string name = child.name();
            if (name == "g" && child.attribute("id") &&
                std::strncmp(child.attribute("id").value(), "gnuplot_plot_", 13) == 0)
                read_curve(child);
            else if (name == "path")
                read_path(child);
            else if (name == "text")
                read_text(child);
            else if (name != "defs")
                walk(child);
        }
    }
    SvgPlot finish() {
        auto &panels = _plot.panels;
        for (std::size_t i = panels.size(); i-- > 0;)
            for (std::size_t k = i + 1; k < panels.size() && panels[i].x.name.empty(); ++k)
                if (panels[k].left == panels[i].left && panels[k].right == panels[i].right)
                    panels[i].x.name = panels[k].x.name;
        for (std::size_t i = 1; i < panels.size(); ++i)
            for (std::size_t k = i; k-- > 0 && panels[i].y.name.empty();)
                if (panels[k].top == panels[i].top && panels[k].bottom == panels[i].bottom)
                    panels[i].y.name = panels[k].y.name;
        return _plot;
    }

  private:
    Panel &panel() { return _plot.panels.back(); }

    void read_path(pugi::xml_node path) {
        const auto lines = lines_of(path.attribute("d").value());
        if (lines.empty() || path.attribute("class"))
            return;
        if (lines[0].size() == 5 && lines[0][0].x == lines[0][4].x && !_plot.panels.empty()) {
            Panel &of = panel();
            of.left = std::min(lines[0][0].x, lines[0][2].x);
            of.right = std::max(lines[0][0].x, lines[0][2].x);
            of.top = std::min(lines[0][0].y, lines[0][2].y);
            of.bottom = std::max(lines[0][0].y, lines[0][2].y);
        }
        _mark = lines[0];
        _mark_of = path.parent();
    }
    /// The number of an axis stands in one group with its mark.
    void read_text(pugi::xml_node text) {
        const std::string words = all_text(text);
        const pugi::xml_node place = text.parent();
        if (place.parent() == _mark_of && _mark.size() == 2 && read_number(text, words)) {
            _mark.clear();
            return;
        }
        if (words.empty())
            return;
        _plot.texts.push_back(words);
        const std::string turned = place.attribute("transform").value();
        double x = 0;
        double y = 0;
        if (std::sscanf(turned.c_str(), "translate(%lf,%lf", &x, &y) != 2 || _plot.panels.empty())
            return;
        Panel &of = panel();
        const bool upright = turned.find("rotate(270)") != std::string::npos;
        if (upright && x < of.left)
            of.y.name = words;
        else if (!upright && of.bottom > 0 && y > of.bottom && x > of.left && x < of.right)
            of.x.name = words;
    }
    bool read_number(pugi::xml_node text, const std::string &words) {
        const bool below = _mark[0].x == _mark[1].x;
        const std::string anchor = text.parent().attribute("text-anchor").value();
        double value = 0;
        bool power = false;
        const pugi::xml_node raised = text.child("tspan").next_sibling("tspan");
        if (raised && raised.attribute("dy").as_double() < 0) {
            // 10 with an exponent marks a logarithmic axis, 2×10 with one a large number.
            const double exponent = std::strtod(raised.text().get(), nullptr);
            const std::string base = text.child("tspan").text().get();
            const double mantissa = std::strtod(base.c_str(), nullptr);
            power = mantissa == 10;
            value = power ? exponent : mantissa * std::pow(10, exponent);
        } else {
            char *end = nullptr;
            value = std::strtod(words.c_str(), &end);
            if (end == words.c_str() || *end != '\0')
                return false;
        }
        if (!below && anchor == "start")
            return true; // of a second axis at the right
        if (_plot.panels.empty() || !panel().curves.empty())
            _plot.panels.emplace_back();
        Axis &axis = below ? panel().x : panel().y;
        axis.logarithmic = power;
        axis.ticks.push_back({below ? _mark[0].x : _mark[0].y, value});
        return true;
    }
    void read_curve(pugi::xml_node group) {
        PlottedCurve curve{group.attribute("id").value(), {}, {}};
        collect(group, curve);
        if (!_plot.panels.empty())
            panel().curves.push_back(curve);
    }
    void collect(pugi::xml_node node, PlottedCurve &curve) {
        for (const pugi::xml_node child : node.children()) {
            const std::string name = child.name();
            if (name == "path") {
                for (auto &line : lines_of(child.attribute("d").value()))
                    curve.lines.push_back(std::move(line));
            } else if (name == "use") {
                curve.lines.push_back(mark_of(child));
            } else if (name == "text") {
                _plot.texts.push_back(all_text(child));
                double x = 0;
                double y = 0;
                std::sscanf(node.attribute("transform").value(), "translate(%lf,%lf", &x, &y);
                curve.name_at = y;
            } else {
                collect(child, curve);
            }
        }
    }
    static std::vector<PlotPixel> mark_of(pugi::xml_node use) {
        PlotPixel at;
        std::sscanf(use.attribute("transform").value(), "translate(%lf,%lf", &at.x, &at.y);
        return {at};
    }

    SvgPlot _plot;
    std::vector<PlotPixel> _mark; ///< the path read last
    pugi::xml_node _mark_of;
};

} // namespace

SvgPlot svg_plot(const std::string &svg) {
    pugi::xml_document document;
    if (!document.load_string(svg.c_str()))
        return {};
    Reader reader;
    reader.walk(document.child("svg"));
    return reader.finish();
}

} // namespace whirl::tests
