#include "model/mass.h"

#include <cmath>
#include <numbers>

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

} // namespace whirl::model
