#include "arrangement_groups.h"

#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>

namespace whirl::closed_form::detail {

namespace {

using std::numbers::pi;
using Visitor = std::function<void(const GroupedPosition &, int)>;

constexpr int sectors = 12;

int total(const std::vector<int> &counts) {
    int sum = 0;
    for (const int count : counts)
        sum += count;
    return sum;
}

/// Puts the last two groups so that a exp(i alpha) + b exp(i beta) = target; both solutions are
/// visited.
void close_polygon(GroupedPosition &position, std::complex<double> target, int sector,
                   const Visitor &visit) {
    const std::size_t last = position.counts.size() - 1;
    const double a = position.counts[last - 1];
    const double b = position.counts[last];
    const double length = std::abs(target);
    // Arrangements on one line sit exactly on the limits: allow for rounding there.
    constexpr double allowance = 1e-12;
    if (length < allowance || length > (a + b) * (1.0 + allowance) ||
        length < std::abs(a - b) - allowance)
        return;
    const double cosine = (length * length + a * a - b * b) / (2.0 * length * a);
    const double opening = std::acos(std::clamp(cosine, -1.0, 1.0));
    for (const double side : {1.0, -1.0}) {
        position.angles[last - 1] = std::arg(target) + side * opening;
        const auto rest = target - std::polar(a, position.angles[last - 1]);
        position.angles[last] = std::arg(rest);
        visit(position, side > 0.0 ? sector : sector + sectors);
    }
}

/// Mean unit vector plus 1/E and its derivatives by the group angles.
struct BalanceEquations {
    Eigen::Vector2d residual;
    Eigen::MatrixXd jacobian;
};

BalanceEquations balance_equations(const GroupedPosition &position, double capacity) {
    const auto groups = static_cast<Eigen::Index>(position.counts.size());
    const double n = total(position.counts);
    BalanceEquations equations{Eigen::Vector2d(1.0 / capacity, 0.0), {}};
    equations.jacobian.resize(2, groups);
    for (Eigen::Index g = 0; g < groups; ++g) {
        const double weight = position.counts[g] / n;
        const double cosine = std::cos(position.angles[g]);
        const double sine = std::sin(position.angles[g]);
        equations.residual += weight * Eigen::Vector2d(cosine, sine);
        equations.jacobian.col(g) = weight * Eigen::Vector2d(-sine, cosine);
    }
    return equations;
}

void append_partitions(int rest, int parts, int largest, std::vector<int> &head,
                       std::vector<std::vector<int>> &all) {
    if (parts == 0) {
        if (rest == 0)
            all.push_back(head);
        return;
    }
    for (int count = std::min(largest, rest - parts + 1); count >= 1; --count) {
        head.push_back(count);
        append_partitions(rest - count, parts - 1, count, head, all);
        head.pop_back();
    }
}

} // namespace

std::vector<double> GroupedPosition::ball_angles() const {
    std::vector<double> all;
    for (std::size_t g = 0; g < counts.size(); ++g)
        all.insert(all.end(), counts[g], angles[g]);
    return all;
}

std::vector<std::vector<int>> partitions(int balls, int parts) {
    std::vector<std::vector<int>> all;
    std::vector<int> head;
    append_partitions(balls, parts, balls, head, all);
    return all;
}

void scan_balanced(const std::vector<int> &counts, double capacity, const Visitor &visit) {
    const std::complex<double> whole(-total(counts) / capacity, 0.0);
    GroupedPosition position{counts, std::vector<double>(counts.size())};
    if (counts.size() == 2) {
        close_polygon(position, whole, 0, visit);
        return;
    }
    // The first angle stays in the upper half plane: the rest are mirror images.
    const int first_steps = counts.size() == 3 ? 480 : 60;
    const int second_steps = counts.size() == 3 ? 1 : 120;
    for (int i = 0; i <= first_steps; ++i) {
        position.angles[0] = pi * i / first_steps;
        const auto rest = whole - std::polar<double>(counts[0], position.angles[0]);
        const int sector = std::min(sectors - 1, sectors * i / first_steps);
        for (int j = 0; j < second_steps; ++j) {
            if (counts.size() == 3) {
                close_polygon(position, rest, sector, visit);
                continue;
            }
            position.angles[1] = pi * (2.0 * j / second_steps - 1.0);
            close_polygon(position, rest - std::polar<double>(counts[1], position.angles[1]),
                          sector, visit);
        }
    }
}

bool restore_balance(GroupedPosition &position, double capacity) {
    for (int iteration = 0; iteration < 20; ++iteration) {
        const BalanceEquations equations = balance_equations(position, capacity);
        if (equations.residual.norm() < 1e-15)
            return true;
        const Eigen::VectorXd step =
            equations.jacobian.jacobiSvd(Eigen::ComputeThinU | Eigen::ComputeThinV)
                .solve(equations.residual);
        for (Eigen::Index g = 0; g < step.size(); ++g)
            position.angles[g] -= step[g];
    }
    return balance_equations(position, capacity).residual.norm() < 1e-13;
}

void climb(GroupedPosition &position, double capacity,
           const std::function<double(const GroupedPosition &)> &objective) {
    if (position.counts.size() < 3)
        return;
    double best = objective(position);
    double step = 0.05;
    for (int iteration = 0; iteration < 2000 && step > 1e-9; ++iteration) {
        const Eigen::MatrixXd jacobian = balance_equations(position, capacity).jacobian;
        const Eigen::JacobiSVD<Eigen::MatrixXd> svd(jacobian, Eigen::ComputeFullV);
        const auto directions = svd.matrixV().rightCols(jacobian.cols() - 2);
        bool improved = false;
        for (Eigen::Index d = 0; d < 2 * directions.cols() && !improved; ++d) {
            GroupedPosition trial = position;
            for (Eigen::Index g = 0; g < jacobian.cols(); ++g)
                trial.angles[g] += (d % 2 == 0 ? step : -step) * directions(g, d / 2);
            if (!restore_balance(trial, capacity))
                continue;
            const double value = objective(trial);
            if (value > best) {
                best = value;
                position = trial;
                improved = true;
            }
        }
        step *= improved ? 1.5 : 0.5;
    }
}

} // namespace whirl::closed_form::detail
