#include "tracking/crossing_nodes.h"

#include <algorithm>
#include <cmath>
#include <complex>

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

namespace {

/// Rates that no eigenvector gives: of the parabola through the line at this node and at those on
/// both sides.
void add_slopes(const Node &a, const Node &b, Node &node) {
    const auto speed = [](const Node &of) { return of.snapshot.spectrum.speed; };
    const double before = speed(node) - speed(a);
    const double behind = speed(b) - speed(node);
    for (std::size_t i = 0; i < node.lines.size(); ++i) {
        const std::optional<std::size_t> from = place_of(a, node.lines[i]);
        const std::optional<std::size_t> to = place_of(b, node.lines[i]);
        if (node.lines[i] == no_line || !from || !to)
            continue;
        const std::complex<double> here = mode_at(node, i).eigenvalue;
        const std::complex<double> slope =
            (behind / before * (here - mode_at(a, *from).eigenvalue) +
             before / behind * (mode_at(b, *to).eigenvalue - here)) /
            (before + behind);
        modes::ModeBasis &basis = node.snapshot.basis;
        for (Eigen::VectorXcd *rates : {&basis.rate_below, &basis.rate_above})
            if (const auto place = static_cast<Eigen::Index>(i);
                !std::isfinite((*rates)(place).real()))
                (*rates)(place) = slope;
    }
}

} // namespace

Node node_at(const modes::SpectrumSolver &solver, double speed, const Node &a, const Node &b) {
    modes::Spectrum spectrum = solver.at(speed, wanted_of(a, b));
    modes::ModeBasis basis = solver.basis(spectrum);
    Node node{{std::move(spectrum), std::move(basis)}, {}};
    node.lines.assign(node.snapshot.spectrum.modes.size(), no_line);
    for (const Link &link : links_between(b, node, b.lines))
        node.lines[link.to] = link.line;
    for (const Link &link : links_between(a, node, a.lines))
        node.lines[link.to] = link.line;
    add_slopes(a, b, node);
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
        known->second.rate_below = _tracking.rates[k].below; // slopes of lines too
        known->second.rate_above = _tracking.rates[k].above;
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
