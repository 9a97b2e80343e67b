#include "tracking/bands/branch_point.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace whirl::tracking {

namespace {

/// The parabola through three points, the line through two.
class Interpolation {
  public:
    explicit Interpolation(const std::vector<Pair> &points)
        : _at(points[0]), _next(points[1].speed), _slope(slope(points[0], points[1])) {
        if (points.size() > 2)
            _bend = (slope(points[1], points[2]) - _slope) / (points[2].speed - points[0].speed);
    }

    [[nodiscard]] double operator()(double speed) const {
        return _at.square + (speed - _at.speed) * (_slope + (speed - _next) * _bend);
    }

  private:
    Pair _at;
    double _next, _slope;
    double _bend = 0;

    static double slope(const Pair &a, const Pair &b) {
        return (b.square - a.square) / (b.speed - a.speed);
    }
};

class BranchSearch {
  public:
    /// @param known  at any speeds
    BranchSearch(const Pair &inside, const Pair &outside, double relative, const SquareAt &square,
                 std::vector<Pair> known)
        : _square(square), _inside(inside), _outside(outside), _relative(relative),
          _known(std::move(known)) {
        _known.push_back(outside);
        _known.push_back(inside);
        std::erase_if(_known, [](const Pair &pair) { return !std::isfinite(pair.square); });
    }

    /// @returns false where it was to stop at a jump and there is one
    bool narrow_down(bool stop_at_jump) {
        constexpr int most = 120; // a guard: halving alone reaches 1e-11 in 37 steps
        for (int step = 0; step < most && !narrow(); ++step) {
            if (stop_at_jump && jumps_across(_outside.square, width(), _inside.speed))
                return false;
            const double before = width();
            if (const std::optional<double> root = led_to())
                evaluate_about(*root);
            if (width() > before / 2)
                evaluate((_inside.speed + _outside.speed) / 2);
        }
        return true;
    }

    [[nodiscard]] BranchPoint found() const { return {_inside.speed, _outside.speed}; }

  private:
    const SquareAt &_square;
    Pair _inside, _outside;
    double _relative;
    std::vector<Pair> _known;
    std::optional<double> _root; ///< where the parabola led last
    double _width_then = 0;      ///< of the part that it was in

    [[nodiscard]] double width() const { return std::abs(_outside.speed - _inside.speed); }
    [[nodiscard]] bool narrow() const { return width() <= _relative * std::abs(_inside.speed); }
    [[nodiscard]] bool within(double speed) const {
        return (speed - _inside.speed) * (speed - _outside.speed) < 0;
    }

    void evaluate(double speed) {
        const Pair here{speed, _square(speed)};
        (here.square > 0 ? _outside : _inside) = here;
        if (std::isfinite(here.square))
            _known.push_back(here);
    }

    [[nodiscard]] std::optional<double> led_to() {
        if (_known.size() < 2)
            return std::nullopt;
        const std::size_t count = std::min<std::size_t>(3, _known.size());
        std::ranges::partial_sort(_known, _known.begin() + static_cast<std::ptrdiff_t>(count), {},
                                  [](const Pair &pair) { return std::abs(pair.square); });
        _known.resize(count);
        const Interpolation square(_known);
        double in = _inside.speed;
        double out = _outside.speed;
        if (!(square(in) < 0 && square(out) > 0))
            return std::nullopt;
        constexpr int halves = 60; // to the last digit
        for (int i = 0; i < halves; ++i)
            (square((in + out) / 2) > 0 ? out : in) = (in + out) / 2;
        return (in + out) / 2;
    }

    /// On both sides of where the end ought to be, as far from it as it may be missed: that grows
    /// with the third power of the part's width, of which the second is left for safety.
    void evaluate_about(double root) {
        constexpr double first = 0.02; // of the way
        constexpr double safe = 3;
        const double way = std::abs(_outside.speed - root);
        double miss = first * way;
        if (_root)
            miss = safe * std::abs(root - *_root) * std::pow(width() / _width_then, 2);
        _root = root;
        _width_then = width();
        const double offset =
            std::copysign(std::clamp(miss, _relative / 3 * std::abs(root),
                                     std::max(0.1 * way, _relative / 3 * std::abs(root))),
                          _outside.speed - root);
        for (const double speed : {root + offset, root - offset})
            if (within(speed))
                evaluate(speed);
    }
};

} // namespace

BranchPoint band_end(const Pair &inside, const Pair &outside, double relative,
                     const SquareAt &square, std::vector<Pair> others) {
    BranchSearch search(inside, outside, relative, square, std::move(others));
    search.narrow_down(false);
    return search.found();
}

std::optional<BranchPoint> branch_point(const Pair &inside, const Pair &outside, double relative,
                                        const SquareAt &square) {
    BranchSearch search(inside, outside, relative, square, {});
    return search.narrow_down(true) ? std::optional(search.found()) : std::nullopt;
}

} // namespace whirl::tracking
