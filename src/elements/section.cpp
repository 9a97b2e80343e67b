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

Section Beam::at(double xi) const {
    const double ro = (span.outer_start + (span.outer_end - span.outer_start) * xi) / 2;
    const double ri = (span.inner_start + (span.inner_end - span.inner_start) * xi) / 2;
    const double A = std::numbers::pi * (ro * ro - ri * ri);
    const double I = A * (ro * ro + ri * ri) / 4;
    const double kappa = shear == model::ShearFormula::given
                             ? given_shear_coefficient
                             : shear_coefficient(shear, material.poisson_ratio(), ri / ro);
    return {material.E * I, kappa * material.G * A, material.rho * A, material.rho * I};
}

Beam beam_of(const model::Shaft &shaft, const mesh::Span &span) {
    const model::Segment &segment = shaft.segments[static_cast<std::size_t>(span.segment)];
    return {span, segment.material, shaft.shear, shaft.shear_coefficient, shaft.axial_force};
}

} // namespace whirl::elements
