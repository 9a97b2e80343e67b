#include "tracking/mode_names.h"

#include "linalg/check.h"
#include "model/errors.h"
#include "process/progress.h"
#include "tracking/spectra.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace whirl::tracking {

namespace {

/// A mode to be named whose line comes in from beyond the modes computed: more would show more of
/// it.
bool comes_from_beyond(const Line &line, const std::vector<modes::Spectrum> &spectra,
                       const std::vector<char> &asked, const ModesToName &wanted) {
    if (line.absence.front() != Absence::beyond)
        return false;
    for (std::size_t k = 0; k < spectra.size(); ++k)
        if (asked[k] != 0 && line.place[k] != Line::absent &&
            wanted.which(spectra[k], static_cast<std::size_t>(line.place[k])))
            return true;
    return false;
}

} // namespace

ModeNames::ModeNames(const modes::SpectrumSolver &solver, const model::SpeedRange &range, int modes,
                     bool follow, const ModesToName &wanted)
    : _solver(&solver) {
    const std::vector<double> named_at = naming_speeds(range);
    const std::vector<double> nodes = followed_speeds(solver.discretization().rotor(), range);
    _speeds = nodes;
    for (const double speed : wanted.speeds) {
        const bool inside = speed >= named_at.front() && speed <= named_at.back();
        // Beyond standstill senses change their names.
        if (inside || (wanted.beyond_range && named_at.front() >= 0 && speed >= 0))
            _speeds.push_back(speed);
    }
    std::ranges::sort(_speeds);
    _speeds.erase(std::unique(_speeds.begin(), _speeds.end()), _speeds.end());
    std::vector<std::size_t> naming;
    std::vector<char> asked;
    for (std::size_t k = 0; k < _speeds.size(); ++k) {
        if (std::binary_search(named_at.begin(), named_at.end(), _speeds[k]))
            naming.push_back(k);
        asked.push_back(std::ranges::count(wanted.speeds, _speeds[k]) > 0);
    }
    Tracking tracking;
    int computed = modes + 2;
    std::optional<int> left = wanted.most_more;
    for (int attempt = 0; attempt < 4; ++attempt) {
        _spectra = spectra_alone(solver, _speeds, computed, follow);
        tracking = track(solver, _spectra, modes, left, nodes);
        if (left && attempt > 0)
            *left -= static_cast<int>(_speeds.size());
        if (tracking.cut_short || left.value_or(0) < 0)
            throw model::AnalysisFailure(
                "following the lines for mode names takes too many speeds");
        if (std::ranges::none_of(tracking.lines, [&](const Line &line) {
                return comes_from_beyond(line, _spectra, asked, wanted);
            }))
            break;
        computed += std::max(4, modes / 2);
    }
    _rates = tracking.rates;
    const std::vector<LineName> names = line_names(tracking.lines, _spectra, naming, modes);
    for (const modes::Spectrum &spectrum : _spectra)
        _names.emplace_back(spectrum.modes.size());
    for (std::size_t i = 0; i < names.size(); ++i)
        for (std::size_t k = 0; names[i].sure && k < _speeds.size(); ++k)
            if (const int place = tracking.lines[i].place[k]; place != Line::absent)
                _names[k][static_cast<std::size_t>(place)] = names[i].label;
}

std::optional<std::size_t> ModeNames::place_of(double speed) const {
    const auto found = std::lower_bound(_speeds.begin(), _speeds.end(), speed);
    if (found == _speeds.end() || *found != speed)
        return std::nullopt;
    return static_cast<std::size_t>(found - _speeds.begin());
}

const modes::Spectrum *ModeNames::at(double speed) const {
    const auto k = place_of(speed);
    return k ? &_spectra[*k] : nullptr;
}

std::string ModeNames::of(double speed, std::size_t place) const {
    const auto k = place_of(speed);
    return k && place < _names[*k].size() ? _names[*k][place] : "";
}

