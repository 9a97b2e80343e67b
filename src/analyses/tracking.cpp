#include "analyses/tracking.h"

#include <algorithm>
#include <tuple>

namespace whirl::analyses {

namespace {

/// An overlap above this cannot belong to two modes: overlaps of one mode with the orthogonal
/// modes of another speed sum to 1.
constexpr double sure = 0.7;
/// Below this it is no continuation at all.
constexpr double possible = 0.25;
constexpr int deepest = 8;

struct Matching {
    std::vector<int> to;
    bool ambiguous = false;
};

struct Snapshot {
    const Spectrum &spectrum;
    EnergyBasis basis;
};

bool is_zero(const Spectrum &spectrum, Eigen::Index i) {
    return spectrum.modes[static_cast<std::size_t>(i)].eigenvalue == 0.0;
}

/// Pairs in descending order of overlap; `important` bounds which ones must be sure.
Matching pair_up(const Snapshot &a, const Snapshot &b, int important) {
    Eigen::MatrixXd overlap = overlaps(a.basis, b.basis);
    // Zero modes of a free rotor differ in nothing but their order, which is always the same.
    for (Eigen::Index i = 0; i < std::min(overlap.rows(), overlap.cols()); ++i) {
        if (!is_zero(a.spectrum, i) || !is_zero(b.spectrum, i))
            break;
        overlap.row(i).setZero();
        overlap.col(i).setZero();
        overlap(i, i) = 1;
    }
    std::vector<std::tuple<double, Eigen::Index, Eigen::Index>> pairs;
    for (Eigen::Index i = 0; i < overlap.rows(); ++i)
        for (Eigen::Index j = 0; j < overlap.cols(); ++j)
            if (overlap(i, j) >= possible)
                pairs.emplace_back(-overlap(i, j), i, j);
    std::sort(pairs.begin(), pairs.end());
    Matching out{std::vector<int>(static_cast<std::size_t>(overlap.rows()), Line::absent), false};
    std::vector<bool> taken(static_cast<std::size_t>(overlap.cols()), false);
    std::vector<double> strength(out.to.size(), 0);
    for (const auto &[negative, i, j] : pairs) {
        auto &to = out.to[static_cast<std::size_t>(i)];
        if (to != Line::absent || taken[static_cast<std::size_t>(j)])
            continue;
        to = static_cast<int>(j);
        taken[static_cast<std::size_t>(j)] = true;
        strength[static_cast<std::size_t>(i)] = -negative;
    }
    for (std::size_t i = 0; i < out.to.size(); ++i) {
        const bool matters =
            static_cast<int>(i) < important || (out.to[i] != Line::absent && out.to[i] < important);
        out.ambiguous = out.ambiguous || (matters && strength[i] < sure);
    }
    for (std::size_t j = 0; j < taken.size() && static_cast<int>(j) < important; ++j)
        out.ambiguous = out.ambiguous || !taken[j];
    return out;
}

std::vector<int> follow(const SpectrumSolver &solver, const Snapshot &a, const Snapshot &b,
                        int important, int depth) {
    Matching direct = pair_up(a, b, important);
    if (!direct.ambiguous || depth == deepest)
        return direct.to;
    const double middle = (a.spectrum.speed + b.spectrum.speed) / 2;
    const auto wanted =
        static_cast<int>(std::max(a.spectrum.modes.size(), b.spectrum.modes.size()));
    const Spectrum between = solver.at(middle, wanted);
    const Snapshot mid{between, solver.energy_basis(between.modes)};
    const std::vector<int> first = follow(solver, a, mid, important, depth + 1);
    const std::vector<int> second = follow(solver, mid, b, important, depth + 1);
    std::vector<int> to(first.size(), Line::absent);
    for (std::size_t i = 0; i < first.size(); ++i)
        if (first[i] != Line::absent)
            to[i] = second[static_cast<std::size_t>(first[i])];
    return to;
}

} // namespace

std::vector<int> continuation(const SpectrumSolver &solver, const Spectrum &a, const Spectrum &b,
                              int important) {
    return follow(solver, {a, solver.energy_basis(a.modes)}, {b, solver.energy_basis(b.modes)},
                  important, 0);
}

std::vector<Line> track(const SpectrumSolver &solver, const std::vector<Spectrum> &spectra,
                        int important) {
    std::vector<Line> lines;
    std::vector<std::size_t> line_of; // of each mode of the last speed
    const auto begin_line = [&](std::size_t speed, int place) {
        Line line{std::vector<int>(spectra.size(), Line::absent)};
        line.place[speed] = place;
        lines.push_back(std::move(line));
        return lines.size() - 1;
    };
    for (std::size_t i = 0; i < spectra.front().modes.size(); ++i)
        line_of.push_back(begin_line(0, static_cast<int>(i)));
    EnergyBasis basis = solver.energy_basis(spectra.front().modes);
    for (std::size_t k = 1; k < spectra.size(); ++k) {
        EnergyBasis next = solver.energy_basis(spectra[k].modes);
        const Snapshot a{spectra[k - 1], std::move(basis)};
        const Snapshot b{spectra[k], std::move(next)};
        const std::vector<int> to = follow(solver, a, b, important, 0);
        std::vector<std::size_t> now(spectra[k].modes.size(), lines.max_size());
        for (std::size_t i = 0; i < to.size(); ++i) {
            if (to[i] == Line::absent)
                continue;
            now[static_cast<std::size_t>(to[i])] = line_of[i];
            lines[line_of[i]].place[k] = to[i];
        }
        for (std::size_t j = 0; j < now.size(); ++j)
            if (now[j] == lines.max_size())
                now[j] = begin_line(k, static_cast<int>(j));
        line_of = std::move(now);
        basis = b.basis;
    }
    return lines;
}

} // namespace whirl::analyses
