#include "criterion/form.h"

#include "linalg/check.h"
#include "model/errors.h"
#include "results/formulation.h"

#include <Eigen/Eigenvalues>
#include <Eigen/SVD>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace whirl::criterion {

namespace {

/// Columns: an orthonormal basis of the imbalances that move anything. Planes at one place make one
/// force; those of a rigid rotor a force and a moment, however many they are.
Eigen::MatrixXd range_of_planes(const std::vector<double> &z, double length, bool rigid) {
    const auto count = static_cast<Eigen::Index>(z.size());
    // Parts of the length that are one place: rounding of sums of segments.
    constexpr double one_place = 1e-11;
    Eigen::MatrixXd forces = Eigen::MatrixXd::Zero(count, rigid ? 2 : count);
    for (Eigen::Index i = 0; i < count; ++i) {
        const double at = z[static_cast<std::size_t>(i)];
        if (rigid) {
            forces.row(i) << 1, (at - length / 2) / length;
            continue;
        }
        const auto same = std::ranges::find_if(
            z, [&](double other) { return std::abs(other - at) <= one_place * length; });
        forces(i, same - z.begin()) = 1;
    }
    const Eigen::JacobiSVD<Eigen::MatrixXd> svd(forces, Eigen::ComputeFullU);
    const auto rank = (svd.singularValues().array() > one_place * svd.singularValues()(0)).count();
    if (rank == count)
        return Eigen::MatrixXd::Identity(count, count);
    return svd.matrixU().leftCols(rank);
}

} // namespace

BalanceForm::BalanceForm(const assembly::Discretization &rotor, results::Form form,
                         const std::vector<assembly::Combination> &places,
                         const std::vector<double> &z)
    : _receptance(rotor, form, places),
      _range(range_of_planes(z, rotor.rotor().shaft.length(), rotor.rigid())) {}

const Eigen::MatrixXcd &BalanceForm::at(double speed) {
    const auto found = _known.find(speed);
    if (found != _known.end())
        return found->second;
    for (const double nudge : {0.0, 1e-12, -1e-10}) {
        try {
            return _known[speed] = synchronous::hermitian_part(_receptance.at(speed * (1 + nudge)));
        } catch (const linalg::SolverError &) {
            continue;
        }
    }
    throw model::AnalysisFailure(model::Sentence(
        "no steady motion at or near {}: the rotor is free to move", model::as::speed(speed)));
}

Eigen::MatrixXcd BalanceForm::on_range(double speed) {
    const Eigen::MatrixXcd range = _range.cast<std::complex<double>>();
    const Eigen::MatrixXcd of_range = at(speed) * range;
    return range.adjoint() * of_range;
}

double BalanceForm::value(std::size_t plane, double speed) {
    const auto j = static_cast<Eigen::Index>(plane);
    if (j < _range.rows())
        return at(speed)(j, j).real();
    const Eigen::MatrixXcd form = on_range(speed);
    if (form.rows() == 1)
        return form(0, 0).real();
    return Eigen::SelfAdjointEigenSolver<Eigen::MatrixXcd>(form, Eigen::EigenvaluesOnly)
        .eigenvalues()
        .maxCoeff();
}

double BalanceForm::rounding(std::size_t plane, double speed) {
    const auto j = static_cast<Eigen::Index>(plane);
    if (j < _range.rows())
        return _receptance.rounding(speed, Eigen::VectorXcd::Unit(_range.rows(), j));
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXcd> solver(on_range(speed));
    return _receptance.rounding(speed, _range * solver.eigenvectors().rightCols<1>());
}

results::SignaturePoint BalanceForm::signature(double speed) {
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXcd> solver(on_range(speed));
    const Eigen::VectorXd &values = solver.eigenvalues();
    results::SignaturePoint point;
    point.speed = speed;
    point.eigenvalues.assign(values.data(), values.data() + values.size());
    point.negative = static_cast<int>((values.array() < 0).count());
    const double size = values.cwiseAbs().maxCoeff();
    point.relative = size > 0 ? values(values.size() - 1) / size : 0;
    Eigen::VectorXcd worst = _range * solver.eigenvectors().rightCols<1>();
    Eigen::Index largest = 0;
    worst.cwiseAbs().maxCoeff(&largest);
    if (std::abs(worst(largest)) > 0) // the largest imbalance at phase zero
        worst *= std::conj(worst(largest)) / std::abs(worst(largest));
    point.worst.assign(worst.data(), worst.data() + worst.size());
    point.eigenvalues.resize(static_cast<std::size_t>(_range.rows()), 0.0);
    std::ranges::sort(point.eigenvalues);
    return point;
}

} // namespace whirl::criterion
