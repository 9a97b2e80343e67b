#pragma once

#include "results/campbell.h"

namespace whirl::analyses {

/// Lines on which motion grows, in one note.
void note_growing(results::CampbellResult &result);

} // namespace whirl::analyses
