#pragma once

#include "modes/spectrum.h"

#include <vector>

namespace whirl::tracking {

/// Spectra at many speeds, by this process.
/// @param follow  see SpectrumSolver::follow
/// @throws model::AnalysisFailure where modes are not found.
[[nodiscard]] std::vector<modes::Spectrum> spectra_alone(const modes::SpectrumSolver &solver,
                                                         const std::vector<double> &speeds,
                                                         int wanted, bool follow);

/// Spectra at many speeds, shared among the processes started by mpirun. Where modes are found from
/// those at other speeds (SpectrumSolver::carries_over) process 0 finds all: the numbers do not
/// depend on how many processes there are. Collective; complete on process 0, empty on the others.
/// @param follow  as in spectra_alone
/// @throws model::AnalysisFailure on every process where one of them failed.
[[nodiscard]] std::vector<modes::Spectrum> spectra_at(const modes::SpectrumSolver &solver,
                                                      const std::vector<double> &speeds, int wanted,
                                                      bool follow = false);

} // namespace whirl::tracking
