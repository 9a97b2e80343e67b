#pragma once

#include "linalg/eigenpair.h"
#include "modes/orbits.h"

#include <Eigen/Core>

#include <complex>
#include <vector>

namespace whirl::modes {

/// Whirl in the fixed frame of a motion exp(l t) sum_k q_k exp(2 i k speed t) in rotating axes, by
/// one of its terms.
///
/// With nu = Im l + 2 k speed term k whirls there at speed + nu, and against that at nu - speed. So
/// does one of its neighbours: the whirl at w of a term and the one at -w of the next are one
/// orbit, an ellipse in the fixed frame. Where they are as large, be it by rounding, it is a
/// straight line.
struct FixedFrameWhirl {
    double turn = 0;         ///< of the larger whirl of the term, positive with x towards y, rad/s
    double other = 0;        ///< of the smaller one
    double size = 0;         ///< of the larger one: energy of deflections
    double other_size = 0;   ///< of the smaller one
    Eigen::VectorXcd circle; ///< planar: x + i y = circle exp(i turn t) + opposite exp(-i turn t)
    Eigen::VectorXcd opposite; ///< of the neighbour; none: zero
    bool straight = false;     ///< both of one size

    /// Over pairs (x, y), (x, y)(t) = Re(shape exp(i |turn| t)): the ellipse of a straight motion,
    /// the circle of any other.
    [[nodiscard]] Eigen::VectorXcd shape() const;
};

/// Share of the largest term of a series, or whirl of a term, that another one must have to be as
/// large; equal ones may differ by rounding.
inline constexpr double equal_share = 1 - 1e-6;

/// @param terms      q_-K, ..., q_K over pairs (x, y), a column each
/// @param place      the column of the term
/// @param frequency  nu, rad/s
/// @param speed      not zero, rad/s
[[nodiscard]] FixedFrameWhirl fixed_frame_whirl(const Stations &stations,
                                                const Eigen::MatrixXcd &terms, Eigen::Index place,
                                                double frequency, double speed);

/// Of an eigenpair of Hill's series, or of a rotor without periodic supports, by its constant term.
/// @param size  unknowns of a term
[[nodiscard]] FixedFrameWhirl fixed_frame_whirl(const Stations &stations,
                                                const linalg::ComplexPair &pair, Eigen::Index size,
                                                double speed);

/// A motion on straight lines is as large in the alias that turns with the spin as in the one that
/// turns against it. The second stands for both: in the first the motion would come to stand where
/// its frequency is the spin speed. @param all  eigenpairs of Hill's series
void drop_alias_of_straight(const Stations &stations, Eigen::Index size, double speed,
                            std::vector<linalg::ComplexPair> &all);

} // namespace whirl::modes
