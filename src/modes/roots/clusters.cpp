#include "modes/roots/clusters.h"

#include <algorithm>
#include <cmath>

namespace whirl::modes {

namespace {

using Value = std::complex<double>;
using Coefficients = Eigen::VectorXcd; ///< of powers 0, 1, ...

Value mean(const Cluster &roots, Value Root::*of) {
    Value sum = 0;
    for (const Root *root : roots)
        sum += root->*of;
    return sum / static_cast<double>(roots.size());
}

/// Largest distance from the mean, and how far it comes over a change of the speed by the rates: of
/// two real roots that met a little before and part again it is largest between.
double radius(const Cluster &roots, double change = 0) {
    const Value centre = mean(roots, &Root::value);
    const Value rate = mean(roots, &Root::rate);
    double out = 0;
    for (const Root *root : roots)
        out = std::max(out, std::abs(root->value - centre) +
                                std::abs(change) * std::abs(root->rate - rate));
    return out;
}

std::ptrdiff_t growing(const Cluster &roots) {
    return std::ranges::count_if(roots, [](const Root *r) { return r->sign() > 0; });
}

bool known(const Cluster &roots) {
    return std::ranges::all_of(roots, [](const Root *r) { return r->sign() != 0; });
}

/// A root at one end of a step, as the polynomial takes it.
struct Place {
    Value at, change;
    double noise = 0;
};

/// The monic polynomial with all of these roots but one.
Coefficients product_without(const std::vector<Place> &places, const Place *one) {
    Coefficients out = Coefficients::Zero(std::ssize(places) + 1);
    out(0) = 1;
    Eigen::Index degree = 0;
    for (const Place &place : places) {
        if (&place == one)
            continue;
        ++degree;
        for (Eigen::Index k = degree; k > 0; --k)
            out(k) = out(k - 1) - place.at * out(k);
        out(0) *= -place.at;
    }
    return out;
}

/// The monic polynomial with these roots at one end of a step, its change over the step by its
/// rate, and its rounding.
struct PolynomialEnd {
    Coefficients value, change;
    Eigen::VectorXd noise;

