#include "analyses/crossings.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace whirl::analyses {

namespace {

/// Frequency minus a multiple of the spin speed along one line between two grid speeds.
class Gap {
  public:
    Gap(const SpectrumSolver &solver, const Spectrum &from, int place, double multiple)
        : _solver(solver), _multiple(multiple), _wanted(static_cast<int>(from.modes.size())),
          _near(solver.energy_basis({from.modes[static_cast<std::size_t>(place)]})) {}

    /// The mode at this speed that overlaps most with the one last looked at.
    double operator()(double speed) {
        const Spectrum spectrum = _solver.at(speed, _wanted);
        const EnergyBasis basis = _solver.energy_basis(spectrum.modes);
        Eigen::Index best = 0;
        overlaps(_near, basis).row(0).maxCoeff(&best);
        const WhirlMode &mode = spectrum.modes[static_cast<std::size_t>(best)];
        _near = _solver.energy_basis({mode});
        return mode.eigenvalue.imag() - _multiple * speed;
    }

  private:
    const SpectrumSolver &_solver;
    double _multiple;
    int _wanted;
    EnergyBasis _near;
};

/// Root of a function that changes sign between a and b, by the Illinois form of false position
/// (Dowell and Jarratt 1971), which keeps the bracket.
template <class Function>
double bracketed_root(Function &&f, double a, double fa, double b, double fb) {
    const double tolerance = 1e-11 * std::max(std::abs(a), std::abs(b));
    double last = a;
    for (int step = 0; step < 60; ++step) {
        const double c = (a * fb - b * fa) / (fb - fa);
        if (std::abs(c - last) <= tolerance || std::abs(b - a) <= tolerance)
            return c;
        const double fc = f(c);
        if (fc == 0)
            return c;
        if ((fc > 0) != (fb > 0)) {
            a = b;
            fa = fb;
        } else {
            fa /= 2;
        }
        b = c;
        fb = fc;
        last = c;
    }
    return b;
}

/// Where a frequency that equals the multiple at `locked` (an asymmetric rotor holds it there over
/// a band of speeds) leaves it on the way to `free`.
double end_of_lock(Gap &&gap, double locked, double free) {
    for (int step = 0; step < 60 && std::abs(free - locked) > 1e-11 * std::abs(free); ++step) {
        const double middle = (free + locked) / 2;
        (gap(middle) == 0 ? locked : free) = middle;
    }
    return locked;
}

std::optional<double> frequency_at(const Line &line, const std::vector<Spectrum> &spectra,
                                   std::size_t k) {
    if (line.place[k] == Line::absent)
        return std::nullopt;
    const double f = spectra[k].modes[static_cast<std::size_t>(line.place[k])].eigenvalue.imag();
    return f > 0 ? std::optional(f) : std::nullopt;
}

/// Speeds at which one line crosses a multiple of the spin speed; of a band of speeds over which it
/// stays there the two ends.
std::vector<double> crossings_of(const SpectrumSolver &solver, const Line &line,
                                 const std::vector<Spectrum> &spectra, double multiple) {
    std::vector<double> out;
    const auto gap_from = [&](std::size_t k) {
        return Gap(solver, spectra[k], line.place[k], multiple);
    };
    std::optional<double> before; // gap at the speed before, where the line has one
    for (std::size_t k = 0; k < spectra.size(); ++k) {
        const double speed = spectra[k].speed;
        const auto frequency = frequency_at(line, spectra, k);
        if (!frequency) {
            before.reset();
            continue;
        }
        const double here = *frequency - multiple * speed;
        if (!before) {
            if (here == 0)
                out.push_back(speed);
        } else if (*before == 0 && here != 0) {
            const double end = end_of_lock(gap_from(k - 1), spectra[k - 1].speed, speed);
            if (out.empty() || end - out.back() > 1e-9 * std::abs(end)) // no mere crossing
                out.push_back(end);
        } else if (*before != 0 && here == 0) {
            out.push_back(end_of_lock(gap_from(k), speed, spectra[k - 1].speed));
        } else if ((*before > 0) != (here > 0)) {
            out.push_back(
                bracketed_root(gap_from(k - 1), spectra[k - 1].speed, *before, speed, here));
        }
        before = here;
    }
    return out;
}

} // namespace

std::vector<Crossing> crossings(const SpectrumSolver &solver, const std::vector<Line> &lines,
                                const std::vector<Spectrum> &spectra,
                                const std::vector<double> &multiples) {
    std::vector<Crossing> out;
    for (const double multiple : multiples) {
        const std::size_t first = out.size();
        for (std::size_t i = 0; i < lines.size(); ++i)
            for (const double speed : crossings_of(solver, lines[i], spectra, multiple))
                out.push_back({multiple, speed, multiple * speed, static_cast<int>(i)});
        std::sort(out.begin() + static_cast<std::ptrdiff_t>(first), out.end(),
                  [](const Crossing &a, const Crossing &b) { return a.speed < b.speed; });
    }
    return out;
}

} // namespace whirl::analyses
