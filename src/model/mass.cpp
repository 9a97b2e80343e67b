#include "model/mass.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace whirl::model {

namespace {

/// Volume of a cone of these diameters, per length.
double cone(double start, double end) {
    return std::numbers::pi / 12 * (start * start + start * end + end * end);
}

/// Its second polar moment of area, per length: pi/32 times the mean of d^4.
double polar_of_cone(double start, double end) {
    double sum = 0;
    for (int k = 0; k <= 4; ++k)
        sum += std::pow(start, 4 - k) * std::pow(end, k);
    return std::numbers::pi / 32 * sum / 5;
}

/// Mass per length in a segment, at a share of its length.
double line_density(const Segment &s, double share) {
    const auto disc = [](double d) { return std::numbers::pi / 4 * d * d; };
    const auto between = [share](double start, double end) {
        return start + share * (end - start);
    };
    double sum = s.mass_outer > 0 ? disc(s.mass_outer) - disc(s.mass_inner)
                                  : disc(between(s.outer_start, s.outer_end)) -
                                        disc(between(s.inner_start, s.inner_end));
    sum *= s.material.rho;
    for (const Layer &layer : s.layers)
        sum += layer.material.rho * (disc(layer.outer) - disc(layer.inner));
    return sum;
}

/// Of what has mass in a segment, per length.
/// @param moment  of a full cone between two diameters, per length
double sum_over(const Segment &s, double (*moment)(double start, double end)) {
    double sum = s.mass_outer > 0
                     ? moment(s.mass_outer, s.mass_outer) - moment(s.mass_inner, s.mass_inner)
                     : moment(s.outer_start, s.outer_end) - moment(s.inner_start, s.inner_end);
    sum *= s.material.rho;
    for (const Layer &layer : s.layers)
        sum += layer.material.rho *
               (moment(layer.outer, layer.outer) - moment(layer.inner, layer.inner));
    return sum;
}

} // namespace

double mass_of(const Shaft &shaft) {
    double sum = 0;
    for (const Segment &segment : shaft.segments)
        sum += sum_over(segment, cone) * segment.length;
    return sum;
}

double polar_inertia_of(const Shaft &shaft) {
    double sum = 0;
    if (shaft.rotary_inertia)
        for (const Segment &segment : shaft.segments)
            sum += sum_over(segment, polar_of_cone) * segment.length;
    return sum;
}

double mass_of_shaft_and_discs(const Rotor &rotor) {
    double sum = mass_of(rotor.shaft);
    for (const Disc &disc : rotor.discs)
        sum += disc.mass;
    return sum;
}

MassBetween mass_between(const Rotor &rotor, double from, double to) {
    MassBetween sum;
    double start = 0;
    for (const Segment &segment : rotor.shaft.segments) {
        const double a = std::max(from, start);
        const double b = std::min(to, start + segment.length);
        // Simpson's rule has no error here: the mass per length is quadratic in z, its moment
        // cubic.
        for (const auto &[z, weight] :
             {std::pair(a, 1.0 / 6), {(a + b) / 2, 4.0 / 6}, {b, 1.0 / 6}})
            if (b > a) {
                const double mass =
                    weight * (b - a) * line_density(segment, (z - start) / segment.length);
                sum.mass += mass;
                sum.moment += mass * z;
            }
        start += segment.length;
    }
    for (const Disc &disc : rotor.discs)
        if (disc.z > from && disc.z < to) {
            sum.mass += disc.mass;
            sum.moment += disc.mass * disc.z;
        }
    return sum;
}

} // namespace whirl::model
