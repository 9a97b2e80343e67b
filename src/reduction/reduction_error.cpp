#include "reduction/reduction_error.h"

#include "assembly/system.h"
#include "linalg/definite_pencil.h"
#include "linalg/dense/products.h"
#include "linalg/harmonic_solve.h"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <map>

namespace whirl::reduction {

namespace {

constexpr std::complex<double> imaginary_unit(0, 1);

using Columns = std::vector<assembly::Combination>;

/// Deflections (x rows, then y rows) at the places under forward unit forces, full model.
Eigen::MatrixXcd full_response(const assembly::Discretization &d, const Columns &places,
                               double speed) {
    const assembly::FixedSystem system = assembly::assemble_fixed(d, speed);
    linalg::HarmonicSolver solver({&system.M, &system.C, &system.G, &system.K, &system.Kc});
    const auto count = static_cast<Eigen::Index>(places.size());
    Eigen::MatrixXcd forces = Eigen::MatrixXcd::Zero(2 * d.planar_size(), count);
    for (Eigen::Index j = 0; j < count; ++j)
        for (const auto &[unknown, value] : places[static_cast<std::size_t>(j)]) {
            forces(2 * unknown, j) += value;
            forces(2 * unknown + 1, j) -= value * imaginary_unit;
        }
    const Eigen::MatrixXcd motion = solver.solve(speed, forces).displacements;
    Eigen::MatrixXcd response = Eigen::MatrixXcd::Zero(2 * count, count);
    for (Eigen::Index i = 0; i < count; ++i)
        for (const auto &[unknown, value] : places[static_cast<std::size_t>(i)]) {
            response.row(i) += value * motion.row(2 * unknown);
            response.row(count + i) += value * motion.row(2 * unknown + 1);
        }
    return response;
}

Eigen::MatrixXcd reduced_response(const ReducedRotor &reduced, const Columns &places,
                                  double speed) {
    const Eigen::Index r = reduced.size();
    const auto count = static_cast<Eigen::Index>(places.size());
    const ReducedRotor::Supports at = reduced.supports_at(speed);
    Eigen::MatrixXcd A = at.stiffness + imaginary_unit * speed * at.damping;
    A.diagonal().array() -= speed * speed;
    if (reduced.mass_beside.size() > 0)
        A -= speed * speed * reduced.mass_beside;
    const Eigen::MatrixXcd alone = reduced.elastic + imaginary_unit * speed * reduced.internal;
    A.topLeftCorner(r, r) += alone;
    A.bottomRightCorner(r, r) += alone;
    const Eigen::MatrixXcd across =
        speed * reduced.internal + imaginary_unit * speed * speed * reduced.gyroscopic;
    A.topRightCorner(r, r) += across;
    A.bottomLeftCorner(r, r) -= across;
    Eigen::MatrixXd rows(r, count);
    for (Eigen::Index i = 0; i < count; ++i)
        rows.col(i) = reduced.row(places[static_cast<std::size_t>(i)]);
    Eigen::MatrixXcd forces(2 * r, count);
    forces << rows, -imaginary_unit * rows;
    const Eigen::MatrixXcd motion = linalg::solved(A.partialPivLu(), forces);
    const Eigen::MatrixXcd read = rows.cast<std::complex<double>>();
    Eigen::MatrixXcd response(2 * count, count);
    response << linalg::transposed_times(read, motion.topRows(r)),
        linalg::transposed_times(read, motion.bottomRows(r));
    return response;
}

/// Whirl speeds w of (K + shift) + w speed G - w^2, by modulus.
std::vector<double> whirl_speeds(const ReducedRotor &reduced, double speed, double shift) {
    const Eigen::Index r = reduced.size();
    const Eigen::MatrixXd supports = reduced.supports_at(speed).stiffness;
    // On (q, w q / |speed|), so that all entries are frequencies, whatever the unit of time.
    Eigen::MatrixXd A = Eigen::MatrixXd::Zero(2 * r, 2 * r);
    A.topRightCorner(r, r).diagonal().setConstant(std::abs(speed));
    A.bottomLeftCorner(r, r) =
        reduced.elastic + (supports.topLeftCorner(r, r) + supports.bottomRightCorner(r, r)) / 2;
    A.bottomLeftCorner(r, r).diagonal().array() += shift;
    A.bottomLeftCorner(r, r) /= std::abs(speed);
    A.bottomRightCorner(r, r) = speed * reduced.gyroscopic;
    const Eigen::VectorXcd values = A.eigenvalues();
    std::vector<double> speeds;
    for (const auto &value : values)
        speeds.push_back(value.real());
    std::sort(speeds.begin(), speeds.end(),
              [](double a, double b) { return std::abs(a) < std::abs(b); });
    return speeds;
}

/// The full pencil with mean bearings and K shifted by shift M, so that it is definite.
std::unique_ptr<linalg::DefinitePencil> full_pencil(const assembly::Discretization &d, double speed,
                                                    double shift) {
    const assembly::PlanarSystem system = assembly::assemble_planar(d, speed);
    return std::make_unique<linalg::DefinitePencil>(
        linalg::Matrix::sum(1, system.K, shift, system.M), system.M, system.G);
}

} // namespace

struct ReductionError::Full {
    Columns places;
    double speed = 0;
    double shift = 0;
    Eigen::MatrixXcd response;
    std::unique_ptr<linalg::DefinitePencil> pencil;
    std::map<std::size_t, std::vector<linalg::RealPair>> slowest; ///< by how many were asked for

    const std::vector<linalg::RealPair> &whirl(std::size_t wanted) {
        const auto [entry, made] = slowest.try_emplace(wanted);
        if (made)
            entry->second = pencil->smallest(speed, static_cast<int>(wanted));
        return entry->second;
    }
};

ReductionError::ReductionError(const assembly::Discretization &discretization,
                               const ReductionGoal &goal)
    : _full(std::make_unique<Full>()) {
    for (const double z : goal.places)
        _full->places.push_back(discretization.deflection_at(z));
    _full->speed = goal.speed;
    _full->shift = 0.01 * goal.speed * goal.speed;
    _full->response = full_response(discretization, _full->places, goal.speed);
    _full->pencil = full_pencil(discretization, goal.speed, _full->shift);
}

ReductionError::~ReductionError() = default;

void ReductionError::measure(ReducedRotor &reduced) const {
    Full &full = *_full;
    const Eigen::MatrixXcd response = reduced_response(reduced, full.places, full.speed);
    reduced.response_error =
        (response - full.response).cwiseAbs().maxCoeff() / full.response.cwiseAbs().maxCoeff();
    const std::vector<double> found = whirl_speeds(reduced, full.speed, full.shift);
    const auto slow = std::count_if(found.begin(), found.end(),
                                    [&](double w) { return std::abs(w) <= std::abs(full.speed); });
    const auto wanted = static_cast<std::size_t>(std::max<std::ptrdiff_t>(2, slow));
    const std::vector<linalg::RealPair> &exact = full.whirl(wanted);
    reduced.frequency_error = 0;
    for (std::size_t i = 0; i < std::min({wanted, found.size(), exact.size()}); ++i) {
        double nearest = std::abs(found[i]); // of neighbours in modulus either may come first
        for (const linalg::RealPair &pair : exact)
            nearest = std::min(nearest, std::abs(pair.value - found[i]));
        reduced.frequency_error = std::max(reduced.frequency_error, nearest / std::abs(found[i]));
    }
}

} // namespace whirl::reduction
