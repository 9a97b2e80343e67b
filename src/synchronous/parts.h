#pragma once

#include "assembly/rotating_system.h"
#include "linalg/matrix.h"

#include <vector>

namespace whirl::synchronous {

/// [A B; -B A]: the real form of A - i B on (Re, Im); without B: [A 0; 0 A].
[[nodiscard]] linalg::Matrix doubled(const linalg::Matrix &A, const linalg::Matrix *B);

/// The rotor in rotating axes, the balls of its balancers held at their balanced positions.
[[nodiscard]] assembly::RotatingSystem held_in_rotating_axes(const assembly::Discretization &rotor,
                                                             double bearing_speed);

/// Rows of all bearing tables of a rotor, rad/s, ascending, each once; empty where there are none.
[[nodiscard]] std::vector<double> table_speeds(const model::Rotor &rotor);

/// Speeds between which the coefficients of all bearings are linear.
struct TablePiece {
    int index = 0;           ///< rows below it
    double from = 0, to = 0; ///< its rows, rad/s; equal, the speed asked for: constant coefficients
};
/// The piece that a speed lies in, a row in the one above it.
/// @param rows  table_speeds()
[[nodiscard]] TablePiece table_piece(const std::vector<double> &rows, double speed);

} // namespace whirl::synchronous
