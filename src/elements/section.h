#pragma once

#include "mesh/shaft_mesh.h"

namespace whirl::elements {

/// Section constants of a hollow circular section at one place of a beam.
struct Section {
    double EI = 0;      ///< bending stiffness, N m2
    double kappaGA = 0; ///< shear stiffness, N
    double rhoA = 0;    ///< mass per length, kg/m
    double rhoI = 0;    ///< diametral rotary inertia per length, kg m
};

/// Shear coefficient of a hollow circular section; m = bore over outer diameter, nu = Poisson's
/// ratio. Cowper (1966) table 1 or Hutchinson (2001) eq. for the hollow circle; docs/theory.md.
[[nodiscard]] double shear_coefficient(model::ShearFormula formula, double nu, double m);

/// A beam between two nodes: geometry and material, ready for integration along it.
struct Beam {
    mesh::Span span;
    model::Material material;
    model::ShearFormula shear = model::ShearFormula::cowper;
    double given_shear_coefficient = 0;
    double axial_force = 0; ///< N, tension positive
    bool rotary_inertia = true;
    double mass_outer = 0; ///< diameters of what has mass, m; 0: those of the span
    double mass_inner = 0;
    std::vector<model::Layer> layers{}; ///< beside the span's own section
    double axial_torque = 0;            ///< N m, model/shaft.h

    /// Section at xi in [0, 1].
    [[nodiscard]] Section at(double xi) const;
    [[nodiscard]] bool uniform() const {
        return span.outer_start == span.outer_end && span.inner_start == span.inner_end;
    }
};

/// The beam over one span of a mesh of this shaft.
[[nodiscard]] Beam beam_of(const model::Shaft &shaft, const mesh::Span &span);

} // namespace whirl::elements
