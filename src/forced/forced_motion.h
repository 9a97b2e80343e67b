#pragma once

#include "assembly/rotating_system.h"
#include "assembly/system.h"
#include "linalg/check.h"
#include "linalg/harmonic_solve.h"
#include "model/case.h"
#include "results/formulation.h"

#include <Eigen/Core>

#include <complex>
#include <memory>
#include <optional>
#include <vector>

namespace whirl::forced {

inline constexpr std::complex<double> imaginary_unit(0, 1);

/// Two components over time: Re(x exp(i Omega t)), Re(y exp(i Omega t)).
struct Phasor {
    std::complex<double> x;
    std::complex<double> y;
};

/// Forward and backward part: x(t) + i y(t) = a exp(i Omega t) + conj(d) exp(-i Omega t).
struct WhirlParts {
    explicit WhirlParts(const Phasor &motion)
        : a((motion.x + imaginary_unit * motion.y) / 2.0),
          d((motion.x - imaginary_unit * motion.y) / 2.0) {}
    std::complex<double> a, d;
};

/// What a probe sees that looks along `angle`, from x towards y: x cos(angle) + y sin(angle).
[[nodiscard]] std::complex<double> reading(const Phasor &motion, double angle);

/// What is looked at: a deflection, or the force that a bearing has from this stretch of it.
struct Quantity {
    static constexpr int deflection = -1; ///< no bearing has this number
    assembly::Combination stretch;        ///< of planar unknowns
    int bearing = deflection;
    /// Direction in which a probe looks, from x towards y, rad; none: in all, the whole orbit.
    std::optional<double> angle{};
    double z = 0; ///< of a place on the shaft, m
    /// The deflection is this bearing's stretch, shaft against pedestal; none: that of a place.
    std::optional<int> film{};
    /// Or that of its pedestal.
    std::optional<int> pedestal{};
    /// Or what this probe reads.
    std::optional<model::Probe> probe{};

    /// What is seen of a motion: all of it, or what the probe reads, as a motion in x.
    [[nodiscard]] Phasor seen(const Phasor &motion) const {
        return angle ? Phasor{reading(motion, *angle), 0} : motion;
    }
};

/// A force of one frequency on a station in the fixed frame: Re(x exp(i w t)), Re(y exp(i w t)), N.
struct Push {
    double z = 0; ///< m
    Phasor force;
};

/// What a motion is looked at over, in rad/s: the spin speed, or the frequency of a force, with the
/// other a multiple of it or constant.
struct Sweep {
    double spin = 0, spin_rate = 1;           ///< spin speed: spin + spin_rate s
    double frequency = 0, frequency_rate = 1; ///< that of the forces likewise

    [[nodiscard]] double spin_at(double s) const { return spin + spin_rate * s; }
    [[nodiscard]] double frequency_at(double s) const { return frequency + frequency_rate * s; }
};

/// Of a block on (x, y) the part that is the same from all sides.
[[nodiscard]] Eigen::Matrix2d all_round(const Eigen::Matrix2d &block);
/// J block, J a quarter turn from x towards y: what is multiplied by a velocity in axes that stand
/// still multiplies the speed of axes that turn and the deflection in these.
[[nodiscard]] Eigen::Matrix2d quarter_turned(const Eigen::Matrix2d &block);

/// What drives the steady motion: the imbalances of the rotor, its weight, or forces of one
/// frequency.
struct Drive {
    double gravity = 0;         ///< m/s2 towards -y; 0: the imbalances or forces
    std::vector<Push> forces{}; ///< in place of the imbalances, or with them
    Sweep sweep{};              ///< of forces; else over the spin speed
    bool unbalanced = false;    ///< the imbalances too, where forces turn with the spin speed
    /// Several sets of imbalances, each alone, in place of those of the rotor; empty: those.
    std::vector<std::vector<model::Imbalance>> sets{};

