#include "ends/branches.h"

#include "ends/coupling.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace whirl::ends {

namespace {

constexpr int samples = 16; ///< of a cubic, to see two passages of zero in a step

bool passes_safely(const Branch &branch) {
    const int a = branch.from->sign();
    const int b = branch.to->sign();
    if (a == 0 || b == 0)
        return true; // nothing more can be decided here
    // The part of the real part that a speed in between could disprove.
    const double bend = std::abs(branch.off_parabola().real());
    int changes = 0;
    double least = HUGE_VAL;
    double before = branch.from->value.real();
    double slope_before = branch.slope(0).real();
    for (int k = 1; k <= samples; ++k) {
        const double t = static_cast<double>(k) / samples;
        const double real = branch.at(t).real();
        const double slope = branch.slope(t).real();
        // Where it turns between two samples, a parabola by no more than this beyond both.
        const bool turns = (slope > 0) != (slope_before > 0);
        const double beyond =
            turns ? std::max(std::abs(slope), std::abs(slope_before)) / (4.0 * samples) : 0;
        changes += (real > 0) != (before > 0) ? 1 : 0;
        least = std::min({least, std::abs(real) - beyond, std::abs(before) - beyond});
        before = real;
        slope_before = slope;
    }
    if (a == b)
        return changes == 0 && least > 0.5 * bend;
    return changes == 1 &&
           bend < 0.3 * std::abs(branch.to->value.real() - branch.from->value.real());
}

/// Of a cubic, to bracket an equal frequency: two of them pass at most three times.
constexpr int parts = 8;
using Course = std::array<double, parts + 1>; ///< frequencies along a branch

Course course_of(const Branch &branch) {
    Course out{};
    out.front() = branch.from->value.imag();
    for (int k = 1; k < parts; ++k)
        out[static_cast<std::size_t>(k)] = branch.at(static_cast<double>(k) / parts).imag();
    out.back() = branch.to->value.imag();
    return out;
}

/// Where the frequencies of two branches are equal, if they pass each other inside the step and
/// that speed is not an end of the step.
std::optional<double> passing(const Branch &a, const Branch &b, const Course &of_a,
                              const Course &of_b, double scale) {
    const auto gap = [&](double t) { return (a.at(t) - b.at(t)).imag(); };
    const double first = a.from->value.imag() - b.from->value.imag();
    const double last = a.to->value.imag() - b.to->value.imag();
    const double reals_from = std::abs(a.from->value.real()) + std::abs(b.from->value.real());
    const double reals_to = std::abs(a.to->value.real()) + std::abs(b.to->value.real());
    // Of the speed: the root of rounding doubled, what double roots are known to.
    constexpr double equal = 3e-8;
    constexpr double share = 0.25; // of what coupling must overcome
    if (std::abs(first) <= std::max(share * reals_from, equal * scale) ||
        std::abs(last) <= std::max(share * reals_to, equal * scale))
        return std::nullopt;
    double t0 = 0;
    double g0 = first;
    for (int k = 1; k <= parts; ++k) {
        const double t1 = static_cast<double>(k) / parts;
        const double g1 = of_a[static_cast<std::size_t>(k)] - of_b[static_cast<std::size_t>(k)];
        if ((g0 > 0) != (g1 > 0)) {
            double t = t0 + (t1 - t0) * g0 / (g0 - g1);
            for (int newton = 0; newton < 3; ++newton) {
                const double g = gap(t);
                const double slope = (g1 - g0) / (t1 - t0);
                t = std::clamp(t - g / slope, t0, t1);
            }
            return a.at(t).imag() + b.at(t).imag() >= -1e-9 * scale ? std::optional(t)
                                                                    : std::nullopt;
        }
        t0 = t1;
        g0 = g1;
    }
    return std::nullopt;
}

} // namespace

std::optional<double> where_to_refine(const Branches &all, const Spectrum &from, const Spectrum &to,
                                      double scale) {
    if (!all.clear)
        return all.middle;
    for (const Branch &branch : all.branches)
        if (branch.cluster == 0 && !passes_safely(branch))
            return all.middle;
    std::vector<Course> courses;
    for (const Branch &branch : all.branches)
        courses.push_back(course_of(branch));
    for (std::size_t i = 0; i < all.branches.size(); ++i)
        for (std::size_t k = i + 1; k < all.branches.size(); ++k) {
            const int cluster = all.branches[i].cluster;
            if (cluster != 0 && cluster == all.branches[k].cluster)
                continue;
            if (const auto t =
                    passing(all.branches[i], all.branches[k], courses[i], courses[k], scale);
                t && !weakly_coupled(all.branches[i], all.branches[k], *t, from, to))
                return t;
        }
    return std::nullopt;
}

} // namespace whirl::ends
