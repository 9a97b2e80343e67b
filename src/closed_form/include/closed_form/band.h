#pragma once

#include <optional>

namespace whirl::closed_form {

/// Open interval of spin speed (rad/s, or dimensionless where the caller is); no `to`: up to
/// infinity.
struct Band {
    double from = 0.0;
    std::optional<double> to;

    [[nodiscard]] bool contains(double speed) const { return speed > from && (!to || speed < *to); }
};

} // namespace whirl::closed_form
