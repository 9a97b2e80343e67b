// Eigenvalues of full matrices, compiled once: see instances.h.

#define WHIRL_EIGEN_INSTANCES
#include "eigen/instances.h"

WHIRL_EIGEN_KERNELS(extern template);
WHIRL_EIGEN_SYMMETRIC(template, Eigen::MatrixXd);
WHIRL_EIGEN_SYMMETRIC(template, Eigen::MatrixXcd);
WHIRL_EIGEN_SYMMETRIC_PAIR(template, Eigen::MatrixXcd);
WHIRL_EIGEN_GENERAL(template);
