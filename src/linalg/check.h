#pragma once

#include <source_location>
#include <stdexcept>

namespace whirl::linalg {

/// A library under us reported an error, or did not converge. Caught by the solver that knows
/// what to try next, or turned into words for the user at the top.
class SolverError : public std::runtime_error {
  public:
    using std::runtime_error::runtime_error;
};

/// Throws SolverError where a PETSc, SLEPc or MPI call returned an error code.
void check(int code, std::source_location where = std::source_location::current());

} // namespace whirl::linalg