double ModeNames::away(std::size_t k, std::size_t place, const modes::WhirlMode &mode,
                       const Sought &sought) const {
    const double step = sought.speed - _speeds[k];
    const Eigen::VectorXcd &rates = step < 0 ? _rates[k].below : _rates[k].above;
    const std::complex<double> rate = rates(static_cast<Eigen::Index>(place));
    const bool known = std::isfinite(rate.real()) && std::isfinite(rate.imag());
    return std::abs(mode.eigenvalue + (known ? rate * step : 0.0) - sought.value);
}

std::string ModeNames::nearest(double solved, const Sought &sought) const {
    const auto k = place_of(solved);
    if (!k)
        return "";
    // A name is one of a few: eigenvalues that are off by that much decide it, unless two modes are
    // about as near, or one is about as near as it may be. These are refined.
    const double off = _solver->left_out() * std::abs(sought.value);
    const double rounding = (sought.speed == solved ? 1e-9 : 1e-4) * std::abs(sought.value);
    const std::vector<modes::WhirlMode> &modes = _spectra[*k].modes;
    std::vector<Candidate> near;
    for (std::size_t i = 0; i < modes.size(); ++i)
        if (const double distance = away(*k, i, modes[i], sought);
            sought.qualifies(modes[i]) && distance < sought.within + off)
            near.push_back({distance, of(solved, i), i});
    const auto best = [&near] { return *std::ranges::min_element(near, {}, &Candidate::away); };
    const auto clear_by = [&](double slack) {
        return std::ranges::all_of(near, [&](const Candidate &other) {
            return other.name == best().name ||
                   other.away - slack > sought.clear * (best().away + slack) + rounding;
        });
    };
    if (near.empty())
        return "";
    if (off > 0 && !(best().away + off < sought.within && clear_by(off))) {
        for (Candidate &candidate : near) {
            const std::vector<modes::WhirlMode> refined =
                _solver->near(solved, {modes[candidate.place]});
            if (refined.empty())
                return "";
            candidate.away = away(*k, candidate.place, refined.front(), sought);
        }
        std::erase_if(near, [&](const Candidate &of) { return !(of.away < sought.within); });
        if (near.empty())
            return "";
    }
    return clear_by(0) ? best().name : "";
}

std::optional<ModeNames> mode_names(const modes::SpectrumSolver &solver,
                                    const model::SpeedRange &range, int modes, bool follow,
                                    const ModesToName &wanted) {
    const process::Stage stage("names of modes", 0.9, 1.0);
    try {
        return ModeNames(solver, range, modes, follow, wanted);
    } catch (const model::AnalysisFailure &) { // no diagram, no names
    } catch (const linalg::SolverError &) {
    }
    return std::nullopt;
}

bool near_spin(const modes::Spectrum &spectrum, std::size_t place) {
    const std::complex<double> spin(0, std::abs(spectrum.speed));
    return std::abs(spectrum.modes[place].eigenvalue - spin) < resonant * spin.imag();
}

std::vector<std::string>
names_of_critical(const ModeNames &names,
                  const std::vector<results::CriticalSpeed> &critical_speeds) {
    const auto next = [&names](const results::CriticalSpeed &critical, const auto &qualifies) {
        const double speed = critical.speed;
        const std::complex<double> value(critical.real, std::abs(speed));
        // A mode at that speed is off its synchronous eigenvalue by the slope of its frequency over
        // the speed, well below 1, times its real part.
        const double within = 0.05 * value.imag() + 0.5 * std::abs(value.real());
        constexpr double clear = 2; // the next mode of this whirl must be twice as far away
        return names.nearest(speed, {speed, value, within, clear, qualifies});
    };
    std::vector<std::string> out;
    for (const results::CriticalSpeed &critical : critical_speeds)
        out.push_back(next(critical, [&critical](const modes::WhirlMode &mode) {
            return mode.whirl == critical.whirl;
        }));
    // Of nearly equal eigenvalues, and of orbits that are hardly open, neither list gives the
    // whirl.
    for (std::size_t i = 0; i < critical_speeds.size(); ++i) {
        if (!out[i].empty())
            continue;
        std::string any = next(critical_speeds[i], [](const modes::WhirlMode &) { return true; });
        if (std::ranges::find(out, any) == out.end())
            out[i] = std::move(any);
    }
    return out;
}

} // namespace whirl::tracking
