#pragma once

// What most rooms that compute include: see case.h.

#include "assembly/discretization.h"
#include "assembly/planes.h"
#include "assembly/system.h"
#include "balancers/linear_element.h"
#include "precompiled/case.h"

#include <Eigen/Core>
#include <Eigen/SparseCore>

#include <complex>
#include <memory>

namespace whirl::precompiled {

inline Eigen::SparseMatrix<std::complex<double>>
turned(const Eigen::SparseMatrix<std::complex<double>> &A) {
    Eigen::SparseMatrix<std::complex<double>> out = A.adjoint();
    return out;
}

} // namespace whirl::precompiled
