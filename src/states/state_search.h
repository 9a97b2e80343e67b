#pragma once

#include "model/case.h"
#include "results/steady_states.h"
#include "states/steady_equations.h"

#include <complex>
#include <functional>
#include <optional>
#include <vector>

namespace whirl::states {

/// All steady states of a rotor with balancers at one speed; docs/theory.md, "Steady states".
///
/// A mass on a circle feels no force along it where the deflection of the circle's centre is zero,
/// or points to it or away from it. So in each plane that deflection is zero, and the masses make
/// what that needs, or all masses stand on one line through the centre. For each way to share out
/// the masses of all planes between the two ends of their lines the directions of the lines are the
/// roots of as many trigonometric polynomials, all of which are found (trig_roots.h). On tracks out
/// of round each mass has such an equation of its own. Any mass may rest against a wall across
/// its race instead, on which it is pushed; then it is one that the rotor has there.
class StateSearch {
  public:
    /// @throws model::AnalysisFailure as SteadyEquations; more balls than are searched; states that
    ///         are not isolated
    StateSearch(const model::Case &scene, double slowest, double fastest);

    /// A state with what is needed to follow it.
    struct Found {
        results::SteadyState state;
        Eigen::VectorXd x;
        double place = 0; ///< along what is followed: the speed, or the value of an entry
        int along = 0;    ///< motions along the family, which neither grow nor die out
        int way = 0;      ///< in which the masses stand
        /// The root of the motion that grows least of those that grow, 1/s; 0 where none does.
        /// Next to the end of a band in which one more grows it is that one's: without damping all
        /// others stay on the imaginary axis.
        std::complex<double> least_growing;
        std::complex<double> fastest; ///< the root of largest real part, 1/s
        bool damped = false;          ///< some motion dies out
    };
    /// At a speed other than 0.
    /// @param undecided  set where two states are too close to be told apart
    /// @throws linalg::SolverError
    [[nodiscard]] std::vector<Found> at(double speed, bool &undecided) const;

    /// What is wanted of states: their places alone, or all that follows from them.
    enum class Wanted { places, all };
    /// Those of one way to stand.
    [[nodiscard]] std::vector<Found> of_way(int way, double speed, bool &undecided,
                                            Wanted wanted = Wanted::all) const;
    /// Another rotor whose masses can stand in the same ways, in the same order.
    [[nodiscard]] bool same_ways(const StateSearch &other) const;

    /// There can be states in which no plane with balancers is deflected (no race's centre, where
    /// that lies off the axis): balls or rings alone, two or more in each plane.
    [[nodiscard]] bool can_balance() const;
    /// The state in which no plane with balancers is deflected. None where the masses cannot make
    /// what that needs.
    /// @param member  of the family that three masses or more have: first the usual arrangement.
    ///                Where large slopes do not let it be the next one that they do.
    /// @throws linalg::SolverError, also where it was not found though the masses can make it
    [[nodiscard]] std::optional<Found> balanced(double speed, int member) const;
    /// Motions of masses beyond two in each plane, each of a ring with its own turning: they change
    /// nothing.
    [[nodiscard]] int free_motions() const;

    [[nodiscard]] const SteadyEquations &equations() const { return _equations; }
    /// The same state at another speed near by, from a guess of its unknowns; none: not reached.
    [[nodiscard]] std::optional<Found> followed(const Found &from, const Eigen::VectorXd &guess,
                                                double speed) const;
    /// Every ball stands between the same two walls in both; whether one is so near to a wall, or
    /// presses on it so little, that the state ends there.
    [[nodiscard]] bool between_same_walls(const Eigen::VectorXd &a, const Eigen::VectorXd &b) const;
    [[nodiscard]] bool ends_at_wall(const Found &found) const;
    /// All masses stand at the same angles, those that could be exchanged in any order.
    [[nodiscard]] bool stand_alike(const Found &a, const Found &b) const;
    /// Masses that could be exchanged are, so that each stands as near as may be to where it does
    /// in another state of the same way to stand: each by itself where races are out of round; a
    /// pair on a line is the same after half a turn.
    [[nodiscard]] Eigen::VectorXd lined_up(Eigen::VectorXd x, const Eigen::VectorXd &with) const;
    void line_up(Found &found, const Found &with) const;
    /// Sets what follows from the unknowns: angles, amplitudes, growth, stability.
    void describe(Found &found, double speed) const;

  private:
    /// Where a mass touches a wall, the sense in which it is pushed there, and the torque along its
    /// angle over the force across the wall, m.
    struct Stop {
        double angle;
        int sense;
        double arm;
    };
    /// Sets growth and stability. @param zeros  roots that are zero wherever the masses stand
    /// @throws linalg::SolverError
    void judge(Found &found, int zeros) const;

