#include "analyses/balance_form.h"

#include "linalg/check.h"
#include "model/errors.h"

#include <Eigen/Eigenvalues>
#include <Eigen/SVD>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace whirl::analyses {

namespace {

/// Columns: an orthonormal basis of the imbalances that move anything.
Eigen::MatrixXd range_of_places(const std::vector<assembly::Combination> &places, int size) {
    const auto count = static_cast<Eigen::Index>(places.size());
    Eigen::MatrixXd rows = Eigen::MatrixXd::Zero(count, size);
    for (std::size_t i = 0; i < places.size(); ++i)
        for (const auto &[unknown, value] : places[i])
            rows(static_cast<Eigen::Index>(i), unknown) += value;
    const Eigen::JacobiSVD<Eigen::MatrixXd> svd(rows * rows.transpose(), Eigen::ComputeFullU);
    const Eigen::VectorXd &values = svd.singularValues();
    const auto rank = (values.array() > 1e-12 * values(0)).count();
    if (rank == count)
        return Eigen::MatrixXd::Identity(count, count);
    return svd.matrixU().leftCols(rank);
}

} // namespace

BalanceForm::BalanceForm(const assembly::Discretization &rotor, Form form,
                         const std::vector<assembly::Combination> &places)
    : _receptance(rotor, form, places), _range(range_of_places(places, rotor.planar_size())) {}

const Eigen::MatrixXcd &BalanceForm::at(double speed) {
    const auto found = _known.find(speed);
    if (found != _known.end())
        return found->second;
    for (const double nudge : {0.0, 1e-12, -1e-10}) {
        try {
            return _known[speed] = hermitian_part(_receptance.at(speed * (1 + nudge)));
        } catch (const linalg::SolverError &) {
            continue;
        }
    }
    throw model::AnalysisFailure(fmt::format(
        "no steady motion at or beside {:.6g} rad/s: the rotor is free to move", speed));
}

double BalanceForm::plane(int index, double speed) { return at(speed)(index, index).real(); }

Eigen::MatrixXcd BalanceForm::on_range(double speed) {
    return _range.transpose() * at(speed) * _range;
}

double BalanceForm::joint(double speed) {
    const Eigen::MatrixXcd form = on_range(speed);
    if (form.rows() == 1)
        return form(0, 0).real();
    return Eigen::SelfAdjointEigenSolver<Eigen::MatrixXcd>(form, Eigen::EigenvaluesOnly)
        .eigenvalues()
        .maxCoeff();
}

SignaturePoint BalanceForm::signature(double speed) {
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXcd> solver(on_range(speed));
    const Eigen::VectorXd &values = solver.eigenvalues();
    SignaturePoint point;
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
    std::sort(point.eigenvalues.begin(), point.eigenvalues.end());
    return point;
}

} // namespace whirl::analyses
