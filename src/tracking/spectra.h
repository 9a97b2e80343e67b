#pragma once

#include "modes/spectrum.h"

#include <vector>

namespace whirl::tracking {

/// Spectra at many speeds, by this process.
/// @param follow  damped rotors with symmetric matrices: from speed to speed, see
///                SpectrumSolver::follow
/// @throws model::AnalysisFailure where modes are not found.
[[nodiscard]] std::vector<modes::Spectrum> spectra_alone(const modes::SpectrumSolver &solver,
                                                         const std::vector<double> &speeds,
                                                         int wanted, bool follow);

/// Spectra at many speeds, shared among the processes started by mpirun. Collective; complete on
/// process 0, empty on the others. The numbers depend on how many processes there are by their
/// rounding: what was learned at one speed helps at the next.
/// @param follow  as in spectra_alone
/// @throws model::AnalysisFailure on every process where one of them failed.
[[nodiscard]] std::vector<modes::Spectrum> spectra_at(const modes::SpectrumSolver &solver,
                                                      const std::vector<double> &speeds, int wanted,
                                                      bool follow = false);

} // namespace whirl::tracking
