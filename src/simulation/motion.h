#pragma once

#include "simulation/dry/dry_state.h"
#include "simulation/moving_parts.h"

#include <Eigen/Dense>

#include <cmath>
#include <vector>

namespace whirl::simulation {

/// Blocks of 4 x 4, one a plane, side by side.
using PlaneBlocks = Eigen::Matrix<double, 4, Eigen::Dynamic>;

/// Right-hand side of the motion in time; docs/theory.md, "Motion in time".
///
/// State: p (2r: real, then imaginary part), the free angles (relative to the rotor), their
/// velocities in the same order; with a motor the rotor's angle and speed; the work done by the
/// drive, the energy lost, the angular impulse from outside. All accelerations are exact: the
/// angles are eliminated one by one, and the planes' accelerations follow from one small system
/// (four unknowns a plane).
class RotorMotion {
  public:
    explicit RotorMotion(MovingParts parts);

    [[nodiscard]] const MovingParts &parts() const { return _parts; }
    [[nodiscard]] int size() const;        ///< of the state
    [[nodiscard]] int coordinates() const; ///< 2r + free angles
    [[nodiscard]] int first_angle() const { return 2 * _parts.rotor.size(); }
    [[nodiscard]] int books() const { return size() - 3; } ///< index of work, loss, impulse

    /// Whatever jumps is as in the piece between two jumps that holds this time.
    void enter_piece(double time) { _piece = time; }
    /// Times at which the rates jump or bend, ascending, > 0.
    [[nodiscard]] std::vector<double> jumps() const;
    [[nodiscard]] Spin::At spin(double t, const double *state) const;

    /// Contact and dry friction, docs/theory.md: what touches and stands is for others to say.
    void set_dry(DryState dry);
    [[nodiscard]] DryState &dry() { return _dry; }
    [[nodiscard]] const DryState &dry() const { return _dry; }
    [[nodiscard]] double gap_of(const Gap &gap, const double *angles) const;
    /// Rate at which the two of a gap come apart, rad/s.
    [[nodiscard]] double opening(const Gap &gap, const double *state) const {
        return gap.between(state + first_angle() + coordinates());
    }
    // At the state of the last rates(), N m about the axis: what holds two together, what holds one
    // that stands, what friction could hold beyond that; a torque that moves a part at this rate.
    [[nodiscard]] double pressure(std::size_t gap) const { return _multipliers[gap]; }
    [[nodiscard]] double holding_torque(std::size_t i) const { return _friction[i].stand; }
    [[nodiscard]] double friction_reserve(std::size_t i) const {
        return _friction[i].limit - std::abs(_friction[i].stand);
    }
    [[nodiscard]] double torque_scale(int i, double rate) const {
        return _free_equations[static_cast<std::size_t>(i)].a * rate * rate;
    }
    [[nodiscard]] bool lifts(std::size_t i) const { return _friction[i].normal < 0; }
    /// Change of all velocities by a unit impulse (N m s) that parts the two of a gap.
    [[nodiscard]] Eigen::VectorXd impulse_response(double t, const double *state,
                                                   const Gap &gap) const;

    /// dy/dt.
    void rates(double t, const double *state, double *rates) const;
    struct Totals {
        double energy = 0;   ///< kinetic and potential, with that of the spin, J
        double momentum = 0; ///< angular, about z, kg m2/s
    };
    [[nodiscard]] Totals totals(double t, const double *state) const;
    /// Deflection of a row, (x, y) in m.
    [[nodiscard]] Eigen::Vector2d deflection(const reduction::Row &row, const double *state) const;

