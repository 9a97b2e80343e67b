#pragma once

#include "balancers/parts_motion.h"
#include "balancers/track.h"
#include "model/balancer.h"

#include <Eigen/Core>

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace whirl::balancers {

/// A mass that may stand anywhere on a circle about the axis, or about a centre next to it
/// (Kind::race_centre): a ball, the centre of a ring.
struct CircledMass {
    double moment = 0;  ///< m R, kg m
    double inertia = 0; ///< m R^2, kg m2
    int alike = 0;      ///< masses of one number could be exchanged

    [[nodiscard]] double radius() const { return inertia / moment; } ///< m
};

/// A mass that a spring of the centrifugal force holds back: a displacement sin f across a line.
struct SwungMass {
    double line = 0;   ///< angle of the line in the rotor, rad
    double moment = 0; ///< of mass at f = 90 deg, 2 m l, kg m
    double pivot = 0;  ///< a: at rest a tan f is the deflection across the line, m
};

/// All parts together at rest in the rotor; diametral inertias are half of the polar ones.
struct PartsInertia {
    double mass = 0;      ///< kg
    double on_circle = 0; ///< polar inertia of the parts as points, sum m R^2, kg m2
    double own = 0;       ///< polar inertia of the parts about axes of their own, kg m2
    /// In the motion in time the parts are a disc that turns with the rotor; else their equations
    /// hold their gyroscopic effect.
    bool turn_with_rotor = false;
};

/// All parts fixed in the rotor at some angles.
struct HeldParts {
    double mass = 0;                     ///< kg
    double on_circle = 0;                ///< polar inertia of the parts as points, kg m2
    double own = 0;                      ///< the same about axes of their own, kg m2
    std::complex<double> second_moment;  ///< sum m r^2 exp(2 i a), kg m2
    std::complex<double> moment_of_mass; ///< sum m r exp(i a), kg m
};

/// What the parts can do against an imbalance.
struct Reach {
    double imbalance = 0;    ///< the largest that they can balance, kg m
    double side_by_side = 0; ///< the imbalance that they make themselves at worst, kg m
    std::string formula;     ///< of the capacity E, for messages: "n m R/(m0 R0)"
};

/// Small motions of the parts about balance: complex unknowns y (m) in rotating axes with
///
///     node:  ... + sum_j pull_j (y_j'' + 2 i Omega y_j' - Omega^2 y_j)
///     j:     sum_k (inertia_jk y_k'' + damping_jk y_k') + restoring_j Omega^2 y_j
///                + 1/2 [pull_j a_A - conjugate_j conj(a_A)] = 0
///
/// a_A the acceleration of the node as in linear_element.h. Where drift_j > 0 only the rate of y_j
/// matters, y_j = const being a motion without any force. The unknown is then Y_j (m/s) with
/// y_j' = Y_j + Y_j'/drift_j: a column M_j l^2 + C_j l becomes (M_j l + C_j)(l/drift_j + 1), and
/// the root 0, which says nothing about stability, becomes -drift_j, far from all others.
struct SmallMotions {
    Eigen::VectorXd pull;       ///< kg
    Eigen::VectorXcd conjugate; ///< kg
    Eigen::MatrixXd inertia;    ///< kg
    Eigen::MatrixXd damping;    ///< kg/s
    Eigen::VectorXd restoring;  ///< kg
    Eigen::VectorXd drift;      ///< 1/s
    /// Of all parts on one diameter: their common D = exp(2 i a), |D| = 1. They move across it
    /// alone, y = 1/2 (y - D conj(y)), which the node drives and feels; what is left of the
    /// unknown, along it, is no motion of theirs and dies away by itself at the roots -far and -2
    /// far.
    std::optional<std::complex<double>> diameter;
    double far = 0; ///< 1/s
    /// Mean motions of groups of parts that move alike as combinations of y; empty: y themselves.
    Eigen::MatrixXd groups;

    /// A drift over the rates of the motions themselves: no motion is as fast, and rounding is far.
    static constexpr double far_away = 1e3;

    /// Sets `diameter` where all parts stand on one.
    /// @param D     mean of exp(2 i a) over the parts at angles a
    /// @param rate  of the motions themselves, 1/s
    void set_diameter(std::complex<double> D, double rate);
};

/// How the parts are drawn, seen from the side: all lengths are radii, m.
struct Outline {
    std::string label;                               ///< "ball balancer"
    std::vector<double> points;                      ///< circles on which point masses stand
    std::vector<std::pair<double, double>> arms;     ///< lines from, to
    std::vector<std::pair<double, double>> sections; ///< cut bodies from, to
    [[nodiscard]] double radius() const;             ///< the largest
};

/// A kind of balancer: all that the rest of the program asks of it. docs/adding_a_balancer.md.
class Kind {
  public:
    Kind() = default;
    Kind(const Kind &) = delete;
    Kind &operator=(const Kind &) = delete;
    virtual ~Kind() = default;

    [[nodiscard]] virtual std::string name() const = 0;  ///< as in the case: "ball"
    [[nodiscard]] virtual std::string parts() const = 0; ///< "balls"
    [[nodiscard]] virtual PartsInertia inertia() const = 0;
    [[nodiscard]] virtual Reach reach() const = 0;
    [[nodiscard]] virtual bool damped() const = 0;
    /// Damping over mass of parts that move as balls of one sort do, 1/s.
    [[nodiscard]] virtual std::optional<double> rate() const { return std::nullopt; }
    /// What can take any angle, in the order of model::Balancer::position; none for pendulums.
    [[nodiscard]] virtual std::vector<CircledMass> circled() const { return {}; }
    /// The centre of the circles of circled(), which turns with the rotor, from the axis, m.
    [[nodiscard]] virtual std::complex<double> race_centre() const { return 0; }
    /// h of the tracks of circled() that are no circles (track.h).
    [[nodiscard]] virtual std::complex<double> out_of_round() const { return 0; }
    /// Slope of the planes of the circles of circled() against the shaft, turning with the rotor,
    /// rad: what lies at x stands Re(conj(slope) x) less far along z.
    [[nodiscard]] virtual std::complex<double> inclination() const { return 0; }
    /// circled() do not stand anywhere on circles across the shaft: their tracks are none or
    /// tilted, or have walls.
    [[nodiscard]] virtual bool obstructed() const { return false; }
    /// What swings about its place at rest, in the order of coordinates(); none for balls.
    [[nodiscard]] virtual std::vector<SwungMass> swung() const { return {}; }
    /// The position that is taken where the case gives none, angles from the imbalance; none: the
    /// first of the family. Only asked for a position that exists.
    /// @param capacity  at least 1, may be infinite
    [[nodiscard]] virtual std::optional<std::vector<double>>
    usual_position([[maybe_unused]] double capacity) const {
        return std::nullopt;
    }
    /// @param angles  of the circled masses in the rotor, or without any of all coordinates, rad
    [[nodiscard]] virtual HeldParts held(const std::vector<double> &angles) const;
    /// @param angles  of the circled masses in the rotor, rad
    [[nodiscard]] virtual SmallMotions small_motions(const std::vector<double> &angles) const = 0;
    /// @param tilt     whether the parts resist tilting
    /// @param gravity  m/s2 towards -y
    [[nodiscard]] virtual std::shared_ptr<const PartsMotion> motion(bool tilt,
                                                                    double gravity) const = 0;
    /// Names of the coordinates of motion(); those of the circled masses come first.
    [[nodiscard]] virtual std::vector<std::string> coordinates() const = 0;
    [[nodiscard]] virtual Outline outline() const = 0;

    /// Angles that say where a motion starts: of the circled masses, or without any of all
    /// coordinates; the others start at 0.
    [[nodiscard]] std::size_t start_angles() const {
        const std::size_t masses = circled().size();
        return masses > 0 ? masses : coordinates().size();
    }
};

/// The kind of a balancer, which must outlive it.
[[nodiscard]] std::unique_ptr<Kind> kind_of(const model::Balancer &balancer);
/// That of its parts, each in a source of its own. A new kind: its line here.
[[nodiscard]] std::unique_ptr<Kind> kind_of(const model::Balls &balls);
[[nodiscard]] std::unique_ptr<Kind> kind_of(const model::Pendulums &pendulums);
[[nodiscard]] std::unique_ptr<Kind> kind_of(const model::Rings &rings);

/// The centre of some race lies off the axis.
[[nodiscard]] bool has_eccentric_race(const std::vector<model::Balancer> &balancers);
/// Some race is no circle across the shaft, or has walls.
[[nodiscard]] bool has_obstructed_race(const std::vector<model::Balancer> &balancers);

} // namespace whirl::balancers
