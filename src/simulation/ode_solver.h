#pragma once

#include <functional>
#include <memory>
#include <vector>

namespace whirl::simulation {

/// Axes that turn, in which a motion that goes round with them stands still, so that it is followed
/// in long steps. The rates must look the same from axes turned by any angle, and not depend on
/// time otherwise: those at t = 0 are then the rates in the turning axes, but for the turning
/// itself. The problem is stated and answered in axes that stand still all the same.
struct TurningAxes {
    double speed = 0; ///< rad/s; 0: integrated as it is
    int count = 0;    ///< of the vectors: x of all, then y of all, from each of `first` on
    std::vector<int> first;

    /// Turns these vectors of a state by an angle, rad.
    void turn(double angle, double *state) const;
};

/// An initial value problem of fixed size.
struct OdeProblem {
    int size = 0;
    /// Writes dy/dt; both arrays have `size` entries.
    std::function<void(double t, const double *y, double *rates)> rates;
    /// Writes the error allowed in each entry, > 0; the local error is kept below it in the mean
    /// square over the entries.
    std::function<void(const double *y, double *allowed)> allowed_error;
    TurningAxes axes = {};
};

/// How y' = f(t, y) is integrated.
enum class OdeMethod {
    explicit_high_order, ///< Runge-Kutta of Verner, order 8 with an estimate of order 7
    implicit_stiff       ///< diagonally implicit Runge-Kutta of Kennedy and Carpenter, order 5
};

struct OdeCounts {
    long steps = 0;
    long failed = 0; ///< steps repeated because their error was too large
    long rates = 0;  ///< evaluations of f
};

/// Adaptive integration by the Runge-Kutta methods of ARKODE (SUNDIALS), one internal step a call.
class OdeSolver {
  public:
    OdeSolver(OdeProblem problem, OdeMethod method);
    ~OdeSolver();
    OdeSolver(const OdeSolver &) = delete;
    OdeSolver &operator=(const OdeSolver &) = delete;

    /// Starts at (t, y); call it again wherever the rates jump.
    /// @param step  to try first; 0: chosen
    void start(double t, const double *y, double step = 0);
    /// One step, not beyond `end` (which is met exactly). @returns the time reached.
    /// @throws SolverError where no step is small enough.
    double step(double end);
    /// y at the time reached; `size` entries, valid until the next call of start() or step().
    [[nodiscard]] const double *state() const;
    /// Step size it will try next.
    [[nodiscard]] double next_step() const;
    [[nodiscard]] OdeCounts counts() const; ///< since it was made

  private:
    struct Arkode;
    std::unique_ptr<Arkode> _arkode;
};

} // namespace whirl::simulation
