#pragma once

#include "tracking/mode_matching.h"

#include <vector>

namespace whirl::tracking {

constexpr int no_line = -1;

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

/// Modes to ask for between two nodes: as many as the larger one has.
[[nodiscard]] int wanted_of(const Node &a, const Node &b);

/// Modes of two nodes linked by their vectors, with the lines given for those of `a`.
[[nodiscard]] std::vector<Link> links_between(const Node &a, const Node &b,
                                              const std::vector<int> &lines);

/// The node at a speed between two others, with their lines.
[[nodiscard]] Node node_at(const modes::SpectrumSolver &solver, double speed, const Node &a,
                           const Node &b);

} // namespace whirl::tracking