    struct Mass {
        Eigen::Index coordinate; ///< among all angles
        double moment;           ///< kg m
        double radius;           ///< m
        double tilt;             ///< kg m2
        int alike;               ///< masses of one number could be exchanged
        std::vector<Stop> stops; ///< of each wall that before it and that behind it
    };
    struct Plane {
        Eigen::Index index; ///< among those of the equations
        std::vector<Mass> masses;
        double tilt = 0;                    ///< of all masses, kg m2
        Eigen::Vector2d centre;             ///< of their circles, from the axis, m
        std::complex<double> out_of_round;  ///< of their tracks (balancers/track.h)
        Eigen::Vector2d slope;              ///< of their circles (balancers/kind.h), rad
        std::vector<std::size_t> balancers; ///< whose masses they are
    };
    struct Swung {
        Eigen::Index plane;
        Eigen::Index coordinate;
        double line, moment, pivot;
    };
    /// How the masses of a plane stand: empty: balanced; else which end of the line each takes, 0:
    /// where its track holds it, or at_stop.
    using Sides = std::vector<int>;
    static constexpr int at_stop = 2;
    /// Of each mass its stop, -1: it is free.
    using Stops = std::vector<int>;
    struct PlaneWay {
        Sides sides;
        Stops stops;
    };
    struct Way {
        std::vector<Sides> sides; ///< of each plane
        std::vector<Stops> stops; ///< likewise
        SteadyEquations::Held held;
    };
    /// Roots for one way to stand.
    class Lines;

    SteadyEquations _equations;
    std::vector<Plane> _planes;
    std::vector<model::Balancer> _balancers;
    std::vector<Swung> _swung;
    std::vector<Way> _ways;
    bool _walls = false;                 ///< some race has walls
    std::vector<std::size_t> _angles_of; ///< angles that each balancer shows
    std::vector<Eigen::Index> _first_of; ///< coordinate of its first angle

    void write_angles(Found &found) const;
    void collect(const model::Case &scene);
    [[nodiscard]] static std::vector<PlaneWay> ways_of(const Plane &plane);
    static void add_sides(const Plane &plane, const Stops &stops, std::vector<PlaneWay> &out);
    [[nodiscard]] std::vector<Way> all_ways() const;
    [[nodiscard]] double size_of_deflections(double speed) const;
    void add_states(int index, double speed, double deflection, Wanted wanted,
                    std::vector<Found> &out, bool &undecided) const;
    /// Angles of the masses of a plane from the imbalance that they balance, kg m.
    [[nodiscard]] std::vector<double> balanced_angles(const Plane &plane, double imbalance,
                                                      int member) const;
    /// Those of the family where |sum mR exp(2 i a)| is largest (sign -1) or least (1).
    [[nodiscard]] std::vector<double> extreme_angles(const Plane &plane, double imbalance,
                                                     double sign) const;
    [[nodiscard]] bool place(const Way &way, const Lines &lines, const Eigen::VectorXd &root,
                             int member, Eigen::VectorXd &angles) const;
    /// Two equal masses that need not make anything stand opposite each other, at any angle.
    [[nodiscard]] static bool turns_as_pair(const Plane &plane, std::complex<double> needed);
    /// Some pair does.
    [[nodiscard]] bool pair_turns(const Way &way, const Lines &lines,
                                  const Eigen::VectorXd &root) const;
    /// By which one more member of that family is turned, where walls leave room; none: nowhere.
    [[nodiscard]] static std::optional<double>
    turn_of_pair(const Plane &plane, const Eigen::VectorXd &angles, int member);
    [[nodiscard]] int along_family(const Way &way, const Eigen::VectorXd &angles) const;
    enum class Fit { yes, no, undecided };
    /// Whether free masses stand beside the walls and others press on theirs.
    [[nodiscard]] Fit at_walls(const Way &way, const Eigen::VectorXd &x, double speed,
                               double deflection, double nothing) const;
    void write_wall_forces(Found &found) const;
    [[nodiscard]] bool same(const Eigen::VectorXd &a, const Eigen::VectorXd &b) const;
    [[nodiscard]] results::SteadyState::Kind kind_of(const Way &way) const;
};

/// Of those other than 0, absolute; 1 where there is none, rad/s.
struct SpeedExtremes {
    double slowest = 1;
    double fastest = 1;
};
[[nodiscard]] SpeedExtremes extremes_of(const std::vector<double> &speeds);

/// All steady states at the speeds of a case, ascending.
/// @throws model::AnalysisFailure
[[nodiscard]] results::SteadyStates steady_states(const model::Case &scene,
                                                  const std::vector<double> &speeds);
/// The same at one speed over entries of the case.
/// @param with  the case with these entries at a value
/// @throws model::AnalysisFailure, also where the balls of one value are not those of another;
///         model::BadInput where there is no such rotor
[[nodiscard]] results::SteadyStates
steady_states_over(const model::SweepAxis &over, double speed,
                   const std::function<model::Case(double value)> &with);

} // namespace whirl::states
