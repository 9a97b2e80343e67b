#pragma once

#include "tracking/mode_matching.h"
#include "tracking/tracking.h"

#include <cstddef>
#include <map>
#include <optional>
#include <vector>

namespace whirl::tracking {

constexpr int no_line = -1; ///< no line has this number

/// A spectrum with the line of each of its modes.
struct Node {
    Snapshot snapshot;
    std::vector<int> lines;
};

/// Two modes that continue each other from one node to the next.
struct Link {
    std::size_t from, to;
    int line;
};

[[nodiscard]] inline const modes::WhirlMode &mode_at(const Node &node, std::size_t place) {
    return node.snapshot.spectrum.modes[place];
}

/// Place of a line at a node; none where it is not there.
[[nodiscard]] std::optional<std::size_t> place_of(const Node &node, int line);

/// Modes to ask for between two nodes: as many as the larger one has.
[[nodiscard]] int wanted_of(const Node &a, const Node &b);

/// Modes of two nodes linked by their vectors, with the lines given for those of `a`.
[[nodiscard]] std::vector<Link> links_between(const Node &a, const Node &b,
                                              const std::vector<int> &lines);

/// The node at a speed between two others, with their lines.
[[nodiscard]] Node node_at(const modes::SpectrumSolver &solver, double speed, const Node &a,
                           const Node &b);

/// The speeds of a sweep as nodes.
class SweepNodes {
  public:
    SweepNodes(const modes::SpectrumSolver &solver, const Tracking &tracking,
               const std::vector<modes::Spectrum> &spectra)
        : _solver(solver), _tracking(tracking), _spectra(spectra) {}

    [[nodiscard]] std::size_t count() const { return _spectra.size(); }
    [[nodiscard]] double speed(std::size_t k) const { return _spectra[k].speed; }
    [[nodiscard]] const modes::Spectrum &spectrum(std::size_t k) const { return _spectra[k]; }
    [[nodiscard]] const std::vector<Line> &lines() const { return _tracking.lines; }
    [[nodiscard]] const Rates &rates(std::size_t k) const { return _tracking.rates[k]; }
    [[nodiscard]] const modes::SpectrumSolver &solver() const { return _solver; }

    /// Without the vectors of its modes.
    [[nodiscard]] Node bare(std::size_t k) const;
    [[nodiscard]] Node full(std::size_t k) const;
    /// Lines that are there at a speed and at the next.
    [[nodiscard]] std::vector<Link> links(std::size_t k) const;

  private:
    const modes::SpectrumSolver &_solver;
    const Tracking &_tracking;
    const std::vector<modes::Spectrum> &_spectra;
    mutable std::map<std::size_t, modes::ModeBasis> _bases; ///< of speeds asked for last

    [[nodiscard]] std::vector<int> lines_at(std::size_t k) const;
};

} // namespace whirl::tracking
