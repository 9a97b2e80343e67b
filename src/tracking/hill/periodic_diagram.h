#pragma once

#include "modes/spectrum.h"
#include "tracking/crossings.h"
#include "tracking/followed_lines.h"

#include <optional>
#include <vector>

namespace whirl::tracking {

/// Lines and crossings of a rotor whose equations stay periodic in time.
struct PeriodicDiagram {
    /// At the speeds of the diagram modes of the whole rotor; far below all frequencies
    /// (modes::FloquetSpectrum::slow) those of the reduced rotor stand where they are not found,
    /// not confirmed. At the others, where lines are followed and named, those of the reduced
    /// rotor.
    FollowedLines found;
    Crossings crossed;
};

/// By the reduced rotor (modes/hill/floquet_spectrum.h), at the speeds of the diagram and at as
/// many others, evenly spread over its range, that nothing depends on which the first ones are:
/// lines are followed, crossings and bands looked for there. Results are then made those of the
/// whole rotor. Collective; complete on process 0.
/// @param solver  form hill
/// @param speeds  of the diagram, ascending, rad/s; none: crossings alone are made those of the
///                whole rotor, with what finer elements change of them
/// @param naming  of its range, ascending, rad/s
/// @returns nothing (on any process) where some motion of the whole rotor is not found from those
///          of the reduced rotor
/// @throws model::AnalysisFailure where modes are not found
[[nodiscard]] std::optional<PeriodicDiagram> periodic_diagram(const modes::SpectrumSolver &solver,
                                                              const std::vector<double> &speeds,
                                                              const std::vector<double> &naming,
                                                              int modes,
                                                              const std::vector<double> &multiples);

} // namespace whirl::tracking
