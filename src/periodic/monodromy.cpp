#include "periodic/monodromy.h"

#include "linalg/check.h"
#include "linalg/dense/general_eigen.h"
#include "linalg/dense/products.h"
#include "linalg/quadratic/quadratic_eigen.h"
#include "periodic/half_turn.h"
#include "periodic/step_maps.h"

#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

namespace whirl::periodic {

namespace {

using Complex = std::complex<double>;
using Eigen::MatrixXcd;
using Eigen::MatrixXd;
using linalg::Rows;

constexpr double epsilon = std::numeric_limits<double>::epsilon();

/// As FloquetMotion::action says, of an equation that conserves it.
double action_of(const System::Steady &steady, const Eigen::VectorXcd &shape) {
    const Eigen::Index n = shape.size() / 2;
    const Eigen::VectorXcd q = shape.head(n);
    const Eigen::VectorXcd rate = shape.tail(n);
    const auto squared = [&steady](const Eigen::VectorXcd &x) {
        return x.dot(steady.M * x).real();
    };
    const Eigen::VectorXd real = q.real();
    const Eigen::VectorXd imag = q.imag();
    const Eigen::VectorXd damping = steady.D * imag;
    const double action = q.dot(steady.M * rate).imag() + real.dot(damping);
    return action / std::sqrt(squared(q) * squared(rate));
}

} // namespace

Eigen::VectorXd weights_of(const System::Steady &steady, double speed) {
    const Eigen::Index n = steady.M.rows();
    const Eigen::ArrayXd M = steady.M.diagonal().array().abs().sqrt();
    Eigen::ArrayXd q = steady.K.diagonal().array().abs().sqrt().max(std::abs(speed) * M);
    q = (q > 0).select(q, 1.0);
    // What has no mass has a rate of no weight of its own.
    const Eigen::ArrayXd v = (M > 0).select(M, q / std::max(std::abs(speed), 1e-300));
    Eigen::VectorXd out(2 * n);
    out << q.matrix(), v.matrix();
    return out;
}

MatrixXd monodromy(const System &system, double speed, int steps, std::vector<Rows> *along) {
    if (along == nullptr)
        if (std::optional<MatrixXd> found = half_turn_by_windows(system, speed, steps))
            return *std::move(found);
    const double length = period(speed) / steps;
    const StepMaps maps(system, speed, length);
    Rows state = Rows::Identity(2 * system.size(), 2 * system.size());
    Rows next = state;
    Rows step_map = state;
    for (int step = 0; step < steps; ++step) {
        if (along != nullptr)
            along->push_back(state);
        maps.set_map(step * length, step_map);
        next.noalias() = step_map * state;
        std::swap(state, next);
    }
    if (!state.allFinite())
        throw linalg::SolverError("the motion over half a turn cannot be found");
    return state;
}

std::vector<FloquetMotion> motions_of(const System &system, double speed,
                                      const MatrixXd &monodromy) {
    const System::Steady steady = system.steady(speed);
    const Eigen::VectorXd weights = weights_of(steady, speed);
    const MatrixXd turn = weights.asDiagonal() * monodromy * weights.cwiseInverse().asDiagonal();
    const linalg::GeneralEigen found = linalg::general_eigen(turn, linalg::Vectors::both);
    const double size = turn.norm();
    const bool conserves = system.conserves(speed);
    std::vector<FloquetMotion> out;
    for (Eigen::Index i = 0; i < turn.cols(); ++i) {
        const Complex multiplier = found.values(i);
        const Eigen::VectorXcd right = vector_of(found, found.right, i);
        const Eigen::VectorXcd left = vector_of(found, found.left, i);
        const double sharp = std::abs(found.products(i)) / (right.norm() * left.norm());
        const double rounding_of_value = 10 * epsilon * size / std::max(sharp, epsilon);
        constexpr double known = 1e-3; // of a multiplier
        if (!(rounding_of_value < known * std::abs(multiplier)))
            continue;
        FloquetMotion motion;
        motion.value = std::log(multiplier) / period(speed);
        motion.noise = rounding_of_value / std::abs(multiplier) / period(speed);
        motion.state = right.normalized();
        motion.shape = weights.cwiseInverse().cwiseProduct(motion.state);
        motion.frequency = frequency_of(steady.M, motion.shape);
        if (conserves)
            motion.action = action_of(steady, motion.shape);
        out.push_back(std::move(motion));
    }
    return out;
}

std::vector<FloquetMotion> floquet_motions(const System &system, double speed, int steps) {
    std::vector<FloquetMotion> out = motions_of(system, speed, monodromy(system, speed, steps));
    // What rounding leaves of a step is the same in all of them.
    constexpr double of_a_step = 20 * epsilon; // 14 were seen of conserving rotors
    for (FloquetMotion &motion : out)
        motion.noise += of_a_step * steps / period(speed);
    return out;
}

std::vector<FloquetMotion> steady_motions(const System &system, double speed) {
    System::Steady steady = system.steady(speed);
    if (speed == 0) {
        const MatrixXd still = system.turning(0, 0);
        const MatrixXd &P = system.places();
        const auto over_unknowns = [&P](const MatrixXd &at_places) {
            return linalg::times(linalg::times(P, at_places), MatrixXd(P.transpose()));
        };
        steady.K += over_unknowns(still.leftCols(P.cols()));
        if (still.cols() > P.cols())
            steady.D += over_unknowns(still.rightCols(P.cols()));
    }
    linalg::QuadraticOptions options;
    options.method = linalg::QuadraticMethod::dense;
    options.wanted = 2 * system.size();
    options.fewest = 1; // of those asked for as many as can be resolved
    const double scale = std::sqrt(steady.K.norm() / steady.M.norm());
    options.shift = 0.31 * std::max(std::abs(speed), 1e-3 * scale);
    const Eigen::VectorXd weights = weights_of(steady, speed);
    std::vector<FloquetMotion> out;
    const auto found = linalg::solve_quadratic(steady.M.sparseView(), steady.D.sparseView(),
                                               steady.K.sparseView(), options);
    for (const linalg::ComplexPair &pair : found.pairs) {
        FloquetMotion motion;
        motion.value = pair.value;
        motion.shape.resize(2 * system.size());
        motion.shape << pair.vector, pair.value * pair.vector;
        motion.state = weights.cwiseProduct(motion.shape).normalized();
        motion.noise = (100 * pair.rounding + 10 * pair.residual) * std::abs(pair.value);
        motion.frequency = std::abs(pair.value);
        out.push_back(motion);
        if (pair.value.imag() == 0)
            continue;
        motion.value = std::conj(motion.value);
        motion.state = motion.state.conjugate().eval();
        motion.shape = motion.shape.conjugate().eval();
        out.push_back(std::move(motion));
    }
    return out;
}

} // namespace whirl::periodic