    /// @param at  the roots, their changes over the step and what rounding leaves open of them
    explicit PolynomialEnd(const std::vector<Place> &at)
        : value(product_without(at, nullptr)), change(Coefficients::Zero(value.size())),
          noise(Eigen::VectorXd::Zero(value.size())) {
        for (const Place &place : at) {
            const Coefficients others = product_without(at, &place);
            change -= place.change * others;
            noise += place.noise * others.cwiseAbs();
        }
    }
};

Value value_at(const Coefficients &polynomial, Value z) {
    Value out = 0;
    for (Eigen::Index k = polynomial.size() - 1; k >= 0; --k)
        out = out * z + polynomial(k);
    return out;
}

/// All roots, starting from those of a polynomial close by (Durand and Kerner), displaced without
/// symmetry so that pairs can become real and part.
/// @returns whether they were found
bool move_roots(const Coefficients &polynomial, std::vector<Value> &roots) {
    double size = 0;
    for (const Value &root : roots)
        size = std::max(size, std::abs(root));
    for (std::size_t k = 0; k < roots.size(); ++k)
        roots[k] += std::polar(0.01 * size, 1 + 2.4 * static_cast<double>(k));
    // A guard: from 1 % off simple roots take some ten steps, multiple ones converge linearly.
    constexpr int most = 150;
    // Of the largest root: far below distances from the axis that count.
    constexpr double settled = 1e-9;
    for (int step = 0; step < most; ++step) {
        double largest = 0;
        size = 0;
        for (Value &root : roots) {
            Value others = 1;
            for (const Value &other : roots)
                if (&other != &root)
                    others *= root - other;
            if (others == 0.0)
                return false;
            const Value change = value_at(polynomial, root) / others;
            root -= change;
            largest = std::max(largest, std::abs(change));
            size = std::max(size, std::abs(root));
        }
        if (largest <= settled * size)
            return true;
    }
    return false;
}

/// Geometric mean of their moduli.
double mean_size(const Cluster &roots) {
    double sum = 0;
    for (const Root *root : roots)
        sum += std::log(std::max(std::abs(root->value), 1e-300));
    return std::exp(sum / static_cast<double>(roots.size()));
}

/// @param powers  seen over the logarithm of the speed, less the power of the speed that they rise
///                with on an average: a positive factor, which brings no root to the axis
bool stays_off(const Cluster &a, const Cluster &b, const ClusterStep &step, bool powers) {
    const double length = powers ? std::log(step.to / step.from) : step.to - step.from;
    const double size_a = powers ? mean_size(a) : 1;
    const double size_b = powers ? mean_size(b) : 1;
    const double power = std::log(size_b / size_a) / length;
    const Value centre(0, powers ? 0 : (mean(a, &Root::value) + mean(b, &Root::value)).imag() / 2);
    const auto places = [&](const Cluster &roots, double speed, double size) {
        std::vector<Place> out;
        for (const Root *root : roots) {
            const Value at = (root->value - centre) / size;
            const Value rate = powers ? speed * root->rate / size - power * at : root->rate;
            out.push_back({at, length * rate, root->noise / size});
        }
        return out;
    };
    const std::vector<Place> first = places(a, step.from, size_a);
    const PolynomialEnd from(first);
    const PolynomialEnd to(places(b, step.to, size_b));
    const Coefficients rise = to.value - from.value;
    const Coefficients bend = 3.0 * rise - 2.0 * from.change - to.change;
    const Coefficients twist = from.change + to.change - 2.0 * rise;
    const auto at = [&](double t) -> Coefficients {
        return from.value + t * (from.change + t * (bend + t * twist));
    };
    const auto slope_at = [&](double t) -> Coefficients {
        return from.change + t * (2.0 * bend + 3.0 * t * twist);
    };
    const Eigen::VectorXd open =
        (rise - (from.change + to.change) / 2.0).cwiseAbs() + from.noise + to.noise;
    std::vector<Value> roots;
    for (const Place &place : first)
        roots.push_back(place.at);
    // Twice as dense as for single roots: powers of up to the cluster's size.
    constexpr int samples_of_step = 32;
    Eigen::VectorXd steepest = from.change.cwiseAbs();
    for (int k = 1; k <= samples_of_step; ++k) {
        const double t = static_cast<double>(k) / samples_of_step;
        const Coefficients now = at(t);
        // On the way there, too: by the slopes, as a root that comes near the axis between two
        // samples and goes back has alike values at both.
        const Eigen::VectorXd slope = slope_at(t).cwiseAbs();
        const Eigen::VectorXd left = open + steepest.cwiseMax(slope) / samples_of_step;
        steepest = slope;
        if (!move_roots(now, roots))
            return false;
        for (const Value &root : roots) {
            const double w = root.imag();
            double allowed = 0;
            for (Eigen::Index of = left.size() - 1; of >= 0; --of)
                allowed = allowed * std::abs(w) + left(of);
            if (!(std::abs(value_at(now, {0, w})) > allowed))
                return false;
        }
    }
    return true;
}

} // namespace

Cluster cluster(const RootsAt &spectrum, const std::vector<int> &numbers) {
    Cluster out;
    for (const int number : numbers)
        out.push_back(&spectrum.roots[static_cast<std::size_t>(number)]);
    return out;
}

bool all_alike(const Cluster &a, const Cluster &b, double step) {
    if (a.size() != b.size() || a.empty())
        return false;
    const int sign = a.front()->sign();
    double noise = 0;
    double spread = 0;
    for (const Cluster *cluster : {&a, &b})
        for (const Root *root : *cluster) {
            if (root->sign() != sign)
                return false;
            noise += root->noise;
            spread = std::max(spread, std::abs(root->value - a.front()->value));
        }
    if (sign == 0)
        return spread <= noise;
    const Value before = mean(a, &Root::value);
    const Value after = mean(b, &Root::value);
    const Value off = after - before - step * (mean(a, &Root::rate) + mean(b, &Root::rate)) / 2.0;
    constexpr double allowance = 1.5; // over the distances at the ends
    const double least = std::min(std::abs(before.real()), std::abs(after.real()));
    const double widest = std::max(radius(a, step / 2), radius(b, step / 2));
    return least > allowance * widest + std::abs(off);
}

bool off_the_axis(const Cluster &a, const Cluster &b, const ClusterStep &step) {
    constexpr std::size_t most = 6; // of which more are no cluster but a step too long
    if (a.size() != b.size() || a.empty() || a.size() > most || growing(a) != growing(b) ||
        !known(a) || !known(b))
        return false;
    return stays_off(a, b, step, false) || (step.is_long && stays_off(a, b, step, true));
}

bool one_root(const Cluster &a, const Cluster &b) {
    const auto equal = [](const Cluster &roots) {
        constexpr double rounding = 1e-9; // of the value: of a root that is double
        constexpr double known = 3;       // noise of two, each of one part of a value
        return radius(roots) <=
               rounding * std::abs(roots.front()->value) + known * roots.front()->noise;
    };
    return a.size() == b.size() && !a.empty() && equal(a) && equal(b);
}

bool zero_but_for_rounding(const Cluster &a, const Cluster &b) {
    const auto in_noise = [](const Cluster &roots) {
        // Noise is that of one part of a value; the modulus has two.
        constexpr double both_parts = 3;
        return std::ranges::all_of(
            roots, [](const Root *r) { return std::abs(r->value) <= both_parts * r->noise; });
    };
    return a.size() == b.size() && (in_noise(a) || in_noise(b));
}

} // namespace whirl::modes
