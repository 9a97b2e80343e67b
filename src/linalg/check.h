#pragma once

#include "model/errors.h"

namespace whirl::linalg {

/// A library under us reported an error, or did not converge. Caught by the solver that knows
/// what to try next, or turned into words for the user at the top.
class SolverError : public model::Failure {
  public:
    using Failure::Failure;
};

/// Throws SolverError where a PETSc, SLEPc or MPI call returned an error code, std::bad_alloc where
/// it is for want of memory. File and line are
/// those of the caller (compiler built-ins, as clang-tidy 14 cannot read std::source_location).
void check(int code, const char *file = __builtin_FILE(), int line = __builtin_LINE());

} // namespace whirl::linalg
