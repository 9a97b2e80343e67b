// Inner loops of products and triangular solves, compiled once: see kernels.h.

#define WHIRL_EIGEN_INSTANCES
#include "eigen/kernels.h"

WHIRL_EIGEN_KERNELS(template);
