#include "criterion/undamped_rotor.h"

#include "assembly/constraints.h"
#include "assembly/system.h"
#include "linalg/semidefinite_pair.h"
#include "synchronous/parts.h"
#include "synchronous/receptance.h"

#include <Eigen/Core>

#include <cmath>
#include <complex>

namespace whirl::criterion {

namespace {

using Complex = std::complex<double>;
using Sparse = Eigen::SparseMatrix<double>;

/// Entries between unknowns of different planes (`across`), or of the same one.
Sparse part_of(const Sparse &K, bool across) {
    std::vector<Eigen::Triplet<double>> entries;
    for (int column = 0; column < K.outerSize(); ++column)
        for (Sparse::InnerIterator it(K, column); it; ++it)
            if ((it.row() % 2 != it.col() % 2) == across && it.value() != 0)
                entries.emplace_back(static_cast<int>(it.row()), static_cast<int>(it.col()),
                                     it.value());
    Sparse out(K.rows(), K.cols());
    out.setFromTriplets(entries.begin(), entries.end());
    return out;
}

/// x = u, y = -i v: an entry k from y to x becomes -i k, one from x to y becomes i k.
Sparse imaginary_part(const Sparse &K) {
    Sparse out = part_of(K, true);
    for (int column = 0; column < out.outerSize(); ++column)
        for (Sparse::InnerIterator it(out, column); it; ++it)
            if (it.row() % 2 == 0)
                it.valueRef() = -it.value();
    return out;
}

} // namespace

UndampedRotor::UndampedRotor(const assembly::Discretization &rotor, results::Form form,
                             double bearing_speed, int harmonics)
    : _form(form) {
    if (results::in_rotating_axes(form)) {
        const assembly::FixedSystem system =
            synchronous::steady_in_rotating_axes(rotor, bearing_speed, harmonics);
        _K = system.K.view();
        _A = system.M.view();
    } else if (form == results::Form::planar) {
        const assembly::PlanarSystem system = assembly::assemble_planar(rotor, bearing_speed);
        _K = system.K.view();
        _A = linalg::Matrix::sum(1, system.M, -1, system.G).view();
    } else {
        const assembly::FixedSystem system = assembly::assemble_fixed(rotor, bearing_speed);
        const linalg::Matrix S = assembly::hyperbolic_coupling(rotor);
        const Sparse K = system.K.view();
        _K = part_of(K, false);
        if (!rotor.rotor().bearings_orthotropic())
            _K_imaginary = imaginary_part(K);
        _A = linalg::Matrix::sum(1, system.M, -1, S).view();
    }
}

/// Of the rotor that can only move as the columns of T.
std::vector<double> UndampedRotor::roots(const Sparse &T, double from, double to) const {
    const Sparse K = T.transpose() * _K * T;
    const Sparse A = T.transpose() * _A * T;
    if (_K_imaginary.nonZeros() == 0)
        return linalg::SemidefinitePair(K, A).roots(from, to);
    const Sparse skew = T.transpose() * _K_imaginary * T;
    const Eigen::SparseMatrix<Complex> hermitian =
        K.cast<Complex>() + Complex(0, 1) * skew.cast<Complex>();
    return linalg::HermitianPair(hermitian, A.cast<Complex>()).roots(from, to);
}

std::vector<double> UndampedRotor::critical_speeds(double from, double to) const {
    Sparse all(_K.rows(), _K.rows());
    all.setIdentity();
    return roots(all, from, to);
}

std::vector<double>
UndampedRotor::pinned_critical_speeds(const std::vector<assembly::Combination> &places, double from,
                                      double to) const {
    const int a_place = synchronous::imbalances_a_place(_form);
    Eigen::MatrixXd rows =
        Eigen::MatrixXd::Zero(a_place * static_cast<Eigen::Index>(places.size()), _K.rows());
    for (std::size_t i = 0; i < places.size(); ++i)
        for (const auto &[unknown, value] : places[i]) {
            const auto row = a_place * static_cast<Eigen::Index>(i);
            if (_form == results::Form::planar) {
                rows(row, unknown) += value;
            } else { // general: forward, (x, i y) alike; in rotating axes x and y each
                rows(row, 2 * unknown) += value;
                rows(row + a_place - 1, 2 * unknown + 1) += value;
            }
        }
    const Eigen::VectorXd size =
        _K.diagonal().cwiseAbs() + to * to * Eigen::VectorXd(_A.diagonal().cwiseAbs());
    const Eigen::VectorXd scale =
        size.unaryExpr([](double d) { return d > 0 ? 1 / std::sqrt(d) : 1.0; });
    return roots(assembly::constrained_motions(rows, scale), from, to);
}

} // namespace whirl::criterion
