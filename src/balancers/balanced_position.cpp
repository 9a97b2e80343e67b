#include "balancers/balanced_position.h"

#include "closed_form/arrangement_interval.h"
#include "closed_form/balanced_position.h"
#include "model/errors.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace whirl::balancers {

namespace {

using std::numbers::pi;

/// E = 1 is a product of inputs with nine digits or more.
constexpr double capacity_rounding = 1e-9;

bool has_balanced_position(const model::Balancer &balancer) {
    const double E = capacity(balancer);
    if (balancer.kind != model::BalancerKind::ball)
        return false;
    return balancer.n == 1 ? std::abs(E - 1) <= capacity_rounding : E >= 1 - capacity_rounding;
}

/// Capacity of a balancer that has a balanced position: rounding below 1 removed.
double sound_capacity(const model::Balancer &balancer) { return std::max(1.0, capacity(balancer)); }

/// Regular polygon with a side symmetric about angle 0: two balls at +-pi/2, the limit of their
/// position as E grows.
std::vector<double> regular_polygon(int balls) {
    std::vector<double> angles;
    for (int j = 0; j < balls; ++j)
        angles.push_back(pi * (2 * j + 1) / balls);
    return angles;
}

/// Minimum-norm Newton steps back to balance from a position that misses it slightly.
void restore_balance(std::vector<double> &angles, double capacity) {
    const auto n = static_cast<double>(angles.size());
    for (int iteration = 0; iteration < 20; ++iteration) {
        std::complex<double> defect = 1 / capacity;
        double cc = 0;
        double ss = 0;
        double cs = 0;
        for (const double a : angles) {
            defect += std::polar(1 / n, a);
            cc += std::cos(a) * std::cos(a) / (n * n);
            ss += std::sin(a) * std::sin(a) / (n * n);
            cs += std::cos(a) * std::sin(a) / (n * n);
        }
        const double determinant = cc * ss - cs * cs;
        if (std::abs(defect) < 1e-15 || determinant <= 0)
            return;
        // Jacobian rows (-sin a_j, cos a_j)/n: solve J J^T y = defect, step J^T y.
        const double y1 = (cc * defect.real() + cs * defect.imag()) / determinant;
        const double y2 = (ss * defect.imag() + cs * defect.real()) / determinant;
        for (double &a : angles)
            a -= (-std::sin(a) * y1 + std::cos(a) * y2) / n;
    }
}

/// Interval of |constant + factor D|.
std::optional<PositionInterval> interval_of(const model::Balancer &balancer, double constant,
                                            double factor) {
    if (!has_balanced_position(balancer) || balancer.n > largest_searched_count)
        return std::nullopt;
    const double E = sound_capacity(balancer);
    const auto value = [&](const std::vector<double> &angles) {
        return std::abs(constant + factor * closed_form::second_harmonic(angles));
    };
    if (balancer.n <= 2) {
        const auto angles = ball_angles_at_balance(balancer, "balancer");
        return PositionInterval{value(angles), value(angles), angles, angles};
    }
    // The search divides by n/E: a family without imbalance is reached from one with next to none.
    constexpr double almost_infinite = 1e9;
    const auto found =
        closed_form::modulus_interval(balancer.n, std::min(E, almost_infinite), constant, factor);
    if (!found)
        return std::nullopt;
    PositionInterval interval{found->least, found->largest, found->least_position,
                              found->largest_position};
    if (E > almost_infinite) {
        interval.least_position = regular_polygon(balancer.n); // D = 0, and A_m0 next to nothing
        restore_balance(interval.least_position, E);
        restore_balance(interval.largest_position, E);
        interval.least = value(interval.least_position);
        interval.largest = value(interval.largest_position);
    }
    return interval;
}

/// Step of the additive recurrence x_k = frac(i g^-k), k = 1..dimension, with g the root above 1
/// of g^(dimension + 1) = g + 1 (M. Roberts' generalisation of the golden ratio): even also in
/// many dimensions, where a Halton sequence of few points is a set of straight lines.
double recurrence_root(std::size_t dimension) {
    double g = 1.5;
    for (int iteration = 0; iteration < 60; ++iteration)
        g = std::pow(1 + g, 1 / (static_cast<double>(dimension) + 1));
    return g;
}

/// The index-th point of the family, index >= 1: every ball takes an angle that leaves a sum which
/// the remaining ones can close, the last two close it.
std::vector<double> position_of_family(int balls, double capacity, int index) {
    std::vector<double> angles;
    const auto free = static_cast<std::size_t>(balls) - 2;
    const double g = recurrence_root(free);
    std::complex<double> rest = -balls / capacity;
    double step = 1;
    for (std::size_t j = 0; j < free; ++j) {
        step /= g;
        const double share = 0.5 + index * step - std::floor(0.5 + index * step);
        const auto others = static_cast<double>(balls) - static_cast<double>(j) - 1;
        const double length = std::abs(rest);
        // |rest - exp(i a)| <= others
        const double cosine =
            length > 0 ? (length * length + 1 - others * others) / (2 * length) : -1;
        const double widest = std::acos(std::clamp(cosine, -1.0, 1.0));
        angles.push_back(std::arg(rest) + (2 * share - 1) * widest);
        rest -= std::polar(1.0, angles.back());
    }
    const double opening = std::acos(std::min(1.0, std::abs(rest) / 2));
    angles.push_back(std::arg(rest) + opening);
    angles.push_back(std::arg(rest) - opening);
    return angles;
}

} // namespace

