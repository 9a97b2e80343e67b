#include "modes/following/unmixed.h"

#include "linalg/dense/products.h"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>

#include <algorithm>

namespace whirl::modes {

namespace {

using Complex = std::complex<double>;
using Group = std::vector<std::size_t>;

} // namespace

std::vector<Group> close_groups(const std::vector<SymmetricPair> &pairs) {
    constexpr double close = 0.03;
    // A part e of one another in their vectors moves values by e^2 of their distance: so many
    // doubts apart these parts are small.
    constexpr double clear = 1e6;
    std::vector<bool> taken(pairs.size(), false);
    std::vector<Group> out;
    for (std::size_t i = 0; i < pairs.size(); ++i) {
        if (taken[i])
            continue;
        Group group{i};
        for (std::size_t k = 0; k < group.size(); ++k) {
            const Complex value = pairs[group[k]].value;
            for (std::size_t j = i + 1; j < pairs.size(); ++j)
                if (const double within =
                        std::min(close, clear * (pairs[group[k]].doubt + pairs[j].doubt));
                    !taken[j] &&
                    std::norm(pairs[j].value - value) < within * within * std::norm(value)) {
                    taken[j] = true;
                    group.push_back(j);
                }
        }
        if (group.size() > 1)
            out.push_back(std::move(group));
    }
    return out;
}

namespace {

/// For each row the column it has its largest entry in, each column once.
std::vector<Eigen::Index> columns_by_rows(Eigen::MatrixXd sizes) {
    std::vector<Eigen::Index> out(static_cast<std::size_t>(sizes.rows()));
    for (Eigen::Index k = 0; k < sizes.rows(); ++k) {
        Eigen::Index row = 0;
        Eigen::Index column = 0;
        sizes.maxCoeff(&row, &column);
        out[static_cast<std::size_t>(row)] = column;
        sizes.row(row).setConstant(-1);
        sizes.col(column).setConstant(-1);
    }
    return out;
}

/// Q(l) on the span of vectors.
struct Span {
    Eigen::MatrixXcd Y, M, D, K;
};

Span span_of(const SymmetricProblem &problem, double speed, const std::vector<SymmetricPair> &pairs,
             const Group &group) {
    Span out{Eigen::MatrixXcd(problem.size(), std::ssize(group)), {}, {}, {}};
    for (std::size_t k = 0; k < group.size(); ++k)
        out.Y.col(static_cast<Eigen::Index>(k)) = pairs[group[k]].vector;
    const SymmetricProblem::ColumnProducts of = problem.products(speed, out.Y);
    const Eigen::VectorXd scales = out.Y.colwise().norm().cwiseInverse();
    out.Y *= scales.asDiagonal();
    out.M = linalg::transposed_times(out.Y, of.M) * scales.asDiagonal();
    out.D = linalg::transposed_times(out.Y, of.D) * scales.asDiagonal();
    out.K = linalg::transposed_times(out.Y, of.K) * scales.asDiagonal();
    return out;
}

/// The problem on the span of a group, linear in the distance from the mean of the values.
/// @returns false where it cannot be solved
bool unmix(const Span &span, const Group &group, std::vector<SymmetricPair> &pairs) {
    Complex mean = 0;
    for (const std::size_t i : group)
        mean += pairs[i].value / static_cast<double>(group.size());
    const Eigen::MatrixXcd there = mean * mean * span.M + mean * span.D + span.K;
    const Eigen::PartialPivLU<Eigen::MatrixXcd> slope(2.0 * mean * span.M + span.D);
    const Eigen::MatrixXcd moves = -linalg::solved(slope, there);
    const Eigen::ComplexEigenSolver<Eigen::MatrixXcd> solver(moves);
    if (solver.info() != Eigen::Success || !solver.eigenvectors().allFinite())
        return false;
    const std::vector<Eigen::Index> mine = columns_by_rows(solver.eigenvectors().cwiseAbs());
    for (std::size_t k = 0; k < group.size(); ++k) {
        SymmetricPair &pair = pairs[group[k]];
        if (pair.refined)
            continue;
        // Its own guess goes into it as it is: the sign is carried on by it.
        const auto mixture = solver.eigenvectors().col(mine[k]);
        const Complex own = mixture(static_cast<Eigen::Index>(k));
        const Eigen::VectorXcd shares = mixture * (std::conj(own) / std::abs(own));
        pair.vector = linalg::times(span.Y, shares);
        pair.value = mean + solver.eigenvalues()(mine[k]);
    }
    return true;
}

} // namespace

std::vector<bool> unmix(const SymmetricProblem &problem, double speed,
                        std::vector<SymmetricPair> &pairs) {
    std::vector<bool> grouped(pairs.size(), false);
    for (const Group &group : close_groups(pairs)) {
        const bool known = std::all_of(group.begin(), group.end(),
                                       [&](std::size_t i) { return pairs[i].refined; });
        if (!known && unmix(span_of(problem, speed, pairs, group), group, pairs))
            for (const std::size_t i : group)
                grouped[i] = true;
    }
    return grouped;
}

} // namespace whirl::modes
