#pragma once

#include "model/sentence.h"

namespace whirl::results {

// Results speak in the sentences that cases and failures have too.
namespace as = model::as;
using model::joined;
using model::Sentence;
using model::Value;
using model::Weight;

} // namespace whirl::results
