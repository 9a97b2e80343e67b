#pragma once

#include "modes/following/symmetric_problem.h"

#include <Eigen/Core>

#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

namespace whirl::modes {

/// Vectors at one speed times the matrices, four at a time; where there are fewer the last one
/// stands in the other lanes too.
/// @param work  (i, products, lane): vector i is the one in that lane
template <class Work>
void multiply_each(const SymmetricProblem &problem, double speed,
                   const std::vector<const Eigen::VectorXcd *> &vectors, const Work &work) {
    linalg::Vector4 x;
    SymmetricProblem::Products of;
    for (std::size_t first = 0; first < vectors.size(); first += linalg::lanes) {
        std::array<const Eigen::VectorXcd *, linalg::lanes> four{};
        for (std::size_t lane = 0; lane < linalg::lanes; ++lane)
            four[lane] = vectors[std::min(first + lane, vectors.size() - 1)];
        linalg::set(x, four);
        problem.multiply(x, linalg::Real4{speed, speed, speed, speed}, of);
        for (std::size_t i = first; i < std::min(first + linalg::lanes, vectors.size()); ++i)
            work(i, of, static_cast<int>(i - first));
    }
}

} // namespace whirl::modes
