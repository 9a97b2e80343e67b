#include "modes/planar_whirl.h"

#include "assembly/planes.h"
#include "results/whirl.h"

#include <algorithm>
#include <utility>

namespace whirl::modes {

namespace {

bool parallel(const Eigen::VectorXcd &a, const Eigen::VectorXcd &b) {
    return std::abs(a.dot(b)) > 0.999 * a.norm() * b.norm();
}

} // namespace

void set_planar_whirl(WhirlMode &mode, std::complex<double> value, bool positive, double speed) {
    const bool forward = positive == (speed >= 0);
    mode.rotating_value = value;
    mode.whirl = forward ? results::Whirl::forward : results::Whirl::backward;
    mode.forward_fraction = forward ? 1 : 0;
}

Spectrum as_planar(Spectrum found, double speed) {
    std::vector<WhirlMode> planar;
    for (WhirlMode &mode : found.modes) {
        const assembly::Planes planes(mode.shape);
        const Eigen::VectorXcd with = planes.towards();
        const Eigen::VectorXcd against = planes.against().conjugate();
        const auto taken = [&](const Eigen::VectorXcd &w, std::complex<double> value) {
            return std::any_of(planar.begin(), planar.end(), [&](const WhirlMode &other) {
                return std::abs(other.rotating_value - value) <= 1e-7 * std::abs(value) &&
                       (other.rotating_value != 0.0 || other.whirl == mode.whirl) &&
                       parallel(other.shape, w);
            });
        };
        bool positive = with.norm() >= against.norm();
        if (taken(positive ? with : against,
                  positive ? mode.eigenvalue : std::conj(mode.eigenvalue)))
            positive = !positive;
        mode.shape = positive ? with : against;
        mode.left.resize(0);
        set_planar_whirl(mode, positive ? mode.eigenvalue : std::conj(mode.eigenvalue), positive,
                         speed);
        planar.push_back(std::move(mode));
    }
    found.modes = std::move(planar);
    return found;
}

} // namespace whirl::modes
