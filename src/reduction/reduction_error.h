#pragma once

#include "reduction/reduced_rotor.h"

#include <memory>

namespace whirl::reduction {

/// How far a reduced rotor is from the full one, which is solved once.
class ReductionError {
  public:
    /// @throws linalg::SolverError where the full model cannot be solved.
    ReductionError(const assembly::Discretization &discretization, const ReductionGoal &goal);
    ~ReductionError();
    ReductionError(const ReductionError &) = delete;
    ReductionError &operator=(const ReductionError &) = delete;
    ReductionError(ReductionError &&) = delete;
    ReductionError &operator=(ReductionError &&) = delete;

    /// Fills response_error: largest difference of the deflections at the places under forward
    /// synchronous unit forces there, over the largest of them; and frequency_error: of the whirl
    /// speeds on mean bearings up to the spin speed.
    void measure(ReducedRotor &reduced) const;

  private:
    struct Full;
    std::unique_ptr<Full> _full;
};

} // namespace whirl::reduction
