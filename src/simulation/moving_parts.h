#pragma once

#include "balancers/circle_mass.h"
#include "balancers/parts_motion.h"
#include "reduction/reduced_rotor.h"
#include "simulation/excitation.h"
#include "simulation/spin.h"

#include <memory>
#include <optional>
#include <vector>

namespace whirl::simulation {

/// A plane with a balancer or a point mass: rows of its deflection and slope.
struct MassPlane {
    reduction::Row w;
    reduction::Row phi;
};

/// The parts of a balancer, which move by themselves.
struct FreeParts {
    int plane = 0;
    std::shared_ptr<const balancers::PartsMotion> motion;
    double from = 0; ///< s: held in the rotor before
};

/// A mass that turns with the rotor. Without inertia: an eccentricity, on a row of its own.
struct FixedMass {
    int plane = -1; ///< -1: `row`
    reduction::Row row;
    balancers::CircleMass mass;
    double phase = 0; ///< rad
    double from = 0;  ///< s: not there before
};

/// Constant torque minus slope times speed.
struct Motor {
    double torque = 0; ///< N m
    double slope = 0;  ///< N m s
};

/// Everything that moves.
struct MovingParts {
    reduction::ReducedRotor rotor;
    std::vector<MassPlane> planes;
    std::vector<FreeParts> free;
    std::vector<FixedMass> fixed;
    double polar_inertia = 0; ///< kg m2, of all that turns with the rotor but masses listed above
    Spin spin{0.0};
    std::optional<Motor> motor; ///< then the speed is an unknown and spin is not read
    Excitation excitation;

    [[nodiscard]] int free_angles() const {
        int sum = 0;
        for (const FreeParts &parts : free)
            sum += parts.motion->size();
        return sum;
    }
};

} // namespace whirl::simulation
