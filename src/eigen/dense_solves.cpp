// Linear systems with full matrices and singular values, compiled once: see instances.h.

#define WHIRL_EIGEN_INSTANCES
#include "eigen/instances.h"

WHIRL_EIGEN_KERNELS(extern template);
WHIRL_EIGEN_SOLVES(template, Eigen::MatrixXd);
WHIRL_EIGEN_SOLVES(template, Eigen::MatrixXcd);
WHIRL_EIGEN_LEAST_SQUARES(template, Eigen::MatrixXcd);
WHIRL_EIGEN_SINGULAR(template);
