#include "synchronous/reduced.h"

#include "assembly/frequency_scales.h"
#include "assembly/planar_part.h"
#include "linalg/dense/products.h"
#include "linalg/symmetric_eigen.h"
#include "modes/zero_modes.h"
#include "reduction/planar_shapes.h"
#include "synchronous/parts.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace whirl::synchronous {

namespace {

using Complex = std::complex<double>;

/// Shapes of one plane as shapes of pairs (x, y).
Eigen::MatrixXd in_both_planes(const Eigen::MatrixXd &planar) {
    Eigen::MatrixXd out = Eigen::MatrixXd::Zero(2 * planar.rows(), 2 * planar.cols());
    for (Eigen::Index i = 0; i < planar.rows(); ++i)
        for (Eigen::Index j = 0; j < planar.cols(); ++j)
            out(2 * i, 2 * j) = out(2 * i + 1, 2 * j + 1) = planar(i, j);
    return out;
}

/// The least stiffness of a support over directions and rows; none where it pushes away.
double softest(const std::vector<model::BearingCoefficients> &rows,
               Eigen::Matrix2d model::BearingCoefficients::*which) {
    double least = std::numeric_limits<double>::infinity();
    for (const model::BearingCoefficients &row : rows) {
        const Eigen::Matrix2d k = (row.*which + (row.*which).transpose()) / 2;
        least = std::min(least, Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d>(k).eigenvalues()(0));
    }
    return std::max(least, 0.0);
}

/// Supports alike in all directions, as soft as they are in any and at any speed. What a support
/// holds is well described by shapes of a rotor that it does not hold, with its static deflections;
/// what is free of it is not by shapes that it holds: the stiffness left over is then a small
/// difference of energies.
model::Rotor with_softest_supports(model::Rotor rotor) {
    for (model::Bearing &bearing : rotor.bearings) {
        model::BearingCoefficients soft = bearing.rows.front();
        soft.k =
            softest(bearing.rows, &model::BearingCoefficients::k) * Eigen::Matrix2d::Identity();
        soft.kt =
            softest(bearing.rows, &model::BearingCoefficients::kt) * Eigen::Matrix2d::Identity();
        bearing.speeds.clear();
        bearing.rows = {soft};
        if (bearing.pedestal)
            bearing.pedestal->k.setConstant(bearing.pedestal->k.minCoeff());
    }
    return rotor;
}

/// Each unknown by itself, of a size at which K + top^2 M is about 1.
Eigen::MatrixXd all_unknowns(const assembly::Discretization &rotor, double top) {
    const assembly::PlanarPair pair = assembly::planar_pair(rotor, 0);
    const Eigen::VectorXd size =
        pair.K.diagonal().cwiseAbs() + top * top * Eigen::VectorXd(pair.M.diagonal().cwiseAbs());
    return unit_diagonal(size).asDiagonal();
}

} // namespace

SharedShapes all_shapes(const assembly::Discretization &rotor, double top) {
    return {all_unknowns(rotor, top), top};
}

SharedShapes synchronous_shapes(const assembly::Discretization &rotor, double top, int modes) {
    constexpr int small = 20; // planar unknowns that are all kept
    const int n = rotor.planar_size();
    if (rotor.rigid() || n <= small)
        return {all_unknowns(rotor, top), top};
    // Modes at rest up to 1.5 times what is wanted (PlanarShapes: twice its own), which the static
    // deflections complete: what they leave out moves a root by some 1e-4, and each is found again
    // on the whole rotor.
    constexpr double beyond = 1.5;
    const double described = beyond / 2 * top;
    const assembly::Discretization soft(with_softest_supports(rotor.rotor()), rotor.order());
    reduction::PlanarShapes shapes(soft, described, modes);
    std::vector<assembly::Combination> pedestals;
    for (std::size_t i = 0; i < rotor.rotor().bearings.size(); ++i)
        if (rotor.rotor().bearings[i].pedestal)
            pedestals.push_back({{rotor.pedestal_unknown(static_cast<int>(i)), 1.0}});
    if (!pedestals.empty())
        shapes.add_static(pedestals);
    const Eigen::MatrixXd &S = shapes.matrix();
    if (3 * S.cols() > 2 * n)
        return {all_unknowns(rotor, top), top};
    // S^T (K + t M) S = 1, t = described^2: 1 / (w^2 + t) are the eigenvalues of S^T M S, and the
    // last of as many modes may be far above the top.
    const auto at_rest = linalg::symmetric_eigenpairs(
        linalg::transposed_times(S, Eigen::MatrixXd(assembly::planar_pair(rotor, 0).M * S)));
    const double last = at_rest.eigenvalues()(std::max<Eigen::Index>(S.cols() - modes, 0));
    const double square = last > 0 ? 1 / last - described * described : 0;
    return {S, std::max(top, square > 0 ? std::sqrt(square) / beyond : 0)};
}

ReducedSynchronous::ReducedSynchronous(const SynchronousProblem &problem,
                                       const Eigen::MatrixXd &shapes)
    : _problem(problem), _shapes(problem.pairs() ? in_both_planes(shapes) : shapes),
      _first{projected(problem.first().M),
             projected(problem.first().D),
             projected(problem.first().K),
             {},
             {}},
      _scale(assembly::support_scale(problem.rotor())) {
    for (std::size_t i = 0; i < problem.rows().size(); ++i)
        _changes.push_back(
            {{}, projected(problem.change(i).D), projected(problem.change(i).K), {}, {}});
    const results::Form motions = problem.pairs() ? results::Form::general : results::Form::planar;
    for (const double row : problem.rows())
        _zeros.push_back(
            modes::zero_modes(problem.rotor(), motions, problem.spin() * row, 0).eigenvalues);
}

