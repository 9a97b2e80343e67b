#pragma once

#include <string>

namespace whirl::model {

/// A linear elastic material.
struct Material {
    std::string name;
    double E = 0;   ///< Young's modulus, Pa
    double G = 0;   ///< shear modulus, Pa
    double rho = 0; ///< density, kg/m3

    /// Poisson's ratio of an isotropic material with these moduli.
    [[nodiscard]] double poisson_ratio() const { return E / (2 * G) - 1; }
};

} // namespace whirl::model
