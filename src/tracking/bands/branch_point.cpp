#include "tracking/bands/branch_point.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace whirl::tracking {

namespace {

struct Outside {
    double speed = 0;
    double square = 0;
};

class BranchSearch {
  public:
    BranchSearch(double inside, double outside, double relative, const SquareAt &square)
        : _square(square), _inside(inside), _outside(outside), _relative(relative) {
        evaluate(outside);
    }

    /// @returns false where it was to stop at a jump and there is one
    bool narrow_down(bool stop_at_jump) {
        constexpr int most = 120; // a guard: halving alone reaches 1e-11 in 37 steps
        for (int step = 0; step < most && !narrow(); ++step) {
            if (stop_at_jump && _last && jumps_across(_last->square, width(), _inside))
                return false;
            const double before = width();
            if (const std::optional<double> root = led_to())
                evaluate_about(*root);
            if (width() > before / 2)
                evaluate((_inside + _outside) / 2);
        }
        return true;
    }

    [[nodiscard]] BranchPoint found() const { return {_inside, _outside}; }

  private:
    const SquareAt &_square;
    double _inside, _outside, _relative;
    std::optional<Outside> _last, _before; ///< the two evaluated last outside
    std::optional<double> _root;           ///< where the line led last
    double _miss = 0.02;                   ///< of it, over the way left

    [[nodiscard]] double width() const { return std::abs(_outside - _inside); }
    [[nodiscard]] bool narrow() const { return width() <= _relative * std::abs(_inside); }
    [[nodiscard]] bool within(double speed) const {
        return (speed - _inside) * (speed - _outside) < 0;
    }

    void evaluate(double speed) {
        const std::optional<double> square = _square(speed);
        if (!square) {
            _inside = speed;
            return;
        }
        _outside = speed;
        _before = std::exchange(_last, Outside{speed, *square});
    }

    [[nodiscard]] std::optional<double> led_to() const {
        if (!_last || !_before || _last->square == _before->square)
            return std::nullopt;
        const double root = _last->speed - _last->square * (_before->speed - _last->speed) /
                                               (_before->square - _last->square);
        return within(root) ? std::optional(root) : std::nullopt;
    }

    /// On both sides of where the end ought to be, as far from it as the line may miss it.
    void evaluate_about(double root) {
        const double way = _outside - root;
        if (_root && _before->speed != *_root)
            _miss =
                std::clamp(3 * std::abs((root - *_root) / (_before->speed - *_root)), 1e-6, 0.1);
        _root = root;
        const double offset =
            std::copysign(std::max(_relative / 3 * std::abs(root), _miss * std::abs(way)), way);
        for (const double speed : {root + offset, root - offset})
            if (within(speed))
                evaluate(speed);
    }
};

} // namespace

BranchPoint band_end(double inside, double outside, double relative, const SquareAt &square) {
    BranchSearch search(inside, outside, relative, square);
    search.narrow_down(false);
    return search.found();
}

std::optional<BranchPoint> branch_point(double inside, double outside, double relative,
                                        const SquareAt &square) {
    BranchSearch search(inside, outside, relative, square);
    return search.narrow_down(true) ? std::optional(search.found()) : std::nullopt;
}

} // namespace whirl::tracking
