#pragma once

#include "model/case.h"
#include "results/balance.h"

namespace whirl::analyses {

/// What the criterion leaves open: the balancers as they are. Where the balanced position is stable
/// (balance.balanced_position), and motions in time at balance.simulated speeds, with the order
/// chosen for the criterion and the form that suits them, whatever form was asked for for the
/// criterion. Notes say what there is not, and why.
/// @param scene  with balancers and a range of speeds
void judge_real_balancers(const model::Case &scene, int order, results::BalanceResult &result);

} // namespace whirl::analyses
