#include "tracking/line_errors.h"

#include "assembly/discretization.h"
#include "mesh_error/finer_model.h"
#include "mesh_error/shape_residual.h"
#include "results/formulation.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <iterator>
#include <limits>
#include <set>

namespace whirl::tracking {

namespace {

/// Fills the gaps of a list known at some places, linearly in the logarithm, constant outside.
void interpolate(std::vector<std::optional<double>> &values) {
    const double floor = std::numeric_limits<double>::min();
    std::vector<std::size_t> known;
    for (std::size_t k = 0; k < values.size(); ++k)
        if (values[k])
            known.push_back(k);
    if (known.empty())
        return;
    for (std::size_t k = 0; k < values.size(); ++k) {
        if (values[k])
            continue;
        const auto after = std::lower_bound(known.begin(), known.end(), k);
        if (after == known.begin() || after == known.end()) {
            values[k] = values[after == known.end() ? known.back() : known.front()];
            continue;
        }
        const std::size_t a = *(after - 1);
        const std::size_t b = *after;
        const double t = static_cast<double>(k - a) / static_cast<double>(b - a);
        values[k] = std::exp((1 - t) * std::log(std::max(*values[a], floor)) +
                             t * std::log(std::max(*values[b], floor)));
    }
}

/// Fills the gaps of a list known at some places by something that follows it everywhere: the ratio
/// of the two linearly in the logarithm, constant outside.
void carry(std::vector<std::optional<double>> &values, const std::vector<double> &follows) {
    const auto divide = [&](bool back) {
        for (std::size_t k = 0; k < values.size(); ++k)
            if (values[k] && follows[k] > 0)
                *values[k] *= back ? follows[k] : 1 / follows[k];
    };
    divide(false);
    interpolate(values);
    divide(true);
}

/// `of` at all places, evaluated until two neighbours differ by little; in between the larger of
/// both, so that errors are not understated.
/// @param of  of several places at once
std::vector<double>
along(std::size_t count,
      const std::function<std::vector<double>(const std::vector<std::size_t> &)> &of) {
    // An estimate costs a finer spectrum: every fourth speed to begin with.
    constexpr std::size_t stride = 4;
    // Ratio of errors that count as equal: within the safety factor of estimates, 1.25.
    constexpr double like = 1.2;
    std::vector<double> out(count);
    const auto ask = [&](const std::vector<std::size_t> &places) {
        const std::vector<double> found = of(places);
        for (std::size_t i = 0; i < places.size(); ++i)
            out[places[i]] = found[i];
    };
    std::vector<std::size_t> first;
    for (std::size_t k = 0; k < count; k += stride)
        first.push_back(k);
    if (first.back() + 1 < count)
        first.push_back(count - 1);
    ask(first);
    const std::function<void(std::size_t, std::size_t)> fill = [&](std::size_t a, std::size_t b) {
        if (b - a < 2)
            return;
        const double larger = std::max(out[a], out[b]);
        const std::size_t middle = (a + b) / 2;
        if (larger > like * std::min(out[a], out[b])) {
            ask({middle});
            fill(a, middle);
            fill(middle, b);
        } else {
            std::fill(out.begin() + static_cast<std::ptrdiff_t>(a) + 1,
                      out.begin() + static_cast<std::ptrdiff_t>(b), larger);
        }
    };
    for (std::size_t k = 0; k < count; k += stride)
        fill(k, std::min(k + stride, count - 1));
    return out;
}

/// By the shapes of the modes of a line, at some speeds; 1 where it has none there.
std::vector<double> residuals(const mesh_error::ShapeResidual &residual, const Line &line,
                              const std::vector<modes::Spectrum> &spectra,
                              const std::vector<std::size_t> &places) {
    std::vector<double> out(places.size(), 1.0);
    std::vector<std::size_t> with_mode;
    std::vector<mesh_error::ShapeResidual::At> at;
    for (std::size_t i = 0; i < places.size(); ++i) {
        const modes::Spectrum &spectrum = spectra[places[i]];
        if (const int place = line.place[places[i]]; place != Line::absent) {
            with_mode.push_back(i);
            at.push_back({&spectrum.modes[static_cast<std::size_t>(place)], spectrum.speed});
        }
    }
    const std::vector<double> found = residual.of(at);
    for (std::size_t i = 0; i < with_mode.size(); ++i)
        out[with_mode[i]] = found[i];
    return out;
}

/// The line has a mode there that is one of this mesh, not of a reduced rotor alone.
bool confirmed(const Line &line, const modes::Spectrum &spectrum, std::size_t k) {
    return line.place[k] != Line::absent &&
           spectrum.modes[static_cast<std::size_t>(line.place[k])].confirmed;
}

bool all_confirmed(const modes::Spectrum &spectrum) {
    return std::ranges::all_of(spectrum.modes,
                               [](const modes::WhirlMode &mode) { return mode.confirmed; });
}

void leave_confirmed(std::vector<std::optional<double>> &errors, const Line &line,
                     const std::vector<modes::Spectrum> &spectra) {
    for (std::size_t k = 0; k < spectra.size(); ++k)
        if (!confirmed(line, spectra[k], k))
            errors[k].reset();
}

/// Of the modes on lines, the finer ones found from them; infinite for others. None where they are
/// not found.
std::vector<double> refined_errors(const mesh_error::FinerModel &finer,
                                   const std::vector<Line> &lines, const modes::Spectrum &spectrum,
                                   std::size_t k) {
    std::vector<std::size_t> places;
    modes::Spectrum on_lines = spectrum;
    on_lines.modes.clear();
    for (const Line &line : lines)
        if (line.place[k] != Line::absent) {
            places.push_back(static_cast<std::size_t>(line.place[k]));
            on_lines.modes.push_back(spectrum.modes[places.back()]);
        }
    const std::vector<double> some = finer.errors_by_refinement(on_lines);
    if (some.empty())
        return {};
    std::vector<double> all(spectrum.modes.size(), std::numeric_limits<double>::infinity());
    for (std::size_t i = 0; i < places.size(); ++i)
        all[places[i]] = some[i];
    return all;
}

/// Motions of Hill's series so slow that those of a finer mesh are far away beside the aliases of
/// others, and take long to find.
bool many_terms(const modes::SpectrumSolver &solver, const modes::Spectrum &spectrum) {
    constexpr Eigen::Index many = 25; // terms of the series, each as large as the rotor
    return solver.form() == results::Form::hill && spectrum.speed != 0 &&
           std::ranges::any_of(spectrum.modes, [&](const modes::WhirlMode &mode) {
               return mode.rotating_vector.size() > many * solver.unknowns();
           });
}

/// The first speed after rest where all modes are confirmed and have few terms, or the end.
std::size_t slowest_probed(const modes::SpectrumSolver &solver,
                           const std::vector<modes::Spectrum> &spectra) {
    std::size_t k = 1;
    while (k < spectra.size() && (many_terms(solver, spectra[k]) || !all_confirmed(spectra[k])))
        ++k;
    return k;
}

} // namespace

LineErrors line_errors(const model::Rotor &rotor, const modes::SpectrumSolver &solver,
                       const std::vector<Line> &lines,
                       const std::vector<modes::Spectrum> &spectra) {
    LineErrors errors(lines.size());
    for (auto &list : errors)
        list.resize(spectra.size());
    const bool series = solver.form() == results::Form::hill; // cut off: an error of its own
    if (rotor.shaft.rigid && !series) {
        for (auto &list : errors)
            std::ranges::fill(list, 0.0);
        return errors;
    }
    const mesh_error::FinerModel finer(rotor, solver);
    // Of each mode the finer one can be found from it.
    const bool singly = solver.refines() || results::in_rotating_axes(solver.form());
    std::set<std::size_t> probes{0, spectra.size() / 2, spectra.size() - 1};
    if (const std::size_t slow = slowest_probed(solver, spectra); series && slow < spectra.size())
        probes.insert(slow); // not at rest: needs most harmonics
    const auto take = [&](std::size_t i, std::size_t k, const std::vector<double> &of_modes) {
        if (!of_modes.empty() && lines[i].place[k] != Line::absent)
            errors[i][k] = of_modes[static_cast<std::size_t>(lines[i].place[k])];
    };
    for (const std::size_t k : probes) {
        if (many_terms(solver, spectra[k]))
            continue;
        std::vector<double> all;
        if (singly && all_confirmed(spectra[k]))
            all = refined_errors(finer, lines, spectra[k], k);
        if (all.empty() && !series && all_confirmed(spectra[k]))
            all = finer.errors(spectra[k]);
        for (std::size_t i = 0; i < lines.size(); ++i)
            if (!all.empty())
                take(i, k, all);
            else if (confirmed(lines[i], spectra[k], k)) // alone, beside others that are not found
                take(i, k, refined_errors(finer, {lines[i]}, spectra[k], k));
    }
    const auto nothing_known = [&](std::size_t i) {
        return std::ranges::none_of(errors[i], &std::optional<double>::has_value);
    };
    // Lines that are at none of these speeds, or whose finer mode is not found there: at others.
    constexpr int tries = 4;
    for (std::size_t i = 0; series && i < lines.size(); ++i) {
        int left = tries;
        for (std::size_t k = spectra.size(); k-- > 0 && left > 0 && nothing_known(i);)
            if (probes.count(k) == 0 && confirmed(lines[i], spectra[k], k) &&
                !many_terms(solver, spectra[k])) {
                --left;
                take(i, k, refined_errors(finer, {lines[i]}, spectra[k], k));
            }
    }
    // Hill's series of a finer mesh is a large problem: only for lines of which nothing is known,
    // once a speed.
    std::vector<std::size_t> unknown;
    for (std::size_t i = 0; series && i < lines.size(); ++i)
        if (nothing_known(i))
            unknown.push_back(i);
    for (const std::size_t k : probes) {
        std::vector<std::size_t> here;
        std::ranges::copy_if(unknown, std::back_inserter(here),
                             [&](std::size_t i) { return confirmed(lines[i], spectra[k], k); });
        if (here.empty() || many_terms(solver, spectra[k]) || (k > 0 && spectra.front().speed == 0))
            continue;
        const std::vector<double> all = finer.errors(spectra[k]);
        for (const std::size_t i : here)
            take(i, k, all);
    }
    const mesh_error::ShapeResidual residual(solver.discretization(), solver.form());
    for (std::size_t i = 0; i < lines.size(); ++i) {
        if (series || probes.size() < spectra.size())
            carry(errors[i], along(spectra.size(), [&](const std::vector<std::size_t> &places) {
                      return series ? std::vector<double>(places.size(), 1.0)
                                    : residuals(residual, lines[i], spectra, places);
                  }));
        leave_confirmed(errors[i], lines[i], spectra);
    }
    return errors;
}

} // namespace whirl::tracking
