#pragma once

#include "analyses/operating/mover.h"
#include "model/case.h"
#include "results/operating.h"

#include <map>
#include <memory>
#include <string>
#include <vector>

namespace whirl::analyses {

/// The machine at its operating speeds, each solved for on the whole rotor, and the largest values
/// against the limits of the case over all speeds between: of probes and pedestals from the lowest
/// operating speed to the highest that it reaches, of clearances from rest. Speeds of [speeds] have
/// no say in it.
///
/// Motions of different frequencies are added with their largest values, as if these came together:
/// never less than what a transducer would show.
///
/// A probe that does not say what it measures against, on a machine with pedestals, is judged both
/// in the fixed frame and against the pedestal of its bearing.
///
/// @param scene   with [operation], and with the imbalances of its balancers
/// @param movers  all that moves the rotor
/// @param nodes   stations, looked at where there are no probes
[[nodiscard]] results::OperatingResponse
operating_response(const model::Case &scene, const assembly::Discretization &d,
                   const std::vector<std::unique_ptr<Mover>> &movers,
                   const std::map<int, std::string> &nodes);

/// Says at which operating speeds there is no steady motion.
void note_operating_resonances(const results::OperatingResponse &operating,
                               std::vector<results::Sentence> &notes);

} // namespace whirl::analyses
