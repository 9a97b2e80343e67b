#include "periodic/slow_motions.h"

#include "linalg/check.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace whirl::periodic {

namespace {

using Complex = std::complex<double>;
using Eigen::Index;
using Eigen::MatrixXcd;

/// Whether one motion is an alias of another: the exponents differ by a multiple of 2 i speed, and
/// the terms are the same.
bool aliases(const SeriesMotion &a, Complex b_value, const MatrixXcd &b, double speed) {
    // Of value and speed: a thousand times what motions are settled to.
    constexpr double same = 1e-9;
    const double places = std::round((a.value - b_value).imag() / (2 * speed));
    const Complex rest = a.value - b_value - Complex(0, 2 * speed * places);
    if (!(std::abs(rest) <= same * (std::abs(a.value) + std::abs(speed))))
        return false;
    Complex common = 0;
    for (Index k = 0; k < a.right.cols(); ++k) { // term k of a is term k + places of b
        const auto at = k - a.right.cols() / 2 + static_cast<Index>(places) + b.cols() / 2;
        if (at >= 0 && at < b.cols())
            common += a.right.col(k).dot(b.col(at));
    }
    return std::abs(common) > 0.999 * a.right.norm() * b.norm();
}

bool all_apart(const std::vector<SeriesMotion> &motions, double speed) {
    for (std::size_t i = 0; i < motions.size(); ++i)
        for (std::size_t j = 0; j < i; ++j) {
            const SeriesMotion &other = motions[j];
            const MatrixXcd turned = other.right.rowwise().reverse().conjugate();
            if (aliases(motions[i], other.value, other.right, speed) ||
                aliases(motions[i], std::conj(other.value), turned, speed))
                return false;
        }
    return true;
}

/// Displacements of a motion over unknowns as the system has scaled them, with their rates.
SeriesMotion with_rates(const FloquetSeries &motion, const System &system, double speed) {
    const Index n = motion.terms.rows();
    const Index terms = motion.terms.cols();
    const MatrixXcd q = system.scales().cwiseInverse().asDiagonal() * motion.terms;
    Index largest = 0;
    q.colwise().norm().maxCoeff(&largest);
    const Index wide = std::min(largest, terms - 1 - largest);
    SeriesMotion out;
    const Index middle = terms / 2;
    out.value = motion.value + Complex(0, 2 * speed * static_cast<double>(largest - middle));
    out.right.resize(2 * n, 2 * wide + 1);
    for (Index k = -wide; k <= wide; ++k) {
        const Complex rate = out.value + Complex(0, 2 * speed * static_cast<double>(k));
        out.right.col(k + wide) << q.col(largest + k), rate * q.col(largest + k);
    }
    return out;
}

} // namespace

SlowMotions::SlowMotions(SystemAt system, double from, const std::vector<FloquetSeries> &motions)
    : _system(std::move(system)), _from(from) {
    Motions first;
    for (const FloquetSeries &motion : motions)
        first.push_back(with_rates(motion, _system(from), from));
    if (std::optional<Motions> settled = stepped(first, from))
        _known[std::abs(from)] = *std::move(settled);
    else
        _lost = std::abs(from);
}

std::optional<SlowMotions::Motions> SlowMotions::stepped(const Motions &from, double speed) const
    try {
    const ModalSeries series(_system(speed), speed);
    Motions out;
    for (const SeriesMotion &motion : from) {
        std::optional<SeriesMotion> next = series.next_to(motion);
        if (!next)
            return std::nullopt;
        out.push_back(*std::move(next));
    }
    return all_apart(out, speed) ? std::optional(std::move(out)) : std::nullopt;
} catch (const linalg::SolverError &) {
    return std::nullopt;
}

/// By steps as long as motions keep their shape, and no longer than a fifth of the speed.
const SlowMotions::Motions *SlowMotions::reached(double size) {
    constexpr double longest = 1.2; // a fifth of the speed, as said above
    // Ratio of speeds: motions that change their shape within less cannot be followed.
    constexpr double shortest = 1.002;
    const double sign = _from < 0 ? -1 : 1;
    double ratio = longest;
    while (size > _lost) {
        const auto above = _known.lower_bound(size);
        if (above == _known.end())
            return nullptr;
        if (above->first == size)
            return &above->second;
        const double next = above->first > ratio * size ? above->first / ratio : size;
        if (std::optional<Motions> found = stepped(above->second, sign * next)) {
            _known[next] = *std::move(found);
            ratio = std::min(longest, ratio * ratio);
            continue;
        }
        ratio = std::sqrt(std::min(ratio, above->first / next));
        if (ratio < shortest)
            _lost = std::max(_lost, size);
    }
    return nullptr;
}

std::optional<std::vector<FloquetSeries>> SlowMotions::at(double speed) {
    const Motions *found = reached(std::abs(speed));
    if (found == nullptr)
        return std::nullopt;
    const System &system = _system(speed);
    std::vector<FloquetSeries> out;
    for (const SeriesMotion &motion : *found) {
        // Units of rounding for the sums over unknowns and terms.
        constexpr double rounding = 100 * std::numeric_limits<double>::epsilon();
        out.push_back(
            {motion.value, rounding * (std::abs(motion.value) + std::abs(speed)),
             system.scales().asDiagonal() * motion.right.topRows(motion.right.rows() / 2)});
    }
    return out;
}

} // namespace whirl::periodic
