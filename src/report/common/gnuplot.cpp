#include "report/common/gnuplot.h"

#include "report/common/words.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <string_view>

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

/// The script as it is handed over: its points as in with_points_as_in_png, where it is for an SVG,
/// and the powers of ten of its texts (those of plot_text) as they are written by hand: only here,
/// for the units of the numbers may have been changed before.
std::string handed_over(const std::string &script, PictureFormat format) {
    const bool svg = format == PictureFormat::svg;
    std::string out;
    std::size_t from = 0;
    while (from < script.size()) {
        const std::size_t start = std::min(script.find('\'', from), script.size());
        std::size_t end = start + 1;
        while (end < script.size() && (script[end] != '\'' || script.compare(end, 2, "''") == 0))
            end += script[end] == '\'' ? 2 : 1;
        end = std::min(end, script.size());
        const std::string commands = script.substr(from, start - from);
        out += svg ? with_points_as_in_png(commands) : commands;
        const std::string text = script.substr(start, end - start);
        out += script.compare(end, 12, "' noenhanced") == 0 ? with_powers(text) : text;
        if (end < script.size())
            out += '\'';
        from = end + 1;
    }
    return out;
}

} // namespace

std::string gnuplot_input(const Figure &figure, PictureFormat format) {
    return terminal(figure, format) + handed_over(figure.script, format);
}

std::string plot_text(const std::string &text) {
    std::string quoted = "'";
    for (const char letter : text) {
        if (letter == '\'')
            quoted += "''";
        else
            quoted += static_cast<unsigned char>(letter) < 0x20 ? ' ' : letter;
    }
    return quoted + "' noenhanced";
}

} // namespace whirl::report
