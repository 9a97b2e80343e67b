#include "periodic/monodromy.h"

#include "linalg/check.h"
#include "linalg/dense/general_eigen.h"
#include "linalg/dense/products.h"
#include "linalg/lanes/row_products.h"
#include "linalg/lanes/small_products.h"
#include "linalg/quadratic/quadratic_eigen.h"
#include "periodic/collocation.h"
#include "periodic/half_turn.h"

#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

namespace whirl::periodic {

namespace {

using Complex = std::complex<double>;
using Eigen::MatrixXd;
using linalg::Rows;

/// Matrices n x c of all stages, a row each: their rows one after another.
class Blocks {
  public:
    Blocks(Eigen::Index rows, Eigen::Index columns)
        : _rows(rows), _columns(columns), _all(Rows::Zero(stages, rows * columns)) {}

    [[nodiscard]] Eigen::Index rows() const { return _rows; }
    [[nodiscard]] Eigen::Index columns() const { return _columns; }
    [[nodiscard]] const Rows &all() const { return _all; }
    [[nodiscard]] Rows &all() { return _all; }
    [[nodiscard]] Eigen::Map<Rows> at(Eigen::Index stage) {
        return {_all.row(stage).data(), _rows, _columns};
    }
    [[nodiscard]] Eigen::Map<const Rows> at(Eigen::Index stage) const {
        return {_all.row(stage).data(), _rows, _columns};
    }

  private:
    Eigen::Index _rows, _columns;
    Rows _all;
};

/// The collocation equations of the steady part over one step, U_i the change of q from its
/// beginning to point i, B the inverse of the method's matrix over the length of the step:
///
///     sum_k (B^2)_ik M U_k + B_ik D U_k + K U_i = f_i
class StageSystem {
  public:
    StageSystem(const System::Steady &steady, double length)
        : _M(-steady.M), _D(-steady.D), _K(-steady.K), _B(collocation().inverse / length),
          _left(stages, stages), _T(stages, stages) {
        const Collocation &points = collocation();
        for (Eigen::Index pair = 0; pair < stages / 2; ++pair) {
            const Complex root = points.roots(pair) / length;
            _factors.emplace_back(root * root * steady.M + root * steady.D +
                                  steady.K.cast<Complex>());
            _left.row(2 * pair) = points.left.row(pair).real();
            _left.row(2 * pair + 1) = points.left.row(pair).imag();
            _T.col(2 * pair) = 2 * points.T.col(pair).real();
            _T.col(2 * pair + 1) = -2 * points.T.col(pair).imag();
        }
    }

    /// sum_k B_ik of each i
    [[nodiscard]] Eigen::VectorXd start() const { return _B.rowwise().sum(); }

    /// @param right  of as many columns as fill whole vectors of the machine
    [[nodiscard]] Blocks solve(const Blocks &right) const {
        Blocks out = transformed(right);
        // The transformation costs four digits: they come back.
        out.all() += transformed(rest(right, out)).all();
        return out;
    }

    /// sum_k B_ik X_k
    [[nodiscard]] Blocks rates(const Blocks &X) const {
        Blocks out(X.rows(), X.columns());
        linalg::set_product(_B, X.all(), out.all());
        return out;
    }

  private:
    Rows _M, _D, _K; ///< all with a minus
    Rows _B;
    Rows _left, _T;                          ///< of the pairs, real and imaginary parts
    std::vector<linalg::RowSolver> _factors; ///< of one root of each pair

    /// The transformation makes one system of each root.
    [[nodiscard]] Blocks transformed(const Blocks &right) const {
        Blocks sums(right.rows(), right.columns()); // two parts of each pair
        linalg::set_product(_left, right.all(), sums.all());
        for (Eigen::Index pair = 0; pair < stages / 2; ++pair)
            _factors[static_cast<std::size_t>(pair)].solve(sums.at(2 * pair),
                                                           sums.at(2 * pair + 1));
        Blocks out(right.rows(), right.columns());
        linalg::set_product(_T, sums.all(), out.all());
        return out;
    }

