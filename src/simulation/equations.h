#pragma once

#include "model/case.h"
#include "results/formulation.h"
#include "results/sentence.h"
#include "simulation/motion.h"

#include <string>
#include <vector>

namespace whirl::simulation {

/// A case made ready to move: the parts, and where results come from.
struct MotionScene {
    MovingParts parts; ///< the free ones in the order of the balancers
    /// Of a rotor without balancers: wherever something is attached.
    struct Stations {
        std::vector<reduction::Row> rows;
        std::vector<double> z; ///< m
        std::vector<std::string> names;
    } stations;
    std::vector<double> start_angles; ///< of all coordinates of the balancers, rad
    /// A size of the moments of mass of the free parts, and of the forces from outside by the
    /// speed squared, kg m.
    double moment = 0;
    double fastest = 0; ///< rad/s, |speed| (motor: a bound); of a rotor at rest
                        ///< scale_at_rest()
    int order = 0;      ///< of the shaft elements
    int elements = 0;
    std::vector<results::Sentence> notes;
};

/// @throws model::BadInput where something is missing or absurd; model::AnalysisFailure.
[[nodiscard]] MotionScene motion_scene(const model::Case &scene);

/// Largest deflection of each place (z, m) in the steady motion under the imbalances, m.
/// @throws linalg::SolverError at a resonance without damping
[[nodiscard]] std::vector<double> steady_amplitudes(const assembly::Discretization &d,
                                                    results::Form form, double speed,
                                                    const std::vector<double> &places);

/// Those at the balancers of the rotor without their parts, under all its imbalances; or, without
/// any imbalance, under that which the parts of each balancer make side by side.
[[nodiscard]] std::vector<double> unbalanced_amplitudes(const model::Case &scene, int order,
                                                        double speed);

/// Angles at the start of all coordinates, rad.
/// @param given  of each balancer as in simulate.ball_angles, or empty: chosen
[[nodiscard]] std::vector<double> start_of(const model::Rotor &rotor,
                                           const std::vector<std::vector<double>> &given);

/// Some imbalance acts on the rotor.
[[nodiscard]] bool has_imbalance(const model::Rotor &rotor);

} // namespace whirl::simulation
