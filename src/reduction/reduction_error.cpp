#include "reduction/reduction_error.h"

#include "assembly/planes.h"
#include "assembly/system.h"
#include "linalg/dense/products.h"
#include "linalg/harmonic_solve.h"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>

namespace whirl::reduction {

namespace {

using assembly::i_unit;

/// Deflections (x rows, then y rows) at the places seen under forward unit forces, full model.
/// @param loads  unit loads at the places of forces
/// @param observed  the same at those of the deflections
Eigen::MatrixXcd full_response(const assembly::Discretization &d, const Eigen::MatrixXd &loads,
                               const Eigen::MatrixXd &observed, double speed) {
    linalg::HarmonicSolver solver(assembly::assemble_fixed(d, speed));
    const Eigen::MatrixXcd w = loads.cast<std::complex<double>>();
    const Eigen::MatrixXcd motion = solver.solve(speed, assembly::in_pairs(w, -i_unit * w));
    const Eigen::MatrixXcd at = observed.cast<std::complex<double>>();
    Eigen::MatrixXcd response(2 * at.cols(), w.cols());
    response << linalg::transposed_times(at, motion(Eigen::seqN(0, w.rows(), 2), Eigen::all)),
        linalg::transposed_times(at, motion(Eigen::seqN(1, w.rows(), 2), Eigen::all));
    return response;
}

/// @param frequency  rad/s, at which the forces go round, backward where it is below 0
Eigen::MatrixXcd reduced_response(const ReducedRotor &reduced, const Eigen::MatrixXd &loads,
                                  const Eigen::MatrixXd &observed, double speed, double frequency) {
    const Eigen::Index r = reduced.size();
    const ReducedRotor::Supports at = reduced.supports_at(speed);
    Eigen::MatrixXcd A = at.stiffness + i_unit * frequency * at.damping;
    A.diagonal().array() -= frequency * frequency;
    if (reduced.mass_deviation.size() > 0)
        A -= frequency * frequency * reduced.mass_deviation;
    const Eigen::MatrixXcd alone = reduced.elastic + i_unit * frequency * reduced.internal;
    A.topLeftCorner(r, r) += alone;
    A.bottomRightCorner(r, r) += alone;
    const Eigen::MatrixXcd across =
        speed * reduced.internal + i_unit * speed * frequency * reduced.gyroscopic;
    A.topRightCorner(r, r) += across;
    A.bottomLeftCorner(r, r) -= across;
    const Eigen::MatrixXcd rows =
        linalg::transposed_times(reduced.shapes, loads).cast<std::complex<double>>();
    Eigen::MatrixXcd forces(2 * r, rows.cols());
    forces << rows, -i_unit * rows;
    const Eigen::MatrixXcd motion = linalg::solved(A.partialPivLu(), forces);
    const Eigen::MatrixXcd at_seen =
        linalg::transposed_times(reduced.shapes, observed).cast<std::complex<double>>();
    Eigen::MatrixXcd response(2 * at_seen.cols(), rows.cols());
    response << linalg::transposed_times(at_seen, motion.topRows(r)),
        linalg::transposed_times(at_seen, motion.bottomRows(r));
    return response;
}

/// Whirl speeds w of (K + shift) + w speed G - w^2, by modulus.
/// @param scale  rad/s, of those that count
std::vector<double> whirl_speeds(const ReducedRotor &reduced, double speed, double shift,
                                 double scale) {
    const Eigen::Index r = reduced.size();
    const Eigen::MatrixXd supports = reduced.supports_at(speed).stiffness;
    // On (q, w q / scale), so that all entries are frequencies, whatever the unit of time.
    Eigen::MatrixXd A = Eigen::MatrixXd::Zero(2 * r, 2 * r);
    A.topRightCorner(r, r).diagonal().setConstant(scale);
    A.bottomLeftCorner(r, r) =
        reduced.elastic + (supports.topLeftCorner(r, r) + supports.bottomRightCorner(r, r)) / 2;
    A.bottomLeftCorner(r, r).diagonal().array() += shift;
    A.bottomLeftCorner(r, r) /= scale;
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
linalg::DefinitePencil full_pencil(const assembly::Discretization &d, double speed, double shift) {
    const assembly::PlanarSystem system = assembly::assemble_planar(d, speed);
    return {linalg::Matrix::sum(1, system.K, shift, system.M), system.M, system.G};
}

Eigen::MatrixXd loads_at(const assembly::Discretization &d, const std::vector<double> &places,
                         const std::vector<double> &more = {}) {
    std::vector<assembly::Combination> deflections;
    for (const auto *list : {&places, &more})
        for (const double z : *list)
            deflections.push_back(d.deflection_at(z));
    return assembly::unit_loads(deflections, d.planar_size());
}

} // namespace

ReductionError::ReductionError(const assembly::Discretization &discretization,
                               const ReductionGoal &goal)
    : _loads(loads_at(discretization, goal.places)),
      _seen(loads_at(discretization, goal.places, goal.watched)), _speed(goal.speed),
      _fastest(goal.fastest), _shift(0.01 * goal.fastest * goal.fastest),
      _response(full_response(discretization, _loads, _seen, _speed)),
      _pencil(full_pencil(discretization, _speed, _shift)) {}

const std::vector<linalg::RealPair> &ReductionError::whirl(std::size_t wanted) {
    const auto [entry, made] = _slowest.try_emplace(wanted);
    if (made)
        entry->second = _pencil.smallest(_speed, static_cast<int>(wanted));
    return entry->second;
}

double ReductionError::difference(const ReducedRotor &a, const ReducedRotor &b,
                                  double frequency) const {
    double largest = 0;
    double apart = 0;
    for (const double way : {frequency, -frequency}) {
        const Eigen::MatrixXcd first = reduced_response(a, _loads, _seen, _speed, way);
        const Eigen::MatrixXcd second = reduced_response(b, _loads, _seen, _speed, way);
        largest = std::max(largest, first.cwiseAbs().maxCoeff());
        apart = std::max(apart, (second - first).cwiseAbs().maxCoeff());
    }
    return apart / largest;
}

void ReductionError::measure(ReducedRotor &reduced) {
    const Eigen::MatrixXcd response = reduced_response(reduced, _loads, _seen, _speed, _speed);
    reduced.response_error =
        (response - _response).cwiseAbs().maxCoeff() / _response.cwiseAbs().maxCoeff();
    const std::vector<double> found = whirl_speeds(reduced, _speed, _shift, _fastest);
    const auto slow = std::count_if(found.begin(), found.end(),
                                    [&](double w) { return std::abs(w) <= _fastest; });
    const auto wanted = static_cast<std::size_t>(std::max<std::ptrdiff_t>(2, slow));
    const std::vector<linalg::RealPair> &exact = whirl(wanted);
    reduced.frequency_error = 0;
    for (std::size_t i = 0; i < std::min({wanted, found.size(), exact.size()}); ++i) {
        double nearest = std::abs(found[i]); // of neighbours in modulus either may come first
        for (const linalg::RealPair &pair : exact)
            nearest = std::min(nearest, std::abs(pair.value - found[i]));
        reduced.frequency_error = std::max(reduced.frequency_error, nearest / std::abs(found[i]));
    }
}

} // namespace whirl::reduction
