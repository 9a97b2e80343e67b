// Cholesky factors and copies of sparse matrices, compiled once: see instances.h.

#define WHIRL_EIGEN_INSTANCES
#include "eigen/instances.h"

WHIRL_EIGEN_KERNELS(extern template);
WHIRL_EIGEN_SPARSE_CHOLESKY(template);
WHIRL_EIGEN_SPARSE_COPIES(template);
