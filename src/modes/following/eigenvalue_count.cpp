#include "linalg/check.h"
#include "modes/following/continuation.h"
#include "modes/whirl_mode.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace whirl::modes {

bool same_number(const SymmetricProblem &problem, const FollowedSpeed &a, double radius_a,
                 const FollowedSpeed &b, double radius_b) try {
    constexpr double slow = 0.9; // an arc over which the ratio turns by more is halved
    constexpr double turn = 2 * std::numbers::pi;
    // Eigenvalues in conjugate pairs: one half of the circle is the image of the other.
    const double whole = problem.conjugates() ? turn / 2 : turn;
    const int arcs = problem.conjugates() ? 6 : 12;
    const double start = problem.conjugates() ? 0 : 0.1;
    EigenpairRefinement at_a(problem, a.speed);
    EigenpairRefinement at_b(problem, b.speed);
    const auto phase = [&](double angle) {
        return at_b.phase(std::polar(radius_b, angle), b.pairs) -
               at_a.phase(std::polar(radius_a, angle), a.pairs);
    };
    struct Arc {
        double from, to, phase_from, phase_to;
    };
    std::vector<Arc> open;
    const double first = phase(start);
    double last = first;
    for (int arc = 0; arc < arcs; ++arc) {
        const double end = start + whole * (arc + 1) / arcs;
        const bool closed = arc + 1 == arcs && !problem.conjugates();
        const double there = closed ? first : phase(end);
        open.push_back({start + whole * arc / arcs, end, last, there});
        last = there;
    }
    double winding = 0;
    while (!open.empty()) {
        const Arc arc = open.back();
        open.pop_back();
        const double change = std::remainder(arc.phase_to - arc.phase_from, turn);
        if (std::abs(change) <= slow) {
            winding += change;
            continue;
        }
        if (arc.to - arc.from < 1e-6)
            return false; // an eigenvalue on the circle
        const double middle = (arc.from + arc.to) / 2;
        const double there = phase(middle);
        open.push_back({arc.from, middle, arc.phase_from, there});
        open.push_back({middle, arc.to, there, arc.phase_to});
    }
    return std::abs(winding) < whole / 4;
} catch (const linalg::SolverError &) {
    return false; // a pivot that happens to be zero
}

double widest_gap(const FollowedSpeed &at, int wanted) {
    std::vector<std::pair<double, bool>> sizes; // with whirl or without
    for (const SymmetricPair &pair : at.pairs)
        sizes.emplace_back(std::abs(pair.value),
                           std::abs(pair.value.imag()) > real_axis * std::abs(pair.value));
    std::sort(sizes.begin(), sizes.end());
    double radius = 0;
    double widest = 1;
    int inside = 0;
    for (std::size_t i = 0; i + 1 < sizes.size(); ++i) {
        inside += sizes[i].second ? 1 : 0;
        const double ratio = sizes[i + 1].first / sizes[i].first;
        if (inside >= wanted && ratio > widest) {
            widest = ratio;
            radius = std::sqrt(sizes[i].first * sizes[i + 1].first);
        }
    }
    return radius;
}

} // namespace whirl::modes
