#pragma once

#include "simulation/ode/ode_problem.h"

#include <memory>
#include <vector>

namespace whirl::simulation {

/// How y' = f(t, y) is integrated.
enum class OdeMethod {
    explicit_high_order, ///< Runge-Kutta of Verner, order 8 with an estimate of order 7
    implicit_stiff,      ///< diagonally implicit Runge-Kutta of Kennedy and Carpenter, order 5
    exponential          ///< ExponentialAdams: of a problem with a linear part
};

/// Adaptive integration, one internal step a call.
class OdeSolver {
  public:
    virtual ~OdeSolver() = default;
    OdeSolver(const OdeSolver &) = delete;
    OdeSolver &operator=(const OdeSolver &) = delete;

    /// Starts at (t, y); call it again wherever the rates jump.
    /// @param step  to try first; 0: chosen. Methods that choose it anyway leave it.
    void start(double t, const double *y, double step = 0);
    /// One step, not beyond `end` (which is met exactly). @returns the time reached.
    /// @throws SolverError where no step is small enough.
    double step(double end);
    /// y at the time reached; `size` entries, valid until the next call of any of these.
    [[nodiscard]] const double *state() { return in_resting_axes(state_in_axes(), _t); }
    /// The state after this share (between 0 and 1) of the last step, where that may be longer than
    /// the motion in the resting axes needs (OdeMethod::exponential).
    [[nodiscard]] const double *within(double share);
    /// Step size it will try next.
    [[nodiscard]] virtual double next_step() const = 0;
    [[nodiscard]] virtual OdeCounts counts() const = 0; ///< since it was made

  protected:
    explicit OdeSolver(OdeProblem problem);
    [[nodiscard]] const OdeProblem &problem() const { return _problem; }

    // The same with states in the turning axes of the problem.
    virtual void start_in_axes(double t, const double *y, double step) = 0;
    virtual double step_in_axes(double end) = 0;
    [[nodiscard]] virtual const double *state_in_axes() const = 0;
    /// @throws SolverError of a method that does not know it
    [[nodiscard]] virtual const double *within_in_axes(double share);

  private:
    OdeProblem _problem;
    double _t = 0;
    double _before = 0;           ///< the last step
    std::vector<double> _resting; ///< y in axes that stand still, where those of it turn

    void turn(double angle, double *y) const;
    [[nodiscard]] const double *in_resting_axes(const double *y, double at);
};

[[nodiscard]] std::unique_ptr<OdeSolver> ode_solver(OdeProblem problem, OdeMethod method);

/// Runge-Kutta methods with adaptive steps, by ARKODE (SUNDIALS).
[[nodiscard]] std::unique_ptr<OdeSolver> arkode(OdeProblem problem, bool stiff);

} // namespace whirl::simulation