  private:
    MovingParts _parts;
    DryState _dry;
    std::vector<Eigen::Index> _plane_of; ///< of each free coordinate
    std::vector<double> _free_from;      ///< s: of each, held in the rotor before
    mutable bool _frictionless = false;
    mutable std::vector<DryTorque> _friction;     ///< of each free coordinate
    mutable std::vector<Constraint> _constraints; ///< active
    mutable std::vector<double> _multipliers;     ///< of gaps, then of parts at rest, N m
    Eigen::MatrixXd _rows;                        ///< r x 2P: w, phi of each plane
    Eigen::MatrixXd _products;                    ///< _rows^T _rows
    Eigen::MatrixXd _stiffness;                   ///< 2r x 2r with constant supports
    Eigen::MatrixXd _inverse_mass;                ///< where the rotor's is not one; else empty
    Eigen::MatrixXd _of_place;                    ///< p to K p, then the gyroscopic matrix times p
    Eigen::MatrixXd _of_velocity;                 ///< v to C v, then the same of v
    bool _tables = false;                         ///< supports depend on speed
    bool _circulating = false;                    ///< the supports' stiffness is not symmetric
    bool _internal = false;
    double _piece = 0;
    // Room for one evaluation of the rates, kept between them.
    mutable std::vector<balancers::PlaneMotion> _motions; ///< of the planes
    mutable Eigen::ArrayXd _turned, _cosines, _sines;     ///< of the free angles, fixed frame
    mutable std::vector<balancers::MassEquation> _free_equations;
    mutable std::vector<balancers::MassEquation> _fixed_equations;
    mutable Eigen::MatrixXd _forces;      ///< 2r x 2: alone, per unit of spin acceleration
    mutable Eigen::MatrixXd _planes;      ///< 4P x 2: accelerations of the planes
    mutable Eigen::MatrixXd _loads;       ///< 4P x 2
    mutable PlaneBlocks _coupling;        ///< Q
    mutable Eigen::VectorXd _by_place;    ///< of `_of_place`, with constant supports
    mutable Eigen::VectorXd _by_velocity; ///< of `_of_velocity`, likewise
    mutable Eigen::VectorXd _push;        ///< 2r: K p + C v
    mutable Eigen::MatrixXd _slip;        ///< r x 2: velocity as seen from the rotor
    mutable Eigen::MatrixXd _inner;       ///< r x 2: the internal damping times that
    mutable Eigen::VectorXd _external;    ///< 2r: loads from outside
    mutable Eigen::Vector2d _base = Eigen::Vector2d::Zero(); ///< acceleration of the foundation

    void rotor_forces(const Spin::At &spin, const double *p, const double *v) const;
    void outside_forces(double t) const;
    void mass_loads(const Spin::At &spin, const double *state) const;
    void fixed_loads(const Spin::At &spin) const;
    void add_sliding(std::size_t i, balancers::MassEquation &e) const;
    int add_constraint_columns() const;
    void push_column(const Constraint &c, Eigen::Index column) const;
    [[nodiscard]] double free_acceleration(int i, Eigen::Index column) const;
    void apply_constraints(const Spin::At &spin, const double *state, int held) const;
    void settle_friction() const;
    [[nodiscard]] double coupled_acceleration(std::size_t i, Eigen::Index column) const;
    [[nodiscard]] Eigen::Vector2d free_torque(int columns) const;
    void add_outside_work(const Spin::At &spin, const double *state, double *books) const;
    [[nodiscard]] bool is_there(const FixedMass &mass) const {
        return mass.from <= 0 || _piece > mass.from;
    }
    [[nodiscard]] bool is_held(std::size_t i) const {
        return _free_from[i] > 0 && _piece <= _free_from[i];
    }
    void solve_accelerations(int columns) const;
    void gather(Eigen::Index column) const;
    [[nodiscard]] Eigen::Vector2d torque(const double *state, int columns) const;
    void keep_energy_balance(const Spin::At &spin, double torque, const double *state,
                             double *books) const;
    [[nodiscard]] balancers::PlaneVector at_plane(int plane, const double *p) const;
    [[nodiscard]] balancers::PlaneMotion motion_of(int plane, const double *state) const;
    [[nodiscard]] balancers::PlaneVector fixed_motion(const FixedMass &mass, const double *p) const;
};

} // namespace whirl::simulation
