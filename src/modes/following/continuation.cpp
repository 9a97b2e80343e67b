#include "modes/following/continuation.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace whirl::modes {

namespace {

/// Speeds of a sweep from one that is solved by inverse iteration to the next at most.
constexpr std::size_t longest_stride = 8;

double largest_ratio(const model::Rotor &rotor) {
    double ratio = 2; // a thin ring; less for any other body
    for (const model::Disc &disc : rotor.discs)
        if (disc.Ip > ratio * disc.Id) // without Id: no bound, each speed is counted
            ratio = disc.Id > 0 ? disc.Ip / disc.Id : std::numeric_limits<double>::infinity();
    return ratio;
}

bool mixed(const FollowedSpeed &at) {
    return std::any_of(at.pairs.begin(), at.pairs.end(),
                       [](const SymmetricPair &pair) { return pair.mixed; });
}

/// Whether the pairs in this place are the same motion at all speeds.
bool one_motion(const std::map<double, FollowedSpeed> &at, std::size_t place) {
    return std::none_of(at.begin(), at.end(),
                        [place](const auto &node) { return node.second.pairs[place].either; });
}

} // namespace

Continuation::Continuation(const SymmetricProblem &problem,
                           const assembly::Discretization &discretization, Start start,
                           Start undamped)
    : _problem(problem), _start(std::move(start)), _undamped(std::move(undamped)),
      _fastest(largest_ratio(discretization.rotor())),
      _creep(discretization.rotor().shaft.internal_damping) {}

GuessedSpeed Continuation::guessed(Run &run, double speed) {
    GuessedSpeed out{speed, {}};
    const auto before = run.before.find(speed);
    std::vector<SymmetricPair> solved_before;
    if (const auto tried = run.tried.extract(speed); !tried.empty())
        solved_before = std::move(tried.mapped().pairs);
    for (std::size_t i = 0; i < run.places.size(); ++i) {
        Guess guessed = guess(run.at, speed, i);
        if (before != run.before.end() && run.places[i]) {
            out.pairs.push_back(before->second.pairs[*run.places[i]]);
            carry_sign(guessed.pair, out.pairs.back());
        } else {
            out.pairs.push_back(taken_for(guessed.pair, solved_before));
        }
        out.nearest.push_back(guessed.nearest);
    }
    return out;
}

/// At speeds whose guesses do not need one another.
std::vector<std::optional<FollowedSpeed>>
Continuation::steps(Run &run, const std::vector<double> &speeds) const {
    std::vector<GuessedSpeed> all;
    std::vector<std::vector<bool>> solved;
    for (const double speed : speeds) {
        all.push_back(guessed(run, speed));
        solved.emplace_back();
        for (const SymmetricPair &pair : all.back().pairs)
            solved.back().push_back(pair.solved);
    }
    settle_guesses(_problem, all, _wanted);
    std::vector<std::optional<FollowedSpeed>> out;
    for (std::size_t k = 0; k < all.size(); ++k) {
        out.emplace_back();
        if (!all[k].settled)
            continue;
        out.back() = FollowedSpeed{all[k].speed, std::move(all[k].pairs), 0, false};
        std::vector<SymmetricPair> &pairs = out.back()->pairs;
        for (std::size_t i = 0; i < pairs.size(); ++i)
            pairs[i].solved = pairs[i].solved || solved[k][i];
    }
    return out;
}

std::optional<FollowedSpeed> Continuation::step(Run &run, double speed) const {
    return std::move(steps(run, {speed}).front());
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
    if (radius == 0 || !none_missing(_problem, counted, counted.radius, at, radius))
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
        const bool clear = next && !mixed(*next);
        if (next)
            (clear ? run.at : run.tried).insert_or_assign(speed, std::move(*next));
        if (!clear && !bridged(run, speed == to ? middle : from, speed, depth - 1))
            return false;
    }
    return true;
}

/// The speeds between those solved: halves of all intervals together, then their halves.
void Continuation::fill(Run &run, const std::vector<double> &speeds,
                        const std::vector<std::size_t> &solved) const {
    const auto take = [&](std::vector<std::optional<FollowedSpeed>> found) {
        for (std::optional<FollowedSpeed> &at : found)
            if (at)
                run.at.emplace(at->speed, std::move(*at));
    };
    std::vector<std::size_t> ends = solved;
    for (bool open = true; open;) {
        std::vector<std::size_t> next{ends.front()};
        std::vector<double> middles;
        for (std::size_t k = 1; k < ends.size(); ++k) {
            if (ends[k] - ends[k - 1] > 1) {
                next.push_back((ends[k] + ends[k - 1]) / 2);
                middles.push_back(speeds[next.back()]);
            }
            next.push_back(ends[k]);
        }
        open = !middles.empty();
        take(steps(run, middles));
        ends = std::move(next);
    }
    for (std::size_t k = ends.front(); k <= ends.back(); ++k)
        if (run.at.count(speeds[k]) == 0) // once more, with more neighbours
            take(steps(run, {speeds[k]}));
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
                        1e-20 * std::norm(pairs[j].value) &&
                    one_motion(other.at, j))
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
    int longer_after = 0; // strides that are clear
    for (std::size_t stride = 1; solved.back() + 1 < speeds.size();) {
        const std::size_t from = solved.back();
        const std::size_t to = std::min(from + stride, speeds.size() - 1);
        std::optional<FollowedSpeed> next = step(run, speeds[to]);
        const bool clear = next && !mixed(*next);
        if (next)
            (clear ? run.at : run.tried).insert_or_assign(speeds[to], std::move(*next));
        if (!clear && stride > 1) {
            stride /= 2;
            longer_after = 2;
            continue;
        }
        if (!clear && !bridged(run, speeds[from], speeds[to], 4)) {
            const auto just_there = run.tried.extract(speeds[to]);
            if (just_there.empty())
                break;
            run.at.insert_or_assign(speeds[to], just_there.mapped());
        }
        solved.push_back(to);
        if (--longer_after <= 0)
            stride = std::min(2 * stride, longest_stride);
    }
    fill(run, speeds, solved);
    const std::size_t last = complete(run, speeds, first, solved.back(), wanted);
    std::erase_if(run.at, [&](const auto &node) {
        return std::abs(node.first - speeds[first]) > std::abs(speeds[last] - speeds[first]);
    });
    run.before.clear();
    run.tried.clear();
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

std::vector<std::optional<SymmetricPair>>
Continuation::single(const std::vector<Single> &asked) const {
    std::vector<std::optional<SymmetricPair>> out(asked.size());
    std::vector<SinglePair> pairs;
    std::vector<std::size_t> places;
    for (std::size_t k = 0; k < asked.size(); ++k)
        for (const Run &run : _runs) {
            const auto [speed, i] = asked[k];
            const auto above = run.at.lower_bound(speed);
            if (above == run.at.begin() || above == run.at.end())
                continue;
            Guess guessed = guess(run.at, speed, i);
            pairs.push_back({speed, std::move(guessed.pair), guessed.nearest,
                             distance_from_others(above->second.pairs, i)});
            places.push_back(k);
        }
    settle_single(_problem, pairs);
    for (std::size_t k = 0; k < pairs.size(); ++k)
        if (pairs[k].settled)
            out[places[k]] = std::move(pairs[k].pair);
    return out;
}

/// At a speed inside a run.
const FollowedSpeed *Continuation::between(Run &run, double speed) {
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

} // namespace whirl::modes