    [[nodiscard]] Blocks rest(const Blocks &right, const Blocks &U) const {
        const Blocks V = rates(U);
        const Blocks W = rates(V);
        Blocks out = right;
        for (Eigen::Index i = 0; i < stages; ++i) {
            linalg::add_product(_M, W.at(i), out.at(i));
            linalg::add_product(_D, V.at(i), out.at(i));
            linalg::add_product(_K, U.at(i), out.at(i));
        }
        return out;
    }
};

/// The maps of a step of one length, s = stages: the state at its end is R x + L f, displacements
/// and rates at the places and points (or displacements alone) Y x + Z f, of the state x at its
/// beginning and forces -f at places and points (points one after the other).
struct StepMaps {
    Rows R; ///< 2n x 2n
    Rows L; ///< 2n x sm
    Rows Y; ///< 2sm x 2n, or sm x 2n
    Rows Z; ///< 2sm x sm, or sm x sm

    StepMaps(const System &system, double speed, double length) {
        const System::Steady steady = system.steady(speed);
        const StageSystem equations(steady, length);
        const Eigen::Index n = system.size();
        const MatrixXd &P = system.places();
        const Eigen::Index m = P.cols();
        const Eigen::Index columns = 2 * n + stages * m;
        const Eigen::VectorXd start = equations.start();
        Blocks right(n, linalg::whole_vectors(columns));
        for (Eigen::Index i = 0; i < stages; ++i) {
            auto here = right.at(i);
            here.leftCols(n) = -steady.K;
            here.middleCols(n, n) = start(i) * steady.M;
            here.middleCols(2 * n + i * m, m) = -P;
        }
        Blocks q = equations.solve(right);
        const Blocks v = equations.rates(q);
        for (Eigen::Index i = 0; i < stages; ++i)
            q.at(i).leftCols(n).diagonal().array() += 1;
        Rows last(2 * n, columns);
        last << q.at(stages - 1).leftCols(columns), v.at(stages - 1).leftCols(columns);
        if (!last.allFinite())
            throw linalg::SolverError("a step in time meets a singular matrix");
        R = last.leftCols(2 * n);
        L = last.rightCols(stages * m);
        if (m == 0) { // nothing acts back
            Y.resize(0, 2 * n);
            Z.resize(0, 0);
            return;
        }
        const Eigen::Index rows = system.turning(speed, 0).cols(); // at each point
        const Rows at_places = P.transpose();
        Rows seen(stages * rows, columns);
        for (Eigen::Index i = 0; i < stages; ++i) {
            linalg::set_product(at_places, q.at(i).leftCols(columns), seen.middleRows(i * rows, m));
            if (rows > m)
                linalg::set_product(at_places, v.at(i).leftCols(columns),
                                    seen.middleRows(i * rows + m, m));
        }
        Y = seen.leftCols(2 * n);
        Z = seen.rightCols(stages * m);
    }
};

/// How displacements and rates at the places act back at each point of one step: S_i (y, y').
std::vector<Rows> forces(const System &system, double speed, double from, double length) {
    std::vector<Rows> out;
    for (int i = 0; i < stages; ++i) {
        const double time = from + collocation().nodes(i) * length;
        out.emplace_back(system.turning(speed, 2 * speed * time));
    }
    return out;
}

/// S A, S with these blocks on its diagonal.
void set_product(const std::vector<Rows> &S, const Rows &A, linalg::RowsOut out) {
    const Eigen::Index m = S.front().rows();
    const Eigen::Index seen = S.front().cols();
    for (Eigen::Index i = 0; i < stages; ++i)
        linalg::set_product(S[static_cast<std::size_t>(i)], A.middleRows(i * seen, seen),
                            out.middleRows(i * m, m));
}

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
    const double length = period(speed) / steps;
    const StepMaps maps(system, speed, length);
    const Eigen::Index forces_at_once = maps.Z.cols();
    const Rows away = -maps.Z;
    Rows state = Rows::Identity(2 * system.size(), 2 * system.size());
    Rows next = state;
    Rows step_map = maps.R;
    Rows acting(forces_at_once, forces_at_once + state.cols()); // beside what acts back on itself
    for (int step = 0; step < steps; ++step) {
        if (along != nullptr)
            along->push_back(state);
        if (forces_at_once > 0) { // the supports are not the same from every direction
            const std::vector<Rows> S = forces(system, speed, step * length, length);
            set_product(S, away, acting.leftCols(forces_at_once));
            acting.leftCols(forces_at_once).diagonal().array() += 1;
            set_product(S, maps.Y, acting.rightCols(state.cols()));
            linalg::solve_beside(acting);
            step_map = maps.R;
            linalg::add_product(maps.L, acting.rightCols(state.cols()), step_map);
        }
        linalg::set_product(step_map, state, next);
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
    return motions_of(system, speed, monodromy(system, speed, steps));
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
