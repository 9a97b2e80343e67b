#include "states/steady_equations.h"

#include "balancers/kind.h"
#include "linalg/check.h"
#include "linalg/dense/general_eigen.h"
#include "linalg/dense/least_squares.h"
#include "linalg/dense/products.h"
#include "model/errors.h"
#include "simulation/equations.h"

#include <algorithm>
#include <cmath>
#include <variant>

namespace whirl::states {

namespace {

using Eigen::Index;

/// X + i Y on (Re; Im).
void add_complex(const Eigen::MatrixXd &X, const Eigen::MatrixXd &Y, Eigen::MatrixXd &out) {
    const Index r = X.rows();
    out.topLeftCorner(r, r) += X;
    out.bottomRightCorner(r, r) += X;
    out.topRightCorner(r, r) -= Y;
    out.bottomLeftCorner(r, r) += Y;
}

/// i X for a real form X of complex numbers.
Eigen::MatrixXd turned(const Eigen::MatrixXd &X) {
    const Index r = X.rows() / 2;
    Eigen::MatrixXd out(X.rows(), X.cols());
    out.topRows(r) = -X.bottomRows(r);
    out.bottomRows(r) = X.topRows(r);
    return out;
}

void refuse_what_is_not_steady(const model::Case &scene) {
    const model::Rotor &rotor = scene.rotor;
    if (!rotor.bearings_isotropic() || !rotor.support_masses_isotropic())
        throw model::AnalysisFailure(
            "steady states are found for bearings that are the same in x and y: on others nothing "
            "stands still in axes that turn with the rotor");
    for (const model::Balancer &b : rotor.balancers)
        if (const auto *balls = std::get_if<model::Balls>(&b.parts)) {
            if (balls->contact)
                throw model::AnalysisFailure("steady states are found for balls that pass each "
                                             "other; those of a balancer here touch (contact)");
            if (balls->resists())
                throw model::AnalysisFailure(
                    "steady states are found for balls without resistance to rolling: with it they "
                    "can rest anywhere within intervals");
        }
}

/// The case as `simulate` would run it from the slowest to the fastest speed, with nothing from
/// outside. Its shapes are to be good to more digits than those of a motion in time, which end in
/// plots.
model::Case in_motion(model::Case scene, double slowest, double fastest) {
    constexpr double shapes = 1e-6;
    model::SimulateSettings &s = scene.simulate;
    s.time = 1;
    s.run_up = {{0, slowest}, {1, fastest}};
    s.torque.reset();
    s.gravity = 0;
    s.imbalances.clear();
    s.forces.clear();
    s.base.reset();
    s.reduction_tolerance = std::min(s.reduction_tolerance, shapes);
    return scene;
}

} // namespace

SteadyEquations::SteadyEquations(const model::Case &scene, double slowest, double fastest) {
    refuse_what_is_not_steady(scene);
    const model::Case moving = in_motion(scene, slowest, fastest);
    _parts = simulation::motion_scene(moving).parts;
    const Index r = _parts.rotor.size();
    _rows = Eigen::MatrixXd::Zero(4 * planes(), 2 * r);
    for (Index i = 0; i < planes(); ++i) {
        const simulation::MassPlane &plane = _parts.planes[static_cast<std::size_t>(i)];
        _rows.row(4 * i).head(r) = _rows.row(4 * i + 1).tail(r) = plane.w.transpose();
        _rows.row(4 * i + 2).head(r) = _rows.row(4 * i + 3).tail(r) = plane.phi.transpose();
    }
    _damped = scene.rotor.damped();
    _round_races = std::ranges::all_of(scene.rotor.balancers, [](const model::Balancer &b) {
        const auto kind = balancers::kind_of(b);
        return kind->out_of_round() == 0.0 && kind->inclination() == 0.0;
    });
}

bool SteadyEquations::driven() const {
    return std::ranges::any_of(
        _parts.fixed, [](const simulation::FixedMass &mass) { return mass.mass.moment != 0; });
}

bool SteadyEquations::round() const {
    return _round_races &&
           std::ranges::none_of(
               _parts.fixed, [](const simulation::FixedMass &mass) { return mass.mass.tilt != 0; });
}

void SteadyEquations::for_tilting_masses(
    double speed,
    const std::function<void(const Eigen::MatrixXd &, const balancers::AtRest &)> &add) const {
    for (const simulation::FixedMass &mass : _parts.fixed) {
        if (mass.plane < 0 || mass.mass.tilt == 0)
            continue;
        balancers::AtRest rest(0);
        mass.mass.add_at_rest(balancers::PlaneVector::Zero(), speed, mass.phase, std::nullopt,
                              rest);
        add(_rows.middleRows<4>(4 * mass.plane), rest);
    }
}

// In turning axes q' becomes u' + i Omega u; internal damping acts on u' alone:
//     u'' + [C + C_i + i Omega (2 - G)] u' + [K + i Omega C - Omega^2 (1 - G)] u = loads.
Eigen::MatrixXd SteadyEquations::stiffness(double speed) const {
    const reduction::ReducedRotor &rotor = _parts.rotor;
    const Index r = rotor.size();
    const reduction::ReducedRotor::Supports at = rotor.supports_at(speed);
    Eigen::MatrixXd K = at.stiffness + speed * turned(at.damping);
    add_complex(rotor.elastic +
                    speed * speed * (rotor.gyroscopic - Eigen::MatrixXd::Identity(r, r)),
                Eigen::MatrixXd::Zero(r, r), K);
    for_tilting_masses(speed, [&](const Eigen::MatrixXd &rows, const balancers::AtRest &rest) {
        K += rows.transpose() * rest.stiffness * rows;
    });
    return K;
}

Eigen::VectorXd SteadyEquations::load(double speed) const {
    const Index r = _parts.rotor.size();
    Eigen::VectorXd out = Eigen::VectorXd::Zero(2 * r);
    for (const simulation::FixedMass &mass : _parts.fixed) {
        const std::complex<double> pull = std::polar(speed * speed * mass.mass.moment, mass.phase);
        const reduction::Row &row =
            mass.plane < 0 ? mass.row : _parts.planes[static_cast<std::size_t>(mass.plane)].w;
        out.head(r) += pull.real() * row;
        out.tail(r) += pull.imag() * row;
    }
    return out;
}

std::vector<std::complex<double>> SteadyEquations::deflections(const Eigen::VectorXd &x) const {
    const Eigen::VectorXd y = _rows * x.head(rotor_unknowns());
    std::vector<std::complex<double>> out;
    for (Index i = 0; i < planes(); ++i)
        out.emplace_back(y(4 * i), y(4 * i + 1));
    return out;
}

SteadyEquations::Balance SteadyEquations::balance(const Eigen::VectorXd &x, double speed,
                                                  double deflection, Motions wanted) const {
    const reduction::ReducedRotor &rotor = _parts.rotor;
    const Index r2 = rotor_unknowns();
    const Index n = unknowns();
    const Index r = rotor.size();
    Balance out;
    modes::DenseQuadratic<double> &m = out.motions;
    m.K = Eigen::MatrixXd::Zero(n, n);
    const bool all = wanted == Motions::all;
    if (all) {
        m.M = m.D = m.K;
        m.M.topLeftCorner(r2, r2).setIdentity();
        Eigen::MatrixXd C = rotor.supports_at(speed).damping;
        add_complex(rotor.internal,
                    speed * (2 * Eigen::MatrixXd::Identity(r, r) - rotor.gyroscopic), C);
        m.D.topLeftCorner(r2, r2) = C;
        for_tilting_masses(speed, [&](const Eigen::MatrixXd &rows, const balancers::AtRest &rest) {
            m.M.topLeftCorner(r2, r2) += rows.transpose() * rest.inertia * rows;
            m.D.topLeftCorner(r2, r2) += rows.transpose() * rest.gyroscopic * rows;
        });
    }
    const Eigen::MatrixXd K = stiffness(speed);
    m.K.topLeftCorner(r2, r2) = K;
    const Eigen::VectorXd fixed = load(speed);
    const auto u = x.head(r2);
    out.left = Eigen::VectorXd::Zero(n);
    out.left.head(r2) = fixed - K * u;
    out.sizes = Eigen::VectorXd::Zero(n);
    out.sizes.head(r2) = fixed.cwiseAbs() + K.cwiseAbs() * u.cwiseAbs();
    for (Index first = r2; const simulation::FreeParts &free : _parts.free) {
        const Eigen::MatrixXd rows = _rows.middleRows<4>(4 * free.plane);
        const Eigen::Index size = free.motion->size();
        const balancers::AtRest rest = free.motion->at_rest(rows * u, speed, x.data() + first);
        out.left.head(r2) += rows.transpose() * rest.force.head<4>();
        // The pulls of masses may cancel: each of them is as large as what turning it changes.
        out.sizes.head(r2) += rows.transpose().cwiseAbs() *
                              (rest.force.head<4>().cwiseAbs() +
                               rest.stiffness.topRightCorner(4, size).cwiseAbs().rowwise().sum());
        out.left.segment(first, size) += rest.force.tail(size);
        out.sizes.segment(first, size) += rest.stiffness.block(4, 0, size, 2).rowwise().norm() *
                                          std::max(deflection, (rows * u).head<2>().norm());
        const auto add = [&](const Eigen::MatrixXd &part, Eigen::MatrixXd &whole) {
            whole.topLeftCorner(r2, r2) += rows.transpose() * part.topLeftCorner<4, 4>() * rows;
            whole.block(0, first, r2, size) += rows.transpose() * part.topRightCorner(4, size);
            whole.block(first, 0, size, r2) += part.bottomLeftCorner(size, 4) * rows;
            whole.block(first, first, size, size) += part.bottomRightCorner(size, size);
        };
        add(rest.stiffness, m.K);
        if (all) {
            add(rest.inertia, m.M);
            add(rest.gyroscopic + rest.damping, m.D);
        }
        first += size;
    }
    return out;
}

Eigen::VectorXd SteadyEquations::with_angles(const Eigen::VectorXd &angles, double speed) const {
    const Index r2 = rotor_unknowns();
    Eigen::VectorXd x = Eigen::VectorXd::Zero(unknowns());
    x.tail(angles.size()) = angles;
    const Balance at = balance(x, speed, 0, Motions::stiffness); // linear in u at constant angles
    x.head(r2) =
        linalg::solved(at.motions.K.topLeftCorner(r2, r2).eval().partialPivLu(), at.left.head(r2));
    return x;
}

double SteadyEquations::refine(Eigen::VectorXd &x, double speed, double deflection,
                               const Held &held) const {
    constexpr int most_steps = 30;
    const auto balance_of = [&](const Eigen::VectorXd &at) {
        Balance out = balance(at, speed, deflection, Motions::stiffness);
        for (const Index coordinate : held) { // a wall gives what is not in balance there
            const Index i = rotor_unknowns() + coordinate;
            out.left(i) = out.sizes(i) = 0;
            out.motions.K.row(i).setZero();
            out.motions.K(i, i) = 1;
        }
        return out;
    };
    const auto left_of = [](const Balance &at) {
        double most = 0;
        const Eigen::Index n = at.left.size();
        const double largest = at.sizes.maxCoeff();
        for (Eigen::Index i = 0; i < n; ++i)
            most = std::max(most, std::abs(at.left(i)) / std::max(at.sizes(i), 1e-12 * largest));
        return most;
    };
    Balance at = balance_of(x);
    double left = left_of(at);
    for (int i = 0; i < most_steps && left > 0; ++i) {
        // Each equation over its size, or directions of small forces would not count.
        Eigen::MatrixXd A = at.motions.K;
        Eigen::VectorXd b = at.left;
        for (Eigen::Index row = 0; row < A.rows(); ++row) {
            const double size = A.row(row).cwiseAbs().maxCoeff();
            if (size > 0) {
                A.row(row) /= size;
                b(row) /= size;
            }
        }
        const Eigen::VectorXd step = linalg::least_squares(A, b);
        bool better = false;
        constexpr double shortest = 1e-2; // of the step: then it leads nowhere
        for (double part = 1; part > shortest && !better; part /= 2) {
            const Eigen::VectorXd next = x + part * step;
            Balance then = balance_of(next);
            if (const double less = left_of(then); less < left) {
                better = true;
                x = next;
                at = std::move(then);
                left = less;
            }
        }
        if (!better)
            break;
    }
    return left;
}

std::vector<SteadyEquations::Push> SteadyEquations::pushes(const Eigen::VectorXd &x, double speed,
                                                           double deflection) const {
    const Balance at = balance(x, speed, deflection, Motions::stiffness);
    std::vector<Push> out;
    for (Index i = rotor_unknowns(); i < unknowns(); ++i)
        out.push_back({at.left(i), at.sizes(i)});
    return out;
}

modes::DenseQuadratic<double> SteadyEquations::about(const Eigen::VectorXd &x, double speed,
                                                     const Held &held) const {
    modes::DenseQuadratic<double> all = balance(x, speed, 0, Motions::all).motions;
    if (held.empty())
        return all;
    std::vector<Index> moving;
    for (Index i = 0; i < unknowns(); ++i)
        if (!std::ranges::binary_search(held, i - rotor_unknowns()))
            moving.push_back(i);
    for (Eigen::MatrixXd *part : {&all.M, &all.D, &all.K})
        *part = part->operator()(moving, moving).eval();
    return all;
}

} // namespace whirl::states
