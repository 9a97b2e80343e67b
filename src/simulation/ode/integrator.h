#pragma once

#include "simulation/ode/ode_problem.h"

namespace whirl::simulation {

/// A method by which OdeSolver integrates: all states are in the turning axes of the problem.
class Integrator {
  public:
    Integrator() = default;
    virtual ~Integrator() = default;
    Integrator(const Integrator &) = delete;
    Integrator &operator=(const Integrator &) = delete;

    /// @param step  to try first; 0: chosen. Methods that choose it anyway leave it.
    virtual void start(double t, const double *y, double step) = 0;
    /// As OdeSolver::step().
    virtual double step(double end) = 0;
    [[nodiscard]] virtual const double *state() const = 0;
    /// The state after this share (between 0 and 1) of the last step; valid until the next call.
    /// @throws SolverError of a method that does not know it
    [[nodiscard]] virtual const double *within(double share) = 0;
    [[nodiscard]] virtual double next_step() const = 0;
    [[nodiscard]] virtual double last_step() const = 0;
    [[nodiscard]] virtual OdeCounts counts() const = 0; ///< since it was made
};

} // namespace whirl::simulation
