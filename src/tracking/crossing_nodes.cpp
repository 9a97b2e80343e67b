#include "tracking/crossing_nodes.h"

#include <algorithm>

namespace whirl::tracking {

std::optional<std::size_t> place_of(const Node &node, int line) {
    const auto found = std::ranges::find(node.lines, line);
    if (found == node.lines.end())
        return std::nullopt;
    return static_cast<std::size_t>(found - node.lines.begin());
}

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

std::vector<int> SweepNodes::lines_at(std::size_t k) const {
    std::vector<int> out(_spectra[k].modes.size(), no_line);
    for (std::size_t line = 0; line < _tracking.lines.size(); ++line)
        if (_tracking.lines[line].place[k] != Line::absent)
            out[static_cast<std::size_t>(_tracking.lines[line].place[k])] = static_cast<int>(line);
    return out;
}

Node SweepNodes::bare(std::size_t k) const {
    modes::ModeBasis basis;
    basis.rate_below = _tracking.rates[k].below;
    basis.rate_above = _tracking.rates[k].above;
    return {{_spectra[k], std::move(basis)}, lines_at(k)};
}

Node SweepNodes::full(std::size_t k) const {
    constexpr std::size_t most = 8; // the ends of a step are asked for again and again
    auto known = _bases.find(k);
    if (known == _bases.end()) {
        if (_bases.size() >= most)
            _bases.clear();
        known = _bases.emplace(k, _solver.basis(_spectra[k])).first;
    }
    return {{_spectra[k], known->second}, lines_at(k)};
}

std::vector<Link> SweepNodes::links(std::size_t k) const {
    std::vector<Link> out;
    for (std::size_t line = 0; line < _tracking.lines.size(); ++line) {
        const int a = _tracking.lines[line].place[k];
        const int b = _tracking.lines[line].place[k + 1];
        if (a != Line::absent && b != Line::absent)
            out.push_back(
                {static_cast<std::size_t>(a), static_cast<std::size_t>(b), static_cast<int>(line)});
    }
    return out;
}

} // namespace whirl::tracking
