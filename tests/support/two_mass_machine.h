#pragma once

#include "model/case.h"
#include "support/scenes.h"

#include <complex>
#include <string>

namespace whirl::tests {

/// A mass in the middle of a rigid shaft without mass, on two equal bearings on equal pedestals: in
/// translation a point mass on spring and damper, on a second one on spring and damper.
struct TwoMassMachine {
    double mass = 10, k = 1e6, c = 300; ///< of the rotor; of both bearings together
    double pedestal_mass = 8, pedestal_k = 5e6, pedestal_c = 900; ///< of both together
    double mr = 1e-4;                                             ///< kg m

    using Complex = std::complex<double>;
    struct Motion {
        Complex shaft, pedestal; ///< m
        Complex film;            ///< N/m: stiffness and damping of the bearings
    };
    /// Under a force that turns with a frequency.
    [[nodiscard]] Motion under(Complex force, double frequency) const {
        const Complex i(0, 1);
        const Complex film = k + i * frequency * c;
        const Complex below =
            film + pedestal_k + i * frequency * pedestal_c - pedestal_mass * frequency * frequency;
        const Complex determinant = (film - mass * frequency * frequency) * below - film * film;
        return {force * below / determinant, force * film / determinant, film};
    }
    /// Under the imbalance.
    [[nodiscard]] Motion at(double speed) const { return under(mr * speed * speed, speed); }

    [[nodiscard]] model::Case scene() const {
        model::Case scene;
        scene.rotor.shaft = uniform_shaft(1, 0.05, weightless_steel());
        scene.rotor.shaft.rigid = true;
        scene.rotor.discs = {disc_at(0.5, mass, 0.05, 0.1)};
        for (const double z : {0.0, 1.0}) {
            model::Bearing bearing = isotropic_bearing(z, k / 2, c / 2);
            bearing.name = z == 0 ? "left" : "right";
            bearing.pedestal = model::Pedestal(pedestal_mass / 2, pedestal_k / 2, pedestal_c / 2);
            bearing.clearance = 2e-4;
            scene.rotor.bearings.push_back(bearing);
        }
        scene.rotor.imbalances = {imbalance_at(0.5, mr)};
        scene.rotor.probes = {{"DE", 0, 0}};
        scene.speeds = model::SpeedRange{0, 1500, 31};
        return scene;
    }
};

} // namespace whirl::tests
