#pragma once

#include "cli/arguments.h"

namespace whirl::cli {

/// Reads the case, runs the analysis on all processes and delivers the result from the first:
/// files, and text or JSON on standard output. Collective under mpirun.
/// @throws model::BadInput, model::AnalysisFailure, std::exception; nothing is written then.
void run(const Arguments &arguments);

} // namespace whirl::cli
