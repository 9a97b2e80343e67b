#include "linalg/dense/products.h"

namespace whirl::linalg {

using Eigen::MatrixXcd;
using Eigen::MatrixXd;
using Eigen::PartialPivLU;
using Eigen::VectorXcd;

MatrixXd times(const MatrixXd &A, const MatrixXd &B) { return A * B; }
MatrixXcd times(const MatrixXcd &A, const MatrixXcd &B) { return A * B; }
VectorXcd times(const MatrixXcd &A, const VectorXcd &x) { return A * x; }

MatrixXd transposed_times(const MatrixXd &A, const MatrixXd &B) { return A.transpose() * B; }
MatrixXcd transposed_times(const MatrixXcd &A, const MatrixXcd &B) { return A.transpose() * B; }
MatrixXcd adjoint_times(const MatrixXcd &A, const MatrixXcd &B) { return A.adjoint() * B; }

MatrixXd congruent(const MatrixXd &A, const MatrixXd &T) { return T.transpose() * times(A, T); }

MatrixXd solved(const PartialPivLU<MatrixXd> &A, const MatrixXd &B) { return A.solve(B); }
MatrixXcd solved(const PartialPivLU<MatrixXcd> &A, const MatrixXcd &B) { return A.solve(B); }
VectorXcd solved(const PartialPivLU<MatrixXcd> &A, const VectorXcd &b) { return A.solve(b); }
double reciprocal_condition(const PartialPivLU<MatrixXcd> &A) { return A.rcond(); }

} // namespace whirl::linalg
