#include "modes/following/pair_guess.h"

#include "linalg/check.h"
#include "modes/whirl_mode.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace whirl::modes {

namespace {

using Complex = std::complex<double>;

/// Points of a polynomial between known speeds, and beyond them.
constexpr std::size_t points_between = 6;
constexpr std::size_t points_beyond = 4;
/// Cosine between a guess and what became of it, where all unknowns count alike.
constexpr double same_motion = 0.8;

/// Known pairs at the speeds nearest to one, with the factors of a polynomial's values.
struct Points {
    std::vector<const FollowedSpeed *> at;
    std::vector<double> factors;
};

/// A point of a polynomial.
bool tells(const SymmetricPair &pair) { return pair.solved && !pair.mixed; }

Points points_near(const std::map<double, FollowedSpeed> &known, double speed, std::size_t pair) {
    std::vector<const FollowedSpeed *> low;
    std::vector<const FollowedSpeed *> high;
    const auto above = known.lower_bound(speed);
    for (auto it = above; it != known.begin() && low.size() < points_between;)
        if (tells((--it)->second.pairs[pair]))
            low.push_back(&it->second);
    for (auto it = above; it != known.end() && high.size() < points_between; ++it)
        if (tells(it->second.pairs[pair]) && it->first != speed)
            high.push_back(&it->second);
    Points out;
    // From one side alone polynomials of high degree run away.
    const std::size_t most = std::min(low.empty() || high.empty() ? points_beyond : points_between,
                                      2 * std::min(low.size(), high.size()) + points_beyond);
    for (std::size_t l = 0, h = 0; out.at.size() < most && (l < low.size() || h < high.size());) {
        const bool below =
            h == high.size() || (l < low.size() && speed - low[l]->speed <= high[h]->speed - speed);
        out.at.push_back(below ? low[l++] : high[h++]);
    }
    for (const FollowedSpeed *a : out.at) {
        double factor = 1;
        for (const FollowedSpeed *b : out.at)
            if (b != a)
                factor *= (speed - b->speed) / (a->speed - b->speed);
        out.factors.push_back(factor);
    }
    return out;
}

bool parallel(const Eigen::VectorXcd &a, const Eigen::VectorXcd &b, double cosine) {
    return std::norm(a.dot(b)) > cosine * cosine * a.squaredNorm() * b.squaredNorm();
}

/// Two pairs have become one.
bool coincide(const std::vector<SymmetricPair> &pairs) {
    for (std::size_t i = 0; i < pairs.size(); ++i)
        for (std::size_t j = i + 1; j < pairs.size(); ++j)
            if (std::norm(pairs[i].value - pairs[j].value) < 1e-14 * std::norm(pairs[i].value) &&
                pairs[i].vector.size() > 0 && pairs[j].vector.size() > 0 &&
                parallel(pairs[i].vector, pairs[j].vector, 0.999))
                return true;
    return false;
}

/// An eigenvalue of a real problem: real, or the one of two conjugates with Im > 0.
/// @param real  it is known to be real
bool upper(const SymmetricProblem &problem, SymmetricPair &pair, bool real) {
    const double size = std::abs(pair.value);
    if (!problem.conjugates())
        return true;
    if (std::abs(pair.value.imag()) <= 1e-9 * size)
        pair.value = pair.value.real();
    return real ? pair.value.imag() == 0 // else two real ones have met
                : pair.value.imag() > 1e-6 * size;
}

/// Refines guesses; false where one does not settle, or becomes another one's.
bool refined(const SymmetricProblem &problem, double speed, std::vector<SymmetricPair> &pairs,
             int slowest) try {
    EigenpairRefinement refinement(problem, speed);
    std::vector<double> distances;
    for (std::size_t i = 0; i < pairs.size(); ++i)
        distances.push_back(distance_from_others(pairs, i));
    const std::vector<double> enough = enough_errors(pairs, slowest);
    for (std::size_t i = 0; i < pairs.size(); ++i) {
        SymmetricPair &pair = pairs[i];
        if (pair.vector.size() == 0 || (pair.Mx.size() > 0 && pair.error <= enough[i]))
            continue; // only counted, or known
        const bool real = problem.conjugates() && pair.value.imag() == 0;
        const Eigen::VectorXcd before = pair.vector;
        if (!refinement.refine(pair, distances[i], enough[i]) || !upper(problem, pair, real) ||
            (pair.solved && !parallel(before, pair.vector, same_motion)))
            return false;
    }
    return !coincide(pairs);
} catch (const linalg::SolverError &) {
    return false; // a pivot that happens to be zero
}

bool whirls(const SymmetricPair &pair) {
    return std::abs(pair.value.imag()) > real_axis * std::abs(pair.value);
}

} // namespace

int FollowedSpeed::within(double size) const {
    return static_cast<int>(std::count_if(pairs.begin(), pairs.end(), [size](const auto &pair) {
        return whirls(pair) && std::abs(pair.value) < size;
    }));
}

SymmetricPair guess(const std::map<double, FollowedSpeed> &known, double speed, std::size_t i) {
    const Points points = points_near(known, speed, i);
    const SymmetricPair &nearest = points.at.front()->pairs[i];
    const auto member =
        nearest.reduced.size() > 0 ? &SymmetricPair::reduced : &SymmetricPair::vector;
    SymmetricPair out;
    if (points.at.size() == 1) {
        out.value = nearest.value + nearest.rate * (speed - points.at.front()->speed);
        out.*member = nearest.*member;
        return out;
    }
    const double length = (nearest.*member).squaredNorm();
    Eigen::VectorXcd &sum = out.*member;
    sum = points.factors[0] * nearest.*member;
    for (std::size_t k = 0; k < points.at.size(); ++k) {
        const SymmetricPair &pair = points.at[k]->pairs[i];
        out.value += points.factors[k] * pair.value;
        // Vectors are known but for a factor: all have the same part along the nearest.
        if (k > 0)
            sum +=
                (points.factors[k] * length / (nearest.*member).dot(pair.*member)) * (pair.*member);
    }
    return out;
}

const SymmetricPair &nearest(const std::map<double, FollowedSpeed> &known, double speed,
                             std::size_t i) {
    return points_near(known, speed, i).at.front()->pairs[i];
}

SymmetricPair nearest_upper(const SymmetricProblem &problem, double speed, double value) {
    EigenpairRefinement refinement(problem, speed);
    SymmetricPair pair = refinement.nearest(value);
    if (problem.conjugates() && pair.value.imag() < 0) {
        pair.value = std::conj(pair.value);
        pair.vector = problem.conjugate(pair.vector);
    }
    pair.Mx.resize(0); // to be refined again
    (void)upper(problem, pair, false);
    return pair;
}

std::optional<std::vector<SymmetricPair>> pairs_near(const SymmetricProblem &problem, double speed,
                                                     std::vector<SymmetricPair> guesses,
                                                     int slowest) {
    return refined(problem, speed, guesses, slowest) ? std::optional(std::move(guesses))
                                                     : std::nullopt;
}

} // namespace whirl::modes
