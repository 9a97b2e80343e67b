#pragma once

#include <Eigen/Core>

#include <vector>

namespace whirl::linalg {

/// Entries that hold so many numbers in whole vectors of the machine.
[[nodiscard]] Eigen::Index whole_vectors(Eigen::Index size);

// y = A x for one small matrix and many x: rows four at a time in vector instructions. Outputs have
// whole_vectors(rows) entries; those beyond the rows are 0.

class RealProduct {
  public:
    RealProduct() = default;
    explicit RealProduct(const Eigen::MatrixXd &A);

    void operator()(const double *x, double *out) const;

  private:
    Eigen::Index _rows = 0, _columns = 0;
    std::vector<double> _A; ///< by columns, each filled up with zeros
};

} // namespace whirl::linalg
