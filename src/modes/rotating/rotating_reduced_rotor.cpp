#include "modes/rotating/rotating_reduced_rotor.h"

#include "assembly/frequency_scales.h"
#include "assembly/planar_part.h"
#include "linalg/check.h"
#include "linalg/dense/definite.h"
#include "linalg/dense/products.h"
#include "linalg/symmetric_eigen.h"
#include "reduction/planar_shapes.h"
#include "reduction/projection.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

namespace whirl::modes {

namespace {

using Pairs = std::vector<linalg::ComplexPair>;

/// Principal parts below this share of the largest are left out at first, then a tenth of it each
/// time the basis does not suffice: eigenvalues are off by its square.
constexpr double least_part = 1e-4;

/// At speeds that no shapes were taken from, eigenvalues of the reduced rotor are those of the
/// whole rotor to this part of themselves or of the speed.
constexpr double agreeing = 1e-7;

/// Largest size of the basis, over the planar unknowns: beyond it a reduced rotor saves nothing.
constexpr double large_share = 0.6;

/// What bends the shaft, K + top^2 M in a plane, as L L^T; by its diagonal where it is not
/// positive.
Eigen::MatrixXd metric_factor(const assembly::Discretization &d, double top) {
    const assembly::PlanarPair pair = assembly::planar_pair(d, 0);
    const Eigen::MatrixXd H = pair.K + top * top * pair.M;
    if (std::optional<Eigen::MatrixXd> factor = linalg::cholesky(H))
        return *std::move(factor);
    return H.diagonal().cwiseAbs().cwiseSqrt().asDiagonal();
}

/// The shapes of motions sampled at some speeds.
class Samples {
  public:
    Samples(const assembly::Discretization &d, double top)
        : _L(metric_factor(d, top)), _sum(Eigen::MatrixXd::Zero(_L.rows(), _L.rows())) {}

    void add(const linalg::ComplexPair &pair) {
        Eigen::MatrixXd parts = linalg::transposed_times(
            _L, reduction::planar_parts(pair.vector, _L.rows(), pair.vector.size()));
        const double length = parts.colwise().norm().maxCoeff();
        if (!(length > 0))
            return;
        parts /= length;
        _sum += linalg::times(parts, Eigen::MatrixXd(parts.transpose()));
    }

    [[nodiscard]] Eigen::MatrixXd principal(double least) const {
        const auto found = linalg::symmetric_eigenpairs(_sum);
        const Eigen::VectorXd &energy = found.eigenvalues(); // ascending
        const Eigen::Index count = (energy.array() > least * least * energy.maxCoeff()).count();
        return _L.transpose().triangularView<Eigen::Upper>().solve(
            found.eigenvectors().rightCols(count));
    }

