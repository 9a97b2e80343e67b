#pragma once

#include <array>
#include <complex>

namespace whirl::forced {

/// A square matrix of at most so many rows: the unknowns of both ends of a chain. Plain, as its
/// products are written out: Eigen's of fixed size compile longer than the rest of this room.
constexpr int most_chained = 8;
template <class Scalar> using FewRows = std::array<std::array<Scalar, most_chained>, most_chained>;

/// Dynamic stiffness between two ends, the unknowns of one before those of the other; sizes: what
/// the entries add up to before they cancel, rounding by epsilon.
struct Chain {
    int half = 0; ///< unknowns of an end
    FewRows<std::complex<double>> values{};
    FewRows<double> sizes{};
};

/// The outer ends of two that share one.
[[nodiscard]] Chain joined(const Chain &a, const Chain &b);

/// So many equal ones in a row.
[[nodiscard]] Chain equal_chain(const Chain &one, int count);

} // namespace whirl::forced
