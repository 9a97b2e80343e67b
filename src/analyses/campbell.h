#pragma once

#include "model/case.h"
#include "results/campbell.h"

#include <optional>
#include <vector>

namespace whirl::analyses {

/// Whirl speeds and damping over the spin speeds of the case, modes tracked, with every crossing
/// of a wanted multiple of the spin speed as a root (relative 1e-10).
///
/// Reported are all modes that are among the `campbell.modes` lowest at some speed. Errors add the
/// discretisation error (order p against p + 1, at three speeds, interpolated between them), the
/// residual of the eigenpair and the rounding of the matrix entries.
/// Collective under mpirun; complete on process 0.
/// @throws model::BadInput without [speeds]; model::AnalysisFailure where modes are not found.
[[nodiscard]] results::CampbellResult campbell(const model::Case &scene);

/// Crossings of a rotor of form hill. The lines of the diagram are no more than it takes to find
/// and name these: without errors, at speeds that name them.
struct HillCrossings {
    results::CampbellResult diagram;
    std::vector<std::optional<double>> by_mesh; ///< tracking::Crossings::by_mesh
};
[[nodiscard]] HillCrossings hill_crossings(const model::Case &scene);

} // namespace whirl::analyses
