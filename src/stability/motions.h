#pragma once

#include "assembly/discretization.h"
#include "balancers/arrangement.h"
#include "linalg/eigenpair.h"
#include "results/formulation.h"

#include <Eigen/Core>

#include <complex>
#include <memory>
#include <vector>

namespace whirl::stability {

/// A free motion exp(l t) at one spin speed, in the frame of the form.
struct Motion {
    std::complex<double> value; ///< l, 1/s
    Eigen::VectorXcd state;     ///< displacements and velocities, made comparable; length 1
    double noise = 0;           ///< how far Re l can be from the truth by rounding, 1/s
    bool may_meet = true;       ///< slow enough for a combination resonance at this speed
    double repeats = 0;         ///< aliases of l lie i times this apart, rad/s; 0: there are none
    int action = 0;             ///< without damping its sign (FloquetMotion), where it is known

    [[nodiscard]] bool grows() const { return value.real() > noise; }
    [[nodiscard]] bool decays() const { return value.real() < -noise; }
    /// Neither grows nor dies out beyond its noise.
    [[nodiscard]] bool neutral() const { return std::abs(value.real()) <= noise; }
};

/// How far apart two values are where aliases of both lie i times `repeats` apart (0: there are
/// none), 1/s.
[[nodiscard]] double alias_distance(std::complex<double> a, std::complex<double> b, double repeats);

/// Motions looked at, however fast they are: more where bearings drive.
[[nodiscard]] int fewest_motions(const model::Rotor &rotor);

/// |Im l| up to which motions can begin or cease to grow, rad/s. On the imaginary axis the work of
/// the forces is zero: w x^H C x = i x^H N x with the symmetric part C of the damping and the skew
/// part N of the stiffness. In fixed axes w is therefore no larger than the largest such quotient
/// of a single bearing, and the spin speed for the damping of the shaft itself; in rotating axes,
/// where N of a bearing has its C times the speed in it, than the sum of both. Infinite where
/// something drives motions of every frequency: negative damping, cross coupling without damping, a
/// torque without a potential.
/// @param speed  |spin speed|, or the largest of a range, rad/s
[[nodiscard]] double growth_reach(const model::Rotor &rotor, results::Form form, double speed);

class PeriodicMotions;
struct StabilityModel;

/// Free motions of one rotor at any spin speed, for questions of stability. Both conjugates are
/// listed, so that lines can be followed through the real axis.
class MotionSolver {
  public:
    /// @param model        whose `harmonics` are those to begin with: every speed is solved with as
    ///                     many as it needs
    /// @param arrangement  where the balls of each balancer stand
    /// @param shapes       planar shapes to reduce the shaft to (reduction/), or none: all motions
    ///                     of the reduced rotor are then found and listed
    MotionSolver(const StabilityModel &model, const balancers::Arrangement &arrangement,
                 std::shared_ptr<const Eigen::MatrixXd> shapes = nullptr);
    ~MotionSolver();
    MotionSolver(const MotionSolver &) = delete;
    MotionSolver &operator=(const MotionSolver &) = delete;
    MotionSolver(MotionSolver &&) = delete;
    MotionSolver &operator=(MotionSolver &&) = delete;

    /// All motions with |l| up to a little above the spin speed, and eight of them at the least (24
    /// where bearings drive).
    /// With Hill's series each once, at its place next to zero.
    /// @throws model::AnalysisFailure where they cannot be found, or a Hill series does not settle.
    [[nodiscard]] std::vector<Motion> at(double speed) const;

    /// How the monodromy matrix gives them; none where another way is taken.
    [[nodiscard]] const PeriodicMotions *by_monodromy() const;

    /// Real unknowns of the eigenproblem, the largest so far.
    [[nodiscard]] int unknowns() const;
    /// Most harmonics of the Hill series that a speed so far needed; 0 for other forms.
    [[nodiscard]] int harmonics() const;
    [[nodiscard]] const assembly::Discretization &discretization() const;

  private:
    struct Data;
    std::unique_ptr<Data> _data;
};

/// The value of a motion at that of its aliases (Motion::repeats) which is next to another value.
[[nodiscard]] std::complex<double> nearest_alias(std::complex<double> other, const Motion &motion);

/// The one of largest real part.
[[nodiscard]] const Motion &fastest_growing(const std::vector<Motion> &motions);

/// Largest real part, 1/s; below the noise of the motions it is 0.
[[nodiscard]] double growth_of(const std::vector<Motion> &motions);

} // namespace whirl::stability
