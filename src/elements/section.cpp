#include "elements/section.h"

#include <numbers>

namespace whirl::elements {

double shear_coefficient(model::ShearFormula formula, double nu, double m) {
    const double m2 = m * m;
    const double sum2 = (1 + m2) * (1 + m2);
    if (formula == model::ShearFormula::cowper)
        return 6 * (1 + nu) * sum2 / ((7 + 6 * nu) * sum2 + (20 + 12 * nu) * m2);
    const double m4 = m2 * m2;
    return 6 * sum2 * (1 + nu) * (1 + nu) /
           (7 + 34 * m2 + 7 * m4 + nu * (12 + 48 * m2 + 12 * m4) +
            nu * nu * (4 + 16 * m2 + 4 * m4));
}

namespace {

/// Area and second moment of a hollow circle.
struct Ring {
    double ro, ri; ///< radii, m

    [[nodiscard]] double area() const { return std::numbers::pi * (ro * ro - ri * ri); }
    [[nodiscard]] double moment() const { return area() * (ro * ro + ri * ri) / 4; }
};

} // namespace

Section Beam::at(double xi) const {
    const Ring own{(span.outer_start + (span.outer_end - span.outer_start) * xi) / 2,
                   (span.inner_start + (span.inner_end - span.inner_start) * xi) / 2};
    const Ring heavy{mass_outer > 0 ? mass_outer / 2 : own.ro,
                     mass_outer > 0 ? mass_inner / 2 : own.ri};
    const auto kappa = [this](const model::Material &of, const Ring &ring) {
        return shear == model::ShearFormula::given
                   ? given_shear_coefficient
                   : shear_coefficient(shear, of.poisson_ratio(), ring.ri / ring.ro);
    };
    Section sum{material.E * own.moment(), kappa(material, own) * material.G * own.area(),
                material.rho * heavy.area(), material.rho * heavy.moment()};
    for (const model::Layer &layer : layers) {
        const Ring ring{layer.outer / 2, layer.inner / 2};
        sum.EI += layer.material.E * ring.moment();
        sum.kappaGA += kappa(layer.material, ring) * layer.material.G * ring.area();
        sum.rhoA += layer.material.rho * ring.area();
        sum.rhoI += layer.material.rho * ring.moment();
    }
    // Not nothing, for some unknowns of higher orders have no other inertia and the mass matrix
    // must stay positive definite: frequencies differ by that times (diameter / wavelength)^2.
    constexpr double left = 1e-9;
    if (!rotary_inertia)
        sum.rhoI *= left;
    return sum;
}

Beam beam_of(const model::Shaft &shaft, const mesh::Span &span) {
    const model::Segment &segment = shaft.segments[static_cast<std::size_t>(span.segment)];
    Beam beam{span, segment.material, shaft.shear, shaft.shear_coefficient, shaft.axial_force};
    if (segment.shear_coefficient > 0) {
        beam.shear = model::ShearFormula::given;
        beam.given_shear_coefficient = segment.shear_coefficient;
    }
    beam.rotary_inertia = shaft.rotary_inertia;
    beam.mass_outer = segment.mass_outer;
    beam.mass_inner = segment.mass_inner;
    beam.layers = segment.layers;
    beam.axial_torque = shaft.axial_torque;
    return beam;
}

} // namespace whirl::elements
