#pragma once

#include <Eigen/Core>

#include <vector>

namespace whirl::linalg {

/// y = A x for one small complex matrix and many x, real and imaginary parts apart: rows four at a
/// time in vector instructions.
class ComplexProduct {
  public:
    explicit ComplexProduct(const Eigen::MatrixXcd &A);

    /// Entries that hold so many numbers in whole vectors.
    [[nodiscard]] static Eigen::Index whole(Eigen::Index size);

    /// @param re,im          parts of x, a number a column
    /// @param out_re,out_im  parts of y, whole(rows) entries each: those beyond the rows are 0
    void operator()(const double *re, const double *im, double *out_re, double *out_im) const;

  private:
    Eigen::Index _rows, _columns;
    std::vector<double> _re, _im; ///< by columns, each filled up with zeros
};

} // namespace whirl::linalg
