#include "periodic/neutral.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace whirl::periodic {

namespace {

using Complex = std::complex<double>;

/// A motion, and its derivatives by the speed and by the number that is varied.
struct Point {
    double number = 0, speed = 0;
    Complex value, by_speed, by_number;
    double noise = 0; ///< of the value by rounding, 1/s

    [[nodiscard]] double growth() const { return value.real(); }
};

std::optional<Point> point_at(const Family &family, double number, double speed, Complex guess,
                              double frequency) {
    const auto rotor = family(number);
    const auto root = rotor->next_to(speed, guess, frequency);
    if (!root)
        return std::nullopt;
    const double step = 1e-3 * number; // the terms with it are proportional to it
    const auto other = family(number + step);
    return Point{number,
                 speed,
                 root->value,
                 rotor->slope(*root, speed),
                 rotor->change(*root, speed, *other, speed) / step,
                 root->noise};
}

/// A step in the speed and in the number.
struct Step {
    double speed = 0, number = 0;
};

/// Second derivatives of the growth: twice by the speed, and by both; in parts of two scales.
class Curvature {
  public:
    Curvature(double by_speed, Step scale) : _scale(scale), _by_speed(by_speed * scale.speed) {}

    /// Newton's step to a growth of zero with a slope of zero.
    [[nodiscard]] Step newton(const Point &at) const {
        const double a = at.by_speed.real() * _scale.speed;
        const double b = at.by_number.real() * _scale.number;
        const double determinant = a * _by_number - b * _by_speed;
        const double g = at.growth();
        const double slope = at.by_speed.real();
        return {_scale.speed * (b * slope - g * _by_number) / determinant,
                _scale.number * (g * _by_speed - a * slope) / determinant};
    }
    /// The weaker two motions are coupled the sharper they part: as the inverse of the number.
    void learn(const Point &before, const Point &now) {
        _by_speed *= before.number / now.number;
        const double x = (now.speed - before.speed) / _scale.speed;
        const double y = (now.number - before.number) / _scale.number;
        const double rest =
            (now.by_speed - before.by_speed).real() - _by_speed * x - _by_number * y;
        const double square = x * x + y * y;
        if (square == 0)
            return;
        _by_speed += rest * x / square;
        _by_number += rest * y / square;
    }
    /// Difference of the largest growth from that a step aside.
    [[nodiscard]] double beside(double step) const {
        return std::abs(_by_speed * step / _scale.speed * step) / 2;
    }
    [[nodiscard]] bool concave() const { return _by_speed < 0; }

  private:
    Step _scale;
    double _by_speed;
    double _by_number = 0;
};

/// @param start  the middle of the band
std::optional<Closing> followed(const Family &family, const Point &start, const OpenBand &band) {
    // Newton with secant slopes: some ten; a half of the number each is 1e-12 in forty.
    constexpr int most_steps = 40;
    constexpr double enough = 1e-12; // of the number, in units of growth
    const double first = start.number;
    const double width = band.width;
    std::optional<Point> at = start;
    // A band like a parabola, to begin with.
    Curvature curvature(-8 * start.growth() / (width * width), {width, start.number});
    for (int step = 0; step < most_steps; ++step) {
        const Step wanted = curvature.newton(*at);
        const double most = 0.5 * at->number;
        const double by = std::clamp(wanted.number, -most, most);
        const double open = width * std::min(1.0, at->number / first);
        const double aside = std::clamp(wanted.speed, -open / 4, open / 4);
        if (!std::isfinite(by) || !std::isfinite(aside))
            return std::nullopt;
        const Point before = *at;
        at = point_at(family, before.number + by, before.speed + aside,
                      before.value + before.by_number * by + before.by_speed * aside,
                      band.frequency);
        if (!at || !(at->number < 1.5 * first) || !(at->number > 1e-9 * first))
            return std::nullopt;
        curvature.learn(before, *at);
        const double slope = std::abs(at->by_number.real());
        // Where motions hardly decay, rounding is the larger part of what is left of the growth.
        const double left = std::max(enough * slope * at->number, at->noise);
        if (std::abs(by) * slope <= left && std::abs(at->growth()) <= 10 * left &&
            curvature.beside(aside) <= left)
            return curvature.concave() && at->number < first
                       ? std::optional(Closing{at->number, at->speed, at->value, at->noise / slope})
                       : std::nullopt;
    }
    return std::nullopt;
}

} // namespace

std::optional<Neutral> neutral_next_to(const WholeRotor &rotor, double speed, Complex guess,
                                       double frequency, double reach) {
    constexpr int most_steps = 8; // quadratic: three or four from a neighbour
    const double first = speed;
    for (int step = 0; step < most_steps; ++step) {
        const auto root = rotor.next_to(speed, guess, frequency);
        if (!root)
            return std::nullopt;
        const Complex slope = rotor.slope(*root, speed);
        const double change = -root->value.real() / slope.real();
        const double noise = root->noise / std::abs(slope.real());
        if (!(std::abs(speed + change - first) <= reach))
            return std::nullopt;
        speed += change;
        guess = root->value + slope * change;
        // What is left is the square of the last step over a length of the size of the reach.
        constexpr double enough = 1e-13;
        if (std::abs(change) <= noise || change * change <= enough * std::abs(speed) * reach)
            return Neutral{speed, {0, guess.imag()}, slope.real(), noise};
    }
    return std::nullopt;
}

std::optional<Closing> last_to_close(const Family &family, double number,
                                     const std::vector<OpenBand> &bands) {
    struct Start {
        double closes = 0; ///< as the growth lets expect
        Point middle;
        const OpenBand *band = nullptr;
    };
    std::vector<Start> starts;
    for (const OpenBand &band : bands) {
        const auto middle = point_at(family, number, band.speed, band.guess, band.frequency);
        if (!middle || !(middle->growth() > 0))
            return std::nullopt;
        starts.push_back({number - middle->growth() / middle->by_number.real(), *middle, &band});
    }
    std::sort(starts.begin(), starts.end(),
              [](const Start &a, const Start &b) { return a.closes < b.closes; });
    constexpr double far = 0.2; // of the number
    std::optional<Closing> least;
    for (const Start &start : starts) {
        if (least && start.closes > least->number + far * number)
            break;
        const auto closing = followed(family, start.middle, *start.band);
        if (!closing)
            return std::nullopt;
        if (!least || closing->number < least->number)
            least = closing;
    }
    return least;
}

} // namespace whirl::periodic
