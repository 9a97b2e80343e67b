#include "forced/response_gravity.h"

#include "forced/forced_motion.h"
#include "forced/response_error.h"
#include "forced/response_places.h"
#include "model/errors.h"
#include "modes/free_motions.h"
#include "process/parallel.h"
#include "process/progress.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <string>

namespace whirl::forced {

namespace {

/// The motion under the weight at one speed, as rows for lists_of().
class Weighed {
  public:
    Weighed(const assembly::Discretization &d, const std::map<int, std::string> &nodes,
            const Drive &drive)
        : _discretization(d), _nodes(nodes), _form(form_under_weight(d.rotor())),
          _motion(d, _form, drive), _finer(d, _form, drive) {}

    [[nodiscard]] int unknowns() const { return _motion.unknowns(); }

    std::vector<double> row(double speed) {
        std::vector<double> row;
        if (!solve(speed)) {
            for (std::size_t i = 0; i < _nodes.size(); ++i)
                row.insert(row.end(), {unlimited, no_value, no_value, unlimited, no_value, no_value,
                                       no_value});
            for (std::size_t i = 0; i < _discretization.rotor().supports().size(); ++i)
                row.insert(row.end(), {unlimited, unlimited, no_value, no_value});
            return row;
        }
        add_stations(row);
        add_bearings(row);
        return row;
    }

  private:
    const assembly::Discretization &_discretization;
    const std::map<int, std::string> &_nodes;
    results::Form _form;
    ForcedMotion _motion;
    ResponseError _finer;
    bool _error_known = true;

    /// False at a resonance without damping.
    bool solve(double speed) {
        if (!solves(_motion, speed))
            return false;
        if (_motion.rounding() > resonance_rounding && !same_beside(speed))
            return false;
        _error_known = solves(_finer, speed);
        return true;
    }

    [[nodiscard]] std::vector<std::complex<double>> deflections() const {
        std::vector<std::complex<double>> out;
        for (const auto &[node, name] : _nodes) {
            const assembly::Combination w = _discretization.deflection_at_node(node);
            out.push_back(_motion.at_rest(w));
            out.push_back(_motion.motion(w).x);
        }
        return out;
    }

    /// A resonance that the weight does not drive, or very short elements: a little beside it the
    /// rotor moves in the same way, where a driven one would be smaller by orders of magnitude.
    bool same_beside(double speed) {
        // Of the speed: out of an undamped resonance that is driven, whose motion is then
        // 1e8 times the static one at most.
        constexpr double little = 1e-8;
        constexpr double same = 1e-4; // relative: a motion that is not resonant changes by 1e-8
        const std::vector<std::complex<double>> here = deflections();
        _motion.solve(speed * (1 + little));
        const std::vector<std::complex<double>> there = deflections();
        _motion.solve(speed);
        double difference = 0;
        double size = 0;
        for (std::size_t i = 0; i < here.size(); ++i) {
            difference = std::max(difference, std::abs(here[i] - there[i]));
            size = std::max(size, std::abs(there[i]));
        }
        return difference <= same * size;
    }

    /// Radius of the circle; 0 where it is no more than what rounding leaves beside the part that
    /// stands still.
    [[nodiscard]] double radius(const Phasor &twice, double still) const {
        const double radius = std::abs(twice.x);
        return radius > _motion.rounding() * still ? radius : 0;
    }
    [[nodiscard]] double error(double by_elements, double radius, double still) const {
        if (radius == 0)
            return 0;
        const double by_rounding = _motion.rounding() * (1 + still / radius);
        return _error_known ? by_elements + by_rounding : unlimited;
    }

