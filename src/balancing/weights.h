#pragma once

#include <Eigen/Core>

#include <complex>
#include <cstddef>
#include <limits>
#include <vector>

namespace whirl::balancing {

/// Vibration a + H w of places (rows) under weights w in planes (columns), as complex numbers of
/// one frequency; docs/theory.md, "Correction weights".
struct Balance {
    Eigen::MatrixXcd H;      ///< influence matrix
    Eigen::VectorXcd a;      ///< vibration without the weights
    Eigen::VectorXd factors; ///< of the places in what is made small, not negative
    Eigen::VectorXd largest; ///< of |w| in each plane; infinite: no bound

    [[nodiscard]] Eigen::VectorXcd residual(const Eigen::VectorXcd &w) const { return a + H * w; }
    /// With these planes alone.
    [[nodiscard]] Balance of_planes(const std::vector<std::size_t> &planes) const;
};

/// A sum of terms that together have this size, without what rounding leaves in it: neither nothing
/// nor what lies along an axis has then a direction that rounding chose.
[[nodiscard]] std::complex<double> without_rounding(std::complex<double> sum, double size);

struct Solution {
    Eigen::VectorXcd w;
    /// What was made small, root of the sum of squares or largest of |factor residual|, and what it
    /// cannot be less than, by duality.
    double value = 0;
    double bound = 0;
    /// Other weights do as well; of least squares without bounds these are the smallest.
    bool unique = true;
    bool shortest = false; ///< of all that leave the same, the least sum of squares
};

/// The weights of least sum of squares of |factor residual|.
[[nodiscard]] Solution least_squares(const Balance &balance);

/// Of the same sum of squares for all weights, with as few places as there are planes and one more,
/// factors of 1 and no bounds: to try many choices of planes.
[[nodiscard]] Balance reduced(const Balance &balance);

/// The weights of least max |factor residual|.
[[nodiscard]] Solution minimax(const Balance &balance);

/// Whether without the bounds of the planes less would stay.
/// @param method  least_squares or minimax, which found the solution
[[nodiscard]] bool bounds_cost(const Balance &balance, const Solution &solution,
                               Solution (*method)(const Balance &));

/// How well a matrix tells its planes apart, with the factors of the places.
struct Dependence {
    Eigen::VectorXd singular_values; ///< descending
    double condition = 0;            ///< largest over smallest; infinite: dependent
    /// Of each plane the share of its column that no others can make up: the sine of the angle
    /// between the column and the space of the others (1: independent, 0: superfluous).
    Eigen::VectorXd significance;
};
[[nodiscard]] Dependence dependence(const Balance &balance);

/// Sets of planes whose columns, of length one, nearly add up to nothing: each for one singular
/// value below `least` of the largest.
[[nodiscard]] std::vector<std::vector<std::size_t>> dependent_sets(const Balance &balance,
                                                                   double least);

} // namespace whirl::balancing
