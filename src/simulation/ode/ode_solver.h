#pragma once

#include "simulation/ode/integrator.h"

#include <memory>
#include <vector>

namespace whirl::simulation {

/// How y' = f(t, y) is integrated.
enum class OdeMethod {
    explicit_high_order, ///< Runge-Kutta of Verner, order 8 with an estimate of order 7
    implicit_stiff,      ///< diagonally implicit Runge-Kutta of Kennedy and Carpenter, order 5
    exponential          ///< ExponentialAdams: of a problem with a linear part
};

/// Adaptive integration, one internal step a call: by ARKODE (SUNDIALS), or by ExponentialAdams.
class OdeSolver {
  public:
    OdeSolver(OdeProblem problem, OdeMethod method);
    OdeSolver(const OdeSolver &) = delete; // the integrator refers to the problem
    OdeSolver &operator=(const OdeSolver &) = delete;

    /// Starts at (t, y); call it again wherever the rates jump. @param step  to try first; 0:
    /// chosen
    void start(double t, const double *y, double step = 0);
    /// One step, not beyond `end` (which is met exactly). @returns the time reached.
    /// @throws SolverError where no step is small enough.
    double step(double end) { return _t = _integrator->step(end); }
    /// y at the time reached; `size` entries, valid until the next call of any of these.
    [[nodiscard]] const double *state() const;
    /// The state after this share (between 0 and 1) of the last step, where that may be longer than
    /// the motion in the resting axes needs (OdeMethod::exponential).
    [[nodiscard]] const double *within(double share) const;
    /// Step size it will try next.
    [[nodiscard]] double next_step() const { return _integrator->next_step(); }
    [[nodiscard]] OdeCounts counts() const { return _integrator->counts(); }

  private:
    OdeProblem _problem;
    std::unique_ptr<Integrator> _integrator;
    double _t = 0;
    mutable std::vector<double> _resting; ///< y in axes that stand still, where those of it turn

    void turn(double angle, double *y) const;
    [[nodiscard]] const double *in_resting_axes(const double *y, double at) const;
};

} // namespace whirl::simulation
