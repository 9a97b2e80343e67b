#pragma once

#include "criterion/rotor.h"
#include "model/case.h"
#include "results/balance.h"
#include "results/sentence.h"

#include <string>
#include <vector>

namespace whirl::analyses {

/// Where passive auto-balancers in the correction planes of the case (without any: in the planes of
/// its balancers) can balance the rotor: the empirical criterion on the flexible rotor, per plane
/// and for all planes together, in bands of spin speed with refined ends; beside it the closed form
/// of the rigid rotor. The rotor is the one without balancers; where it is not axisymmetric the
/// criterion holds for imbalances in every direction of it. For four-pendulum balancers their
/// efficiency, too. Theory: docs/theory.md, "The criterion on a flexible rotor". Collective over
/// MPI processes: the signature is complete on process 0.
/// @param map  with the criterion over plane positions
/// @throws model::BadInput without planes and balancers, without [speeds], or with negative ones;
///         model::AnalysisFailure where the rotor is free to move.
[[nodiscard]] results::BalanceResult balance(const model::Case &scene, bool map = false);

/// What the criterion leaves open: the balancers as they are. Where the balanced position is stable
/// (balance.balanced_position), and motions in time at balance.simulated speeds, with the order
/// chosen for the criterion and the form that suits them, whatever form was asked for for the
/// criterion. Notes say what there is not, and why.
/// @param scene  with balancers and a range of speeds
void judge_real_balancers(const model::Case &scene, int order, results::BalanceResult &result);

/// What balancers in the planes must supply against the imbalances wherever these are, against
/// their capacity, and what stays; docs/theory.md, "What balancers must supply". Collective; set on
/// process 0. Nothing without imbalances.
void add_supply(const model::Case &scene, const criterion::BalanceScene &s,
                results::BalanceResult &result);

/// Sentences that say what the bands mean and where flexible and rigid rotor, and the three tiers,
/// differ, and why. For one speed alone only what is needed there.
[[nodiscard]] std::vector<results::Sentence> balance_findings(const results::BalanceResult &result,
                                                              const model::Case &scene);

} // namespace whirl::analyses
