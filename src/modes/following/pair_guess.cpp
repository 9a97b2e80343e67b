#include "modes/following/pair_guess.h"

#include "linalg/check.h"
#include "linalg/lanes/vector_products.h"
#include "modes/following/unmixed.h"
#include "modes/whirl_mode.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace whirl::modes {

namespace {

using Complex = std::complex<double>;

/// Points of a polynomial between known speeds, and beyond them; the most where more of them help.
constexpr std::size_t points_between = 6;
constexpr std::size_t points_beyond = 4;
constexpr std::size_t most_points = 12;
/// Cosine between a guess and what became of it, where all unknowns count alike.
constexpr double same_motion = 0.8;

/// Known pairs at the speeds nearest to one, from the nearest on.
using Points = std::vector<const FollowedSpeed *>;

/// A point of a polynomial.
bool tells(const SymmetricPair &pair) { return pair.solved && !pair.mixed; }

Points points_near(const std::map<double, FollowedSpeed> &known, double speed, std::size_t pair) {
    std::vector<const FollowedSpeed *> low;
    std::vector<const FollowedSpeed *> high;
    const auto above = known.lower_bound(speed);
    for (auto it = above; it != known.begin() && low.size() < most_points;)
        if (tells((--it)->second.pairs[pair]))
            low.push_back(&it->second);
    for (auto it = above; it != known.end() && high.size() < most_points; ++it)
        if (tells(it->second.pairs[pair]) && it->first != speed)
            high.push_back(&it->second);
    Points out;
    // From one side alone polynomials of high degree run away.
    const std::size_t most = std::min(low.empty() || high.empty() ? points_beyond : most_points,
                                      2 * std::min(low.size(), high.size()) + points_beyond);
    for (std::size_t l = 0, h = 0; out.size() < most && (l < low.size() || h < high.size());) {
        const bool below =
            h == high.size() || (l < low.size() && speed - low[l]->speed <= high[h]->speed - speed);
        out.push_back(below ? low[l++] : high[h++]);
    }
    return out;
}

/// What the first of the points count for in the value of their polynomial at the speed.
std::vector<double> factors_of(const Points &points, std::size_t count, double speed) {
    std::vector<double> out;
    for (std::size_t a = 0; a < count; ++a) {
        double factor = 1;
        for (std::size_t b = 0; b < count; ++b)
            if (b != a)
                factor *= (speed - points[b]->speed) / (points[a]->speed - points[b]->speed);
        out.push_back(factor);
    }
    return out;
}

/// The polynomial through the nearest of the points: through as many as bring the eigenvalue nearer
/// to where the next ones see it. Near a speed at which eigenvalues meet, real or complex, few do.
std::vector<double> best_factors(const Points &points, double speed, std::size_t pair) {
    const auto value = [&](const std::vector<double> &factors) {
        Complex sum = 0;
        for (std::size_t k = 0; k < factors.size(); ++k)
            sum += factors[k] * points[k]->pairs[pair].value;
        return sum;
    };
    constexpr std::size_t further = 2;
    constexpr double nearer = 0.3;
    std::vector<double> best = factors_of(points, std::min(points.size(), points_between), speed);
    if (best.size() + further > points.size())
        return best;
    Complex there = value(best);
    double change = std::abs(there - value(factors_of(points, best.size() - further, speed)));
    while (best.size() + further <= points.size()) {
        std::vector<double> more = factors_of(points, best.size() + further, speed);
        const Complex next = value(more);
        if (!(std::abs(next - there) < nearer * change))
            break;
        change = std::abs(next - there);
        there = next;
        best = std::move(more);
    }
    return best;
}

bool parallel(const Eigen::VectorXcd &a, const Eigen::VectorXcd &b, double cosine) {
    return std::norm(linalg::dot(a, b)) > cosine * cosine * a.squaredNorm() * b.squaredNorm();
}

/// Two pairs have become one.
bool coincide(const std::vector<SymmetricPair> &pairs) {
    for (std::size_t i = 0; i < pairs.size(); ++i)
        for (std::size_t j = i + 1; j < pairs.size(); ++j)
            if (std::norm(pairs[i].value - pairs[j].value) < 1e-14 * std::norm(pairs[i].value) &&
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
/// @param grouped  of each pair whether it may turn away from its guess
bool refined(const SymmetricProblem &problem, double speed, std::vector<SymmetricPair> &pairs,
             int slowest, const std::vector<bool> &grouped) try {
    const std::vector<double> enough = enough_errors(pairs, slowest);
    std::vector<EigenpairRefinement::Task> tasks;
    std::vector<std::size_t> places;
    std::vector<bool> real;
    std::vector<Eigen::VectorXcd> before;
    for (std::size_t i = 0; i < pairs.size(); ++i) {
        SymmetricPair &pair = pairs[i];
        pair.counted_only = enough[i] == counted_error;
        real.push_back(problem.conjugates() && pair.value.imag() == 0);
        if (pair.Mx.size() > 0 && pair.error <= enough[i])
            continue; // known
        tasks.push_back({&pair, distance_from_others(pairs, i), enough[i]});
        places.push_back(i);
        before.push_back(pair.vector);
    }
    if (!EigenpairRefinement(problem, speed).refine(tasks))
        return false;
    for (std::size_t k = 0; k < tasks.size(); ++k) {
        SymmetricPair &pair = *tasks[k].pair;
        if (!upper(problem, pair, real[places[k]]) ||
            (pair.solved && !grouped[places[k]] && !parallel(before[k], pair.vector, same_motion)))
            return false;
    }
    if (coincide(pairs))
        return false;
    // Guesses may have stood in another order: what was only to be counted is one of the slowest.
    const std::vector<double> now = enough_errors(pairs, slowest);
    bool in_order = true;
    for (std::size_t i = 0; i < pairs.size(); ++i)
        in_order = in_order && (now[i] == counted_error || !pairs[i].counted_only);
    return in_order || refined(problem, speed, pairs, slowest, grouped);
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

Guess guess(const std::map<double, FollowedSpeed> &known, double speed, std::size_t i) {
    const Points points = points_near(known, speed, i);
    const SymmetricPair &nearest = points.front()->pairs[i];
    Guess found{{}, &nearest};
    SymmetricPair &out = found.pair;
    if (points.size() == 1) {
        out.value = nearest.value + nearest.rate * (speed - points.front()->speed);
        out.vector = nearest.vector;
        return found;
    }
    const std::vector<double> factors = best_factors(points, speed, i);
    const double length = nearest.vector.squaredNorm();
    out.vector = factors[0] * nearest.vector;
    for (std::size_t k = 0; k < factors.size(); ++k) {
        const SymmetricPair &pair = points[k]->pairs[i];
        out.value += factors[k] * pair.value;
        // Vectors are known but for a factor: all have the same part along the nearest.
        if (k > 0)
            linalg::add_multiple(factors[k] * length / linalg::dot(nearest.vector, pair.vector),
                                 pair.vector, out.vector);
    }
    return found;
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
    const std::vector<bool> none(guesses.size(), false);
    return refined(problem, speed, guesses, slowest, none) ? std::optional(std::move(guesses))
                                                           : std::nullopt;
}

std::optional<std::vector<SymmetricPair>>
pairs_of_guesses(const SymmetricProblem &problem, double speed, std::vector<SymmetricPair> guesses,
                 const std::vector<const SymmetricPair *> &nearest, int slowest) {
    const std::vector<bool> grouped = unmix(problem, speed, guesses);
    if (!refined(problem, speed, guesses, slowest, grouped))
        return std::nullopt;
    for (std::size_t i = 0; i < guesses.size(); ++i)
        guesses[i].mixed = !parallel(nearest[i]->vector, guesses[i].vector, same_motion);
    return guesses;
}

} // namespace whirl::modes
