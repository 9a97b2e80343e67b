#include "tracking/crossing_nodes.h"

#include <algorithm>

namespace whirl::tracking {

int wanted_of(const Node &a, const Node &b) {
    return static_cast<int>(
        std::max(a.snapshot.spectrum.modes.size(), b.snapshot.spectrum.modes.size()));
}

std::vector<Link> links_between(const Node &a, const Node &b, const std::vector<int> &lines) {
    const auto count = static_cast<int>(lines.size());
    Matching matching = match_by_vectors(a.snapshot, b.snapshot, count);
    if (matching.ambiguous)
        matching = match_by_groups(a.snapshot, b.snapshot);
    std::vector<Link> out;
    for (std::size_t i = 0; i < matching.to.size(); ++i)
        if (matching.to[i] != Matching::none && lines[i] != no_line)
            out.push_back({i, static_cast<std::size_t>(matching.to[i]), lines[i]});
    return out;
}

Node node_at(const modes::SpectrumSolver &solver, double speed, const Node &a, const Node &b) {
    modes::Spectrum spectrum = solver.at(speed, wanted_of(a, b));
    modes::ModeBasis basis = solver.basis(spectrum);
    Node node{{std::move(spectrum), std::move(basis)}, {}};
    node.lines.assign(node.snapshot.spectrum.modes.size(), no_line);
    for (const Link &link : links_between(b, node, b.lines))
        node.lines[link.to] = link.line;
    for (const Link &link : links_between(a, node, a.lines))
        node.lines[link.to] = link.line;
    return node;
}

} // namespace whirl::tracking
