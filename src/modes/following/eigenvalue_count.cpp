#include "linalg/check.h"
#include "modes/following/continuation.h"
#include "modes/following/winding.h"
#include "modes/whirl_mode.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <utility>

namespace whirl::modes {

namespace {

/// Argument of det Q(z) without the eigenvalues given.
double without(const SymmetricProblem &problem, double phase, std::complex<double> z,
               const std::vector<SymmetricPair> &pairs) {
    for (const SymmetricPair &pair : pairs) {
        phase -= std::arg(z - pair.value);
        if (problem.conjugates() && pair.value.imag() != 0)
            phase -= std::arg(z - std::conj(pair.value));
    }
    return phase;
}

} // namespace

bool same_number(const SymmetricProblem &problem, const FollowedSpeed &a, double radius_a,
                 const FollowedSpeed &b, double radius_b, bool damped_a) try {
    constexpr double turn = 2 * std::numbers::pi;
    // Eigenvalues in conjugate pairs: one half of the circle is the image of the other.
    const CircleWay way =
        problem.conjugates() ? CircleWay{0, turn / 2, 6, false} : CircleWay{0.1, turn, 12, true};
    const linalg::Real4 speeds{a.speed, b.speed, a.speed, b.speed};
    const double share = damped_a ? 1 : 0;
    const linalg::Real4 damped{share, 1, share, 1};
    const auto phase = [&](double angle) {
        const std::complex<double> at_a = std::polar(radius_a, angle);
        const std::complex<double> at_b = std::polar(radius_b, angle);
        linalg::Complex4 z{};
        for (int lane = 0; lane < linalg::lanes; ++lane)
            z.set(lane, lane % 2 == 0 ? at_a : at_b);
        const auto phases = problem.factorize(z, speeds, damped).determinant_phases();
        return without(problem, phases[1], at_b, b.pairs) -
               without(problem, phases[0], at_a, a.pairs);
    };
    const std::optional<double> turned = winding(phase, way);
    return turned && std::abs(*turned) < way.length / 4;
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
