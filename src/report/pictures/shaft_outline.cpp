#include "report/pictures/shaft_outline.h"

#include "report/pictures/style.h"

#include <fmt/format.h>

#include <algorithm>

namespace whirl::report {

double shaft_radius(const model::Shaft &shaft, double z) {
    double start = 0;
    double radius = 0;
    for (const auto &segment : shaft.segments) {
        const double share = segment.length > 0 ? (z - start) / segment.length : 0;
        if (share >= -1e-9 && share <= 1 + 1e-9)
            radius = std::max(
                radius,
                (segment.outer_start + share * (segment.outer_end - segment.outer_start)) / 2);
        start += segment.length;
    }
    return radius;
}

std::string outline_data(const Units &units, const model::Rotor &rotor, double largest) {
    double thickest = 1e-12;
    for (const auto &segment : rotor.shaft.segments)
        thickest = std::max({thickest, segment.outer_start / 2, segment.outer_end / 2});
    for (const auto &disc : rotor.discs)
        thickest = std::max(thickest, disc.outer / 2);
    const double scale = 0.5 * largest / thickest;
    std::string data = "$outline << EOD\n";
    const auto box = [&](double a, double b, double ra, double rb) {
        data += fmt::format("{0} {2}\n{1} {3}\n{1} {5}\n{0} {4}\n{0} {2}\n\n",
                            units(Quantity::length, a), units(Quantity::length, b), scale * ra,
                            scale * rb, -scale * ra, -scale * rb);
    };
    double z = 0;
    for (const auto &segment : rotor.shaft.segments) {
        box(z, z + segment.length, segment.outer_start / 2, segment.outer_end / 2);
        z += segment.length;
    }
    for (const auto &disc : rotor.discs) {
        const double half = std::max(disc.width / 2, 0.004 * z);
        const double radius = disc.outer > 0 ? disc.outer / 2 : 0.7 * thickest;
        box(disc.z - half, disc.z + half, radius, radius);
    }
    data += "EOD\n$bearings << EOD\n";
    for (const auto &bearing : rotor.supports())
        data += fmt::format("{} {}\n", units(Quantity::length, bearing.z), -1.12 * largest);
    return data + "NaN NaN\nEOD\n";
}

std::string curve_legend(double height) {
    return fmt::format("unset border\nunset tics\nset xrange [0:1]\nset yrange [0:1]\n"
                       "set key at screen 0.5,{} center center horizontal samplen 4\n"
                       "plot NaN notitle, keyentry with lines lw 2.2 lc rgb '#0072B2' title 'x', "
                       "keyentry with lines lw 2.2 dt (10,6) lc rgb '#D55E00' title 'y', "
                       "keyentry with lines lw 1 lc rgb '#888888' title 'envelope', "
                       "keyentry with points pt 9 ps 1.4 lc rgb '#555555' title 'bearing'\n"
                       "unset label\nunset key\nset border\nset tics\n",
                       height);
}

std::string curves_over_outline(const Units &units, const std::vector<double> &z,
                                const std::vector<double> &x, const std::vector<double> &y,
                                const std::vector<double> &envelope, double factor) {
    std::string data = "$shape << EOD\n";
    for (std::size_t i = 0; i < std::min(z.size(), x.size()); ++i)
        data +=
            fmt::format("{} {} {} {}\n", units(Quantity::length, z[i]), plot_number(x[i] * factor),
                        plot_number(y[i] * factor), plot_number(envelope[i] * factor));
    return data + "NaN NaN NaN NaN\nEOD\nplot $outline with filledcurves closed fs solid 1 "
                  "noborder fc rgb '#F0F1F3', "
                  "$outline with lines lw 0.7 lc rgb '#C8CDD2', "
                  "$bearings with points pt 9 ps 1.4 lc rgb '#555555', "
                  "$shape using 1:4 with lines lw 1 lc rgb '#888888', "
                  "$shape using 1:(-$4) with lines lw 1 lc rgb '#888888', "
                  "$shape using 1:2 with lines lw 2.2 lc rgb '#0072B2', "
                  "$shape using 1:3 with lines lw 2.2 dt (10,6) lc rgb '#D55E00'\n";
}

} // namespace whirl::report
