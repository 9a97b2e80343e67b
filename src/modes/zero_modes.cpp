#include "modes/zero_modes.h"

#include "modes/free_motions.h"
#include "results/formulation.h"
#include "results/whirl.h"

#include <Eigen/Dense>

#include <cmath>

namespace whirl::modes {

namespace {

int rank(const Eigen::MatrixXd &A, double scale) {
    if (A.size() == 0 || scale == 0)
        return 0;
    const Eigen::JacobiSVD<Eigen::MatrixXd> svd(A);
    return static_cast<int>((svd.singularValues().array() > 1e-9 * scale).count());
}

/// Circular whirl, forward or backward, of a motion in x and the same in y, in a form's unknowns.
WhirlMode circular(const ZeroModes &zeros, Eigen::Index pair, results::Form form, bool forward) {
    WhirlMode mode;
    mode.whirl = forward ? results::Whirl::forward : results::Whirl::backward;
    mode.forward_fraction = forward ? 1 : 0;
    const std::complex<double> unit(0, 1);
    if (form == results::Form::planar) {
        mode.shape = zeros.motions.col(pair).cast<std::complex<double>>();
    } else {
        // y = -i x whirls forward; in hyperbolic form y stands for -i y.
        const std::complex<double> factor = form == results::Form::hyperbolic
                                                ? std::complex<double>(forward ? -1 : 1)
                                                : (forward ? -unit : unit);
        mode.shape = zeros.motions.col(2 * pair) + factor * zeros.motions.col(2 * pair + 1);
    }
    return mode;
}

/// Translations make a forward and a backward zero mode at any speed; of a tilt the forward one
/// gets a frequency by the spin, so the backward one stands first.
void make_modes(ZeroModes &zeros, results::Form form, int count) {
    const Eigen::Index pairs =
        form == results::Form::planar ? zeros.motions.cols() : zeros.motions.cols() / 2;
    for (int i = 0; i < count; ++i) {
        const Eigen::Index pair = i / 2;
        if (pair >= pairs) { // a motion free in one plane only
            WhirlMode line;
            line.shape = zeros.motions.col(zeros.motions.cols() - 1).cast<std::complex<double>>();
            zeros.modes.push_back(line);
            continue;
        }
        const bool translation = pair == 0 && pairs == 2;
        zeros.modes.push_back(circular(zeros, pair, form, (i % 2 == 0) == translation));
    }
}

} // namespace

ZeroModes zero_modes(const assembly::Discretization &discretization, results::Form form,
                     double bearing_speed, double spin_speed) {
    const FreeMotions free = free_motions(discretization, form, bearing_speed, spin_speed);
    ZeroModes out;
    out.motions = free.motions;
    const auto dimension = static_cast<int>(out.motions.cols());
    if (dimension == 0)
        return out;
    const Eigen::MatrixXd &damping = free.damping;
    const double scale = free.scale;
    const int rank_all = rank(damping, scale);
    out.eigenvalues = 2 * dimension - rank_all;
    int whirl_modes = out.eigenvalues;
    if (form == results::Form::hyperbolic)
        whirl_modes = out.eigenvalues / 2;
    if (form == results::Form::general) // a damped free motion creeps and does not whirl
        whirl_modes = dimension - rank_all + rank((damping - damping.transpose()) / 2, scale) / 2;
    make_modes(out, form, whirl_modes);
    return out;
}

} // namespace whirl::modes
