#pragma once

#include "linalg/lanes/complex4.h"

#include <Eigen/Core>

#include <array>
#include <complex>
#include <vector>

namespace whirl::linalg {

// Of complex vectors of one size, two entries in one instruction.

/// a^H b
[[nodiscard]] std::complex<double> dot(const Eigen::Ref<const Eigen::VectorXcd> &a,
                                       const Eigen::Ref<const Eigen::VectorXcd> &b);

/// Column i of A times column j of B, of one length, not conjugated.
[[nodiscard]] std::complex<double> product_of_columns(const Eigen::MatrixXcd &A, Eigen::Index i,
                                                      const Eigen::MatrixXcd &B, Eigen::Index j);

/// y += f x
void add_multiple(std::complex<double> f, const Eigen::VectorXcd &x, Eigen::VectorXcd &y);

/// A vector times a real number.
struct RealMultiple {
    double f;
    const Eigen::VectorXcd *x;
};
/// Of at least one.
[[nodiscard]] Eigen::VectorXcd sum_of(const std::vector<RealMultiple> &terms);

/// The vectors, each times a number.
[[nodiscard]] std::array<Eigen::VectorXcd, lanes> vectors_of(const Vector4 &four,
                                                             const Complex4 &factors);

} // namespace whirl::linalg
