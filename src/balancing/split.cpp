#include "balancing/split.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace whirl::balancing {

namespace {

constexpr double full_turn = 2 * std::numbers::pi;

double hole_angle(const Places &places, std::size_t hole) {
    return places.first + full_turn * static_cast<double>(hole) / places.holes;
}

void add_up(Split &split) {
    split.sum = 0;
    for (const Piece &piece : split.pieces)
        split.sum += std::polar(piece.mr, piece.angle);
}

/// In the holes on both sides of it.
Split between_holes(std::complex<double> weight, const Places &places) {
    const double step = full_turn / places.holes;
    double turned = std::fmod(std::arg(weight) - places.first, full_turn);
    if (turned < 0)
        turned += full_turn;
    const auto count = static_cast<std::size_t>(places.holes);
    const std::size_t before = static_cast<std::size_t>(turned / step) % count;
    const double beyond = turned - static_cast<double>(before) * step; // of the hole before
    const double mr = std::abs(weight);
    Split out;
    const auto add = [&](std::size_t hole, double moment) {
        constexpr double nothing = 1e-12;
        if (moment > nothing * mr)
            out.pieces.push_back({hole, hole_angle(places, hole), {}, moment});
    };
    if (places.holes == 2) { // only what lies along them
        const double along = mr * std::cos(beyond);
        add(along > 0 ? before : (before + 1) % 2, std::abs(along));
    } else { // law of sines
        add(before, mr * std::sin(step - beyond) / std::sin(step));
        add((before + 1) % count, mr * std::sin(beyond) / std::sin(step));
    }
    add_up(out);
    return out;
}

/// Two equal weights: the smallest of the stock of which two are enough.
Split at_two_angles(std::complex<double> weight, const Places &places) {
    const double mr = std::abs(weight);
    std::optional<double> least;
    for (const double mass : places.stock)
        if (2 * mass * places.radius >= mr && (!least || mass < *least))
            least = mass;
    const double mass = least.value_or(*std::ranges::max_element(places.stock));
    const double own = mass * places.radius;
    const double aside = std::acos(std::min(1.0, mr / (2 * own)));
    Split out;
    for (const double sign : {-1.0, 1.0})
        out.pieces.push_back({std::nullopt, std::arg(weight) + sign * aside, mass, own});
    out.complete = least.has_value();
    add_up(out);
    return out;
}

/// Search over what each hole holds: nothing or one of the stock.
class HoleSearch {
  public:
    HoleSearch(std::complex<double> weight, const Places &places, std::size_t most)
        : _weight(weight), _places(places), _most(most),
          _largest(*std::ranges::max_element(places.stock) * places.radius) {
        for (std::size_t i = 0; i < static_cast<std::size_t>(places.holes); ++i)
            _holes.push_back(i);
        // Those nearest to its direction first: good sums are found early and cut off others.
        std::ranges::stable_sort(_holes,
                                 [&](std::size_t a, std::size_t b) { return along(a) > along(b); });
    }

    Split run() {
        _best_apart = std::abs(_weight);
        search(0, 0, _weight);
        Split out;
        for (const auto &[hole, mass] : _best)
            out.pieces.push_back({hole, hole_angle(_places, hole), mass, mass * _places.radius});
        std::ranges::sort(out.pieces, {}, [](const Piece &piece) { return *piece.hole; });
        add_up(out);
        return out;
    }

  private:
    std::complex<double> _weight;
    const Places &_places;
    std::size_t _most;
    double _largest;
    std::vector<std::size_t> _holes;
    std::vector<std::pair<std::size_t, double>> _held, _best;
    double _best_apart = 0;

    [[nodiscard]] double along(std::size_t hole) const {
        return std::cos(hole_angle(_places, hole) - std::arg(_weight));
    }

    void search(std::size_t next, std::size_t used, std::complex<double> left) {
        constexpr double as_good = 1e-9; // of the weight: rounding alone
        const double apart = std::abs(left);
        if (apart < _best_apart - as_good * std::abs(_weight)) {
            _best_apart = apart;
            _best = _held;
        }
        const auto more = std::min(_most - used, _holes.size() - next);
        // The rest together cannot make up what is left.
        if (more == 0 || apart - static_cast<double>(more) * _largest >= _best_apart)
            return;
        for (std::size_t i = next; i < _holes.size(); ++i)
            for (const double mass : _places.stock) {
                _held.emplace_back(_holes[i], mass);
                search(i + 1, used + 1,
                       left - std::polar(mass * _places.radius, hole_angle(_places, _holes[i])));
                _held.pop_back();
            }
    }
};

/// Pieces so that no more than a million sums are tried.
std::size_t most_pieces(const Places &places) {
    constexpr double most_sums = 1e6;
    double sums = 1, ways = 1;
    std::size_t pieces = 0;
    const auto stock = static_cast<double>(places.stock.size());
    while (pieces < static_cast<std::size_t>(places.holes)) {
        const double holes = places.holes - static_cast<double>(pieces);
        ways *= holes * stock / (static_cast<double>(pieces) + 1);
        if (sums + ways > most_sums)
            break;
        sums += ways;
        ++pieces;
    }
    return std::max<std::size_t>(pieces, 1);
}

} // namespace

Split split(std::complex<double> weight, const Places &places) {
    if (std::abs(weight) == 0)
        return {};
    if (places.holes == 0 && places.stock.empty()) {
        Split whole{{{std::nullopt, std::arg(weight), {}, std::abs(weight)}}, weight, true};
        return whole;
    }
    if (places.stock.empty())
        return between_holes(weight, places);
    if (places.holes == 0)
        return at_two_angles(weight, places);
    const std::size_t most = most_pieces(places);
    Split out = HoleSearch(weight, places, most).run();
    out.complete = most >= static_cast<std::size_t>(places.holes);
    return out;
}

} // namespace whirl::balancing
