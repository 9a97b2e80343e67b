#include "model/bearing.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

namespace whirl::model {

namespace {

/// Turning a matrix into other axes and back leaves its entries some units in the last place off.
bool nothing(double difference, const Eigen::Matrix2d &a) {
    return std::abs(difference) <=
           8 * std::numeric_limits<double>::epsilon() * a.cwiseAbs().maxCoeff();
}

} // namespace

bool isotropic(const Eigen::Matrix2d &a) { return diagonal(a) && nothing(a(0, 0) - a(1, 1), a); }

bool rotation_invariant(const Eigen::Matrix2d &a) {
    return nothing(a(0, 0) - a(1, 1), a) && nothing(a(0, 1) + a(1, 0), a);
}

bool diagonal(const Eigen::Matrix2d &a) { return nothing(a(0, 1), a) && nothing(a(1, 0), a); }

bool symmetric(const Eigen::Matrix2d &a) { return nothing(a(0, 1) - a(1, 0), a); }

bool pushes_away(const Eigen::Matrix2d &k) {
    const double coupling = (k(0, 1) + k(1, 0)) / 2;
    const double least = k.trace() / 2 - std::hypot((k(0, 0) - k(1, 1)) / 2, coupling);
    return least < -1e-14 * k.cwiseAbs().maxCoeff(); // a share for rounding, as in nothing()
}

bool Bearing::has_mass() const {
    return std::ranges::any_of(rows,
                               [](const BearingCoefficients &row) { return !row.m.isZero(0); });
}

BearingCoefficients Bearing::at(double speed) const {
    if (!depends_on_speed() || speed <= speeds.front())
        return rows.front();
    if (speed >= speeds.back())
        return rows.back();
    const auto above = std::upper_bound(speeds.begin(), speeds.end(), speed);
    const auto i = static_cast<std::size_t>(std::distance(speeds.begin(), above));
    const double t = (speed - speeds[i - 1]) / (speeds[i] - speeds[i - 1]);
    const BearingCoefficients &a = rows[i - 1];
    const BearingCoefficients &b = rows[i];
    return {(1 - t) * a.k + t * b.k, (1 - t) * a.c + t * b.c, (1 - t) * a.m + t * b.m,
            (1 - t) * a.kt + t * b.kt, (1 - t) * a.ct + t * b.ct};
}

double Bearing::bend_between(double from, double to) const {
    const BearingCoefficients a = at(from);
    const BearingCoefficients b = at(to);
    double bend = 0;
    for (auto i = static_cast<std::size_t>(std::ranges::upper_bound(speeds, from) - speeds.begin());
         i < speeds.size() && speeds[i] < to; ++i) {
        const double t = (speeds[i] - from) / (to - from);
        for (const auto part : {&BearingCoefficients::k, &BearingCoefficients::c}) {
            const double size =
                std::max((a.*part).cwiseAbs().maxCoeff(), (b.*part).cwiseAbs().maxCoeff());
            const double gap =
                (rows[i].*part - (1 - t) * (a.*part) - t * (b.*part)).cwiseAbs().maxCoeff();
            bend = std::max(bend, gap > 0 ? gap / size : 0);
        }
    }
    return bend;
}

std::vector<double> Bearing::bends() const {
    constexpr double hardly = 1e-4;
    std::vector<double> out;
    for (std::size_t i = 0; i < speeds.size(); ++i)
        if (i == 0 || i + 1 == speeds.size() || bend_between(speeds[i - 1], speeds[i + 1]) > hardly)
            out.push_back(speeds[i]);
    return out;
}

} // namespace whirl::model
