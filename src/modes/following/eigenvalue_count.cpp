#include "linalg/check.h"
#include "modes/following/continuation.h"
#include "modes/following/winding.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <utility>
#include <vector>

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

bool none_missing(const SymmetricProblem &problem, const FollowedSpeed &a, double radius_a,
                  const FollowedSpeed &b, double radius_b, bool damped_a) try {
    constexpr double turn = 2 * std::numbers::pi;
    // Eigenvalues in conjugate pairs: one half of the circle is the image of the other.
    const CircleWay way =
        problem.conjugates() ? CircleWay{0, turn / 2, 12, false} : CircleWay{0.1, turn, 24, true};
    std::vector<double> sizes;
    for (const SymmetricPair &pair : a.pairs)
        sizes.push_back(std::abs(pair.value));
    const double known_in_a = circle_of_known(sizes, radius_a, radius_b);
    const linalg::Real4 speeds{a.speed, b.speed, a.speed, b.speed};
    const double share = damped_a ? 1 : 0;
    const linalg::Real4 damped{share, 1, share, 1};
    const auto phases = [&](const std::vector<double> &angles) {
        std::vector<double> out;
        for (std::size_t k = 0; k < angles.size(); k += 2) { // two angles in the lanes
            linalg::Complex4 z{};
            for (int lane = 0; lane < linalg::lanes; ++lane)
                z.set(lane, std::polar(lane % 2 == 0 ? known_in_a : radius_b,
                                       angles[std::min(k + lane / 2, angles.size() - 1)]));
            const auto at = problem.factorize(z, speeds, damped).determinant_phases();
            for (int lane = 0; lane < linalg::lanes && k + lane / 2 < angles.size(); lane += 2)
                out.push_back(without(problem, at[lane + 1], z.at(lane + 1), b.pairs) -
                              without(problem, at[lane], z.at(lane), a.pairs));
        }
        return out;
    };
    const std::optional<double> turned = winding(phases, way);
    return turned && std::abs(*turned) < way.length / 4;
} catch (const linalg::SolverError &) {
    return false; // a pivot that happens to be zero
}

double widest_gap(const FollowedSpeed &at, int wanted, bool whirling) {
    std::vector<std::pair<double, bool>> sizes; // and whether it counts
    for (const SymmetricPair &pair : at.pairs)
        sizes.emplace_back(std::abs(pair.value), !whirling || pair.whirls());
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
