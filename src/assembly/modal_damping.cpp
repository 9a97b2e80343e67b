#include "assembly/modal_damping.h"

#include "assembly/assemble.h"
#include "linalg/check.h"
#include "linalg/definite_pair.h"
#include "model/errors.h"

#include <fmt/format.h>

#include <cmath>

namespace whirl::assembly {

namespace {

/// Stiffness and mass of one plane at rest.
struct PlaneAtRest {
    Eigen::SparseMatrix<double> K, M;
};

PlaneAtRest plane_at_rest(const Discretization &d, int direction) {
    std::vector<Eigen::Triplet<double>> K;
    std::vector<Eigen::Triplet<double>> M;
    const auto add = [&](Term term, int i, int j, double value) {
        if (term == Term::stiffness)
            K.emplace_back(i, j, value);
        if (term == Term::mass)
            M.emplace_back(i, j, value);
    };
    assemble_rotating_parts(
        d, [&](Term term, std::span<const int> unknowns, const Eigen::MatrixXd &block) {
            for_each_entry(unknowns, block,
                           [&](int i, int j, double value) { add(term, i, j, value); });
        });
    assemble_bearings(d, 0, [&](Term term, int i, int j, const Eigen::Matrix2d &block) {
        add(term, i, j, block(direction, direction));
    });
    const int n = d.planar_size();
    PlaneAtRest out{Eigen::SparseMatrix<double>(n, n), Eigen::SparseMatrix<double>(n, n)};
    out.K.setFromTriplets(K.begin(), K.end());
    out.M.setFromTriplets(M.begin(), M.end());
    return out;
}

struct Mode {
    double frequency = 0; ///< rad/s
    Eigen::VectorXd shape;
};

/// The lowest modes with a frequency, ascending, v^T M v = 1.
std::vector<Mode> modes_at_rest(const PlaneAtRest &plane, std::size_t wanted) {
    // A shift of the order of the frequencies: K alone is singular where the rotor is free.
    const double shift =
        1e-6 * plane.K.diagonal().cwiseAbs().maxCoeff() / plane.M.diagonal().cwiseAbs().maxCoeff();
    const linalg::DefinitePair pair(linalg::Matrix::from_sparse(plane.K + shift * plane.M),
                                    linalg::Matrix::from_sparse(plane.M));
    // Of a plane: bouncing and tilting of a free rotor, which have no frequency.
    constexpr int rigid_motions = 2;
    std::vector<Mode> out;
    for (const linalg::RealPair &found : pair.smallest(static_cast<int>(wanted) + rigid_motions)) {
        const double mass = found.vector.dot(plane.M * found.vector);
        const double square = found.vector.dot(plane.K * found.vector) / mass;
        // What rounding of K leaves of a motion that strains nothing is far below the shift.
        if (square > 1e-6 * shift && out.size() < wanted)
            out.push_back({std::sqrt(square), found.vector / std::sqrt(mass)});
    }
    return out;
}

} // namespace

ModalDamping make_modal_damping(const Discretization &discretization) {
    const std::vector<double> &ratios = discretization.rotor().shaft.modal_damping;
    ModalDamping out;
    for (int direction = 0; direction < 2; ++direction) {
        const PlaneAtRest plane = plane_at_rest(discretization, direction);
        const std::vector<Mode> modes = modes_at_rest(plane, ratios.size());
        if (modes.size() < ratios.size())
            throw model::BadInput(fmt::format(
                "shaft.modal_damping: expected at most as many ratios as the rotor has modes in a "
                "plane, {}, got {}",
                modes.size(), ratios.size()));
        const auto n = static_cast<Eigen::Index>(discretization.planar_size());
        Eigen::MatrixXd &C = out[static_cast<std::size_t>(direction)];
        C.setZero(n, n);
        for (std::size_t i = 0; i < modes.size(); ++i) {
            const Eigen::VectorXd momentum = plane.M * modes[i].shape;
            C += 2 * ratios[i] * modes[i].frequency * momentum * momentum.transpose();
        }
    }
    return out;
}

} // namespace whirl::assembly
