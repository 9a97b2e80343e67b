#include "simulation/spin.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>

namespace whirl::simulation {

Spin::Spin(double speed) { _pieces.push_back({0, 0, speed, 0}); }

Spin::Spin(const std::vector<std::pair<double, double>> &run_up) : Spin(run_up.front().second) {
    const auto append = [this](double start, double speed, double acceleration) {
        const double angle = start > 0 ? turned(start) : 0;
        if (start <= _pieces.back().start)
            _pieces.pop_back();
        _pieces.push_back({start, angle, speed, acceleration});
    };
    for (std::size_t i = 0; i + 1 < run_up.size(); ++i) {
        const auto [t0, speed0] = run_up[i];
        const auto [t1, speed1] = run_up[i + 1];
        append(t0, speed0, (speed1 - speed0) / (t1 - t0));
    }
    if (run_up.size() > 1)
        append(run_up.back().first, run_up.back().second, 0);
}

const Spin::Piece &Spin::piece_at(double t) const {
    const auto next = std::upper_bound(_pieces.begin() + 1, _pieces.end(), t,
                                       [](double time, const Piece &p) { return time < p.start; });
    return *std::prev(next);
}

std::vector<double> Spin::jumps() const {
    std::vector<double> times;
    for (std::size_t i = 1; i < _pieces.size(); ++i)
        times.push_back(_pieces[i].start);
    return times;
}

Spin::At Spin::at(double t, double piece) const {
    const Piece &p = piece_at(piece);
    const double s = t - p.start;
    // Whole turns before the piece say nothing; without them the angle keeps its digits.
    return {std::remainder(p.angle, 2 * std::numbers::pi) + (p.speed + p.acceleration * s / 2) * s,
            p.speed + p.acceleration * s, p.acceleration};
}

double Spin::turned(double t) const {
    const Piece &p = piece_at(t);
    const double s = t - p.start;
    return p.angle + (p.speed + p.acceleration * s / 2) * s;
}

std::optional<double> Spin::reaches(double speed) const {
    for (std::size_t i = 0; i < _pieces.size(); ++i) {
        const Piece &p = _pieces[i];
        if (std::abs(p.speed) >= speed)
            return p.start;
        if (p.acceleration == 0)
            continue;
        const double after = (std::copysign(speed, p.acceleration) - p.speed) / p.acceleration;
        if (i + 1 == _pieces.size() || p.start + after < _pieces[i + 1].start)
            return p.start + after;
    }
    return std::nullopt;
}

double Spin::fastest(double t) const {
    double fastest = std::abs(at(t, t).speed);
    for (const Piece &p : _pieces)
        if (p.start <= t)
            fastest = std::max(fastest, std::abs(p.speed));
    return fastest;
}

} // namespace whirl::simulation
