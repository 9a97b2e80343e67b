#pragma once

#include "elements/beam.h"

#include <string>

namespace whirl::tests {

/// Radii of a hollow cone at its two ends and its length, m.
struct Cone {
    std::string name;
    double length = 0;
    double outer_start = 0, outer_end = 0;
    double inner_start = 0, inner_end = 0;
};

inline Cone solid_cylinder() { return {"uniform", 0.4, 0.03, 0.03, 0, 0}; }
inline Cone hollow_cylinder() { return {"hollow", 0.4, 0.03, 0.03, 0.018, 0.018}; }
inline Cone solid_cone() { return {"conical", 0.4, 0.03, 0.021, 0, 0}; }
inline Cone hollow_cone() { return {"hollow_cone", 0.4, 0.03, 0.024, 0.01, 0.016}; }

constexpr double young = 2.1e11;
constexpr double shear_modulus = 8e10;
constexpr double density = 7800;

inline elements::Beam beam_of(const Cone &cone) {
    elements::Beam beam;
    beam.span = {0,
                 cone.length,
                 2 * cone.outer_start,
                 2 * cone.outer_end,
                 2 * cone.inner_start,
                 2 * cone.inner_end,
                 0};
    beam.material = {"steel", young, shear_modulus, density};
    return beam;
}

} // namespace whirl::tests
