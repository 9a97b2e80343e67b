#pragma once

#include "modes/biorthogonal.h"
#include "modes/spectrum.h"

namespace whirl::modes {

/// Basis of the modes of a Hill series (form hill), for overlaps with those at other speeds: states
/// over the terms exp(2 i k speed t) of each motion. A motion is the same one with its terms moved
/// by one place and its eigenvalue by 2 i speed, or with all conjugate: those are its aliases, and
/// which of them `modes` hold may change from speed to speed.
///
/// The left vectors of a series cut off are not to be had for all aliases: left is the dual basis
/// of the states and their aliases among themselves, in the kinetic energy. Rates are unknown.
///
/// @param mass   of the rotor in rotating axes
/// @param harmonics  of the states
/// @param slow   the speed is far below the frequencies: motions are those without_modulation
/// @param parts  first unknown of balancers' parts, which are measured in rotating axes at rest too
[[nodiscard]] ModeBasis series_basis(const Eigen::SparseMatrix<double> &mass, Eigen::Index parts,
                                     int harmonics, bool slow, const Spectrum &spectrum);

} // namespace whirl::modes
