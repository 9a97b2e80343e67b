#include "periodic/monodromy.h"

#include "linalg/check.h"
#include "linalg/dense/general_eigen.h"
#include "linalg/dense/products.h"
#include "linalg/lanes/row_products.h"
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

double frequency_of(const MatrixXd &M, const Eigen::VectorXcd &state) {
    const Eigen::Index n = M.rows();
    const auto square = [&M](const auto &x) { return std::abs(x.dot(M * x)); };
    const Eigen::VectorXcd q = state.head(n);
    const Eigen::VectorXcd v = state.tail(n);
    return std::sqrt(square(v) / std::max(square(q), 1e-300));
}

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

MatrixXd half_turn(const System &system, double speed, int steps, std::vector<Rows> *along) {
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
        linalg::set_product(step_map, state, next);
        std::swap(state, next);
    }
    if (!state.allFinite())
        throw linalg::SolverError("the motion over half a turn cannot be found");
    return state;
}

MatrixXcd along_half_turn(const System &system, double speed, int steps,
                          const FloquetMotion &motion) {
    const double length = period(speed) / steps;
    const StepMaps maps(system, speed, length);
    const Complex back = std::exp(-motion.value * length);
    MatrixXcd out(2 * system.size(), steps);
    Rows state(2 * system.size(), 2); // real and imaginary parts
    Rows next = state;
    out.col(0) = motion.shape;
    for (int step = 0; step + 1 < steps; ++step) {
        state << out.col(step).real(), out.col(step).imag();
        maps.set_end(step * length, state, next);
        out.col(step + 1) = back * (next.col(0) + Complex(0, 1) * next.col(1));
    }
    return out;
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
        const bool second = found.values(i).imag() < 0; // of a conjugate pair
        const Eigen::Index first = second ? i - 1 : i;
        const bool pair = found.is_pair(first);
        const Complex multiplier = found.values(i);
        const double right = linalg::packed_norm(found.right, first, pair);
        const double sharp =
            std::abs(found.products(i)) / (right * linalg::packed_norm(found.left, first, pair));
        const double drowned = 10 * epsilon * size / std::max(sharp, epsilon);
        constexpr double known = 1e-3; // of a multiplier
        if (!(drowned < known * std::abs(multiplier)))
            continue;
        FloquetMotion motion;
        motion.value = std::log(multiplier) / period(speed);
        motion.noise = drowned / std::abs(multiplier) / period(speed);
        motion.state = linalg::unpacked(found.right, first, pair) / right;
        if (second)
            motion.state = motion.state.conjugate().eval();
        motion.shape = weights.cwiseInverse().cwiseProduct(motion.state);
        motion.frequency = frequency_of(steady.M, motion.shape);
        if (conserves)
            motion.action = action_of(steady, motion.shape);
        out.push_back(std::move(motion));
    }
    return out;
}

MatrixXd monodromy(const System &system, double speed, int steps) {
    return half_turn(system, speed, steps, nullptr);
}

std::vector<FloquetMotion> floquet_motions(const System &system, double speed, int steps) {
    std::vector<FloquetMotion> out = motions_of(system, speed, monodromy(system, speed, steps));
    // What rounding leaves of a step is the same in all of them.
    constexpr double of_a_step = 5 * epsilon;
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