double capacity(const model::Balancer &balancer) {
    if (balancer.imbalance == 0)
        return std::numeric_limits<double>::infinity();
    if (balancer.kind == model::BalancerKind::pendulum4)
        return 2 * balancer.mass * balancer.arm / balancer.imbalance;
    return closed_form::capacity(balancer.n, balancer.mass, balancer.radius, balancer.imbalance);
}

std::vector<double> ball_angles_at_balance(const model::Balancer &balancer,
                                           const std::string &label) {
    if (balancer.kind != model::BalancerKind::ball)
        throw model::BadInput(label + ".kind: expected \"ball\" for a balanced position of balls, "
                                      "got \"pendulum4\"");
    const double E = capacity(balancer);
    if (!has_balanced_position(balancer))
        throw model::BadInput(
            balancer.n == 1 ? fmt::format("{}: expected a capacity E = m R/(m0 R0) of 1 for a "
                                          "balanced position of one ball, got {:.10g}",
                                          label, E)
                            : fmt::format("{}: expected a capacity E = n m R/(m0 R0) of at least "
                                          "1 for a balanced position, got {:.10g}",
                                          label, E));
    if (!balancer.position.empty())
        return turned(balancer.position, -balancer.imbalance_phase);
    if (balancer.n == 1)
        return {pi};
    if (std::isinf(E))
        return regular_polygon(balancer.n);
    return closed_form::symmetric_position(balancer.n, sound_capacity(balancer)).value();
}

std::vector<double> turned(std::vector<double> angles, double by) {
    if (by != 0)
        for (double &angle : angles)
            angle += by;
    return angles;
}

std::complex<double> second_harmonic_of(const std::vector<double> &angles) {
    return closed_form::second_harmonic(angles);
}

AddedInertias added_inertias(const model::Balancer &balancer) {
    if (!balancer.tilt_inertia)
        return {};
    const double R = balancer.kind == model::BalancerKind::ball ? balancer.radius
                                                                : balancer.pivot + balancer.arm;
    return {balancer.n * balancer.mass * R * R,
            balancer.imbalance * balancer.imbalance_radius.value_or(0)};
}

std::optional<PositionInterval> second_harmonic_interval(const model::Balancer &balancer) {
    return interval_of(balancer, 0, 1);
}

std::optional<PositionInterval> anisotropy_interval(const model::Balancer &balancer) {
    const AddedInertias inertias = added_inertias(balancer);
    return interval_of(balancer, inertias.imbalance / 2, inertias.balls / 2);
}

std::vector<std::vector<double>> sampled_positions(const model::Balancer &balancer, int count,
                                                   const std::string &label) {
    std::vector<std::vector<double>> positions{ball_angles_at_balance(balancer, label)};
    const double E = sound_capacity(balancer);
    if (balancer.n <= 2 || E - 1 <= capacity_rounding)
        return positions;
    std::vector<std::complex<double>> harmonics{second_harmonic_of(positions.front())};
    const auto add = [&](const std::vector<double> &angles) {
        const auto D = second_harmonic_of(angles);
        const bool known = std::any_of(harmonics.begin(), harmonics.end(), [&](const auto &other) {
            return std::abs(other - D) < 1e-9;
        });
        if (known || std::ssize(positions) >= count)
            return;
        positions.push_back(angles);
        harmonics.push_back(D);
    };
    if (const auto interval = anisotropy_interval(balancer)) {
        add(interval->least_position);
        add(interval->largest_position);
    }
    // Without imbalance three balls have one position only: a bound on the tries ends the search.
    for (int index = 1; index <= 4 * count && std::ssize(positions) < count; ++index)
        add(position_of_family(balancer.n, E, index));
    return positions;
}

} // namespace whirl::balancers
