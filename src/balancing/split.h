#pragma once

#include <complex>
#include <cstddef>
#include <optional>
#include <vector>

namespace whirl::balancing {

/// A weight in one place of a plane.
struct Piece {
    std::optional<std::size_t> hole; ///< from 0; none: at any angle
    double angle = 0;                ///< rad
    std::optional<double> mass;      ///< of the stock, kg; none: the moment alone is known
    double mr = 0;                   ///< kg m
};

/// Where weights can be set in a plane, and which.
struct Places {
    int holes = 0;             ///< evenly around; 0: anywhere
    double first = 0;          ///< angle of the first hole, rad
    double radius = 0;         ///< m; of stock
    std::vector<double> stock; ///< masses at hand, kg; empty: any
};

struct Split {
    std::vector<Piece> pieces;
    std::complex<double> sum; ///< of the pieces, kg m
    bool complete = true;     ///< all ways were tried, or there is an exact one
};

/// A weight as pieces. Holes without stock: the two beside its angle, exactly. Stock without holes:
/// two equal weights whose angles make the sum, exactly, where the stock suffices. Holes and stock:
/// at most one weight a hole, the nearest sum of all where they are few, else of at most four
/// pieces; of equal sums the one with fewest pieces.
[[nodiscard]] Split split(std::complex<double> weight, const Places &places);

} // namespace whirl::balancing
