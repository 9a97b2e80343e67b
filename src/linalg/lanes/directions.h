#pragma once

namespace whirl::linalg {

/// Cosines and sines of many angles, rad: four at a time, within two units in the last place of
/// those of the C library, whose own are taken beyond a million radians.
void set_directions(const double *angles, int count, double *cosines, double *sines);

} // namespace whirl::linalg
