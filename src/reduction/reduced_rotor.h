#pragma once

#include "assembly/discretization.h"

#include <Eigen/Core>

#include <optional>
#include <vector>

namespace whirl::reduction {

/// Row of a quantity (a deflection, a slope) over the reduced unknowns, r entries.
using Row = Eigen::VectorXd;

/// A reduced rotor: planar unknowns q = shapes * p, p complex with r entries, the kinetic energy
/// |p'|^2/2: shapes are orthonormal under the mass matrix, fast ones shorter, for inertia is added
/// to them. The real form is (Re p; Im p).
struct ReducedRotor {
    Eigen::MatrixXd shapes;     ///< N x r
    Eigen::MatrixXd mass_times; ///< N x r: p = mass_times^T q, for q = shapes * p
    Eigen::MatrixXd elastic;    ///< r x r, of the shaft; springs of the inertia added
    Eigen::MatrixXd internal;   ///< r x r, damping in rotating axes, of both
    Eigen::MatrixXd gyroscopic; ///< r x r, symmetric
    Row mass_load;   ///< r: load under a unit acceleration of all, pedestals included, with
                     ///< fluid in bearings that accelerates alike
    double mass = 0; ///< kg, without pedestals
    /// 2r x 2r on (Re p; Im p): how the masses of supports deviate from their mean over x and y, to
    /// be added to the unit matrix; empty where they are the same from all sides.
    Eigen::MatrixXd mass_deviation;
    Row load_deviation; ///< r: added to mass_load under an acceleration in x, less in y; or empty

    /// Bearings at one speed, on the real form (2r x 2r).
    struct Supports {
        double speed = 0; ///< rad/s
        Eigen::MatrixXd stiffness;
        Eigen::MatrixXd damping;
    };
    std::vector<Supports> supports; ///< ascending; linear between, constant outside

    int modes = 0;               ///< lowest modes at rest that the shapes contain; r: all
    double response_error = 0;   ///< relative, of the synchronous response at the planes
    double frequency_error = 0;  ///< relative, of the whirl speeds up to the fastest motion
    Eigen::VectorXd frequencies; ///< rad/s, of the shapes at rest on mean bearings, ascending

    [[nodiscard]] int size() const { return static_cast<int>(shapes.cols()); }
    [[nodiscard]] Row row(const assembly::Combination &combination) const;
    /// Supports at a speed and what they change per unit of speed.
    [[nodiscard]] Supports supports_at(double speed) const;
    [[nodiscard]] Supports supports_slope(double speed) const;
};

/// What the shapes must be good for.
struct ReductionGoal {
    double speed = 0;    ///< rad/s, highest of the spin: there the response is compared
    bool varies = false; ///< the rotor passes lower speeds too, or stands still
    double fastest = 0;  ///< rad/s, of the motions that act on the rotor, >= speed
    /// A load that does not turn with the rotor.
    struct Outside {
        double frequency = 0;    ///< rad/s, >= 0
        std::optional<double> z; ///< m; none: the foundation moves
    };
    std::vector<Outside> outside;
    std::vector<double> places;  ///< z of forces and of the deflections that count, m
    std::vector<double> tilted;  ///< z of moments, m
    std::vector<double> watched; ///< z of further deflections that count, without forces, m
    double tolerance = 1e-3;     ///< relative, of response and whirl speeds
    int modes = 0;               ///< so many modes, whatever the error; 0: as many as needed
};

/// The rotor on its lowest undamped planar modes at rest (mean bearing stiffness) and the static
/// deflections under forces at the places and from outside. Raises the number of modes until the
/// steady response to forward synchronous forces and the whirl speeds up to the fastest motion that
/// acts agree with the full model; then adds as much inertia to fast shapes as that allows, on
/// springs and dampers that turn with the rotor, so that motion in time takes long steps. Motions
/// up to the fastest keep their decay to a tenth, and none grows that did not before; responses to
/// forces from outside stay as they are to the tolerance. A rigid shaft, and one with few
/// unknowns, is kept whole.
/// @throws model::AnalysisFailure where a part that moves has no mass, or the full model cannot be
///         solved.
[[nodiscard]] ReducedRotor reduce(const assembly::Discretization &discretization,
                                  const ReductionGoal &goal);

} // namespace whirl::reduction
