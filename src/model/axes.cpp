#include "model/axes.h"

#include "model/bearing.h"

namespace whirl::model {

Eigen::Matrix2d without_rounding(const Eigen::Matrix2d &a) {
    const double mean = a.trace() / 2;
    if (isotropic(a))
        return mean * Eigen::Matrix2d::Identity();
    Eigen::Matrix2d out = a;
    if (diagonal(a)) {
        out(0, 1) = out(1, 0) = 0;
    } else if (symmetric(a)) {
        out(0, 1) = out(1, 0) = (a(0, 1) + a(1, 0)) / 2;
    } else if (rotation_invariant(a)) {
        const double across = (a(0, 1) - a(1, 0)) / 2;
        out << mean, across, -across, mean;
    }
    return out;
}

} // namespace whirl::model
