#pragma once

#include "simulation/ode/integrator.h"

#include <memory>

namespace whirl::simulation {

/// Runge-Kutta methods with adaptive steps, by ARKODE (SUNDIALS).
class Arkode : public Integrator {
  public:
    /// @param problem  must outlive this
    /// @param stiff    diagonally implicit, of Kennedy and Carpenter, order 5; otherwise explicit,
    /// of Verner, order 8 with an estimate of order 7
    Arkode(const OdeProblem &problem, bool stiff);
    ~Arkode() override;

    void start(double t, const double *y, double step) override;
    double step(double end) override;
    [[nodiscard]] const double *state() const override;
    [[nodiscard]] const double *within(double share) override;
    [[nodiscard]] double next_step() const override;
    [[nodiscard]] double last_step() const override;
    [[nodiscard]] OdeCounts counts() const override;

  private:
    struct Data;
    std::unique_ptr<Data> _data;
};

} // namespace whirl::simulation
