#pragma once

#include <optional>
#include <vector>

namespace whirl::closed_form {

/// Least and largest value over all balanced positions, with positions (ball angles, rad) that
/// attain them.
struct ArrangementInterval {
    double least = 0.0;
    double largest = 0.0;
    std::vector<double> least_position;
    std::vector<double> largest_position;
};

/// Interval of |constant + factor * D| over every balanced position of n >= 2 equal balls at
/// capacity E >= 1, D = (1/n) sum exp(2 i a_j); none for other n, E.
///
/// Both ends are global. Where the modulus is stationary and not zero, every ball angle is a root
/// of one trigonometric polynomial of degree two (Lagrange's conditions), so at most four angles
/// differ: the search runs over all ways to put n balls in at most four groups, on a grid, and
/// polishes the best points. Zero is sought separately, because a zero need not be stationary in
/// that sense. Values are attained to 1e-12.
[[nodiscard]] std::optional<ArrangementInterval> modulus_interval(int balls, double capacity,
                                                                  double constant, double factor);

} // namespace whirl::closed_form
