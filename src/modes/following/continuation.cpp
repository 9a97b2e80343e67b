#include "modes/following/continuation.h"

#include "modes/whirl_mode.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace whirl::modes {

namespace {

using Complex = std::complex<double>;

/// Speeds of a sweep from one that is solved by inverse iteration to the next at most.
constexpr std::size_t longest_stride = 8;
/// Points of a polynomial between known speeds, and beyond them.
constexpr std::size_t points_between = 6;
constexpr std::size_t points_beyond = 4;
/// Cosine between a guess and what became of it, where all unknowns count alike.
constexpr double alike = 0.8;

/// Known pairs at the speeds nearest to one, with the factors of a polynomial's values.
struct Points {
    std::vector<const FollowedSpeed *> at;
    std::vector<double> factors;
};

Points points_near(const std::map<double, FollowedSpeed> &run, double speed, std::size_t pair) {
    std::vector<const FollowedSpeed *> low;
    std::vector<const FollowedSpeed *> high;
    const auto above = run.lower_bound(speed);
    for (auto it = above; it != run.begin() && low.size() < points_between;)
        if ((--it)->second.pairs[pair].solved)
            low.push_back(&it->second);
    for (auto it = above; it != run.end() && high.size() < points_between; ++it)
        if (it->second.pairs[pair].solved && it->first != speed)
            high.push_back(&it->second);
    Points out;
    const std::size_t most = low.empty() || high.empty() ? points_beyond : points_between;
    for (std::size_t l = 0, h = 0; out.at.size() < most && (l < low.size() || h < high.size());) {
        const bool below = h == high.size() || (l < low.size() && speed - low[l]->speed <=
                                                                      high[h]->speed - speed);
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

/// a^H b where all unknowns count alike.
Complex product(const Eigen::VectorXd &weights, const Eigen::VectorXcd &a,
                const Eigen::VectorXcd &b) {
    return weights.cwiseProduct(a.conjugate()).cwiseProduct(b).sum();
}

SymmetricPair guess(const std::map<double, FollowedSpeed> &run, double speed, std::size_t i,
                    const Eigen::VectorXd &weights) {
    const Points points = points_near(run, speed, i);
    const SymmetricPair &nearest = points.at.front()->pairs[i];
    SymmetricPair out;
    if (points.at.size() == 1) {
        out.value = nearest.value + nearest.rate * (speed - points.at.front()->speed);
        out.vector = nearest.vector;
        return out;
    }
    const Eigen::VectorXcd measure = weights.cwiseProduct(nearest.vector.conjugate());
    const Complex length = measure.cwiseProduct(nearest.vector).sum();
    out.vector = Eigen::VectorXcd::Zero(nearest.vector.size());
    for (std::size_t k = 0; k < points.at.size(); ++k) {
        const SymmetricPair &pair = points.at[k]->pairs[i];
        out.value += points.factors[k] * pair.value;
        // Vectors are known but for a factor: all have the same part along the nearest.
        out.vector += (points.factors[k] * length / measure.cwiseProduct(pair.vector).sum()) *
                      pair.vector;
    }
    return out;
}

/// From an eigenvalue to the two next ones: product of the distances, relative to it, at most 1.
double distance_from_others(const std::vector<SymmetricPair> &pairs, std::size_t i) {
    double first = 1;
    double second = 1;
    for (std::size_t j = 0; j < pairs.size(); ++j) {
        if (j == i)
            continue;
        const double away = std::norm(pairs[j].value - pairs[i].value);
        if (away < first * std::norm(pairs[i].value)) {
            second = first;
            first = away / std::norm(pairs[i].value);
        } else {
            second = std::min(second, away / std::norm(pairs[i].value));
        }
    }
    return std::sqrt(first * second);
}

/// Two pairs have become one.
bool coincide(const std::vector<SymmetricPair> &pairs, const Eigen::VectorXd &weights) {
    for (std::size_t i = 0; i < pairs.size(); ++i)
        for (std::size_t j = i + 1; j < pairs.size(); ++j)
            if (std::norm(pairs[i].value - pairs[j].value) < 1e-14 * std::norm(pairs[i].value)) {
                const auto &a = pairs[i].vector;
                const auto &b = pairs[j].vector;
                if (std::norm(product(weights, a, b)) > 0.998 *
                                                            product(weights, a, a).real() *
                                                            product(weights, b, b).real())
                    return true;
            }
    return false;
}

/// Refines guesses; false where one does not settle, or becomes another one's.
bool refined(EigenpairRefinement &refinement, std::vector<SymmetricPair> &pairs,
             const Eigen::VectorXd &weights, bool conjugates, bool guessed) {
    std::vector<double> distances;
    for (std::size_t i = 0; i < pairs.size(); ++i)
        distances.push_back(distance_from_others(pairs, i));
    Eigen::VectorXcd before;
    for (std::size_t i = 0; i < pairs.size(); ++i) {
        SymmetricPair &pair = pairs[i];
        const bool real = conjugates && pair.value.imag() == 0;
        before = pair.vector;
        if (!refinement.refine(pair, distances[i]))
            return false;
        if (pair.solved && guessed &&
            std::norm(product(weights, before, pair.vector)) <
                alike * alike * product(weights, before, before).real() *
                    product(weights, pair.vector, pair.vector).real())
            return false;
        if (real && std::abs(pair.value.imag()) > 1e-9 * std::abs(pair.value))
            return false; // two real ones have met
        if (real)
            pair.value = pair.value.real();
        if (conjugates && !real && !(pair.value.imag() > 1e-6 * std::abs(pair.value)))
            return false;
    }
    return !coincide(pairs, weights);
}

bool whirls(const SymmetricPair &pair) {
    return std::abs(pair.value.imag()) > real_axis * std::abs(pair.value);
}

double largest_ratio(const model::Rotor &rotor) {
    double ratio = 2; // a thin ring; less for any other body
    for (const model::Disc &disc : rotor.discs)
        if (disc.Id > 0)
            ratio = std::max(ratio, disc.Ip / disc.Id);
    return ratio;
}

} // namespace

int FollowedSpeed::within(double size) const {
    return static_cast<int>(std::count_if(pairs.begin(), pairs.end(), [size](const auto &pair) {
        return whirls(pair) && std::abs(pair.value) < size;
    }));
}

Continuation::Continuation(std::unique_ptr<SymmetricProblem> problem,
                           const assembly::Discretization &discretization, Start start)
    : _problem(std::move(problem)), _start(std::move(start)),
      _fastest(largest_ratio(discretization.rotor())),
      _creep(discretization.rotor().shaft.internal_damping) {}

std::optional<FollowedSpeed> Continuation::begin(double speed, int wanted) const {
    constexpr int beyond = 4; // to place the circle among, and to leave room for it to shrink
    const StartingPairs found = _start(speed, wanted + beyond);
    EigenpairRefinement refinement(*_problem, speed);
    FollowedSpeed out;
    out.speed = speed;
    for (const auto &[value, shape] : found.whirls) {
        out.pairs.emplace_back();
        out.pairs.back().value = value;
        out.pairs.back().vector = _problem->from_form(shape);
    }
    for (const double value : found.real)
        out.pairs.push_back(refinement.nearest(value));
    if (!refined(refinement, out.pairs, _problem->weights(), _problem->conjugates(), false))
        return std::nullopt;
    for (std::size_t i = 0; i < out.pairs.size(); ++i) {
        out.pairs[i].solved = true;
        for (std::size_t j = 0; j < i; ++j) // no vectors to go on from, but a space
            if (std::norm(out.pairs[i].value - out.pairs[j].value) <
                1e-10 * std::norm(out.pairs[i].value))
                return std::nullopt;
    }
    out.radius = std::min(found.radius, widest_gap(out, wanted));
    out.counted = out.radius > 0;
    if (!out.counted || out.within(out.radius) < wanted)
        return std::nullopt;
    return out;
}

std::optional<FollowedSpeed> Continuation::step(const Run &run, double speed) const {
    FollowedSpeed out;
    out.speed = speed;
    for (std::size_t i = 0; i < run.begin()->second.pairs.size(); ++i)
        out.pairs.push_back(guess(run, speed, i, _problem->weights()));
    EigenpairRefinement refinement(*_problem, speed);
    if (!refined(refinement, out.pairs, _problem->weights(), _problem->conjugates(), true))
        return std::nullopt;
    return out;
}

bool Continuation::covered(const FollowedSpeed &counted, FollowedSpeed &at, int wanted) const {
    double fastest = _fastest + _creep * counted.radius;
    for (const FollowedSpeed *end : {&counted, static_cast<const FollowedSpeed *>(&at)})
        for (const SymmetricPair &pair : end->pairs)
            fastest = std::max(fastest, 2 * std::abs(pair.rate));
    const double radius = counted.radius - fastest * std::abs(at.speed - counted.speed);
    if (at.within(radius) < wanted)
        return false;
    at.radius = std::max(at.radius, radius);
    return true;
}

bool Continuation::count(const FollowedSpeed &counted, FollowedSpeed &at, int wanted) const {
    const double radius = widest_gap(at, wanted);
    if (radius == 0 || !same_number(*_problem, counted, counted.radius, at, radius))
        return false;
    at.radius = radius;
    at.counted = true;
    return true;
}

/// The first of the speeds up to `last` behind which something may be missing.
std::size_t Continuation::complete(Run &run, const std::vector<double> &speeds, std::size_t first,
                                   std::size_t last, int wanted) const {
    const auto node = [&](std::size_t k) {
        const auto known = run.find(speeds[k]);
        return known == run.end() ? nullptr : &known->second;
    };
    std::size_t counted = first;
    for (std::size_t k = first + 1; k <= last; ++k) {
        FollowedSpeed *at = node(k);
        if (at == nullptr || (k < last && covered(*node(counted), *at, wanted)))
            continue;
        // A count farther on covers the speeds before it too.
        std::size_t next = k < last ? std::min(2 * k - counted - 1, last) : last;
        while (next > k && node(next) == nullptr)
            --next;
        if (!count(*node(counted), *node(next), wanted))
            return counted;
        for (std::size_t between = k; between < next; ++between)
            if (FollowedSpeed *other = node(between);
                other != nullptr && !covered(*node(next), *other, wanted) &&
                !count(*node(next), *other, wanted))
                return counted;
        counted = next;
        k = next;
    }
    return last;
}

bool Continuation::bridged(Run &run, double from, double to, int depth) const {
    if (depth == 0)
        return false;
    const double middle = (from + to) / 2;
    for (const double speed : {middle, to}) {
        std::optional<FollowedSpeed> next = step(run, speed);
        if (next)
            run.emplace(speed, std::move(*next));
        else if (!bridged(run, speed == to ? middle : from, speed, depth - 1))
            return false;
    }
    return true;
}

void Continuation::fill(Run &run, const std::vector<double> &speeds, std::size_t from,
                        std::size_t to) const {
    if (to - from < 2)
        return;
    const std::size_t middle = (from + to) / 2;
    if (std::optional<FollowedSpeed> between = step(run, speeds[middle]))
        run.emplace(speeds[middle], std::move(*between));
    fill(run, speeds, from, middle);
    fill(run, speeds, middle, to);
}

/// The first speed that is left.
std::size_t Continuation::run_from(const std::vector<double> &speeds, std::size_t first,
                                   int wanted) {
    std::optional<FollowedSpeed> start = begin(speeds[first], wanted);
    if (!start)
        return first + 1;
    Run run;
    run.emplace(speeds[first], std::move(*start));
    std::vector<std::size_t> solved{first};
    for (std::size_t stride = 1; solved.back() + 1 < speeds.size();) {
        const std::size_t from = solved.back();
        const std::size_t to = std::min(from + stride, speeds.size() - 1);
        if (std::optional<FollowedSpeed> next = step(run, speeds[to]))
            run.emplace(speeds[to], std::move(*next));
        else if (stride > 1) {
            stride /= 2;
            continue;
        } else if (!bridged(run, speeds[from], speeds[to], 4))
            break;
        solved.push_back(to);
        stride = std::min(2 * stride, longest_stride);
    }
    for (std::size_t k = 1; k < solved.size(); ++k)
        fill(run, speeds, solved[k - 1], solved[k]);
    const std::size_t last = complete(run, speeds, first, solved.back(), wanted);
    std::erase_if(run, [&](const auto &node) {
        return std::abs(node.first - speeds[first]) > std::abs(speeds[last] - speeds[first]);
    });
    _runs.push_back(std::move(run));
    return last + 1;
}

void Continuation::follow(const std::vector<double> &speeds, int wanted) {
    constexpr int most_short = 3; // runs that come to nothing
    if (speeds.size() < 3 || wanted == _wanted)
        return;
    _wanted = wanted;
    _runs.clear();
    int too_short = 0;
    for (std::size_t next = 0; next < speeds.size() && too_short < most_short;) {
        const std::size_t last = run_from(speeds, next, wanted);
        too_short += last - next < 4 && last < speeds.size() ? 1 : 0;
        next = last;
    }
}

const FollowedSpeed *Continuation::known(double speed) const {
    for (const Run &run : _runs)
        if (const auto found = run.find(speed); found != run.end())
            return &found->second;
    return nullptr;
}

const FollowedSpeed *Continuation::at(double speed, int wanted) {
    for (Run &run : _runs) {
        const auto above = run.lower_bound(speed);
        if (above == run.end() || (above == run.begin() && above->first != speed))
            continue;
        auto here = above->first == speed ? above : run.end();
        if (here == run.end()) {
            std::optional<FollowedSpeed> between = step(run, speed);
            if (!between)
                return nullptr;
            const FollowedSpeed *low = nullptr;
            const FollowedSpeed *high = nullptr;
            for (const auto &[other, node] : run) {
                if (node.counted && other < speed)
                    low = &node;
                if (node.counted && other > speed && high == nullptr)
                    high = &node;
            }
            bool complete = false;
            for (const FollowedSpeed *end : {low, high})
                complete = (end != nullptr && covered(*end, *between, wanted)) || complete;
            for (const FollowedSpeed *end : {low, high})
                complete = complete || (end != nullptr && count(*end, *between, wanted));
            if (!complete)
                return nullptr;
            here = run.emplace(speed, std::move(*between)).first;
        }
        return here->second.within(here->second.radius) >= wanted ? &here->second : nullptr;
    }
    return nullptr;
}

} // namespace whirl::modes
