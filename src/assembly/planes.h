#pragma once

#include <Eigen/Core>

#include <complex>

namespace whirl::assembly {

inline constexpr std::complex<double> i_unit(0, 1);

/// A motion over unknowns in pairs (x, y), plane by plane.
struct Planes {
    Eigen::VectorXcd x, y;

    explicit Planes(const Eigen::VectorXcd &pairs)
        : x(pairs(Eigen::seqN(0, pairs.size() / 2, 2))),
          y(pairs(Eigen::seqN(1, pairs.size() / 2, 2))) {}

    /// x + i y: of a real motion Re[(x, y) exp(i w t)] twice the part that turns from x towards y.
    [[nodiscard]] Eigen::VectorXcd towards() const { return x + i_unit * y; }
    /// x - i y: twice the conjugate of the part that turns the other way.
    [[nodiscard]] Eigen::VectorXcd against() const { return x - i_unit * y; }
};

/// The motion over pairs (x, y) with these planes.
[[nodiscard]] inline Eigen::VectorXcd in_pairs(const Eigen::VectorXcd &x,
                                               const Eigen::VectorXcd &y) {
    Eigen::VectorXcd out(2 * x.size());
    out(Eigen::seqN(0, x.size(), 2)) = x;
    out(Eigen::seqN(1, y.size(), 2)) = y;
    return out;
}

} // namespace whirl::assembly
