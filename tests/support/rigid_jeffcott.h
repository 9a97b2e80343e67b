#pragma once

#include "model/case.h"
#include "support/scenes.h"

#include <cmath>

namespace whirl::tests {

/// 10 kg in the middle of a rigid shaft without mass on two equal bearings: in translation a point
/// mass on kx, ky and c, m u'' + c u' + k u.
struct RigidJeffcott {
    double mass = 10;
    double kx = 1e6;
    double ky = 1e6;
    double c = 632.4555320336759; ///< damping ratio 0.1: 0.2 sqrt(k m)

    [[nodiscard]] double natural() const { return std::sqrt((kx + ky) / 2 / mass); }
    [[nodiscard]] double ratio() const { return c / (2 * mass * natural()); }
    [[nodiscard]] model::Case scene() const {
        model::Case scene;
        scene.rotor.shaft = uniform_shaft(1, 0.05, weightless_steel());
        scene.rotor.shaft.rigid = true;
        scene.rotor.discs = {disc_at(0.5, mass, 0.05, 0.1)};
        for (const double z : {0.0, 1.0}) {
            model::Bearing bearing = isotropic_bearing(z, 0, c / 2);
            bearing.rows[0].k.diagonal() << kx / 2, ky / 2;
            scene.rotor.bearings.push_back(bearing);
        }
        return scene;
    }
};

} // namespace whirl::tests
