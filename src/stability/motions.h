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
    double repeats = 0;         ///< copies of l lie i times this apart, rad/s; 0: there are none
    int action = 0;             ///< without damping its sign (FloquetMotion), where it is known

    [[nodiscard]] bool grows() const { return value.real() > noise; }
    /// Neither grows nor dies out beyond its noise.
    [[nodiscard]] bool neutral() const { return std::abs(value.real()) <= noise; }
};

/// How far apart two values are where copies of both lie i times `repeats` apart (0: there are
/// none), 1/s.
[[nodiscard]] double copies_apart(std::complex<double> a, std::complex<double> b, double repeats);

class PeriodicMotions;
struct StabilityModel;
struct StepExperience;

/// Free motions of one rotor at any spin speed, for questions of stability. Both conjugates are
/// listed, so that lines can be followed through the real axis.
class MotionSolver {
  public:
    /// @param form       general, rotating or hill
    /// @param order      of the shaft elements
    /// @param arrangement  where the balls of each balancer stand
    /// @param harmonics  of the Hill series (form hill), to begin with: every speed is solved with
    ///                   as many as it needs; 0: by the monodromy matrix (periodic_motions.h)
    /// @param shapes     planar shapes to reduce the shaft to (reduction/), or none: all motions of
    ///                   the reduced rotor are then found and listed
    /// @param top        largest |speed| that will be asked for, where it is known, rad/s
    /// @param experience  with steps in time of rotors that hardly differ (periodic_motions.h)
    MotionSolver(const model::Rotor &rotor, results::Form form, int order,
                 const balancers::Arrangement &arrangement, int harmonics,
                 std::shared_ptr<const Eigen::MatrixXd> shapes = nullptr, double top = 0,
                 std::shared_ptr<StepExperience> experience = nullptr);
    /// As the model says (rotor_at_speeds.h).
    MotionSolver(const StabilityModel &model, const balancers::Arrangement &arrangement,
                 std::shared_ptr<const Eigen::MatrixXd> shapes = nullptr);
    ~MotionSolver();
    MotionSolver(const MotionSolver &) = delete;
    MotionSolver &operator=(const MotionSolver &) = delete;
    MotionSolver(MotionSolver &&) = delete;
    MotionSolver &operator=(MotionSolver &&) = delete;

    /// All motions with |l| up to a little above the spin speed, and at least `least` of them. With
    /// Hill's series each once, at its place next to zero.
    /// @throws model::AnalysisFailure where they cannot be found, or a Hill series does not settle.
    [[nodiscard]] std::vector<Motion> at(double speed) const;

    /// The eigenpairs that at() makes motions of, Im >= 0, over all unknowns (Hill: of all terms).
    /// @throws model::AnalysisFailure as at()
    [[nodiscard]] std::vector<linalg::ComplexPair> pairs(double speed) const;

    /// How the monodromy matrix gives them; none where another way is taken.
    [[nodiscard]] const PeriodicMotions *by_monodromy() const;

    /// Real unknowns of the eigenproblem, the largest so far.
    [[nodiscard]] int unknowns() const;
    /// Most harmonics of the Hill series that a speed so far needed; 0 for other forms.
    [[nodiscard]] int harmonics() const;
    [[nodiscard]] const assembly::Discretization &discretization() const;

    static constexpr int least = 8;
    /// Where bearings can drive fast motions too (cross coupling, negative damping).
    static constexpr int least_driven = 24;

  private:
    struct Data;
    std::unique_ptr<Data> _data;
};

/// The value of a motion at that of its copies (Motion::repeats) which is next to another value.
[[nodiscard]] std::complex<double> copy_next_to(std::complex<double> other, const Motion &motion);

/// The one of largest real part.
[[nodiscard]] const Motion &fastest_growing(const std::vector<Motion> &motions);

/// Largest real part, 1/s; below the noise of the motions it is 0.
[[nodiscard]] double growth_of(const std::vector<Motion> &motions);

} // namespace whirl::stability
