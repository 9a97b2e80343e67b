#include "modes/following/continuation.h"

#include "modes/whirl_mode.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

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

Points points_near(const std::map<double, FollowedSpeed> &known, double speed, std::size_t pair) {
    std::vector<const FollowedSpeed *> low;
    std::vector<const FollowedSpeed *> high;
    const auto above = known.lower_bound(speed);
    for (auto it = above; it != known.begin() && low.size() < points_between;)
        if ((--it)->second.pairs[pair].solved)
            low.push_back(&it->second);
    for (auto it = above; it != known.end() && high.size() < points_between; ++it)
        if (it->second.pairs[pair].solved && it->first != speed)
            high.push_back(&it->second);
    Points out;
    const std::size_t most = low.empty() || high.empty() ? points_beyond : points_between;
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

SymmetricPair guess(const std::map<double, FollowedSpeed> &known, double speed, std::size_t i) {
    const Points points = points_near(known, speed, i);
    const SymmetricPair &nearest = points.at.front()->pairs[i];
    SymmetricPair out;
    if (points.at.size() == 1) {
        out.value = nearest.value + nearest.rate * (speed - points.at.front()->speed);
        out.vector = nearest.vector;
        return out;
    }
    const double length = nearest.vector.squaredNorm();
    out.vector = Eigen::VectorXcd::Zero(nearest.vector.size());
    for (std::size_t k = 0; k < points.at.size(); ++k) {
        const SymmetricPair &pair = points.at[k]->pairs[i];
        out.value += points.factors[k] * pair.value;
        // Vectors are known but for a factor: all have the same part along the nearest.
        out.vector += (points.factors[k] * length / nearest.vector.dot(pair.vector)) * pair.vector;
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

bool parallel(const Eigen::VectorXcd &a, const Eigen::VectorXcd &b, double cosine) {
    return std::norm(a.dot(b)) > cosine * cosine * a.squaredNorm() * b.squaredNorm();
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

/// Refines guesses; false where one does not settle, or becomes another one's.
bool refined(EigenpairRefinement &refinement, std::vector<SymmetricPair> &pairs, bool conjugates,
             bool guessed) {
    std::vector<double> distances;
    for (std::size_t i = 0; i < pairs.size(); ++i)
        distances.push_back(distance_from_others(pairs, i));
    for (std::size_t i = 0; i < pairs.size(); ++i) {
        SymmetricPair &pair = pairs[i];
        if (pair.Mx.size() > 0)
            continue; // known
        const bool real = conjugates && pair.value.imag() == 0;
        const Eigen::VectorXcd before = pair.vector;
        if (!refinement.refine(pair, distances[i]))
            return false;
        if (pair.solved && guessed && !parallel(before, pair.vector, alike))
            return false;
        if (real && std::abs(pair.value.imag()) > 1e-9 * std::abs(pair.value))
            return false; // two real ones have met
        if (real)
            pair.value = pair.value.real();
        if (conjugates && !real && !(pair.value.imag() > 1e-6 * std::abs(pair.value)))
            return false;
    }
    return !coincide(pairs);
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

Continuation::Continuation(const SymmetricProblem &problem,
                           const assembly::Discretization &discretization, Start start)
    : _problem(problem), _start(std::move(start)), _fastest(largest_ratio(discretization.rotor())),
      _creep(discretization.rotor().shaft.internal_damping) {}

std::optional<FollowedSpeed> Continuation::begin(double speed, int wanted) const {
    constexpr int beyond = 4; // to place the circle among, and to leave room for it to shrink
    const StartingPairs found = _start(speed, wanted + beyond);
    EigenpairRefinement refinement(_problem, speed);
    FollowedSpeed out;
    out.speed = speed;
    for (const auto &[value, shape] : found.whirls) {
        out.pairs.emplace_back();
        out.pairs.back().value = value;
        out.pairs.back().vector = _problem.from_form(shape);
    }
    for (const double value : found.real)
        out.pairs.push_back(refinement.nearest(value));
    if (!refined(refinement, out.pairs, _problem.conjugates(), false))
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
    const auto before = run.before.find(speed);
    for (std::size_t i = 0; i < run.places.size(); ++i)
        out.pairs.push_back(before != run.before.end() && run.places[i]
                                ? before->second.pairs[*run.places[i]]
                                : guess(run.at, speed, i));
    EigenpairRefinement refinement(_problem, speed);
    if (!refined(refinement, out.pairs, _problem.conjugates(), true))
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
    if (radius == 0 || !same_number(_problem, counted, counted.radius, at, radius))
        return false;
    at.radius = radius;
    at.counted = true;
    return true;
}

/// The first of the speeds up to `last` behind which something may be missing.
std::size_t Continuation::complete(Run &run, const std::vector<double> &speeds, std::size_t first,
                                   std::size_t last, int wanted) const {
    const auto node = [&](std::size_t k) {
        const auto known = run.at.find(speeds[k]);
        return known == run.at.end() ? nullptr : &known->second;
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
            if (FollowedSpeed *other = node(between); other != nullptr &&
                                                      !covered(*node(next), *other, wanted) &&
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
            run.at.emplace(speed, std::move(*next));
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
        run.at.emplace(speeds[middle], std::move(*between));
    fill(run, speeds, from, middle);
    fill(run, speeds, middle, to);
}

/// A run from these pairs: what is known of them from a run with fewer pairs is taken over.
Continuation::Run Continuation::joining(const FollowedSpeed &start) {
    Run run;
    run.places.resize(start.pairs.size());
    for (Run &other : _before) {
        const auto known = other.at.find(start.speed);
        if (known == other.at.end())
            continue;
        const std::vector<SymmetricPair> &pairs = known->second.pairs;
        for (std::size_t i = 0; i < start.pairs.size(); ++i)
            for (std::size_t j = 0; j < pairs.size(); ++j)
                if (std::norm(pairs[j].value - start.pairs[i].value) <
                    1e-20 * std::norm(pairs[j].value))
                    run.places[i] = j;
        run.before = std::move(other.at);
        other.at.clear();
        return run;
    }
    return run;
}

/// The first speed that is left.
std::size_t Continuation::run_from(const std::vector<double> &speeds, std::size_t first,
                                   int wanted) {
    std::optional<FollowedSpeed> start = begin(speeds[first], wanted);
    if (!start)
        return first + 1;
    Run run = joining(*start);
    run.at.emplace(speeds[first], std::move(*start));
    std::vector<std::size_t> solved{first};
    for (std::size_t stride = 1; solved.back() + 1 < speeds.size();) {
        const std::size_t from = solved.back();
        const std::size_t to = std::min(from + stride, speeds.size() - 1);
        if (std::optional<FollowedSpeed> next = step(run, speeds[to]))
            run.at.emplace(speeds[to], std::move(*next));
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
    std::erase_if(run.at, [&](const auto &node) {
        return std::abs(node.first - speeds[first]) > std::abs(speeds[last] - speeds[first]);
    });
    run.before.clear();
    _runs.push_back(std::move(run));
    return last + 1;
}

void Continuation::follow(const std::vector<double> &speeds, int wanted) {
    constexpr int most_short = 3; // runs that come to nothing
    if (speeds.size() < 3 || wanted == _wanted)
        return;
    _wanted = wanted;
    _before = std::exchange(_runs, {});
    int too_short = 0;
    for (std::size_t next = 0; next < speeds.size() && too_short < most_short;) {
        const std::size_t last = run_from(speeds, next, wanted);
        too_short += last - next < 4 && last < speeds.size() ? 1 : 0;
        next = last;
    }
    _before.clear();
}

const FollowedSpeed *Continuation::known(double speed) const {
    for (const Run &run : _runs)
        if (const auto found = run.at.find(speed); found != run.at.end())
            return &found->second;
    return nullptr;
}

const FollowedSpeed *Continuation::at(double speed, int wanted) {
    for (Run &run : _runs) {
        const auto above = run.at.lower_bound(speed);
        if (above == run.at.end() || (above == run.at.begin() && above->first != speed))
            continue;
        const FollowedSpeed *here = above->first == speed ? &above->second : between(run, speed);
        return here != nullptr && here->within(here->radius) >= wanted ? here : nullptr;
    }
    return nullptr;
}

/// At a speed inside a run.
const FollowedSpeed *Continuation::between(Run &run, double speed) const {
    std::optional<FollowedSpeed> found = step(run, speed);
    if (!found)
        return nullptr;
    const FollowedSpeed *low = nullptr;
    const FollowedSpeed *high = nullptr;
    for (const auto &[other, node] : run.at) {
        if (node.counted && other < speed)
            low = &node;
        if (node.counted && other > speed && high == nullptr)
            high = &node;
    }
    bool complete = false;
    for (const FollowedSpeed *end : {low, high})
        complete = (end != nullptr && covered(*end, *found, _wanted)) || complete;
    for (const FollowedSpeed *end : {low, high})
        complete = complete || (end != nullptr && count(*end, *found, _wanted));
    return complete ? &run.at.emplace(speed, std::move(*found)).first->second : nullptr;
}

std::optional<std::vector<SymmetricPair>> pairs_near(const SymmetricProblem &problem, double speed,
                                                     std::vector<SymmetricPair> guesses) {
    EigenpairRefinement refinement(problem, speed);
    if (!refined(refinement, guesses, problem.conjugates(), true))
        return std::nullopt;
    return guesses;
}

} // namespace whirl::modes
