#include "forced/response_receptance.h"

#include "forced/forced_motion.h"
#include "forced/response_error.h"
#include "forced/response_places.h"
#include "process/parallel.h"
#include "process/progress.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <memory>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

namespace whirl::forced {

namespace {

constexpr std::array axes{"x", "y"};

/// A unit force at a station along x or y, at a constant spin speed; over the frequency.
Drive unit_force(double z, std::size_t axis, double spin) {
    Drive drive;
    drive.forces = {{z, axis == 0 ? Phasor{1, 0} : Phasor{0, 1}}};
    drive.sweep = {spin, 0, 0, 1};
    return drive;
}

/// The motion under such a force.
class Shaken {
  public:
    Shaken(const assembly::Discretization &d, const Drive &drive)
        : _motion(d, results::Form::general, drive), _finer(d, results::Form::general, drive) {}

    [[nodiscard]] int unknowns() const { return _motion.unknowns(); }

    /// At a resonance without damping there is no motion.
    void solve(double frequency) {
        _exists = solves(_motion, frequency);
        _error_known = _exists && solves(_finer, frequency);
    }

    /// Amplitude, phase and relative error of x and then of y.
    void add_to(std::vector<double> &row, double z) const {
        const Phasor u = _exists ? _motion.at(z) : Phasor{};
        if (!_exists || !(_motion.rounding() <= resonance_rounding || confirmed(z, u))) {
            row.insert(row.end(), {unlimited, no_value, unlimited, unlimited, no_value, unlimited});
            return;
        }
        const double size = std::hypot(std::abs(u.x), std::abs(u.y));
        const std::array<double, 2> by_elements =
            _error_known ? _finer.of_components(z, u) : std::array<double, 2>{unlimited, unlimited};
        // Where the finer model had to confirm the motion the difference to it is all there is.
        const double rounding = _motion.rounding() <= resonance_rounding ? _motion.rounding() : 0;
        for (const std::size_t axis : {0U, 1U}) {
            const std::complex<double> &part = axis == 0 ? u.x : u.y;
            const double amplitude = std::abs(part);
            if (amplitude <= rounding * size) // nothing couples the directions
                row.insert(row.end(), {0, no_value, 0});
            else
                row.insert(row.end(), {amplitude, std::arg(part),
                                       by_elements.at(axis) + rounding * size / amplitude});
        }
    }

  private:
    ForcedMotion _motion;
    ResponseError _finer;
    bool _exists = false;
    bool _error_known = false;

