// Factors of sparse matrices, compiled once: see instances.h.

#define WHIRL_EIGEN_INSTANCES
#include "eigen/instances.h"

WHIRL_EIGEN_SPARSE_LU(template, whirl::eigen::SparseReal);
WHIRL_EIGEN_SPARSE_LU(template, whirl::eigen::SparseComplex);
WHIRL_EIGEN_SPARSE_CHOLESKY(template);
