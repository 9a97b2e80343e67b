#include "balancers/balance_family.h"

#include "closed_form/balanced_position.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <functional>
#include <limits>
#include <numbers>
#include <numeric>
#include <optional>

namespace whirl::balancers {

namespace {

using Complex = std::complex<double>;

/// A polygon that closes but for the rounding of inputs with nine digits or more.
constexpr double input_rounding = 1e-9;

/// Step of the additive recurrence x_k = frac(i g^-k), k = 1..dimension, with g the root above 1
/// of g^(dimension + 1) = g + 1 (M. Roberts' generalisation of the golden ratio): even also in
/// many dimensions, where a Halton sequence of few points is a set of straight lines.
double recurrence_root(std::size_t dimension) {
    double g = 1.5;
    for (int iteration = 0; iteration < 60; ++iteration)
        g = std::pow(1 + g, 1 / (static_cast<double>(dimension) + 1));
    return g;
}

/// Angle between the sides `along` and `other` of a triangle whose third side is `across`.
double corner(double along, double other, double across) {
    const double product = 2 * along * other;
    if (!(product > 0))
        return std::numbers::pi / 2;
    const double cosine = (along * along + other * other - across * across) / product;
    return std::acos(std::clamp(cosine, -1.0, 1.0));
}

std::vector<std::size_t> heaviest_first(const std::vector<CircledMass> &masses) {
    std::vector<std::size_t> order(masses.size());
    std::iota(order.begin(), order.end(), 0);
    std::ranges::stable_sort(order, std::greater{},
                             [&](std::size_t i) { return masses[i].moment; });
    return order;
}

/// Distances from 0 that masses can reach together, the first of them the heaviest.
std::pair<double, double> reach_of(const std::vector<CircledMass> &masses,
                                   const std::vector<std::size_t> &order, std::size_t first) {
    double sum = 0;
    for (std::size_t k = first; k < order.size(); ++k)
        sum += masses[order[k]].moment;
    return {std::max(0.0, 2 * masses[order[first]].moment - sum), sum};
}

double sum_of_moments(const std::vector<CircledMass> &masses) {
    double sum = 0;
    for (const CircledMass &mass : masses)
        sum += mass.moment;
    return sum;
}

/// d sum/d a_j = i m_j R_j exp(i a_j), times a plane vector.
std::vector<double> along(const std::vector<CircledMass> &masses, const std::vector<double> &angles,
                          Complex y) {
    std::vector<double> out;
    for (std::size_t j = 0; j < masses.size(); ++j)
        out.push_back(masses[j].moment *
                      (std::cos(angles[j]) * y.imag() - std::sin(angles[j]) * y.real()));
    return out;
}

/// y with J J^T y = b, J the derivative of the sum; none where it is singular.
std::optional<Complex> normal_equation(const std::vector<CircledMass> &masses,
                                       const std::vector<double> &angles, Complex b) {
    double cc = 0;
    double ss = 0;
    double cs = 0;
    for (std::size_t j = 0; j < masses.size(); ++j) {
        const Complex side = std::polar(masses[j].moment, angles[j]);
        cc += side.real() * side.real();
        ss += side.imag() * side.imag();
        cs += side.real() * side.imag();
    }
    const double determinant = cc * ss - cs * cs;
    if (!(determinant > 0))
        return std::nullopt;
    return Complex((cc * b.real() + cs * b.imag()) / determinant,
                   (ss * b.imag() + cs * b.real()) / determinant);
}

/// Half the square of the modulus and its slope along the family.
struct Height {
    double value = 0;
    std::vector<double> slope;
};

class Climb {
  public:
    Climb(const std::vector<CircledMass> &masses, double imbalance, double constant,
          const std::vector<double> &factors, double sign)
        : _masses(masses), _factors(factors), _imbalance(imbalance), _constant(constant),
          _sign(sign) {}

    [[nodiscard]] Height at(const std::vector<double> &angles) const {
        Complex value = _constant;
        for (std::size_t j = 0; j < angles.size(); ++j)
            value += _factors[j] * std::polar(1.0, 2 * angles[j]);
        Height out;
        out.value = _sign * std::norm(value) / 2;
        Complex projected = 0; // J times the slope
        for (std::size_t j = 0; j < angles.size(); ++j) {
            const Complex turned = Complex(0, 2) * _factors[j] * std::polar(1.0, 2 * angles[j]);
            out.slope.push_back(_sign * (std::conj(value) * turned).real());
            projected +=
                Complex(0, 1) * std::polar(_masses[j].moment, angles[j]) * out.slope.back();
        }
        if (const auto y = normal_equation(_masses, angles, projected)) {
            const std::vector<double> normal = along(_masses, angles, *y);
            for (std::size_t j = 0; j < angles.size(); ++j)
                out.slope[j] -= normal[j];
        }
        return out;
    }