    /// The finer model has the same motion, whose rounding is another and whose resonances are not
    /// in just the same place: very short elements look ill conditioned without being it.
    [[nodiscard]] bool confirmed(double z, const Phasor &u) const {
        return _error_known && !_finer.none() && _finer.at(z, u) < 0.1;
    }
};

/// The stations that forces act on, each once.
std::vector<double> shaken_places(const std::vector<model::Receptance> &asked) {
    std::vector<double> out;
    for (const model::Receptance &one : asked)
        if (std::ranges::find(out, one.from) == out.end())
            out.push_back(one.from);
    return out;
}

results::ReceptancePeak described(const results::ResponsePeak &peak,
                                  const results::ReceptanceResponse &of, std::size_t receptance,
                                  const std::string &direction) {
    results::ReceptancePeak out;
    out.receptance = static_cast<int>(receptance);
    out.direction = direction;
    out.from = of.receptances[receptance].from;
    out.to = of.receptances[receptance].to;
    out.frequency = peak.speed;
    out.value = peak.value;
    out.phase = peak.phase;
    out.amplification = peak.amplification;
    out.lower = peak.lower;
    out.upper = peak.upper;
    out.error = peak.error;
    out.frequency_error = peak.speed_error;
    return out;
}

/// Peaks and curves under one unit force of all receptances from there, where the direction moves
/// at all.
void add_receptance_peaks(results::ReceptanceResponse &out, const assembly::Discretization &d,
                          const model::Case &scene, double from, std::size_t axis,
                          std::vector<model::Sentence> &notes) {
    Watched all;
    std::vector<std::pair<std::size_t, std::size_t>> places; // receptance, direction
    for (std::size_t i = 0; i < out.receptances.size(); ++i) {
        if (out.receptances[i].from != from)
            continue;
        for (const std::size_t seen : {0U, 1U}) {
            const std::size_t direction = 2 * seen + axis;
            if (std::ranges::none_of(out.receptances[i].directions[direction].amplitude,
                                     [](double value) { return value > 0; }))
                continue;
            const double z = out.receptances[i].to;
            all.add({d.deflection_at(z), Quantity::deflection,
                     static_cast<double>(seen) * std::numbers::pi / 2},
                    "direction", z, "");
            places.emplace_back(i, direction);
        }
    }
    std::vector<results::ResponsePeak> peaks;
    results::ResponseCurves curves;
    add_peaks(peaks, curves, d, results::Form::general, all, scene.response.frequencies,
              {unit_force(from, axis, out.speed), true}, notes);
    for (const results::ResponsePeak &peak : peaks) {
        const auto &[receptance, direction] = places.at(static_cast<std::size_t>(peak.place));
        out.peaks.push_back(described(peak, out, receptance,
                                      out.receptances[receptance].directions[direction].name));
    }
    for (std::size_t i = 0; i < curves.values.size(); ++i) {
        const auto &[receptance, direction] = places[i];
        out.receptances[receptance].directions[direction].curve = {
            curves.speeds, {curves.values[i]}, {curves.phases[i]}};
    }
}

} // namespace

void add_receptances(results::ResponseResult &result, const assembly::Discretization &d,
                     const model::Case &scene) {
    const std::vector<model::Receptance> &asked = scene.response.receptances;
    const double spin = model::required_speeds(scene).from;
    const std::vector<double> frequencies = scene.response.frequencies.values();
    const std::vector<double> places = shaken_places(asked);
    std::vector<std::unique_ptr<Shaken>> shaken; // of each place along x, then along y
    for (const double z : places)
        for (const std::size_t axis : {0U, 1U})
            shaken.push_back(std::make_unique<Shaken>(d, unit_force(z, axis, spin)));
    std::optional<process::Stage> stage(std::in_place, "receptances at the frequencies", 0.0, 0.6);
    double done = 0;
    const auto row_at = [&](double frequency) {
        process::report_progress(done++ / static_cast<double>(frequencies.size()));
        for (const auto &one : shaken)
            one->solve(frequency);
        std::vector<double> row;
        for (const model::Receptance &one : asked) {
            const auto place =
                static_cast<std::size_t>(std::ranges::find(places, one.from) - places.begin());
            for (const std::size_t axis : {0U, 1U})
                shaken[2 * place + axis]->add_to(row, one.to);
        }
        return row;
    };
    const std::vector<std::vector<double>> rows = process::rows_at(frequencies, row_at);
    if (rows.empty())
        return;
    result.model.unknowns = std::max(result.model.unknowns, shaken.front()->unknowns());
    results::ReceptanceResponse &out = result.receptance.emplace();
    out.speed = spin;
    out.frequencies = frequencies;
    for (const model::Receptance &one : asked) {
        results::Receptance &receptance = out.receptances.emplace_back();
        receptance.from = one.from;
        receptance.to = one.to;
        for (const char *seen : axes)
            for (const char *force : axes)
                receptance.directions.emplace_back().name = std::string(seen) + force;
    }
    for (const std::vector<double> &row : rows) {
        auto value = row.begin();
        for (results::Receptance &receptance : out.receptances)
            for (const std::size_t axis : {0U, 1U})
                for (const std::size_t seen : {0U, 1U}) {
                    results::ReceptanceDirection &into = receptance.directions[2 * seen + axis];
                    for (std::vector<double> *list : {&into.amplitude, &into.phase, &into.error})
                        list->push_back(*value++);
                }
    }
    stage.emplace("peaks of the receptances", 0.6, 1.0);
    for (const double from : places)
        for (const std::size_t axis : {0U, 1U})
            add_receptance_peaks(out, d, scene, from, axis, result.model.notes);
    std::ranges::stable_sort(out.peaks, [](const auto &a, const auto &b) {
        return std::pair(a.receptance, a.direction) < std::pair(b.receptance, b.direction);
    });
    std::vector<double> infinite;
    for (const results::Receptance &receptance : out.receptances)
        for (const results::ReceptanceDirection &direction : receptance.directions)
            for (const double frequency : speeds_without_limit(frequencies, direction.amplitude))
                infinite.push_back(frequency);
    std::ranges::sort(infinite);
    infinite.erase(std::unique(infinite.begin(), infinite.end()), infinite.end());
    if (!infinite.empty())
        result.model.notes.emplace_back(
            model::Weight::warning,
            "receptances are unbounded at {}: a resonance without damping, "
            "or a rotor that is free to move",
            results::as::frequency.list(infinite));
}

} // namespace whirl::forced
