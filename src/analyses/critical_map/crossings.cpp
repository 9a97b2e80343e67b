#include "analyses/critical_map/crossings.h"

#include "model/variants.h"
#include "synchronous/critical_error.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace whirl::analyses {

using results::CriticalMap;
using results::CriticalMapBearing;
using results::CriticalMapCrossing;
using synchronous::SynchronousModes;

namespace {

/// kxx (direction 0) or kyy (1) at the rows of a bearing, N/m.
std::vector<double> direct_stiffness(const model::Bearing &bearing, int direction) {
    std::vector<double> k;
    for (const model::BearingCoefficients &row : bearing.rows)
        k.push_back(row.k(direction, direction));
    return k;
}

bool equal_stiffness(const model::Bearing &a, const model::Bearing &b) {
    return a.speeds == b.speeds && direct_stiffness(a, 0) == direct_stiffness(b, 0) &&
           direct_stiffness(a, 1) == direct_stiffness(b, 1);
}

/// Enough speeds that straight lines on logarithmic axes follow lines that are straight on others.
std::vector<double> speeds_across(const model::Bearing &bearing, double low, double high) {
    std::vector<double> speeds{low, high};
    if (!bearing.depends_on_speed())
        return speeds;
    constexpr int steps = 200;
    for (int k = 1; k < steps; ++k)
        speeds.push_back(low * std::pow(high / low, static_cast<double>(k) / steps));
    for (const double speed : bearing.speeds)
        if (speed > low && speed < high)
            speeds.push_back(speed);
    std::ranges::sort(speeds);
    return speeds;
}

struct OnMap {
    std::size_t curve = 0;
    double difference = 0; ///< relative, of the speeds
};

/// Which curve passes through a speed at a stiffness, looked up on the map itself; none where it is
/// beyond those that the map keeps.
std::optional<OnMap> curve_through(const MapScene &map, const CurveOf &curve_of, double k,
                                   results::Whirl whirl, double speed) {
    const assembly::Discretization d(map.with_stiffness(k), map.order);
    const SynchronousModes list = lowest_of_each(map, d);
    const auto places = of_sense(list, whirl);
    std::optional<OnMap> nearest;
    for (std::size_t i = 0; i < places.size(); ++i) {
        const auto found = curve_of.find({whirl, i});
        const double difference = std::abs(list.modes[places[i]].eigenvalue.imag() - speed) / speed;
        if (found != curve_of.end() && (!nearest || difference < nearest->difference))
            nearest = OnMap{found->second, difference};
    }
    constexpr double another_curve = 1e-3;
    return nearest && nearest->difference < another_curve ? nearest : std::nullopt;
}

/// The crossings of one bearing in one direction.
class Crossings {
  public:
    Crossings(const MapScene &map, const CurveOf &curve_of, CriticalMap &out,
              std::vector<std::string> &notes)
        : _map(map), _curve_of(curve_of), _out(out), _notes(notes) {}

    void add(std::size_t across, const model::Bearing &bearing, int direction) {
        const std::vector<double> k = direct_stiffness(bearing, direction);
        const assembly::Discretization d(
            model::with_support_stiffness(_map.rotor, _map.varied, k, bearing.speeds), _map.order);
        const SynchronousModes found = synchronous::all_synchronous_modes(
            d, _map.form, static_cast<int>(2 * _map.kept()), highest_speed(), _map.symmetric);
        for (const auto &[from, to] : found.doubtful)
            _notes.push_back(fmt::format("critical speed map: crossings between {:.6g} and {:.6g} "
                                         "rad/s may be missing",
                                         from, to));
        const auto errors =
            synchronous::errors_by_finer_model(d, _map.form, found, _map.symmetric, _notes);
        const char *of = _out.bearings[across].isotropic ? "k" : direction == 0 ? "kxx" : "kyy";
        for (std::size_t i = 0; i < found.modes.size(); ++i) {
            CriticalMapCrossing crossing{
                across,         of, found.modes[i].eigenvalue.imag(), 0, found.modes[i].whirl, 1,
                errors[i].sum()};
            crossing.stiffness = bearing.at(crossing.speed).k(direction, direction);
            keep(crossing);
        }
    }

  private:
    [[nodiscard]] double highest_speed() const {
        double highest = 0;
        for (const results::CriticalMapCurve &curve : _out.curves)
            for (const double speed : curve.speed)
                highest = std::max(highest, std::isnan(speed) ? 0 : speed);
        return highest;
    }

    /// Where it lies on the map, and on one of its curves.
    void keep(CriticalMapCrossing crossing) {
        if (crossing.stiffness < _out.stiffness.front() ||
            crossing.stiffness > _out.stiffness.back())
            return;
        const auto on =
            curve_through(_map, _curve_of, crossing.stiffness, crossing.whirl, crossing.speed);
        if (!on)
            return;
        constexpr double same_root = 1e-8; // far above rounding, far below any two curves' distance
        if (on->difference > same_root)
            _notes.push_back(fmt::format("critical speed map: the crossing at {:.6g} rad/s misses "
                                         "its curve by {:.1e} of it",
                                         crossing.speed, on->difference));
        crossing.number = _out.curves[on->curve].number;
        const bool second_direction =
            !_out.crossings.empty() && _out.crossings.back().bearing == crossing.bearing &&
            _out.crossings.back().of == crossing.of && on->curve == _last_curve &&
            std::abs(_out.crossings.back().speed - crossing.speed) <= 1e-9 * crossing.speed;
        _last_curve = on->curve;
        if (!second_direction)
            _out.crossings.push_back(crossing);
    }

    const MapScene &_map;
    const CurveOf &_curve_of;
    CriticalMap &_out;
    std::vector<std::string> &_notes;
    std::size_t _last_curve = 0;
};

} // namespace

std::vector<CriticalMapBearing> bearings_across(const model::Rotor &rotor,
                                                std::optional<std::size_t> varied, double low,
                                                double high) {
    std::vector<CriticalMapBearing> out;
    for (std::size_t i = 0; i < rotor.supports().size(); ++i) {
        if (varied && *varied != i)
            continue;
        const model::Bearing &bearing = rotor.bearings[i];
        const auto equal = std::ranges::find_if(out, [&](const auto &other) {
            return equal_stiffness(rotor.bearings[other.bearings.front()], bearing);
        });
        if (equal != out.end()) {
            equal->bearings.push_back(i);
            continue;
        }
        CriticalMapBearing across;
        across.bearings = {i};
        across.isotropic = direct_stiffness(bearing, 0) == direct_stiffness(bearing, 1);
        across.speeds = speeds_across(bearing, low, high);
        for (const double speed : across.speeds) {
            const model::BearingCoefficients at = bearing.at(speed);
            across.kxx.push_back(at.k(0, 0));
            across.kyy.push_back(at.k(1, 1));
        }
        out.push_back(std::move(across));
    }
    return out;
}

void add_crossings(const MapScene &map, const CurveOf &curve_of, const model::Rotor &rotor,
                   CriticalMap &out, std::vector<std::string> &notes) {
    Crossings crossings(map, curve_of, out, notes);
    for (std::size_t i = 0; i < out.bearings.size(); ++i) {
        const model::Bearing &bearing = rotor.bearings[out.bearings[i].bearings.front()];
        crossings.add(i, bearing, 0);
        if (!out.bearings[i].isotropic)
            crossings.add(i, bearing, 1);
    }
}

} // namespace whirl::analyses
