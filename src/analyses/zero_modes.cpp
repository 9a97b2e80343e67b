#include "analyses/zero_modes.h"

#include "elements/section.h"

#include <Eigen/Dense>

#include <cmath>
#include <numbers>

namespace whirl::analyses {

namespace {

/// Translation and tilt about the centre of mass as columns, over the unknowns of one plane.
Eigen::MatrixXd planar_motions(const assembly::Discretization &d, const Eigen::VectorXd &Mt,
                               int stride) {
    const int n = d.planar_size();
    Eigen::MatrixXd R(n, 2);
    for (int tilt = 0; tilt < 2; ++tilt)
        R.col(tilt) = Eigen::Map<const Eigen::VectorXd>(d.rigid_motion(tilt == 1).data(), n);
    const Eigen::VectorXd weights = Mt(Eigen::seqN(0, n, stride));
    R.col(1) -= R.col(0) * (weights.dot(R.col(1)) / weights.dot(R.col(0)));
    return R;
}

/// The same in real form, for x (plane 0) or y (plane 1).
Eigen::MatrixXd in_plane(const Eigen::MatrixXd &planar, int plane) {
    Eigen::MatrixXd R = Eigen::MatrixXd::Zero(2 * planar.rows(), planar.cols());
    R(Eigen::seqN(plane, planar.rows(), 2), Eigen::all) = planar;
    return R;
}

/// The combinations of the columns of R that K does not resist: singular values below what
/// rounding leaves of the sums of its entries.
Eigen::MatrixXd free_combinations(const linalg::Matrix &K, const Eigen::MatrixXd &R) {
    const Eigen::MatrixXd absR = R.cwiseAbs();
    const Eigen::MatrixXd entries = absR.transpose() * (K.view().cwiseAbs() * absR);
    const Eigen::VectorXd scale = entries.diagonal().cwiseSqrt().cwiseMax(1e-300);
    const Eigen::MatrixXd unit = R * scale.cwiseInverse().asDiagonal();
    const Eigen::JacobiSVD<Eigen::MatrixXd> svd(unit.transpose() * (K.view() * unit),
                                                Eigen::ComputeFullV);
    const auto dimension = (svd.singularValues().array() < 1e-13).count();
    if (dimension == R.cols())
        return R;
    return unit * svd.matrixV().rightCols(dimension);
}

int rank(const Eigen::MatrixXd &A, double scale) {
    const Eigen::JacobiSVD<Eigen::MatrixXd> svd(A);
    return static_cast<int>((svd.singularValues().array() > 1e-9 * scale).count());
}

/// Columns of x and y in turn where both planes are free alike, else whatever is free.
Eigen::MatrixXd real_motions(const linalg::Matrix &K, const Eigen::MatrixXd &planar) {
    const Eigen::MatrixXd x = free_combinations(K, in_plane(planar, 0));
    const Eigen::MatrixXd y = free_combinations(K, in_plane(planar, 1));
    Eigen::MatrixXd both(2 * planar.rows(), 2 * planar.cols());
    both << in_plane(planar, 0), in_plane(planar, 1);
    const Eigen::MatrixXd all = free_combinations(K, both);
    if (x.cols() != y.cols() || x.cols() + y.cols() != all.cols())
        return all;
    Eigen::MatrixXd out(x.rows(), 2 * x.cols());
    for (Eigen::Index i = 0; i < x.cols(); ++i) {
        // The same motion in the other plane (the basis may differ by a sign or a turn).
        out.col(2 * i) = x.col(i);
        out.col(2 * i + 1).setZero();
        out(Eigen::seqN(1, planar.rows(), 2), 2 * i + 1) = x(Eigen::seqN(0, planar.rows(), 2), i);
    }
    return out;
}

/// Circular whirl, forward or backward, of a motion in x and the same in y, in a form's unknowns.
WhirlMode circular(const ZeroModes &zeros, Eigen::Index pair, Form form, bool forward) {
    WhirlMode mode;
    mode.whirl = forward ? Whirl::forward : Whirl::backward;
    mode.forward_fraction = forward ? 1 : 0;
    const std::complex<double> unit(0, 1);
    if (form == Form::planar) {
        mode.shape = zeros.motions.col(pair).cast<std::complex<double>>();
    } else {
        // y = -i x whirls forward; in hyperbolic form y stands for -i y.
        const std::complex<double> factor = form == Form::hyperbolic
                                                ? std::complex<double>(forward ? -1 : 1)
                                                : (forward ? -unit : unit);
        mode.shape = zeros.motions.col(2 * pair) + factor * zeros.motions.col(2 * pair + 1);
    }
    return mode;
}

/// Translations make a forward and a backward zero mode at any speed; of a tilt the forward one
/// gets a frequency by the spin, so the backward one stands first.
void make_modes(ZeroModes &zeros, Form form, int count) {
    const Eigen::Index pairs =
        form == Form::planar ? zeros.motions.cols() : zeros.motions.cols() / 2;
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

ZeroModes zero_modes(const assembly::Discretization &discretization, Form form,
                     const linalg::Matrix &M, const linalg::Matrix &D, const linalg::Matrix &K) {
    const bool planar = form == Form::planar;
    const int n = discretization.planar_size();
    Eigen::VectorXd translation = Eigen::VectorXd::Zero(M.size());
    translation(Eigen::seqN(0, n, planar ? 1 : 2)) =
        Eigen::Map<const Eigen::VectorXd>(discretization.rigid_motion(false).data(), n);
    const Eigen::MatrixXd R =
        planar_motions(discretization, M.view() * translation, planar ? 1 : 2);
    ZeroModes out;
    out.motions = planar ? free_combinations(K, R) : real_motions(K, R);
    const auto dimension = static_cast<int>(out.motions.cols());
    if (dimension == 0)
        return out;
    const Eigen::MatrixXd damping = out.motions.transpose() * (D.view() * out.motions);
    const Eigen::MatrixXd size = out.motions.cwiseAbs();
    const double scale = std::max((size.transpose() * (D.view().cwiseAbs() * size)).norm(), 1e-300);
    const int rank_all = rank(damping, scale);
    out.eigenvalues = 2 * dimension - rank_all;
    int whirl_modes = out.eigenvalues;
    if (form == Form::hyperbolic)
        whirl_modes = out.eigenvalues / 2;
    if (form == Form::general) // a damped free motion creeps and does not whirl
        whirl_modes = dimension - rank_all + rank((damping - damping.transpose()) / 2, scale) / 2;
    make_modes(out, form, whirl_modes);
    return out;
}

double support_scale(const assembly::Discretization &d) {
    double stiffness = 0;
    for (const model::Bearing &bearing : d.rotor().bearings)
        stiffness += bearing.at(0).k.trace() / 2;
    double mass = 0;
    for (const mesh::Span &span : d.shaft_mesh().spans)
        mass += elements::beam_of(d.rotor().shaft, span).at(0.5).rhoA * span.length;
    for (const model::Disc &disc : d.rotor().discs)
        mass += disc.mass;
    const double scale = std::sqrt(std::max(stiffness, 0.0) / mass);
    // Rigid supports say nothing about a flexible rotor.
    const bool telling = scale > 0 && (d.rigid() || scale < elastic_scale(d));
    return telling ? scale : elastic_scale(d);
}

double elastic_scale(const assembly::Discretization &d) {
    double EI = 0;
    double mass = 0;
    for (const mesh::Span &span : d.shaft_mesh().spans) {
        const elements::Section mid = elements::beam_of(d.rotor().shaft, span).at(0.5);
        EI += mid.EI * span.length;
        mass += mid.rhoA * span.length;
    }
    for (const model::Disc &disc : d.rotor().discs)
        mass += disc.mass;
    const double L = d.rotor().shaft.length();
    return std::pow(std::numbers::pi / L, 2) * std::sqrt(EI / mass);
}

} // namespace whirl::analyses
