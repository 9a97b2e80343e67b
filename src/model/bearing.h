#pragma once

#include <Eigen/Core>

#include <optional>
#include <string>
#include <vector>

namespace whirl::model {

/// Linear coefficients of a bearing at one spin speed. The force on the shaft is
/// -(k u + c u' + m u'').
struct BearingCoefficients {
    Eigen::Matrix2d k = Eigen::Matrix2d::Zero();  ///< [kxx kxy; kyx kyy] on (x, y), N/m
    Eigen::Matrix2d c = Eigen::Matrix2d::Zero();  ///< [cxx cxy; cyx cyy], N s/m
    Eigen::Matrix2d m = Eigen::Matrix2d::Zero();  ///< [mxx mxy; myx myy] of the fluid, kg
    Eigen::Matrix2d kt = Eigen::Matrix2d::Zero(); ///< on the slopes (phi_x, phi_y), N m/rad
    Eigen::Matrix2d ct = Eigen::Matrix2d::Zero(); ///< on the slopes, N m s/rad
};

/// Coefficients on (x, y), but for rounding of entries that were turned into other axes:
/// the same from every direction, without coupling between x and y
[[nodiscard]] bool isotropic(const Eigen::Matrix2d &a);
/// the same from every direction: equal on the diagonal, opposite beside it
[[nodiscard]] bool rotation_invariant(const Eigen::Matrix2d &a);
[[nodiscard]] bool diagonal(const Eigen::Matrix2d &a);
[[nodiscard]] bool symmetric(const Eigen::Matrix2d &a);
/// A stiffness of which the symmetric part is negative in some direction
[[nodiscard]] bool pushes_away(const Eigen::Matrix2d &k);

/// A support below the bearing: mass on a spring and damper to the ground, each in x and in y.
struct Pedestal {
    Eigen::Vector2d mass = Eigen::Vector2d::Zero(); ///< kg
    Eigen::Vector2d k = Eigen::Vector2d::Zero();    ///< N/m
    Eigen::Vector2d c = Eigen::Vector2d::Zero();    ///< N s/m

    Pedestal() = default;
    /// The same in both directions.
    Pedestal(double m, double stiffness, double damping)
        : mass(m, m), k(stiffness, stiffness), c(damping, damping) {}
};

/// What a bearing is with its least or its largest clearance: a table over spin speed, as of
/// Bearing.
struct BearingAtClearance {
    std::vector<double> speeds; ///< rad/s
    std::vector<BearingCoefficients> rows;
    std::optional<double> clearance; ///< radial, m; none: as the bearing says otherwise
};

/// A bearing at z: constant coefficients (one row) or a table over spin speed. A seal acts like one
/// but carries nothing: drawings and lists of forces have bearings alone.
struct Bearing {
    std::string name;
    double z = 0;                          ///< m
    std::vector<double> speeds;            ///< rad/s, ascending; empty for constant coefficients
    std::vector<BearingCoefficients> rows; ///< one, or one for each of `speeds`
    std::optional<Pedestal> pedestal;
    std::optional<double> clearance; ///< radial, between the shaft and what holds it, m
    bool seal = false;
    std::optional<BearingAtClearance> least; ///< with its minimum clearance
    std::optional<BearingAtClearance> most;  ///< with its maximum clearance

    [[nodiscard]] bool depends_on_speed() const { return rows.size() > 1; }

    /// Some row has mass coefficients.
    [[nodiscard]] bool has_mass() const;

    /// Coefficients at a spin speed (rad/s): linear between table rows, constant outside.
    [[nodiscard]] BearingCoefficients at(double speed) const;

    /// By how much the stiffness or damping of a row between two speeds (rad/s) is off the straight
    /// line between those there, over the largest entry of its kind there.
    [[nodiscard]] double bend_between(double from, double to) const;

    /// Speeds of the rows at which the coefficients bend, rad/s, ascending: the first and the last
    /// one, and those that are off the straight line between their neighbours by more than 1e-4 of
    /// the largest stiffness or damping there. Between them a table through many rows of a smooth
    /// curve (a spline) is as good as smooth. Empty for constant coefficients.
    [[nodiscard]] std::vector<double> bends() const;
};

} // namespace whirl::model
