#include "svg_texts.h"

#include "report/common/text_width.h"

#include <fmt/format.h>
#include <pugixml.hpp>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <numbers>
#include <regex>
#include <sstream>
#include <string_view>

namespace whirl::tests {

namespace {

/// Moved, then turned: of the groups around a text.
struct Place {
    double x = 0, y = 0;
    double angle = 0; ///< rad, clockwise on the screen as SVG counts
};

/// The numbers in brackets behind a word; empty where it is not there.
std::vector<double> arguments(const std::string &transform, const char *word) {
    std::vector<double> numbers;
    const std::size_t at = transform.find(std::string(word) + "(");
    if (at == std::string::npos)
        return numbers;
    std::string inside = transform.substr(at + std::strlen(word) + 1);
    inside.resize(std::min(inside.find(')'), inside.size()));
    std::replace(inside.begin(), inside.end(), ',', ' ');
    std::istringstream stream(inside);
    for (double number = 0; stream >> number;)
        numbers.push_back(number);
    return numbers;
}

std::string inherited(pugi::xml_node node, const char *attribute, const char *otherwise) {
    for (; node; node = node.parent())
        if (const auto found = node.attribute(attribute))
            return found.value();
    return otherwise;
}

Place place_of(pugi::xml_node text) {
    Place place;
    for (pugi::xml_node node = text; node; node = node.parent()) {
        const std::string transform = node.attribute("transform").value();
        if (const auto move = arguments(transform, "translate"); !move.empty()) {
            place.x += move[0];
            place.y += move.size() > 1 ? move[1] : 0;
        }
        if (const auto turn = arguments(transform, "rotate"); !turn.empty())
            place.angle += turn[0] * std::numbers::pi / 180;
    }
    place.x += text.attribute("x").as_double();
    place.y += text.attribute("y").as_double();
    return place;
}

/// Runs of white space become one blank; those at the ends of a line vanish.
std::string collapsed(const std::string &text) {
    std::string out;
    for (const char letter : text)
        if (std::strchr(" \t\n", letter) == nullptr)
            out += letter;
        else if (!out.empty() && out.back() != ' ')
            out += ' ';
    while (!out.empty() && out.back() == ' ')
        out.pop_back();
    return out;
}

/// A text before it is moved and turned: from its anchor to the right and downwards.
struct Line {
    std::string text;
    double width = 0, top = 0, bottom = 0;
};

void append(Line &line, const std::string &text, double size, double baseline) {
    if (text.empty())
        return;
    line.text += text;
    line.width += report::text_width(text, size);
    const bool low = text.find_first_of("gjpqy,;()[]_|Q") != std::string::npos;
    const bool high = std::any_of(text.begin(), text.end(), [](char letter) {
        return std::string_view("acegmnopqrsuvwxyz.,-_ ").find(letter) == std::string_view::npos;
    });
    line.top = std::min(line.top, baseline - (high ? 0.74 : 0.55) * size);
    line.bottom = std::max(line.bottom, baseline + (low ? 0.2 : 0.0) * size);
}

Line line_of(pugi::xml_node text) {
    const double size = std::stod(inherited(text, "font-size", "16"));
    Line line;
    line.top = std::numeric_limits<double>::max();
    line.bottom = std::numeric_limits<double>::lowest();
    double baseline = text.attribute("dy").as_double();
    if (!text.child("tspan"))
        append(line, collapsed(text.text().get()), size, baseline);
    for (const pugi::xml_node span : text.children("tspan")) {
        baseline += span.attribute("dy").as_double();
        const double own =
            span.attribute("font-size") ? std::stod(span.attribute("font-size").value()) : size;
        append(line, collapsed(span.text().get()), own, baseline);
    }
    return line;
}

double share_left_of_anchor(pugi::xml_node text) {
    const std::string anchor = inherited(text, "text-anchor", "start");
    return anchor == "middle" ? 0.5 : anchor == "end" ? 1 : 0;
}

/// Whether a line parallel to a side of the first box separates the two by `gap` or more.
bool separated_by_a_side(const TextBox &one, const TextBox &other, double gap) {
    for (const std::size_t side : {0U, 1U}) {
        const Corner from = one.corners[side];
        const Corner to = one.corners[side + 1];
        const double length = std::hypot(to.x - from.x, to.y - from.y);
        if (length == 0)
            return true;
        const auto along = [&](const Corner &corner) {
            return (corner.x * (to.x - from.x) + corner.y * (to.y - from.y)) / length;
        };
        const auto range = [&](const TextBox &box) {
            double low = HUGE_VAL;
            double high = -HUGE_VAL;
            for (const Corner &corner : box.corners) {
                low = std::min(low, along(corner));
                high = std::max(high, along(corner));
            }
            return std::pair(low, high);
        };
        const auto [a, b] = range(one);
        const auto [c, d] = range(other);
        if (std::max(a, c) - std::min(b, d) >= gap)
            return true;
    }
    return false;
}

/// "1e+07", or a zero with a sign.
bool has_program_number(const std::string &text) {
    static const std::regex power("[0-9]e[+-][0-9]|(^|[^0-9.])[-−]0(?![0-9.])");
    return std::regex_search(text, power);
}

} // namespace

std::vector<TextBox> svg_texts(const std::string &svg) {
    pugi::xml_document document;
    std::vector<TextBox> boxes;
    if (!document.load_string(svg.c_str(), pugi::parse_default | pugi::parse_ws_pcdata))
        return boxes;
    for (const auto &found : document.select_nodes("//text")) {
        const pugi::xml_node node = found.node();
        const Line line = line_of(node);
        if (line.text.empty())
            continue;
        const Place place = place_of(node);
        const double left = -share_left_of_anchor(node) * line.width;
        TextBox box{line.text, {}};
        const std::array<Corner, 4> upright{{{left, line.top},
                                             {left + line.width, line.top},
                                             {left + line.width, line.bottom},
                                             {left, line.bottom}}};
        for (std::size_t i = 0; i < 4; ++i) {
            const double c = std::cos(place.angle);
            const double s = std::sin(place.angle);
            box.corners[i] = {place.x + c * upright[i].x - s * upright[i].y,
                              place.y + s * upright[i].x + c * upright[i].y};
        }
        boxes.push_back(box);
    }
    return boxes;
}

std::vector<std::string> layout_faults(const std::string &svg) {
    constexpr double slack = 1; // pixel: hinting and rounding of the letters
    pugi::xml_document document;
    if (!document.load_string(svg.c_str()))
        return {"not an SVG"};
    std::istringstream view(document.child("svg").attribute("viewBox").value());
    double left = 0, top = 0, width = 0, height = 0;
    view >> left >> top >> width >> height;
    std::vector<std::string> faults;
    const std::vector<TextBox> boxes = svg_texts(svg);
    for (std::size_t i = 0; i < boxes.size(); ++i) {
        if (has_program_number(boxes[i].text))
            faults.push_back(
                fmt::format("\"{}\" has a number as programs write it", boxes[i].text));
        const auto outside = [&](const Corner &corner) {
            return corner.x < left - slack || corner.x > left + width + slack ||
                   corner.y < top - slack || corner.y > top + height + slack;
        };
        if (std::any_of(boxes[i].corners.begin(), boxes[i].corners.end(), outside))
            faults.push_back(fmt::format("\"{}\" leaves the frame", boxes[i].text));
        for (std::size_t j = 0; j < i; ++j)
            if (!separated_by_a_side(boxes[i], boxes[j], -slack) &&
                !separated_by_a_side(boxes[j], boxes[i], -slack))
                faults.push_back(fmt::format("\"{}\" and \"{}\" overlap near ({:.0f}, {:.0f})",
                                             boxes[j].text, boxes[i].text, boxes[i].corners[0].x,
                                             boxes[i].corners[0].y));
    }
    return faults;
}

} // namespace whirl::tests