  private:
    Eigen::MatrixXd _L;
    Eigen::MatrixXd _sum; ///< of x x^T
};

/// Speeds to begin with, and those between them, each level between all before it.
std::vector<std::vector<double>> levels_of(const RotatingReducedRotor::Range &range) {
    const auto at = [&range](double t) { return range.from + t * (range.to - range.from); };
    std::vector<std::vector<double>> levels{{at(0), at(0.125), at(0.25), at(0.5), at(0.75), at(1)}};
    for (int parts = 8; parts <= 32; parts *= 2) {
        levels.emplace_back();
        for (int i = 1; i < parts; i += 2)
            if (parts > 8 || i > 1)
                levels.back().push_back(at(static_cast<double>(i) / parts));
    }
    return levels;
}

bool is_rest(double speed, const RotatingReducedRotor::Range &range) {
    return std::abs(speed) <= 1e-6 * std::max(std::abs(range.from), std::abs(range.to));
}

/// The eigenvalues next to the shift, about as many as an iteration from there would have found.
void keep_near(RotatingSpectrum::Eigenvalues &found, int wanted, double radius) {
    Pairs &pairs = found.pairs;
    const auto distance = [&](const linalg::ComplexPair &pair) {
        return std::abs(pair.value - found.shift);
    };
    std::sort(pairs.begin(), pairs.end(),
              [&](const auto &a, const auto &b) { return distance(a) < distance(b); });
    std::size_t kept = 0;
    for (int values = 0; kept < pairs.size(); ++kept) {
        if (values >= 2 * wanted + 2 && distance(pairs[kept]) > radius + found.shift)
            break;
        values += pairs[kept].value.imag() != 0 ? 2 : 1;
    }
    if (kept < pairs.size()) {
        pairs.resize(kept);
        found.complete_radius =
            std::min(found.complete_radius, distance(pairs.back()) - found.shift);
    }
    std::sort(pairs.begin(), pairs.end(),
              [](const auto &a, const auto &b) { return std::abs(a.value) < std::abs(b.value); });
}

} // namespace

RotatingReducedRotor::RotatingReducedRotor(const assembly::Discretization &d,
                                           const std::vector<balancers::BalancerElement> &balancers,
                                           const RotatingSpectrum &whole, Eigen::MatrixXd shapes,
                                           int wanted)
    : _whole(whole), _wanted(wanted), _shapes(std::move(shapes)),
      _reduced(RotatingSpectrum::rough(d, balancers, _shapes)),
      _pencil(FormMatrices(d, whole.system()), assembly::support_scale(d)) {}

std::unique_ptr<RotatingReducedRotor>
RotatingReducedRotor::of(const assembly::Discretization &d,
                         const std::vector<balancers::BalancerElement> &balancers,
                         const RotatingSpectrum &whole, const Range &range) try {
    if (d.rigid())
        return nullptr;
    const double top = 2 * std::max(std::abs(range.from), std::abs(range.to));
    Samples samples(d, top);
    std::unique_ptr<RotatingReducedRotor> out;
    double least = least_part;
    for (const std::vector<double> &level : levels_of(range)) {
        bool met = out != nullptr;
        for (const double speed : level) {
            if (is_rest(speed, range))
                continue;
            const RotatingSpectrum::Lowest lowest = whole.lowest(speed, range.wanted);
            if (!lowest.enough)
                return nullptr;
            met = met && out->meets(lowest, speed);
            for (const linalg::ComplexPair &pair : lowest.found.pairs)
                if (whole.asked_for(pair, speed, lowest.highest) && !whole.held(pair.vector))
                    samples.add(pair);
        }
        if (met)
            return out;
        Eigen::MatrixXd shapes = samples.principal(least);
        least /= 10;
        if (static_cast<double>(shapes.cols()) > large_share * d.planar_size())
            return nullptr;
        out.reset(new RotatingReducedRotor(d, balancers, whole, std::move(shapes), range.wanted));
    }
    return nullptr;
} catch (const linalg::SolverError &) {
    return nullptr;
}

/// Each mode of the whole rotor is one of the reduced rotor's, and there are no more.
bool RotatingReducedRotor::meets(const RotatingSpectrum::Lowest &whole, double speed) const {
    const RotatingSpectrum::Lowest reduced = _reduced.lowest(speed, _wanted);
    const auto in_reach = [&](const RotatingSpectrum &rotor, const Pairs &pairs, double reach) {
        std::vector<std::complex<double>> values;
        for (const linalg::ComplexPair &pair : pairs)
            if (!rotor.held(pair.vector) && rotor.asked_for(pair, speed, reach))
                values.push_back(pair.value);
        return values;
    };
    const auto all_in = [&](const std::vector<std::complex<double>> &some,
                            const std::vector<std::complex<double>> &others) {
        return std::all_of(some.begin(), some.end(), [&](std::complex<double> a) {
            return std::any_of(others.begin(), others.end(), [&](std::complex<double> b) {
                return std::abs(a - b) <= agreeing * std::max(std::abs(a), std::abs(speed));
            });
        });
    };
    const double beyond = 1 + 1e-6;
    return reduced.enough &&
           all_in(in_reach(_whole, whole.found.pairs, whole.highest),
                  in_reach(_reduced, reduced.found.pairs, beyond * whole.highest)) &&
           all_in(in_reach(_reduced, reduced.found.pairs, whole.highest / beyond),
                  in_reach(_whole, whole.found.pairs, whole.highest));
}

std::optional<Spectrum> RotatingReducedRotor::modes(double speed, int wanted) try {
    RotatingSpectrum::Lowest lowest = _reduced.lowest(speed, wanted);
    if (!lowest.enough)
        return std::nullopt;
    _pencil.set_speed(speed);
    keep_near(lowest.found, wanted, lowest.highest + std::abs(speed));
    std::vector<std::complex<double>> before;
    std::vector<std::complex<double>> after;
    Pairs refined;
    Pairs others;
    const reduction::Projection projection(_shapes);
    for (linalg::ComplexPair &pair : lowest.found.pairs) {
        const bool asked =
            !_reduced.held(pair.vector) && _reduced.asked_for(pair, speed, lowest.highest);
        pair.vector = projection.lifted(pair.vector);
        if (!asked) {
            others.push_back(std::move(pair));
            continue;
        }
        before.push_back(pair.value);
        std::optional<linalg::ComplexPair> whole = _pencil.refined(pair);
        if (!whole)
            return std::nullopt;
        after.push_back(whole->value);
        refined.push_back(*std::move(whole));
    }
    if (met_twice(before, after))
        return std::nullopt;
    std::move(refined.begin(), refined.end(), std::back_inserter(others));
    lowest.found.pairs = std::move(others);
    return _whole.modes_of(lowest.found, speed);
} catch (const linalg::SolverError &) {
    return std::nullopt;
}

std::vector<WhirlMode> rotating_modes_near(const RotatingSpectrum &rotor, RotatingPencil &pencil,
                                           double speed, const std::vector<WhirlMode> &guesses) {
    pencil.set_speed(speed);
    std::vector<std::complex<double>> before;
    std::vector<std::complex<double>> after;
    std::vector<WhirlMode> out;
    constexpr double farthest = 0.03; // of a mode that the guesses' mesh hardly resolves
    for (const WhirlMode &guess : guesses) {
        std::optional<linalg::ComplexPair> pair =
            pencil.refined({guess.rotating_value, guess.rotating_vector, 0, 0}, farthest);
        if (!pair)
            return {};
        before.push_back(guess.rotating_value);
        out.push_back(rotor.in_fixed_frame(*pair, speed));
        if (speed != 0 && out.back().whirl != guess.whirl)
            return {};
        after.push_back(pair->value);
    }
    return met_twice(before, after) ? std::vector<WhirlMode>() : out;
}

} // namespace whirl::modes
