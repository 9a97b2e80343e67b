// What is laid out once, before the motion begins: see motion.cpp.

#include "simulation/motion.h"

#include <Eigen/LU>

#include <algorithm>
#include <utility>

namespace whirl::simulation {

namespace {

using Eigen::Index;

/// A matrix over the gyroscopic one in both directions: both on the real form of r unknowns.
Eigen::MatrixXd above_turned(const Eigen::MatrixXd &matrix, const Eigen::MatrixXd &gyroscopic) {
    const Index r = gyroscopic.rows();
    Eigen::MatrixXd out = Eigen::MatrixXd::Zero(4 * r, 2 * r);
    out.topRows(2 * r) = matrix;
    out.block(2 * r, 0, r, r) = gyroscopic;
    out.block(3 * r, r, r, r) = gyroscopic;
    return out;
}

} // namespace

RotorMotion::RotorMotion(MovingParts parts) : _parts(std::move(parts)) {
    const reduction::ReducedRotor &rotor = _parts.rotor;
    const Index r = rotor.size();
    const auto planes = static_cast<Index>(_parts.planes.size());
    _rows.resize(r, 2 * planes);
    for (Index i = 0; i < planes; ++i) {
        _rows.col(2 * i) = _parts.planes[static_cast<std::size_t>(i)].w;
        _rows.col(2 * i + 1) = _parts.planes[static_cast<std::size_t>(i)].phi;
    }
    _products = _rows.transpose() * _rows;
    _tables = rotor.supports.size() > 1;
    _internal = !rotor.internal.isZero(0);
    for (const reduction::ReducedRotor::Supports &at : rotor.supports) {
        const double size = at.stiffness.cwiseAbs().maxCoeff();
        const Eigen::MatrixXd skew = at.stiffness - at.stiffness.transpose();
        _circulating = _circulating || skew.cwiseAbs().maxCoeff() > 1e-13 * size;
    }
    _stiffness = rotor.supports.front().stiffness;
    _stiffness.topLeftCorner(r, r) += rotor.elastic;
    _stiffness.bottomRightCorner(r, r) += rotor.elastic;
    _of_place = linalg::RealProduct(above_turned(_stiffness, rotor.gyroscopic));
    _of_velocity =
        linalg::RealProduct(above_turned(rotor.supports.front().damping, rotor.gyroscopic));
    if (rotor.mass_beside.size() > 0) // no planes (motion_scene)
        _inverse_mass = (Eigen::MatrixXd::Identity(2 * r, 2 * r) + rotor.mass_beside).inverse();
    _motions.resize(_parts.planes.size());
    _free_equations.resize(static_cast<std::size_t>(_parts.free_angles()));
    for (Eigen::ArrayXd *each : {&_turned, &_cosines, &_sines})
        each->resize(_parts.free_angles());
    _fixed_equations.resize(_parts.fixed.size());
    _forces.setZero(2 * r, 2);
    _planes.setZero(4 * planes, 2);
    _loads.resize(4 * planes, 2);
    _coupling.resize(4, 4 * planes);
    _by_place.resize(linalg::whole_vectors(4 * r));
    _by_velocity.resize(linalg::whole_vectors(4 * r));
    _push.resize(2 * r);
    _slip.resize(r, 2);
    _external.setZero(2 * r);
    for (const FreeParts &free : _parts.free)
        _plane_of.insert(_plane_of.end(), static_cast<std::size_t>(free.motion->size()),
                         free.plane);
    set_dry({});
}

std::vector<double> RotorMotion::jumps() const {
    std::vector<double> times = _parts.excitation.jumps();
    if (!_parts.motor)
        for (const double jump : _parts.spin.jumps())
            times.push_back(jump);
    for (const FixedMass &mass : _parts.fixed)
        if (mass.from > 0)
            times.push_back(mass.from);
    std::ranges::sort(times);
    times.erase(std::unique(times.begin(), times.end()), times.end());
    return times;
}

} // namespace whirl::simulation
