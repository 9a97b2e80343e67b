#include "closed_form/arrangement_interval.h"

#include <Eigen/LU>
#include <Eigen/SVD>
#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <functional>
#include <map>
#include <numbers>
#include <random>
#include <utility>

namespace whirl::closed_form {

namespace {

using std::numbers::pi;

/// Balls in at most four groups, each of equal angles.
struct GroupedPosition {
    std::vector<int> counts;    ///< balls in each group
    std::vector<double> angles; ///< rad, one per group

    [[nodiscard]] std::vector<double> ball_angles() const {
        std::vector<double> all;
        for (std::size_t g = 0; g < counts.size(); ++g)
            all.insert(all.end(), counts[g], angles[g]);
        return all;
    }
};

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

/// Partitions of n into exactly `parts` positive counts, descending.
std::vector<std::vector<int>> partitions(int balls, int parts) {
    std::vector<std::vector<int>> all;
    std::vector<int> head;
    append_partitions(balls, parts, balls, head, all);
    return all;
}

/// Calls visit(position, sector) for balanced positions of the groups: all of them for two groups,
/// those on a grid of the free angles for three and four. Mirror images (all angles negated) are
/// left out. A sector collects neighbouring positions.
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

/// Of a symmetric matrix without negative eigenvalues: singular where all groups are on one line.
Eigen::Matrix2d pseudo_inverse(const Eigen::Matrix2d &A) {
    constexpr double singular = 1e-15; // of the product of eigenvalues as large as their sum
    const double trace = A.trace();
    return A.determinant() > singular * trace * trace ? Eigen::Matrix2d(A.inverse())
                                                      : Eigen::Matrix2d(A / (trace * trace));
}

/// Returns to balance by minimum-norm Newton steps on the group angles; false where that fails.
bool restore_balance(GroupedPosition &position, double capacity) {
    for (int iteration = 0; iteration < 20; ++iteration) {
        const BalanceEquations equations = balance_equations(position, capacity);
        if (equations.residual.norm() < 1e-15)
            return true;
        const Eigen::VectorXd step =
            equations.jacobian.transpose() *
            (pseudo_inverse(equations.jacobian * equations.jacobian.transpose()) *
             equations.residual);
        for (Eigen::Index g = 0; g < step.size(); ++g)
            position.angles[g] -= step[g];
    }
    return balance_equations(position, capacity).residual.norm() < 1e-13;
}

/// Climbs `objective` along the balanced positions of the same groups by a compass search in the
/// tangent space with shrinking steps, to steps of 1e-9 rad.
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

/// Grid points polished for either end, the best of each sector of each grouping first.
constexpr std::size_t polished = 24;

struct Target {
    int balls;
    double capacity;
    double constant;
    double factor;
};

double modulus(const Target &target, const GroupedPosition &position) {
    std::complex<double> sum = 0.0;
    double n = 0.0;
    for (std::size_t g = 0; g < position.counts.size(); ++g) {
        sum += std::polar<double>(position.counts[g], 2.0 * position.angles[g]);
        n += position.counts[g];
    }
    return std::abs(target.constant + target.factor * sum / n);
}

struct Candidate {
    double value;
    GroupedPosition position;
};

/// The best of some positions for the largest value of sign * modulus, polished.
Candidate polished_best(std::vector<Candidate> candidates, const Target &target, double sign) {
    std::ranges::sort(candidates, std::greater{}, &Candidate::value);
    candidates.resize(std::min(candidates.size(), polished));
    for (Candidate &candidate : candidates) {
        climb(candidate.position, target.capacity,
              [&](const GroupedPosition &position) { return sign * modulus(target, position); });
        candidate.value = sign * modulus(target, candidate.position);
    }
    return *std::ranges::max_element(candidates, {}, &Candidate::value);
}

/// Largest values of modulus and of -modulus over positions of at most four groups.
std::array<Candidate, 2> search_groups(const Target &target) {
    constexpr std::array signs{1.0, -1.0};
    std::array<std::vector<Candidate>, 2> candidates;
    for (int groups = 2; groups <= std::min(4, target.balls); ++groups) {
        for (const auto &counts : partitions(target.balls, groups)) {
            std::array<std::map<int, Candidate>, 2> best;
            scan_balanced(counts, target.capacity,
                          [&](const GroupedPosition &position, int sector) {
                              const double size = modulus(target, position);
                              for (std::size_t k = 0; k < signs.size(); ++k) {
                                  const double value = signs[k] * size;
                                  const auto known = best[k].find(sector);
                                  if (known == best[k].end() || value > known->second.value)
                                      best[k][sector] = {value, position};
                              }
                          });
            for (std::size_t k = 0; k < signs.size(); ++k)
                for (const auto &[sector, candidate] : best[k])
                    candidates[k].push_back(candidate);
        }
    }
    return {polished_best(std::move(candidates[0]), target, signs[0]),
            polished_best(std::move(candidates[1]), target, signs[1])};
}

/// Newton's method (minimum norm) for a balanced position with constant + factor * D = 0, from
/// `angles`.
bool find_zero(const Target &target, std::vector<double> &angles) {
    const auto n = static_cast<Eigen::Index>(angles.size());
    const double weight = 1.0 / target.balls;
    const double wanted = target.constant / target.factor;
    for (int iteration = 0; iteration < 60; ++iteration) {
        Eigen::VectorXd residual = Eigen::Vector4d(1.0 / target.capacity, 0.0, wanted, 0.0);
        Eigen::MatrixXd jacobian(4, n);
        for (Eigen::Index j = 0; j < n; ++j) {
            const double c1 = weight * std::cos(angles[j]);
            const double s1 = weight * std::sin(angles[j]);
            const double c2 = weight * std::cos(2.0 * angles[j]);
            const double s2 = weight * std::sin(2.0 * angles[j]);
            residual += Eigen::Vector4d(c1, s1, c2, s2);
            jacobian.col(j) = Eigen::Vector4d(-s1, c1, -2.0 * s2, 2.0 * c2);
        }
        if (residual.norm() < 1e-13)
            return true;
        Eigen::VectorXd step =
            jacobian.jacobiSvd(Eigen::ComputeThinU | Eigen::ComputeThinV).solve(residual);
        step *= std::min(1.0, 0.5 / step.norm());
        for (Eigen::Index j = 0; j < n; ++j)
            angles[j] -= step[j];
    }
    return false;
}

/// Seeks a position of zero modulus from `start`, from points near it and from random ones.
std::optional<std::vector<double>> search_zero(const Target &target,
                                               const std::vector<double> &start) {
    if (std::abs(target.factor) < std::abs(target.constant))
        return std::nullopt;
    std::mt19937 generator(20);
    std::normal_distribution<double> normal;
    for (int attempt = 0; attempt < 60; ++attempt) {
        std::vector<double> angles = start;
        const double spread = attempt == 0 ? 0.0 : attempt < 20 ? 0.05 : attempt < 40 ? 0.3 : 3.0;
        for (double &angle : angles)
            angle += spread * normal(generator);
        if (find_zero(target, angles))
            return angles;
    }
    return std::nullopt;
}

} // namespace

std::optional<ArrangementInterval> modulus_interval(int balls, double capacity, double constant,
                                                    double factor) {
    if (balls < 2 || !(capacity >= 1.0))
        return std::nullopt;
    const Target target{balls, capacity, constant, factor};
    const auto [largest, least] = search_groups(target);
    ArrangementInterval interval{-least.value, largest.value, least.position.ball_angles(),
                                 largest.position.ball_angles()};
    if (factor != 0.0) {
        if (const auto zero = search_zero(target, interval.least_position)) {
            interval.least = 0.0;
            interval.least_position = *zero;
        }
    }
    return interval;
}

} // namespace whirl::closed_form
