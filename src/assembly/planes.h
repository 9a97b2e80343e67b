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

/// The motions over pairs (x, y) with these planes, a column each.
[[nodiscard]] inline Eigen::MatrixXcd in_pairs(const Eigen::MatrixXcd &x,
                                               const Eigen::MatrixXcd &y) {
    Eigen::MatrixXcd out(2 * x.rows(), x.cols());
    out(Eigen::seqN(0, x.rows(), 2), Eigen::all) = x;
    out(Eigen::seqN(1, y.rows(), 2), Eigen::all) = y;
    return out;
}

} // namespace whirl::assembly
