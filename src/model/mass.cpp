#include "model/mass.h"

#include <numbers>

namespace whirl::model {

namespace {

/// Volume of a cone of these diameters, per length.
double cone(double start, double end) {
    return std::numbers::pi / 12 * (start * start + start * end + end * end);
}

double mass_per_length(const Segment &s) {
    double sum = s.mass_outer > 0
                     ? cone(s.mass_outer, s.mass_outer) - cone(s.mass_inner, s.mass_inner)
                     : cone(s.outer_start, s.outer_end) - cone(s.inner_start, s.inner_end);
    sum *= s.material.rho;
    for (const Layer &layer : s.layers)
        sum +=
            layer.material.rho * (cone(layer.outer, layer.outer) - cone(layer.inner, layer.inner));
    return sum;
}

} // namespace

double mass_of(const Shaft &shaft) {
    double sum = 0;
    for (const Segment &segment : shaft.segments)
        sum += mass_per_length(segment) * segment.length;
    return sum;
}

double mass_of_shaft_and_discs(const Rotor &rotor) {
    double sum = mass_of(rotor.shaft);
    for (const Disc &disc : rotor.discs)
        sum += disc.mass;
    return sum;
}

} // namespace whirl::model
