#include "modes/following/sorted_modes.h"

#include "results/whirl.h"

#include <algorithm>
#include <cmath>

namespace whirl::modes {

void sort_in(std::complex<double> value, WhirlMode mode, GeneralSpectrum::Modes &out) {
    const double size = std::abs(value);
    if (std::abs(value.imag()) > std::max(real_axis, 10 * mode.residual) * size) {
        out.modes.push_back(std::move(mode));
        return;
    }
    out.overdamped.push_back(value.real());
    if (value.real() > 10 * (mode.residual + mode.rounding) * size)
        out.growing.push_back(value.real());
}

void set_planar_whirl(WhirlMode &mode, std::complex<double> value, bool positive, double speed) {
    const bool forward = positive == (speed >= 0);
    mode.rotating_value = value;
    mode.whirl = forward ? results::Whirl::forward : results::Whirl::backward;
    mode.forward_fraction = forward ? 1 : 0;
}

} // namespace whirl::modes
