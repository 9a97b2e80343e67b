#pragma once

#include "simulation/ode/ode_problem.h"

#include <memory>

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
    ~OdeSolver();
    OdeSolver(const OdeSolver &) = delete;
    OdeSolver &operator=(const OdeSolver &) = delete;
    OdeSolver(OdeSolver &&) = delete;
    OdeSolver &operator=(OdeSolver &&) = delete;

    /// Starts at (t, y); call it again wherever the rates jump. @param step  to try first; 0:
    /// chosen
    void start(double t, const double *y, double step = 0);
    /// One step, not beyond `end` (which is met exactly). @returns the time reached.
    /// @throws SolverError where no step is small enough.
    double step(double end);
    /// y at the time reached; `size` entries, valid until the next call of any of these.
    [[nodiscard]] const double *state() const;
    /// The state after this share (between 0 and 1) of the last step, where that may be longer than
    /// the motion in the resting axes needs (OdeMethod::exponential).
    [[nodiscard]] const double *within(double share) const;
    /// Step size it will try next.
    [[nodiscard]] double next_step() const;
    [[nodiscard]] OdeCounts counts() const;

  private:
    struct Data;
    std::unique_ptr<Data> _data;
};

} // namespace whirl::simulation