    void add_stations(std::vector<double> &row) {
        for (const auto &[node, name] : _nodes) {
            const assembly::Combination w = _discretization.deflection_at_node(node);
            const double z = _discretization.shaft_mesh().nodes[static_cast<std::size_t>(node)];
            const std::complex<double> sag = _motion.at_rest(w);
            const Phasor twice = _motion.motion(w);
            const double circle = radius(twice, std::abs(sag));
            row.insert(row.end(),
                       {std::abs(sag), sag.real(), sag.imag(), circle,
                        circle > 0 ? std::arg(twice.x) : no_value,
                        error(_error_known ? _finer.at(z, twice) : 0, circle, std::abs(sag)),
                        _error_known ? _finer.at_rest(z, sag) + _motion.rounding() : unlimited});
        }
    }

    void add_bearings(std::vector<double> &row) {
        const auto count = static_cast<int>(_discretization.rotor().supports().size());
        for (int i = 0; i < count; ++i) {
            const double carried = std::abs(_motion.bearing_force_at_rest(i));
            const Phasor twice = _motion.bearing_force(i);
            const double circle = radius(twice, carried);
            row.insert(row.end(),
                       {carried, circle,
                        error(_error_known ? _finer.of_force(i, twice) : 0, circle, carried),
                        _error_known ? _finer.force_at_rest(i, _motion.bearing_force_at_rest(i)) +
                                           _motion.rounding()
                                     : unlimited});
        }
    }
};

/// The lists of a result, in the order of a row: one value of each a speed.
std::vector<std::vector<double> *> lists_of(results::GravityResponse &response) {
    std::vector<std::vector<double> *> lists;
    for (results::GravityStation &s : response.stations)
        lists.insert(lists.end(),
                     {&s.sag, &s.sag_x, &s.sag_y, &s.twice, &s.phase, &s.error, &s.sag_error});
    for (results::GravityBearing &b : response.bearings)
        lists.insert(lists.end(), {&b.carried, &b.twice, &b.error, &b.carried_error});
    return lists;
}

void refuse_what_falls(const assembly::Discretization &d, double speed) {
    if (modes::free_motions(d, results::Form::general, speed, speed).motions.cols() > 0)
        throw model::BadInput("response.gravity: expected bearings that hold the rotor, got a "
                              "rotor that is free to move: nothing carries its weight");
}

} // namespace

void add_gravity_response(results::ResponseResult &result, const assembly::Discretization &d,
                          const model::Case &scene) {
    const model::SpeedRange &range = model::required_speeds(scene);
    const double gravity = scene.response.gravity;
    refuse_what_falls(d, range.from);
    const Drive drive{gravity};
    const std::map<int, std::string> nodes = attached_nodes(d);
    Weighed weighed(d, nodes, drive);
    const std::vector<std::vector<double>> rows =
        process::rows_at(result.speeds, [&](double speed) { return weighed.row(speed); });
    if (rows.empty())
        return;
    result.model.unknowns = std::max(result.model.unknowns, weighed.unknowns());
    results::GravityResponse &out = result.gravity.emplace();
    out.gravity = gravity;
    add_places(out, d, nodes);
    const std::vector<std::vector<double> *> lists = lists_of(out);
    for (const std::vector<double> &row : rows)
        for (std::size_t i = 0; i < lists.size(); ++i)
            lists[i]->push_back(row.at(i));
    const std::vector<double> infinite =
        speeds_without_limit(result.speeds, out.stations.front().twice);
    if (!infinite.empty())
        result.model.notes.emplace_back(model::Weight::warning,
                                        "no steady motion under the weight at {}: a resonance "
                                        "without damping at twice the spin speed",
                                        results::as::speed.list(infinite));
    const process::Stage stage("peaks at twice the spin speed", 0.6, 1.0);
    if (form_under_weight(d.rotor()) == results::Form::rotating)
        add_peaks(out.peaks, out.curves, d, results::Form::rotating, watched(d, nodes), range,
                  {drive, true}, result.model.notes);
    else
        result.model.notes.emplace_back(
            model::Weight::information,
            "the shaft is equally stiff in all directions: its weight "
            "causes a static sag and no response at twice the spin speed");
}

} // namespace whirl::forced
