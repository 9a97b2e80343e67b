#include "analyses/zero_modes.h"

#include "elements/section.h"

#include <Eigen/Dense>

#include <cmath>
#include <numbers>

namespace whirl::analyses {

namespace {

/// Translation and tilt about the origin as columns; in real form for x, then for y.
Eigen::MatrixXd rigid_motions(const assembly::Discretization &d, bool planar) {
    const int n = d.planar_size();
    Eigen::MatrixXd R = Eigen::MatrixXd::Zero(planar ? n : 2 * n, planar ? 2 : 4);
    for (int tilt = 0; tilt < 2; ++tilt) {
        const std::vector<double> motion = d.rigid_motion(tilt == 1);
        for (int i = 0; i < n; ++i) {
            const double value = motion[static_cast<std::size_t>(i)];
            if (planar) {
                R(i, tilt) = value;
            } else {
                R(2 * i, tilt) = value;
                R(2 * i + 1, 2 + tilt) = value;
            }
        }
    }
    return R;
}

int rank(const Eigen::MatrixXd &A, double scale) {
    if (A.size() == 0)
        return 0;
    Eigen::JacobiSVD<Eigen::MatrixXd> svd(A);
    return static_cast<int>((svd.singularValues().array() > 1e-9 * scale).count());
}

} // namespace

ZeroModes zero_modes(const assembly::Discretization &discretization, bool planar,
                     const linalg::Matrix &D, const linalg::Matrix &K) {
    Eigen::MatrixXd R = rigid_motions(discretization, planar);
    // Unit columns in the scale of the stiffness each one meets: below this much of what rounding
    // leaves of the sums, a support is no support.
    const Eigen::MatrixXd absR = R.cwiseAbs();
    const Eigen::MatrixXd entries = absR.transpose() * (K.view().cwiseAbs() * absR);
    const Eigen::VectorXd scale = entries.diagonal().cwiseSqrt().cwiseMax(1e-300);
    R = R * scale.cwiseInverse().asDiagonal();
    const Eigen::MatrixXd reduced = R.transpose() * (K.view() * R);
    const Eigen::JacobiSVD<Eigen::MatrixXd> svd(reduced, Eigen::ComputeFullV);
    const auto dimension = (svd.singularValues().array() < 1e-13).count();
    ZeroModes out;
    if (dimension == 0)
        return out;
    out.motions = R * svd.matrixV().rightCols(dimension);
    const Eigen::MatrixXd damping = out.motions.transpose() * (D.view() * out.motions);
    const double size = std::max(
        (out.motions.cwiseAbs().transpose() * (D.view().cwiseAbs() * out.motions.cwiseAbs()))
            .norm(),
        1e-300);
    const int rank_all = rank(damping, size);
    out.eigenvalues = 2 * static_cast<int>(dimension) - rank_all;
    out.whirl_modes = out.eigenvalues;
    if (!planar) {
        const int rank_skew = rank((damping - damping.transpose()) / 2, size);
        out.whirl_modes = static_cast<int>(dimension) - rank_all + rank_skew / 2;
    }
    return out;
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
