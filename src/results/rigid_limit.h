#pragma once

#include "results/model_summary.h"

#include <optional>
#include <string>
#include <vector>

namespace whirl::results {

/// One quantity of the rigid rotor and what the finite-element model gives for it, either while the
/// shaft stiffens or while the mesh coarsens; the lists have one entry a point.
struct RigidLimitRow {
    Sentence quantity;
    model::Quantity of = model::Quantity::speed;
    double closed_form = 0;
    bool speed = true;                     ///< counts for the 1 % stiffness
    bool inertia = false;                  ///< of the composite rotor
    int order = 1;                         ///< of the shaft elements
    std::vector<double> factor;            ///< of E and G; infinite: shaft without elastic unknowns
    std::vector<double> stiffness;         ///< 48 EI/L^3 at that factor, N/m; stiffness sweep only
    std::vector<int> elements;             ///< of the shaft; mesh sweep only
    std::vector<std::optional<double>> fe; ///< none: the model has no such value
    std::vector<std::optional<double>> relative_difference; ///< |fe - closed form| over the latter
    std::vector<std::optional<double>> rounding; ///< what rounding can add to that; not of inertias
    /// Slope of log difference over log stiffness (or over log elements), by least squares.
    std::optional<double> rate;
    std::optional<double> rigid; ///< model with shaft.rigid = true; stiffness sweep only
};

/// A shaft at which the rigid formulas err by a given amount.
struct RigidShaft {
    double factor = 1;        ///< of E and G
    double stiffness = 0;     ///< 48 EI/L^3, N/m
    double over_bearings = 0; ///< that over the sum of the bearings' stiffnesses
    double largest = 0;       ///< relative difference of `quantity`
    Sentence quantity;        ///< the speed that differs most
};

struct RigidLimitResult {
    ModelSummary model;
    double stiffness = 0;         ///< 48 EI/L^3 of the shaft as it is, N/m; infinite: rigid
    double bearing_stiffness = 0; ///< sum over the bearings, N/m
    double mesh_factor = 1;       ///< of E and G in the mesh sweep
    std::vector<RigidLimitRow> rows;
    // Of the rigid rotor with its balancers (RigidEquivalent).
    double omega_0 = 0; ///< rad/s
    std::vector<double> partial_frequencies;
    std::optional<double> z_max;           ///< m, from the centre of mass
    std::optional<RigidShaft> as_is;       ///< none where a compared speed does not exist
    std::optional<RigidShaft> one_percent; ///< stiffer shafts err less; none: rigid, or never more
    Sentence sentence;                     ///< the answer for a user
};

} // namespace whirl::results