    /// Down to where it is level, steps by Barzilai and Borwein, halved where they climb.
    [[nodiscard]] double descend(std::vector<double> &angles) const {
        Height here = at(angles);
        double steepest = 0;
        for (const double slope : here.slope)
            steepest = std::max(steepest, std::abs(slope));
        double step = steepest > 0 ? 0.1 / steepest : 0; // rad
        for (int iteration = 0; iteration < 300 && step > 0; ++iteration) {
            std::vector<double> there = angles;
            for (std::size_t j = 0; j < there.size(); ++j)
                there[j] -= step * here.slope[j];
            restore_balance(_masses, _imbalance, there);
            const Height next = at(there);
            if (!(next.value < here.value)) {
                step /= 4;
                if (step * steepest < 1e-12)
                    break;
                continue;
            }
            double change = 0;
            double bend = 0;
            for (std::size_t j = 0; j < there.size(); ++j) {
                change += (there[j] - angles[j]) * (there[j] - angles[j]);
                bend += (there[j] - angles[j]) * (next.slope[j] - here.slope[j]);
            }
            step = bend > 0 ? change / bend : 2 * step;
            angles = std::move(there);
            here = next;
        }
        return here.value;
    }

  private:
    const std::vector<CircledMass> &_masses;
    const std::vector<double> &_factors;
    double _imbalance, _constant, _sign;
};

} // namespace

std::vector<double> symmetric_position(int masses, double capacity) {
    using std::numbers::pi;
    if (std::isinf(capacity)) {
        // Two masses at +-pi/2, the limit of their position as E grows.
        std::vector<double> polygon;
        for (int j = 0; j < masses; ++j)
            polygon.push_back(pi * (2 * j + 1) / masses);
        return polygon;
    }
    if (masses == 1)
        return {pi};
    return closed_form::symmetric_position(masses, capacity).value();
}

std::complex<double> defect_of(const std::vector<CircledMass> &masses, double imbalance,
                               const std::vector<double> &angles) {
    Complex sum = imbalance;
    for (std::size_t j = 0; j < masses.size(); ++j)
        sum += std::polar(masses[j].moment, angles[j]);
    return sum;
}

bool balance_exists(const std::vector<CircledMass> &masses, double imbalance) {
    double longest = imbalance;
    for (const CircledMass &mass : masses)
        longest = std::max(longest, mass.moment);
    const double all = imbalance + sum_of_moments(masses);
    return !masses.empty() && longest * (1 - input_rounding) <= all - longest;
}

std::vector<double> position_of_family(const std::vector<CircledMass> &masses, double imbalance,
                                       int index) {
    const std::vector<std::size_t> order = heaviest_first(masses);
    std::vector<double> angles(masses.size(), std::numbers::pi);
    if (masses.size() == 1)
        return angles;
    const std::size_t free = masses.size() - 2;
    const double g = recurrence_root(free);
    Complex rest = -imbalance;
    double step = 1;
    for (std::size_t j = 0; j < free; ++j) {
        step /= g;
        const double own = masses[order[j]].moment;
        const double place = 2 * (0.5 + index * step - std::floor(0.5 + index * step)) - 1;
        const auto [least, largest] = reach_of(masses, order, j + 1);
        const double length = std::abs(rest);
        // least <= |rest - own exp(i a)| <= largest
        const double narrowest = length > 0 && least > 0 ? corner(length, own, least) : 0;
        const double widest = length > 0 ? corner(length, own, largest) : std::numbers::pi;
        const double off = std::copysign(narrowest + std::abs(place) * (widest - narrowest), place);
        angles[order[j]] = std::arg(rest) + off;
        rest -= std::polar(own, angles[order[j]]);
    }
    const double a = masses[order[free]].moment;
    const double b = masses[order[free + 1]].moment;
    angles[order[free]] = std::arg(rest) + corner(std::abs(rest), a, b);
    angles[order[free + 1]] = std::arg(rest) - corner(std::abs(rest), b, a);
    return angles;
}

void restore_balance(const std::vector<CircledMass> &masses, double imbalance,
                     std::vector<double> &angles) {
    const double size = sum_of_moments(masses);
    for (int iteration = 0; iteration < 20; ++iteration) {
        const Complex defect = defect_of(masses, imbalance, angles);
        if (std::abs(defect) < 1e-15 * size)
            return;
        const auto y = normal_equation(masses, angles, defect);
        if (!y)
            return;
        const std::vector<double> step = along(masses, angles, *y);
        for (std::size_t j = 0; j < angles.size(); ++j)
            angles[j] -= step[j];
    }
}

std::vector<double> extreme_beside(const std::vector<CircledMass> &masses, double imbalance,
                                   const std::vector<double> &factors, double sign,
                                   std::vector<double> angles) {
    static_cast<void>(Climb(masses, imbalance, 0, factors, sign).descend(angles));
    return angles;
}

std::vector<double> extreme_position(const std::vector<CircledMass> &masses, double imbalance,
                                     double constant, const std::vector<double> &factors,
                                     double sign) {
    constexpr int starts = 64;
    const Climb climb(masses, imbalance, constant, factors, sign);
    std::vector<double> best;
    double lowest = std::numeric_limits<double>::infinity();
    for (int index = 0; index < starts; ++index) {
        std::vector<double> angles = position_of_family(masses, imbalance, index);
        const double value = climb.descend(angles);
        if (best.empty() || value < lowest)
            best = std::move(angles);
        lowest = std::min(lowest, value);
    }
    return best;
}

} // namespace whirl::balancers
