#pragma once

#include "model/sentence.h"

#include <string>

namespace whirl::results {

// Results speak in the sentences that cases and failures have too.
namespace as = model::as;
using model::joined;
using model::Sentence;
using model::Value;
using model::Weight;

/// "bearing DE", "bearing at z = 0.5 m".
[[nodiscard]] Sentence place_in_words(const std::string &of, const std::string &name, double z,
                                      int digits = 6);

} // namespace whirl::results
