#pragma once

#include "model/case.h"
#include "results/campbell.h"
#include "tracking/crossings.h"
#include "tracking/followed_lines.h"

namespace whirl::analyses {

/// What a user must know beside the lines and crossings of a result: modes that are absent, not
/// followed or not confirmed, motions that grow or do not whirl, crossings that may be missing or
/// make no peak.
/// @param periodic  lines and crossings are those of the reduced rotor, by monodromy matrices
void add_campbell_notes(const model::CampbellSettings &settings,
                        const tracking::FollowedLines &found, const tracking::Crossings &crossed,
                        bool periodic, results::CampbellResult &result);

} // namespace whirl::analyses
