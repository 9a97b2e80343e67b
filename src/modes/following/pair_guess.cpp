#include "modes/following/pair_guess.h"

#include "linalg/lanes/vector_products.h"
#include "modes/following/unmixed.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

namespace whirl::modes {

namespace {

using Complex = std::complex<double>;

/// Points of a polynomial between known speeds, and beyond them, at most.
constexpr std::size_t points_between = 8;
constexpr std::size_t points_beyond = 4;
/// Cosine between a guess and what became of it, where all unknowns count alike.
constexpr double same_motion = 0.8;

/// A list of a few, made for each guess.
template <class T> struct Few {
    std::array<T, points_between> of{};
    std::size_t count = 0;

    void push_back(const T &value) { of[count++] = value; }
    [[nodiscard]] std::size_t size() const { return count; }
    [[nodiscard]] const T &operator[](std::size_t k) const { return of[k]; }
    [[nodiscard]] const T *begin() const { return of.data(); }
    [[nodiscard]] const T *end() const { return of.data() + count; }
};

/// Known pairs at the speeds nearest to one, from the nearest on.
using Points = Few<const FollowedSpeed *>;

/// A point of a polynomial.
bool tells(const SymmetricPair &pair) { return pair.solved && !pair.mixed; }

Points points_near(const std::map<double, FollowedSpeed> &known, double speed, std::size_t pair) {
    Points low;
    Points high;
    const auto above = known.lower_bound(speed);
    for (auto it = above; it != known.begin() && low.size() < points_between;)
        if (tells((--it)->second.pairs[pair]))
            low.push_back(&it->second);
    for (auto it = above; it != known.end() && high.size() < points_between; ++it)
        if (tells(it->second.pairs[pair]) && it->first != speed)
            high.push_back(&it->second);
    Points out;
    // From one side alone polynomials of high degree run away.
    const std::size_t most =
        std::min(points_between, 2 * std::min(low.size(), high.size()) + points_beyond);
    for (std::size_t l = 0, h = 0; out.size() < most && (l < low.size() || h < high.size());) {
        const bool below =
            h == high.size() || (l < low.size() && speed - low[l]->speed <= high[h]->speed - speed);
        out.push_back(below ? low[l++] : high[h++]);
    }
    return out;
}

/// What a point counts for in a polynomial: its value, and its change with the speed.
struct Weight {
    double value, change;
};
using Weights = Few<Weight>;

/// Hermite's polynomial through the first of the points, at the speed; of points whose change is
/// not known through the value alone.
Weights weights_of(const Points &points, std::size_t count, double speed, std::size_t pair) {
    Weights out;
    for (std::size_t a = 0; a < count; ++a) {
        const double away = speed - points[a]->speed;
        double weight = 1;
        double slope = 0;
        for (std::size_t b = 0; b < count; ++b) {
            if (b == a)
                continue;
            const double apart = 1 / (points[a]->speed - points[b]->speed);
            const double factor = (speed - points[b]->speed) * apart;
            const bool twice = points[b]->pairs[pair].turn.size() > 0;
            weight *= twice ? factor * factor : factor;
            slope += twice ? 2 * apart : apart;
        }
        if (points[a]->pairs[pair].turn.size() > 0)
            out.push_back({weight * (1 - away * slope), weight * away});
        else
            out.push_back({weight, 0});
    }
    return out;
}

Complex value_of(const Points &points, const Weights &weights, std::size_t pair) {
    Complex sum = 0;
    for (std::size_t k = 0; k < weights.size(); ++k)
        sum += weights[k].value * points[k]->pairs[pair].value +
               weights[k].change * points[k]->pairs[pair].rate;
    return sum;
}

/// The polynomial through the nearest of the points: through as many as bring the eigenvalue nearer
/// to where the next ones see it. Near a speed at which eigenvalues meet, real or complex, few do.
/// @param change  square of how far the last ones of them moved it
Weights best_weights(const Points &points, double speed, std::size_t pair, double &change) {
    constexpr double nearer = 0.3 * 0.3; // of squares
    constexpr double settled = 1e-11 * 1e-11;
    const bool beyond = std::all_of(points.begin(), points.end(), [&](const FollowedSpeed *point) {
        return (point->speed < speed) == (points[0]->speed < speed);
    });
    const std::size_t further = beyond ? 1 : 2;
    Weights best = weights_of(points, 1, speed, pair);
    Complex there = value_of(points, best, pair);
    change = std::numeric_limits<double>::infinity();
    for (std::size_t count = 2; count <= points.size(); count += further) {
        const Weights more = weights_of(points, count, speed, pair);
        const Complex next = value_of(points, more, pair);
        if (!(std::norm(next - there) < nearer * change))
            break;
        change = std::norm(next - there);
        there = next;
        best = more;
        if (change < settled * std::norm(there))
            break;
    }
    return best;
}

bool parallel(const Eigen::VectorXcd &a, const Eigen::VectorXcd &b, double cosine) {
    return std::norm(linalg::dot(a, b)) >
           cosine * cosine * linalg::dot(a, a).real() * linalg::dot(b, b).real();
}

} // namespace

bool coincide(const std::vector<SymmetricPair> &pairs) {
    for (std::size_t i = 0; i < pairs.size(); ++i)
        for (std::size_t j = i + 1; j < pairs.size(); ++j)
            if (std::norm(pairs[i].value - pairs[j].value) < 1e-14 * std::norm(pairs[i].value) &&
                parallel(pairs[i].vector, pairs[j].vector, 0.999))
                return true;
    return false;
}

namespace {

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

/// A pair that is to be refined, as it was before.
struct Refined {
    GuessedSpeed *at;
    std::size_t place;
    bool real;
    Eigen::VectorXcd before;
};

void add_tasks(const SymmetricProblem &problem, GuessedSpeed &at, int slowest,
               std::vector<Refined> &refined, std::vector<EigenpairRefinement::Task> &tasks) {
    const std::vector<double> enough = enough_errors(at.pairs, slowest);
    for (std::size_t i = 0; i < at.pairs.size(); ++i) {
        SymmetricPair &pair = at.pairs[i];
        pair.counted_only = enough[i] == counted_error;
        if (pair.refined && pair.error <= enough[i])
            continue; // known
        tasks.push_back({&pair, at.speed, distance_from_others(at.pairs, i), enough[i]});
        refined.push_back({&at, i, problem.conjugates() && pair.value.imag() == 0, pair.vector});
    }
}

/// Whether a pair has settled, and is still the one that was guessed.
bool same_pair(const SymmetricProblem &problem, const Refined &refined) {
    SymmetricPair &pair = refined.at->pairs[refined.place];
    return pair.refined && upper(problem, pair, refined.real) &&
           (!pair.solved || refined.at->grouped[refined.place] ||
            parallel(refined.before, pair.vector, same_motion));
}

/// Guesses may have stood in another order: what was only to be counted is one of the slowest.
bool in_order(const std::vector<SymmetricPair> &pairs, int slowest) {
    const std::vector<double> now = enough_errors(pairs, slowest);
    for (std::size_t i = 0; i < pairs.size(); ++i)
        if (now[i] != counted_error && pairs[i].counted_only)
            return false;
    return true;
}

/// Not settled is where a pair does not settle, or becomes another one's.
void refine(const SymmetricProblem &problem, const std::vector<GuessedSpeed *> &speeds,
            int slowest) {
    std::vector<Refined> refined;
    std::vector<EigenpairRefinement::Task> tasks;
    for (GuessedSpeed *at : speeds)
        add_tasks(problem, *at, slowest, refined, tasks);
    EigenpairRefinement(problem).refine(tasks);
    for (GuessedSpeed *at : speeds)
        at->settled = true;
    for (const Refined &one : refined)
        one.at->settled = one.at->settled && same_pair(problem, one);
    std::vector<GuessedSpeed *> again;
    for (GuessedSpeed *at : speeds) {
        at->settled = at->settled && !coincide(at->pairs);
        if (at->settled && !in_order(at->pairs, slowest))
            again.push_back(at);
    }
    if (!again.empty())
        refine(problem, again, slowest);
}

/// Which of two it is need not be known where both are only counted.
void set_mixed(GuessedSpeed &at) {
    bool asked_for = false;
    for (std::size_t i = 0; i < at.pairs.size(); ++i) {
        SymmetricPair &pair = at.pairs[i];
        pair.mixed = !parallel(at.nearest[i]->vector, pair.vector, same_motion);
        asked_for = asked_for || (pair.mixed && !pair.counted_only);
    }
    for (SymmetricPair &pair : at.pairs) {
        pair.either = pair.mixed && !asked_for;
        pair.mixed = pair.mixed && asked_for;
    }
}

} // namespace

int FollowedSpeed::within(double size) const {
    return static_cast<int>(std::count_if(pairs.begin(), pairs.end(), [size](const auto &pair) {
        return pair.whirls() && std::abs(pair.value) < size;
    }));
}

Guess guess(const std::map<double, FollowedSpeed> &known, double speed, std::size_t i) {
    const Points points = points_near(known, speed, i);
    const SymmetricPair &nearest = points[0]->pairs[i];
    Guess found{{}, &nearest};
    SymmetricPair &out = found.pair;
    double change = 0;
    const Weights weights = best_weights(points, speed, i, change);
    out.value = points.size() > 1 ? value_of(points, weights, i)
                                  : nearest.value + nearest.rate * (speed - points[0]->speed);
    out.doubt = std::sqrt(change / std::norm(out.value));
    std::vector<linalg::RealMultiple> terms;
    terms.reserve(2 * weights.size());
    for (std::size_t k = 0; k < weights.size(); ++k) {
        const SymmetricPair &pair = points[k]->pairs[i];
        terms.push_back({weights[k].value, &pair.vector});
        if (weights[k].change != 0)
            terms.push_back({weights[k].change, &pair.turn});
    }
    out.vector = linalg::sum_of(terms);
    return found;
}

SymmetricPair taken_for(SymmetricPair &guess, std::vector<SymmetricPair> &solved) {
    constexpr double same_value = 0.03;
    constexpr double same_vector = 0.95;
    for (auto pair = solved.begin(); pair != solved.end(); ++pair)
        if (std::norm(pair->value - guess.value) <
                same_value * same_value * std::norm(guess.value) &&
            parallel(pair->vector, guess.vector, same_vector)) {
            SymmetricPair out = std::move(*pair);
            solved.erase(pair);
            carry_sign(guess, out);
            return out;
        }
    return std::move(guess);
}

void carry_sign(const SymmetricPair &guess, SymmetricPair &pair) {
    if (linalg::dot(guess.vector, pair.vector).real() >= 0)
        return;
    for (Eigen::VectorXcd *vector : {&pair.vector, &pair.turn})
        *vector = -*vector;
}

SymmetricPair nearest_upper(const SymmetricProblem &problem, double speed, double value) {
    SymmetricPair pair = EigenpairRefinement(problem).nearest(speed, value);
    if (problem.conjugates() && pair.value.imag() < 0) {
        pair.value = std::conj(pair.value);
        pair.vector = problem.conjugate(pair.vector);
    }
    pair.refined = false;
    (void)upper(problem, pair, false);
    return pair;
}

std::optional<std::vector<SymmetricPair>> pairs_near(const SymmetricProblem &problem, double speed,
                                                     std::vector<SymmetricPair> guesses,
                                                     int slowest) {
    GuessedSpeed at{speed, std::move(guesses)};
    at.grouped.resize(at.pairs.size(), false);
    refine(problem, {&at}, slowest);
    return at.settled ? std::optional(std::move(at.pairs)) : std::nullopt;
}

void settle_guesses(const SymmetricProblem &problem, std::vector<GuessedSpeed> &speeds,
                    int slowest) {
    std::vector<GuessedSpeed *> all;
    // What is good as it is need not be told from its neighbours.
    std::vector<EigenpairRefinement::Task> close;
    for (GuessedSpeed &at : speeds) {
        const std::vector<double> enough = enough_errors(at.pairs, slowest);
        for (const std::vector<std::size_t> &group : close_groups(at.pairs))
            for (const std::size_t i : group)
                if (!at.pairs[i].refined)
                    close.push_back(
                        {&at.pairs[i], at.speed, distance_from_others(at.pairs, i), enough[i]});
    }
    EigenpairRefinement(problem).take_good(close);
    for (GuessedSpeed &at : speeds) {
        at.grouped = unmix(problem, at.speed, at.pairs);
        all.push_back(&at);
    }
    refine(problem, all, slowest);
    for (GuessedSpeed &at : speeds)
        if (at.settled)
            set_mixed(at);
}

void settle_single(const SymmetricProblem &problem, std::vector<SinglePair> &pairs) {
    std::vector<EigenpairRefinement::Task> tasks;
    for (SinglePair &one : pairs)
        tasks.push_back({&one.pair, one.speed, one.distance, enough_error});
    EigenpairRefinement(problem).refine(tasks);
    for (SinglePair &one : pairs)
        one.settled = one.pair.refined && upper(problem, one.pair, false) &&
                      parallel(one.nearest->vector, one.pair.vector, same_motion);
}

} // namespace whirl::modes
