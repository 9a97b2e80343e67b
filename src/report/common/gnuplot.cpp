#include "report/common/gnuplot.h"

#include "report/common/text_width.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <string_view>
#include <utility>

namespace whirl::report {

namespace {

std::string terminal(const Figure &figure, PictureFormat format) {
    // pngcairo's time grows with the pixels: 1200 x 840 cost 0.07 s, the SVG 0.02 s.
    // Sizes of letters are pixels in the SVG but points, of 4/3 pixels, in the PNG: scaled there,
    // so that those that a figure gives itself are the same in both.
    const bool svg = format == PictureFormat::svg;
    return fmt::format("set encoding utf8\nset terminal {} size {},{} background '#ffffff' "
                       "font '{},14' {} enhanced dashlength 1\n",
                       svg ? "svg" : "pngcairo", figure.width, figure.height,
                       svg ? "DejaVu Sans, Arial, sans-serif" : "DejaVu Sans",
                       svg ? "" : "fontscale 0.75");
}

/// Commands, without texts, whose points have about the sizes they have in a PNG: gnuplot draws a
/// point of size 2 in an SVG 24 pixels wide, in a PNG 13, and the figures keep their labels off the
/// latter. A little larger, for the lines of hollow ones are thinner there.
std::string with_points_as_in_png(const std::string &commands) {
    constexpr double png_over_svg = 1.25 * 13.0 / 24.0;
    constexpr std::string_view word = " ps ";
    std::string out;
    std::size_t from = 0;
    for (std::size_t at = commands.find(word); at != std::string::npos;
         at = commands.find(word, from)) {
        const char *number = commands.c_str() + at + word.size();
        char *end = nullptr;
        const double size = std::strtod(number, &end);
        out.append(commands, from, at + word.size() - from);
        from = at + word.size();
        if (end == number)
            continue;
        out += fmt::format("{:.4g}", png_over_svg * size);
        from += static_cast<std::size_t>(end - number);
    }
    return out.append(commands, from);
}

/// A text of plot_text so that gnuplot makes valid SVG of it that says the same: it leaves entities
/// such as "&#x41;" and "]]>" as they are.
std::string for_svg(std::string text) {
    for (const auto &[from, to] :
         {std::pair("\\0046\\0043x", "\\0046\\0043x26;\\0043x"),            // &#x
          std::pair("\\0135\\0135\\0076", "\\0135\\0135\\0046\\0043x3e;")}) // ]]>
        for (std::size_t at = text.find(from); at != std::string::npos;
             at = text.find(from, at + std::strlen(to)))
            text.replace(at, std::strlen(from), to);
    return text;
}

/// The script as it is handed over.
std::string handed_over(const std::string &script, PictureFormat format) {
    if (format == PictureFormat::png)
        return script;
    std::string out;
    bool text = false;
    for (std::size_t from = 0; from <= script.size(); text = !text) {
        const std::size_t to = std::min(script.find('"', from), script.size());
        const std::string piece = script.substr(from, to - from);
        out += text ? for_svg(piece) : with_points_as_in_png(piece);
        out += to < script.size() ? "\"" : "";
        from = to + 1;
    }
    return out;
}

} // namespace

std::string gnuplot_input(const Figure &figure, PictureFormat format) {
    return terminal(figure, format) + handed_over(figure.script, format);
}

std::string plot_text(const std::string &text) {
    std::string quoted = "\"";
    for (const char letter : printable(text)) {
        const auto byte = static_cast<unsigned char>(letter);
        const bool plain =
            byte >= 0x80 || std::isalnum(byte) != 0 || std::strchr(" .,:;()+-=/", byte) != nullptr;
        quoted += plain ? std::string(1, letter) : fmt::format("\\0{:03o}", byte);
    }
    return quoted + "\" noenhanced";
}

} // namespace whirl::report