Eigen::MatrixXcd ReducedSynchronous::projected(const ComplexQuadratic::Sparse &A) const {
    Eigen::MatrixXcd out = Eigen::MatrixXcd::Zero(_shapes.cols(), _shapes.cols());
    if (A.nonZeros() == 0)
        return out;
    const Eigen::SparseMatrix<double> real = A.real();
    const Eigen::SparseMatrix<double> imaginary = A.imag();
    out.real() = linalg::transposed_times(_shapes, Eigen::MatrixXd(real * _shapes));
    if (imaginary.norm() > 0)
        out.imag() = linalg::transposed_times(_shapes, Eigen::MatrixXd(imaginary * _shapes));
    return out;
}

Eigen::VectorXcd ReducedSynchronous::lifted(const Eigen::VectorXcd &shape) const {
    Eigen::VectorXcd out(_shapes.rows());
    out.real() = _shapes * shape.real();
    out.imag() = _shapes * shape.imag();
    return out;
}

/// A rigid motion that no support resists is a double root of zero, which rounding splits.
int ReducedSynchronous::zeros_at(double speed, std::size_t piece) const {
    const std::vector<double> &rows = _problem.rows();
    if (piece + 1 == rows.size() || speed == rows[piece])
        return _zeros[piece];
    return speed == rows[piece + 1] ? _zeros[piece + 1]
                                    : std::min(_zeros[piece], _zeros[piece + 1]);
}

/// K x = W^2 M x through the eigenvalues 1 / (W^2 + t) of L^-1 M L^-H, K + t M = L L^H; none where
/// that is not positive definite.
std::vector<modes::Root> ReducedSynchronous::conservative(const Dense &at, int zeros) const {
    const double lift = 0.3 * assembly::elastic_scale(_problem.rotor());
    // No more than a stiffness that pushes away asks for: rounding is that of t.
    for (const double lifts : {0.0, 1.0, 1e2, 1e4, 1e6, 1e8}) {
        const double t = lifts * lift * lift;
        const Eigen::LLT<Eigen::MatrixXcd> factor(at.K + t * at.M);
        if (factor.info() != Eigen::Success || factor.rcond() < 1e-13)
            continue;
        Eigen::MatrixXcd A = factor.matrixL().solve(at.M);
        A = factor.matrixL().solve(Eigen::MatrixXcd(A.adjoint()));
        const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXcd> solver(A);
        if (solver.info() != Eigen::Success)
            continue;
        // A singular M has eigenvalues zero (speeds at infinity) only up to rounding.
        const double zero = 1e-13 * solver.eigenvalues().cwiseAbs().maxCoeff();
        std::vector<std::pair<double, Eigen::Index>> squares;
        for (Eigen::Index i = A.rows() - 1; i >= 0 && solver.eigenvalues()(i) > zero; --i)
            squares.emplace_back(1 / solver.eigenvalues()(i) - t, i);
        std::ranges::stable_sort(squares, {},
                                 [](const auto &square) { return std::abs(square.first); });
        squares.erase(squares.begin(),
                      squares.begin() + std::min<std::ptrdiff_t>(zeros / 2, std::ssize(squares)));
        std::vector<modes::Root> out;
        for (const auto &[square, i] : squares) {
            const double size = std::sqrt(std::abs(square));
            modes::Root root;
            root.right = root.left = factor.matrixU().solve(solver.eigenvectors().col(i));
            const double mass = root.right.dot(at.M * root.right).real();
            for (const double sign : {1.0, -1.0}) { // x^H (l^2 M + K) x = 0
                root.value = sign * (square > 0 ? Complex(0, size) : Complex(size, 0));
                root.slope = 2.0 * root.value * mass;
                out.push_back(root);
            }
        }
        return out;
    }
    return {};
}

std::vector<modes::Root> ReducedSynchronous::any(const Dense &at, int zeros) const {
    std::vector<modes::Root> out = modes::all_roots<Complex>(at, 0.1 * _scale, zeros);
    // Motions of elements almost without mass are lost in rounding among the others.
    std::erase_if(out, [this](const modes::Root &root) {
        constexpr double far = 1e4;    // of the slow motions
        constexpr double known = 1e-2; // relative
        const double size = std::abs(root.value);
        const bool lost = size > far * _scale && root.noise > known * size;
        if (lost)
            _known_to = std::min(_known_to, size);
        return lost;
    });
    return out;
}

modes::RootsAt ReducedSynchronous::at(double speed, std::size_t piece) const {
    const std::vector<double> &rows = _problem.rows();
    const bool tables = piece + 1 < rows.size();
    const double length = tables ? rows[piece + 1] - rows[piece] : 1;
    Dense rate;
    if (tables) {
        rate.D = (_changes[piece + 1].D - _changes[piece].D) / length;
        rate.K = (_changes[piece + 1].K - _changes[piece].K) / length;
    }
    modes::RootsAt out{speed, {}};
    if (_highest && _highest->speed == speed) {
        out = *_highest;
    } else {
        Dense now{_first.M, _first.D + _changes[piece].D, _first.K + _changes[piece].K, {}, {}};
        if (tables) {
            now.D += (speed - rows[piece]) * rate.D;
            now.K += (speed - rows[piece]) * rate.K;
        }
        const int zeros = zeros_at(speed, piece);
        if (_problem.conservative())
            out.roots = conservative(now, zeros);
        if (out.roots.empty())
            out.roots = any(now, zeros);
        if (!_highest || speed > _highest->speed)
            _highest = out;
    }
    if (tables)
        for (modes::Root &root : out.roots)
            root.rate = -root.left.dot(root.value * (rate.D * root.right) + rate.K * root.right) /
                        root.slope;
    return out;
}

} // namespace whirl::synchronous