    [[nodiscard]] bool weight() const { return gravity != 0; }
    /// Nothing but the imbalances.
    [[nodiscard]] bool imbalances() const { return !weight() && forces.empty(); }
    /// Of the motion in the fixed frame (rad/s), and what it changes with the sweep.
    [[nodiscard]] double frequency_at(double s) const {
        return weight() ? 2 * s : sweep.frequency_at(s);
    }
    [[nodiscard]] double frequency_rate() const { return weight() ? 2 : sweep.frequency_rate; }
};

/// The forces of a drive on the unknowns in pairs (x, y), N.
[[nodiscard]] Eigen::VectorXcd force_loads(const assembly::Discretization &discretization,
                                           const std::vector<Push> &forces);

/// Imbalances as forces on w = x + i y, over planar unknowns, by the spin speed squared: kg m.
[[nodiscard]] Eigen::VectorXcd imbalance_loads(const assembly::Discretization &discretization,
                                               const std::vector<model::Imbalance> &imbalances);
/// Those of the rotor.
[[nodiscard]] Eigen::VectorXcd imbalance_loads(const assembly::Discretization &discretization);

/// Mass of what turns (shaft and discs) as loads on the planar unknowns under a uniform
/// acceleration of one deflection: kg. Pedestals stand settled under their own weight.
[[nodiscard]] Eigen::VectorXd weight_loads(const assembly::Discretization &discretization);

/// What a bearing's force works on: the deflection of the shaft there, against that of a pedestal.
[[nodiscard]] assembly::Combination
stretch_of_bearing(const assembly::Discretization &discretization, int bearing);

/// What a probe reads in its direction: the shaft, against the pedestal where it measures against
/// one, or the pedestal that it sits on.
[[nodiscard]] assembly::Combination stretch_of_probe(const assembly::Discretization &discretization,
                                                     const model::Probe &probe);

/// The deflection that a quantity is, or is of, on this discretisation, which need not be the one
/// that it was made for.
[[nodiscard]] assembly::Combination stretch_of(const assembly::Discretization &discretization,
                                               const Quantity &quantity);

/// Steady motion of a discretised rotor under its imbalances, under its weight, or under forces of
/// one frequency.
///
/// Planar (isotropic bearings), w = u exp(i Omega t): [K + i Omega C_e - Omega^2 (M - G)] u = f;
/// internal damping drops out, since nothing flexes in rotating axes. General, (x, y):
/// [K + Omega Kc + i Omega (C + Omega G) - Omega^2 M] q = f. Rotating (asymmetric rotor): the
/// motion stands still in rotating axes, [K + Omega Ks + Omega^2 Kss] u = f. docs/theory.md, "The
/// forms". All are one system at a spin speed and a frequency (linalg/harmonic_solve.h), the
/// frequency that of the load in the axes that it is solved in: Omega or 0.
///
/// Weight: seen from an asymmetric rotor it turns backwards once a revolution,
/// [K + Omega Ks + Omega^2 Kss + i Omega (C + Omega Cs) - Omega^2 M] q = f exp(i Omega t); in the
/// fixed frame w = w0 + a exp(2 i Omega t), nothing else. A rotor on a shaft that is equally stiff
/// in all directions (any other form) stands still in the fixed frame, [K + Omega Kc] q = f.
/// docs/theory.md, "Weight".
///
/// Forces of any frequency w in the fixed frame: general form at the spin speed Omega,
/// [K + Omega Kc + i w (C + Omega G) - w^2 M] q = f.
class ForcedMotion {
  public:
    /// @param smooth  motions at neighbouring speeds are on a smooth curve
    /// (linalg/harmonic_solve.h)
    ForcedMotion(const assembly::Discretization &discretization, results::Form form,
                 Drive drive = {}, bool smooth = false);

    /// Solves under the forward synchronous imbalances of the rotor, its weight, or the forces.
    /// @param speed  the spin speed; under forces the place along their sweep
    /// @throws linalg::SolverError where the rotor is at an undamped resonance.
    void solve(double speed);
    /// Of several sets of imbalances the one whose motion is read: after a solution the first.
    void look_at(std::size_t set);

    /// Deflection of a combination of planar unknowns in the last solution, m: at the spin speed,
    /// under the weight at twice the spin speed.
    [[nodiscard]] Phasor motion(const assembly::Combination &combination) const;
    /// At a place on the shaft.
    [[nodiscard]] Phasor at(double z) const { return motion(_discretization.deflection_at(z)); }
    /// Of the shaft in a bearing, from the pedestal where there is one.
    [[nodiscard]] Phasor stretch(int bearing) const {
        return motion(stretch_of_bearing(_discretization, bearing));
    }
    /// The same quantity of this discretisation, which need not be the one that it was made for.
    [[nodiscard]] Phasor of(const Quantity &quantity) const;
    /// Force k u + c u' of a bearing on the shaft's support in the last solution, N.
    [[nodiscard]] Phasor bearing_force(int bearing) const {
        return bearing_force(bearing, stretch(bearing), _speed);
    }
    /// That of a stretch, which moves as under the drive at a place of the sweep.
    [[nodiscard]] Phasor bearing_force(int bearing, const Phasor &stretch, double speed) const;
    /// Under the weight: what stands still in the fixed frame, x + i y of a combination (m) and of
    /// the force of a bearing (N).
    [[nodiscard]] std::complex<double> at_rest(const assembly::Combination &combination) const;
    [[nodiscard]] std::complex<double> bearing_force_at_rest(int bearing) const;
    /// Planar unknowns x and y of the last solution, a column each; one column where the orbits are
    /// circles, y = -i x. Under the weight in the axes that they are solved in.
    [[nodiscard]] Eigen::MatrixXcd planar_motion() const;
    /// Relative error of the last solution by rounding, of several sets the largest.
    [[nodiscard]] double rounding() const;
    /// What of that changes from speed to speed (linalg/harmonic_solve.h).
    [[nodiscard]] double noise() const { return _solver ? _solver->noise() : 0; }
    /// Unknowns of the real linear system.
    [[nodiscard]] int unknowns() const {
        return 2 * (stands_still() ? 1 : planes()) * _discretization.planar_size();
    }

