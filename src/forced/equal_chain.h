#pragma once

#include <Eigen/Core>
#include <Eigen/LU>

#include <complex>

namespace whirl::forced {

/// Dynamic stiffness between two ends, the unknowns of one before those of the other; sizes: what
/// the entries add up to before they cancel, rounding by epsilon.
template <int N> struct Chain {
    Eigen::Matrix<std::complex<double>, N, N> values;
    Eigen::Matrix<double, N, N> sizes;
};

/// Of two chains that share an end, [D P; Q M] with the unknowns of that end last.
template <class Scalar, int N> struct SharedEnd {
    static constexpr int half = N / 2;
    using Whole = Eigen::Matrix<Scalar, N, N>;
    Whole D = Whole::Zero();
    Eigen::Matrix<Scalar, N, half> P;
    Eigen::Matrix<Scalar, half, N> Q;
    Eigen::Matrix<Scalar, half, half> M;

    SharedEnd(const Whole &a, const Whole &b) {
        D.template topLeftCorner<half, half>() = a.template topLeftCorner<half, half>();
        D.template bottomRightCorner<half, half>() = b.template bottomRightCorner<half, half>();
        P.template topRows<half>() = a.template topRightCorner<half, half>();
        P.template bottomRows<half>() = b.template bottomLeftCorner<half, half>();
        Q.template leftCols<half>() = a.template bottomLeftCorner<half, half>();
        Q.template rightCols<half>() = b.template topRightCorner<half, half>();
        M = a.template bottomRightCorner<half, half>() + b.template topLeftCorner<half, half>();
    }
};

/// The outer ends of two that share one: D - P M^-1 Q. What rounding changes in D, P, M and Q goes
/// on into it.
template <int N> Chain<N> joined(const Chain<N> &a, const Chain<N> &b) {
    constexpr int half = N / 2;
    const SharedEnd<std::complex<double>, N> value(a.values, b.values);
    const SharedEnd<double, N> size(a.sizes, b.sizes);
    const Eigen::Matrix<std::complex<double>, half, half> inverse = value.M.inverse();
    const Eigen::Matrix<std::complex<double>, half, N> Y = inverse * value.Q;
    const Eigen::Matrix<double, half, N> y = Y.cwiseAbs();
    const Eigen::Matrix<double, N, half> x = (value.P * inverse).cwiseAbs();
    Chain<N> out;
    out.values = value.D - value.P * Y;
    out.sizes = size.D + size.P * y + x * (size.Q + size.M * y);
    return out;
}

/// So many equal ones in a row.
template <int N> Chain<N> equal_chain(const Chain<N> &one, int count) {
    if (count == 1)
        return one;
    const Chain<N> half = equal_chain(one, count / 2);
    const Chain<N> both = joined(half, half);
    return count % 2 == 0 ? both : joined(both, one);
}

} // namespace whirl::forced
