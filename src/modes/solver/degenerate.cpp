#include "modes/solver/degenerate.h"

#include "modes/orbits.h"

#include <Eigen/Eigenvalues>

#include <cmath>

namespace whirl::modes {

namespace {

/// Closer than this, relative, eigenvalues are one: the solvers resolve some 1e-12.
constexpr double same = 1e-9;

/// Orthonormalises the deflections of the group, then diagonalises its mean orbit area.
void separate(const DeflectionsOf &deflections, const Stations &stations, bool real,
              WhirlMode *group, int size) {
    const auto points = static_cast<Eigen::Index>(stations.z().size());
    Eigen::MatrixXcd X(points, size);
    Eigen::MatrixXcd Y(points, size);
    for (int i = 0; i < size; ++i) {
        const auto [x, y] = deflections(group[i]);
        X.col(i) = x;
        Y.col(i) = y;
    }
    const std::complex<double> j(0, 1);
    const Eigen::VectorXd weights = stations.masses().cwiseSqrt();
    const Eigen::MatrixXcd with = weights.asDiagonal() * (X + j * Y) / 2.0;
    const Eigen::MatrixXcd against = weights.asDiagonal() * (X - j * Y) / 2.0;
    Eigen::MatrixXcd area = with.adjoint() * with - against.adjoint() * against;
    Eigen::MatrixXcd size2 = with.adjoint() * with + against.adjoint() * against;
    if (real) // shapes must stay real; both forms are real there
        for (Eigen::MatrixXcd *form : {&area, &size2})
            form->imag().setZero();
    const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXcd> eigen(area, size2);
    if (eigen.info() != Eigen::Success)
        return; // deflections that vanish at all stations: left as they are
    Eigen::MatrixXcd shapes(group[0].shape.size(), size);
    for (int i = 0; i < size; ++i)
        shapes.col(i) = group[i].shape;
    const Eigen::MatrixXcd turned = shapes * eigen.eigenvectors();
    for (int i = 0; i < size; ++i)
        group[i].shape = turned.col(i);
}

} // namespace

void separate_degenerate(const DeflectionsOf &deflections, const Stations &stations, bool real,
                         std::vector<WhirlMode> &modes) {
    std::size_t first = 0;
    for (std::size_t i = 1; i <= modes.size(); ++i) {
        const bool joined =
            i < modes.size() && std::abs(modes[i].eigenvalue - modes[i - 1].eigenvalue) <=
                                    same * std::abs(modes[i].eigenvalue);
        if (joined)
            continue;
        // Zero modes of free rotors come separated.
        if (i - first > 1 && modes[first].eigenvalue != 0.0)
            separate(deflections, stations, real, &modes[first], static_cast<int>(i - first));
        first = i;
    }
}

} // namespace whirl::modes