    /// As the equations are solved, with one complex unknown in the place of each planar one, or
    /// with two, x and y.
    [[nodiscard]] int planes() const { return _planar ? 1 : 2; }
    /// The last solution, over these unknowns; before one zero.
    [[nodiscard]] const Eigen::VectorXcd &solution() const { return _displacements; }
    /// Under other forces with the frequency and at the spin speed of the last solution, a column
    /// each.
    [[nodiscard]] Eigen::MatrixXcd under(const Eigen::MatrixXcd &forces);
    /// x and y of a combination of planar unknowns, as they are solved for; x alone.
    [[nodiscard]] Phasor as_solved(const assembly::Combination &combination,
                                   const Eigen::Ref<const Eigen::VectorXcd> &displacements) const;
    /// The motion that such a pair is, as motion().
    [[nodiscard]] Phasor in_fixed_frame(const Phasor &as_solved) const;
    /// Bearings whose coefficients depend on the speed.
    [[nodiscard]] const std::vector<int> &tabled() const { return _tabled; }
    /// What bearings are in the equations at a place of the sweep.
    /// @param spin  that their coefficients are those of
    [[nodiscard]] linalg::HarmonicSolver::Entries films(const std::vector<int> &bearings,
                                                        double spin, double speed) const;

  private:
    const assembly::Discretization &_discretization;
    Drive _drive;
    Eigen::VectorXd _weight; ///< under the weight: kg on the planar unknowns
    bool _planar;            ///< one complex deflection in each place
    bool _rotating;          ///< solved in rotating axes
    bool _smooth;
    std::unique_ptr<linalg::HarmonicSolver> _solver; ///< of the bearings at rest; none before use
    bool _at_rest = false;                           ///< it is of a rotor that does not turn
    double _speed = 0;                               ///< of the last solution, as given
    Eigen::MatrixXcd _loads, _solutions;             ///< a column a set of imbalances
    Eigen::VectorXcd _displacements;                 ///< the one that is read
    std::vector<int> _tabled;
    mutable std::optional<double> _rounding; ///< once asked for

    void assemble(double spin);
    /// What the bearings with tables are at a speed beside what they are at rest.
    [[nodiscard]] linalg::HarmonicSolver::Entries table_changes(double spin,
                                                                double frequency) const;
    void add_films(const std::vector<int> &bearings, double coefficients_at, double spin,
                   double frequency, double share, linalg::HarmonicSolver::Entries &out) const;
    [[nodiscard]] Eigen::MatrixXcd forces(double speed) const;
    [[nodiscard]] Eigen::VectorXcd forces_of(double speed,
                                             const std::vector<model::Imbalance> &imbalances) const;
    /// Of the motion in the axes that it is solved in.
    [[nodiscard]] double frequency(double speed) const {
        if (!_drive.forces.empty())
            return _drive.frequency_at(speed);
        return _rotating == _drive.weight() ? speed : 0;
    }
    /// Under imbalances the motion stands still in rotating axes: x and y are real but for the
    /// phase.
    [[nodiscard]] bool stands_still() const { return _rotating && _drive.imbalances(); }
};

/// The form the response uses: planar with isotropic bearings, damped or not, else general.
/// @throws model::BadInput where the case forces the planar form and it cannot describe the scene.
[[nodiscard]] results::Formulation response_formulation(const model::Case &scene);

/// Solves a motion at a speed; false at a resonance without damping, of the rotor or of a part of
/// it.
template <class Motion> [[nodiscard]] bool solves(Motion &motion, double speed) {
    try {
        motion.solve(speed);
    } catch (const linalg::SolverError &) {
        return false;
    }
    return true;
}

} // namespace whirl::forced
