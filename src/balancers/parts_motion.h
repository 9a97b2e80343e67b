#pragma once

#include <Eigen/Core>

#include <vector>

namespace whirl::balancers {

/// Deflection w = (x, y) in the first two entries, slope in the last two; or their rates.
using PlaneVector = Eigen::Vector4d;

/// Motion of a plane of the rotor.
struct PlaneMotion {
    PlaneVector place = PlaneVector::Zero();
    PlaneVector velocity = PlaneVector::Zero();
};

/// What the rotor does at one moment.
struct SpinState {
    double angle = 0; ///< theta, rad
    double speed = 0; ///< Omega, rad/s
};

/// Of the coordinates of some parts: cosine and sine of each angle in the fixed frame.
struct Directions {
    const double *cosines = nullptr;
    const double *sines = nullptr;
};

/// An equation a g'' + u . y + b = 0 of one angle g, and the force -(u g'' + Q y) + P on its plane,
/// y the plane's acceleration. The constant inertia that the rotor's mass matrix already holds is
/// not in Q.
struct MassEquation {
    PlaneVector u = PlaneVector::Zero();            ///< coupling of angle and plane
    double a = 0;                                   ///< inertia of the angle
    double b = 0;                                   ///< all without accelerations
    double friction = 0;                            ///< what of b is friction
    PlaneVector force = PlaneVector::Zero();        ///< P
    PlaneVector per_spin = PlaneVector::Zero();     ///< change of P per unit of spin acceleration
    Eigen::Matrix2d tilt = Eigen::Matrix2d::Zero(); ///< Q on the slopes

    /// What couples the angle with the spin beyond that (of a race about a centre off the axis): b
    /// changes by it per unit of spin acceleration, the torque that the rotor needs by it times
    /// g''.
    double by_spin = 0;

    bool in_rotor = false; ///< g'' is that of the angle in the rotor, not in the fixed frame
    /// Torque on the rotor that the part asks for: alone, and per unit of spin acceleration.
    Eigen::Vector2d torque = Eigen::Vector2d::Zero();
    Eigen::Vector2d offset = Eigen::Vector2d::Zero(); ///< S: and Im(conj(S) w'') besides, kg m
    Eigen::Vector2d swash = Eigen::Vector2d::Zero();  ///< and times the slope's acceleration, kg m2
    double weight = 0;                                ///< torque of gravity about the axis, N m

    /// Resistance to rolling: at most `lever` times the normal force of the race, which is
    /// normal + normal_y . y, N.
    double lever = 0; ///< m
    double normal = 0;
    PlaneVector normal_y = PlaneVector::Zero();
};

/// Contributions to the energy and to the angular momentum about the z axis beyond those of the
/// rotor's mass matrix.
struct MassMomenta {
    double kinetic = 0;   ///< J
    double potential = 0; ///< J
    double spin = 0;      ///< dT/d(angular velocity), of the angle alone, kg m2/s
    PlaneVector plane = PlaneVector::Zero(); ///< dT/d(velocity of the plane)

    MassMomenta &operator+=(const MassMomenta &other) {
        kinetic += other.kinetic;
        potential += other.potential;
        spin += other.spin;
        plane += other.plane;
        return *this;
    }
};

/// Parts at rest in the rotor and their small motions about that, in axes that turn with it. The
/// unknowns are the deflection W and slope Phi of the plane, both in rotating axes, then the
/// angles:
///
///     inertia q'' + (gyroscopic + damping) q' + stiffness q = 0
///
/// of the parts alone, without the constant inertia that the rotor's mass matrix already holds.
struct AtRest {
    explicit AtRest(int angles);

    Eigen::VectorXd force; ///< on the plane, and along the angles
    Eigen::MatrixXd inertia, gyroscopic, damping;
    Eigen::MatrixXd stiffness; ///< minus the derivative of `force`

    /// Adds a pair of symmetric (or skew) entries of one angle and two entries of the plane.
    static void add_symmetric(Eigen::MatrixXd &matrix, int plane, Eigen::Index angle,
                              const Eigen::Vector2d &column);
    static void add_skew(Eigen::MatrixXd &matrix, int plane, Eigen::Index angle,
                         const Eigen::Vector2d &column);
};

/// Where the centre of a part is that touches a wall across its race, before and behind it, rad;
/// and the torque along its angle there over the force across the wall, m.
struct Wall {
    double before = 0, behind = 0;
    double arm_before = 0, arm_behind = 0;
};

/// Parts in one race that cannot pass each other, or walls there.
struct TouchingRow {
    int first = 0, count = 0; ///< their coordinates
    double touching = 0;      ///< angle between the centres of two that touch, rad
    double restitution = 1;
    bool pass = false; ///< they pass each other: there are walls alone
    std::vector<Wall> walls;
};

/// Equations of motion of the parts of one balancer: one angle in the rotor a coordinate, no two of
/// which share an inertia. docs/theory.md, "Motion in time".
class PartsMotion {
  public:
    PartsMotion() = default;
    PartsMotion(const PartsMotion &) = delete;
    PartsMotion &operator=(const PartsMotion &) = delete;
    virtual ~PartsMotion() = default;

    [[nodiscard]] virtual int size() const = 0; ///< coordinates
    /// @param angles,rates  in the rotor, rad and rad/s
    /// @param towards       of the same angles
    /// @param out           `size()` equations
    virtual void equations(const PlaneMotion &plane, const SpinState &spin, const double *angles,
                           const double *rates, const Directions &towards,
                           MassEquation *out) const = 0;
    /// All angles constant while plane and rotor turn as one body; without weight, contact and
    /// resistance to rolling. docs/theory.md, "Steady states".
    /// @param place   of the plane in rotating axes
    /// @param angles  in the rotor, rad
    [[nodiscard]] virtual AtRest at_rest(const PlaneVector &place, double speed,
                                         const double *angles) const = 0;
    [[nodiscard]] virtual std::vector<TouchingRow> touching() const { return {}; }
    /// A coordinate has dry resistance.
    [[nodiscard]] virtual bool resists([[maybe_unused]] int coordinate) const { return false; }
    /// Of all parts together.
    [[nodiscard]] virtual MassMomenta momenta(const PlaneMotion &plane, const SpinState &spin,
                                              const double *angles, const double *rates) const = 0;
};

} // namespace whirl::balancers
