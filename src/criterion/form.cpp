#include "criterion/form.h"

#include "criterion/sign_changes.h"
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

/// The same imbalances along both axes of the rotor.
Eigen::MatrixXd along_both_axes(const Eigen::MatrixXd &range) {
    Eigen::MatrixXd out = Eigen::MatrixXd::Zero(2 * range.rows(), 2 * range.cols());
    for (Eigen::Index i = 0; i < range.rows(); ++i)
        for (Eigen::Index j = 0; j < range.cols(); ++j)
            out(2 * i, 2 * j) = out(2 * i + 1, 2 * j + 1) = range(i, j);
    return out;
}

} // namespace

BalanceForm::BalanceForm(const assembly::Discretization &rotor, results::Form form,
                         const std::vector<assembly::Combination> &places,
                         const std::vector<double> &z, int harmonics)
    : _receptance(rotor, form, places, harmonics), _a_place(synchronous::imbalances_a_place(form)) {
    const auto planes = static_cast<Eigen::Index>(z.size());
    for (Eigen::Index j = 0; j < planes; ++j)
        _ranges.emplace_back(Eigen::MatrixXd::Identity(planes, planes).middleCols(j, 1));
    _ranges.push_back(range_of_planes(z, rotor.rotor().shaft.length(), rotor.rigid()));
    if (_a_place == 2)
        for (Eigen::MatrixXd &range : _ranges)
            range = along_both_axes(range);
}

const Eigen::MatrixXcd &BalanceForm::at(double speed) {
    const auto found = _known.find(speed);
    if (found != _known.end())
        return found->second;
    // A rigid rotor without supports has no stiffness: the form is the same at all speeds, but at
    // rest, where only its limit exists, the matrix is zero.
    constexpr double hardly = 1e-6; // rad/s
    for (const double nudge : {0.0, 1e-12, -1e-10}) {
        const double near = speed == 0 && nudge != 0 ? hardly : speed * (1 + nudge);
        try {
            return _known[speed] = synchronous::hermitian_part(_receptance.at(near));
        } catch (const linalg::SolverError &) {
            continue;
        }
    }
    throw model::AnalysisFailure(model::Sentence(
        "no steady motion at or near {}: the rotor is free to move", model::as::speed(speed)));
}

Eigen::MatrixXcd BalanceForm::on_range(std::size_t plane, double speed) {
    const Eigen::MatrixXcd range = _ranges[plane].cast<std::complex<double>>();
    const Eigen::MatrixXcd of_range = at(speed) * range;
    return range.adjoint() * of_range;
}

double BalanceForm::value(std::size_t plane, double speed) {
    const Eigen::MatrixXcd form = on_range(plane, speed);
    if (form.rows() == 1)
        return form(0, 0).real();
    return Eigen::SelfAdjointEigenSolver<Eigen::MatrixXcd>(form, Eigen::EigenvaluesOnly)
        .eigenvalues()
        .maxCoeff();
}

double BalanceForm::rounding(std::size_t plane, double speed) {
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXcd> solver(on_range(plane, speed));
    return _receptance.rounding(speed, _ranges[plane] * solver.eigenvectors().rightCols<1>());
}

std::optional<double> BalanceForm::worst_direction(std::size_t plane, double speed) {
    if (_a_place == 1)
        return std::nullopt;
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXcd> solver(on_range(plane, speed));
    const Eigen::VectorXd s = solver.eigenvectors().rightCols<1>().real();
    return std::atan(s(1) / s(0));
}

std::vector<double> BalanceForm::sign_changes(std::size_t plane, double from, double to) const {
    return criterion::sign_changes(_receptance, _ranges[plane], from, to);
}

results::SignaturePoint BalanceForm::signature(double speed) {
    const std::size_t all = _ranges.size() - 1;
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXcd> solver(on_range(all, speed));
    const Eigen::VectorXd &values = solver.eigenvalues();
    results::SignaturePoint point;
    point.speed = speed;
    point.eigenvalues.assign(values.data(), values.data() + values.size());
    point.negative = static_cast<int>((values.array() < 0).count());
    const double size = values.cwiseAbs().maxCoeff();
    point.relative = size > 0 ? values(values.size() - 1) / size : 0;
    Eigen::VectorXcd worst = _ranges[all] * solver.eigenvectors().rightCols<1>();
    if (_a_place == 2) { // real: x and y
        const Eigen::VectorXd s = worst.real();
        worst = s(Eigen::seqN(0, s.size() / 2, 2)).cast<std::complex<double>>();
        worst.imag() = s(Eigen::seqN(1, s.size() / 2, 2));
    }
    Eigen::Index largest = 0;
    worst.cwiseAbs().maxCoeff(&largest);
    // The largest imbalance at phase zero; where the phase is a direction in the rotor, within a
    // quarter turn of it.
    if (_a_place == 2)
        worst *= worst(largest).real() < 0 ? -1 : 1;
    else if (std::abs(worst(largest)) > 0)
        worst *= std::conj(worst(largest)) / std::abs(worst(largest));
    point.worst.assign(worst.data(), worst.data() + worst.size());
    point.eigenvalues.resize(static_cast<std::size_t>(_ranges[all].rows()), 0.0);
    std::ranges::sort(point.eigenvalues);
    return point;
}

} // namespace whirl::criterion
