#include "periodic/system.h"

#include "assembly/frequency_scales.h"
#include "assembly/rotating_system.h"
#include "linalg/dense/products.h"
#include "linalg/unit_scales.h"
#include "reduction/projection.h"

#include <cmath>
#include <optional>

namespace whirl::periodic {

namespace {

using Sparse = Eigen::SparseMatrix<double>;

/// Unknowns that any of the matrices has entries for, ascending.
std::vector<int> touched(const std::vector<Sparse> &matrices) {
    std::vector<bool> any(static_cast<std::size_t>(matrices.front().rows()), false);
    for (const Sparse &A : matrices)
        for (Eigen::Index column = 0; column < A.outerSize(); ++column)
            for (Sparse::InnerIterator entry(A, column); entry; ++entry)
                if (entry.value() != 0)
                    any[static_cast<std::size_t>(entry.row())] =
                        any[static_cast<std::size_t>(entry.col())] = true;
    std::vector<int> out;
    for (std::size_t i = 0; i < any.size(); ++i)
        if (any[i])
            out.push_back(static_cast<int>(i));
    return out;
}

} // namespace

System::System(const assembly::Discretization &discretization, double bearing_speed,
               const std::vector<balancers::BalancerElement> &balancers,
               const Eigen::MatrixXd *shapes) {
    const assembly::RotatingSystem system =
        assembly::assemble_rotating(discretization, bearing_speed, balancers);
    const auto reduced = [shapes](const linalg::Matrix &A) -> Eigen::MatrixXd {
        return shapes != nullptr ? reduction::Projection(*shapes).of(Sparse(A.view()))
                                 : Eigen::MatrixXd(Sparse(A.view()));
    };
    _M = reduced(system.M);
    _C = reduced(system.C);
    _Cs = reduced(system.Cs);
    _K = reduced(system.K);
    _Ks = reduced(system.Ks);
    _Kss = reduced(system.Kss);
    const int unknowns = system.M.size();
    const assembly::PeriodicSupports turning =
        assembly::periodic_supports(discretization, bearing_speed, unknowns);
    const std::vector<Sparse> all{turning.C.cosine.view(),  turning.C.sine.view(),
                                  turning.K.cosine.view(),  turning.K.sine.view(),
                                  turning.Ks.cosine.view(), turning.Ks.sine.view()};
    const std::vector<int> at = touched(all);
    Eigen::MatrixXd picked = Eigen::MatrixXd::Zero(unknowns, std::ssize(at));
    for (std::size_t j = 0; j < at.size(); ++j)
        picked(at[j], static_cast<Eigen::Index>(j)) = 1;
    const auto small = [&picked](const Sparse &A) -> Eigen::MatrixXd {
        const Eigen::MatrixXd forces = A * picked;
        return linalg::transposed_times(picked, forces);
    };
    _periodic_C = {small(all[0]), small(all[1])};
    _periodic_K = {small(all[2]), small(all[3])};
    _periodic_Ks = {small(all[4]), small(all[5])};
    const auto loads = [shapes](const Eigen::MatrixXd &columns) {
        return shapes != nullptr ? reduction::Projection(*shapes).loads(columns) : columns;
    };
    _places = loads(picked);
    _unknowns = loads(Eigen::MatrixXd::Identity(unknowns, unknowns)).transpose();
    _root_K_whole = Sparse(system.K.view()).diagonal().cwiseAbs().cwiseSqrt();
    _root_M_whole = Sparse(system.M.view()).diagonal().cwiseAbs().cwiseSqrt();
    scale(linalg::scales_at(assembly::support_scale(discretization), _M.diagonal(), _K.diagonal()));
}

void System::scale(const Eigen::VectorXd &d) {
    _scales = d;
    for (Eigen::MatrixXd *A : {&_M, &_C, &_Cs, &_K, &_Ks, &_Kss})
        *A = (d.asDiagonal() * *A * d.asDiagonal()).eval();
    _places = (d.asDiagonal() * _places).eval();
    _unknowns = (_unknowns * d.asDiagonal()).eval();
}

Eigen::VectorXcd System::whole(const Eigen::VectorXcd &shape, double speed) const {
    const Eigen::Index n = size();
    Eigen::VectorXcd out(2 * _unknowns.rows());
    // Balls have no stiffness but that of the spin.
    const Eigen::VectorXd weight = _root_K_whole.cwiseMax(std::abs(speed) * _root_M_whole);
    out << weight.cwiseProduct(_unknowns * shape.head(n)),
        _root_M_whole.cwiseProduct(_unknowns * shape.tail(n));
    return out.normalized();
}

System::Steady System::steady(double speed) const {
    return {_M, _C + speed * _Cs, _K + speed * (_Ks + speed * _Kss)};
}

bool System::conserves(double speed) const {
    // Relative, of sums of element matrices; a real asymmetry is an input, far larger.
    constexpr double rounding = 1e-12;
    const Steady at = steady(speed);
    const Eigen::MatrixXd turned = turning(speed, 1);
    const auto symmetric = [](const Eigen::MatrixXd &A) {
        return (A - A.transpose()).norm() <= rounding * A.norm();
    };
    return turned.cols() == _places.cols() && symmetric(turned) && symmetric(at.K) &&
           (at.D + at.D.transpose()).norm() <= rounding * at.D.norm();
}

Eigen::MatrixXd System::turning(double speed, double angle) const {
    const double c = std::cos(angle);
    const double s = std::sin(angle);
    const Eigen::Index m = _places.cols();
    const bool damps = !_periodic_C.cosine.isZero(0) || !_periodic_C.sine.isZero(0);
    Eigen::MatrixXd out(m, damps ? 2 * m : m);
    out.leftCols(m) = c * (_periodic_K.cosine + speed * _periodic_Ks.cosine) +
                      s * (_periodic_K.sine + speed * _periodic_Ks.sine);
    if (damps)
        out.rightCols(m) = c * _periodic_C.cosine + s * _periodic_C.sine;
    return out;
}

const System &KeptSystem::at(const assembly::Discretization &discretization, double speed,
                             const std::vector<balancers::BalancerElement> &balancers,
                             const Eigen::MatrixXd *shapes) {
    const bool tables = discretization.rotor().bearings_depend_on_speed();
    if (!_system || (tables && speed != _speed))
        _system = std::make_unique<System>(discretization, tables ? speed : 0, balancers, shapes);
    _speed = speed;
    return *_system;
}

} // namespace whirl::periodic
