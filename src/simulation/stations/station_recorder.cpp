#include "simulation/stations/station_recorder.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

namespace whirl::simulation {

namespace {

/// Parts of a step in which maxima are looked for, of the radian of the spin: between motions of up
/// to twice its speed, either way, |w| has a maximum every two of them at most.
constexpr double part = 0.5;
/// What the polynomials may be wrong by decides which maxima are looked at again.
constexpr double doubt = 1e-3;
constexpr std::size_t most_candidates = 6;

template <class Polynomial> Eigen::Vector2d value_at(const Polynomial &w, double s) {
    Eigen::Vector2d sum = w[5];
    for (int k = 4; k >= 0; --k)
        sum = (s * sum + w[static_cast<std::size_t>(k)]).eval();
    return sum;
}

template <class Polynomial> Eigen::Vector2d slope_at(const Polynomial &w, double s) {
    Eigen::Vector2d sum = 5 * w[5];
    for (int k = 4; k >= 1; --k)
        sum = (s * sum + k * w[static_cast<std::size_t>(k)]).eval();
    return sum;
}

} // namespace

StationRecorder::StationRecorder(const RotorMotion &motion, std::vector<reduction::Row> rows,
                                 std::size_t planes, double end, double fastest, double axes)
    : _motion(motion), _rows(std::move(rows)), _planes(planes), _axes(axes), _part(part / fastest),
      _final_from(end * (1 - final_share)), _rates(static_cast<std::size_t>(motion.size())),
      _peaks(_rows.size() - planes), _largest(_rows.size(), 0.0), _final(_rows.size(), 0.0),
      _samples(_rows.size() - planes, end, fastest) {}

std::vector<StationRecorder::End> StationRecorder::ends_at(double t, const double *state) {
    _motion.rates(t, state, _rates.data());
    std::vector<End> ends;
    const int n = _motion.coordinates();
    for (const reduction::Row &row : _rows)
        ends.push_back({_motion.deflection(row, state), _motion.deflection(row, state + n),
                        _motion.deflection(row, _rates.data() + n)});
    return ends;
}

void StationRecorder::begin(double t, const double *state) {
    _ends = ends_at(t, state);
    _time = t;
    _state = Eigen::Map<const Eigen::VectorXd>(state, _motion.size());
}

double StationRecorder::last(std::size_t station) const {
    return _ends[_planes + station].w.norm();
}

/// As seen from the axes when they have turned by this angle: u = w exp(-i axes t).
StationRecorder::End StationRecorder::turned(const End &end, double angle) const {
    const Eigen::Rotation2D<double> back(-angle);
    const auto across = [](const Eigen::Vector2d &x) { return Eigen::Vector2d(-x(1), x(0)); };
    return {back * end.w, back * (end.v - _axes * across(end.w)),
            back * (end.a - 2 * _axes * across(end.v) - _axes * _axes * end.w)};
}

StationRecorder::Polynomial StationRecorder::polynomial(const End &from, const End &to,
                                                        double length) {
    const Eigen::Vector2d c1 = length * from.v;
    const Eigen::Vector2d c2 = length * length / 2 * from.a;
    const Eigen::Vector2d rest = to.w - from.w - c1 - c2;
    const Eigen::Vector2d slope = length * to.v - c1 - 2 * c2;
    const Eigen::Vector2d bend = length * length * to.a - 2 * c2;
    return {from.w,
            c1,
            c2,
            10 * rest - 4 * slope + bend / 2,
            -15 * rest + 7 * slope - bend,
            6 * rest - 3 * slope + bend / 2};
}

void StationRecorder::offer(std::size_t station, PeakCandidate candidate) {
    std::vector<PeakCandidate> &all = _peaks[station];
    if (!all.empty() && candidate.value < (1 - doubt) * all.front().value)
        return;
    candidate.start = _time;
    candidate.state = _state;
    const auto place = std::ranges::find_if(
        all, [&](const PeakCandidate &other) { return candidate.value > other.value; });
    all.insert(place, std::move(candidate));
    std::erase_if(all, [&](const PeakCandidate &other) {
        return other.value < (1 - doubt) * all.front().value;
    });
    if (all.size() > most_candidates)
        all.pop_back();
}

std::vector<double> StationRecorder::take_largest() {
    std::vector<double> now;
    for (const End &end : _ends)
        now.push_back(end.w.norm());
    return std::exchange(_largest, now);
}

void StationRecorder::maximum(std::size_t row, double value, double time) {
    _largest[row] = std::max(_largest[row], value);
    if (time >= _final_from)
        _final[row] = std::max(_final[row], value);
}

void StationRecorder::look_for_maxima(std::size_t row, const Polynomial &w, double to) {
    const double length = to - _time;
    const int parts = std::max(1, static_cast<int>(std::min(std::ceil(length / _part), 1e3)));
    const auto growth = [&](double s) { return value_at(w, s).dot(slope_at(w, s)); };
    double before = growth(0);
    for (int i = 1; i <= parts; ++i) {
        double high = static_cast<double>(i) / parts;
        double low = static_cast<double>(i - 1) / parts;
        const double here = growth(high);
        if (before > 0 && here <= 0) {
            const double from = _time + low * length;
            const double until = _time + high * length;
            for (int halving = 0; halving < 40; ++halving) {
                const double middle = (low + high) / 2;
                (growth(middle) > 0 ? low : high) = middle;
            }
            const double value = value_at(w, low).norm();
            const double time = _time + low * length;
            maximum(row, value, time);
            if (row >= _planes)
                offer(row - _planes, {value, time, from, until, 0, {}});
        }
        before = here;
    }
}

void StationRecorder::step(double t, const double *state) {
    const double length = t - _time;
    if (!(length > 0)) // begun here
        return;
    std::vector<End> ends = ends_at(t, state);
    std::vector<Polynomial> w;
    for (std::size_t i = 0; i < _rows.size(); ++i) {
        w.push_back(polynomial(turned(_ends[i], 0), turned(ends[i], _axes * length), length));
        look_for_maxima(i, w[i], t);
        maximum(i, ends[i].w.norm(), t);
    }
    for (const auto &[window, sample, time] : _samples.between(_time, t)) {
        const Eigen::Rotation2D<double> turn(_axes * (time - _time));
        for (std::size_t i = _planes; i < _rows.size(); ++i)
            _samples.set(i - _planes, window, sample,
                         turn * value_at(w[i], (time - _time) / length));
    }
    _ends = std::move(ends);
    _time = t;
    _state = Eigen::Map<const Eigen::VectorXd>(state, _motion.size());
}

void StationRecorder::save(model::Restart &restart) const {
    restart.largest = _largest;
    restart.last = _final;
    for (std::size_t i = 0; i < _peaks.size(); ++i) {
        auto [value, time] = before(i);
        if (!_peaks[i].empty() && _peaks[i].front().value > value)
            std::tie(value, time) = std::pair(_peaks[i].front().value, _peaks[i].front().time);
        if (last(i) > value)
            std::tie(value, time) = std::pair(last(i), _time);
        restart.peaks.push_back(value);
        restart.peak_times.push_back(time);
    }
}

void StationRecorder::resume(const model::Restart &restart) {
    for (std::size_t i = 0; i < _peaks.size(); ++i)
        _before.emplace_back(restart.peaks[i], restart.peak_times[i]);
    _largest = restart.largest;
    if (restart.time >= _final_from) // else gathered towards an earlier end
        _final = restart.last;
    _samples.leave_out_before(restart.time);
}

} // namespace whirl::simulation
