#pragma once

// What nearly all sources use of templates: for the precompiled headers, in which it is
// instantiated once. Never called.

#include "model/case.h"

#include <Eigen/LU>
#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

namespace whirl::precompiled {

inline model::Case copied(model::Case &to, const model::Case &from) {
    to = from;
    model::Case out(from);
    out.rotor.balancers.push_back(from.rotor.balancers.front());
    out.rotor.bearings.push_back(from.rotor.bearings.front());
    out.rotor.discs.push_back(from.rotor.discs.front());
    std::swap(to, out);
    return out;
}

inline std::string printed(const std::string &text, double number, int count) {
    return fmt::format("{} {:.6g} {}", text, number, count);
}

inline std::vector<std::string> sorted(std::vector<std::string> list, std::vector<double> numbers,
                                       std::vector<int> counts) {
    std::sort(numbers.begin(), numbers.end());
    numbers.insert(numbers.end(), numbers.begin(), numbers.end());
    numbers.push_back(numbers.front());
    counts.push_back(counts.front());
    list.push_back(list.front());
    list.insert(list.end(), list.begin(), list.end());
    return list;
}

inline Eigen::MatrixXd solved(const Eigen::MatrixXd &A, const Eigen::MatrixXd &B) {
    Eigen::MatrixXd out = A.partialPivLu().solve(B);
    out = A * B;
    out += A.transpose() * B;
    return out;
}
inline Eigen::MatrixXcd solved(const Eigen::MatrixXcd &A, const Eigen::MatrixXcd &B) {
    Eigen::MatrixXcd out = A.partialPivLu().solve(B);
    out = A * B;
    out += A.adjoint() * B;
    return out;
}

} // namespace whirl::precompiled
