#include "closed_form/arrangement_interval.h"

#include "arrangement_groups.h"

#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <complex>
#include <map>
#include <random>

namespace whirl::closed_form {

namespace {

using detail::GroupedPosition;

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

/// Largest value of sign * modulus over positions of at most four groups.
Candidate search_groups(const Target &target, double sign) {
    std::vector<Candidate> candidates;
    for (int groups = 2; groups <= std::min(4, target.balls); ++groups) {
        for (const auto &counts : detail::partitions(target.balls, groups)) {
            std::map<int, Candidate> best;
            detail::scan_balanced(counts, target.capacity,
                                  [&](const GroupedPosition &position, int sector) {
                                      const double value = sign * modulus(target, position);
                                      const auto found = best.find(sector);
                                      if (found == best.end() || value > found->second.value)
                                          best[sector] = {value, position};
                                  });
            for (const auto &[sector, candidate] : best)
                candidates.push_back(candidate);
        }
    }
    std::ranges::sort(candidates, std::greater{}, &Candidate::value);
    candidates.resize(std::min(candidates.size(), polished));
    for (Candidate &candidate : candidates) {
        detail::climb(candidate.position, target.capacity, [&](const GroupedPosition &position) {
            return sign * modulus(target, position);
        });
        candidate.value = sign * modulus(target, candidate.position);
    }
    return *std::ranges::max_element(candidates, {}, &Candidate::value);
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
    const Candidate largest = search_groups(target, 1.0);
    const Candidate least = search_groups(target, -1.0);
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
