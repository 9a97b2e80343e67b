#include "synchronous/branch.h"

#include "synchronous/parts.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace whirl::synchronous {

namespace {

using Complex = std::complex<double>;
using ComplexSparse = ComplexQuadratic::Sparse;

/// Steps below this part that shrink no more are rounding, which very stiff meshes have; so are
/// larger ones within what rounding of the entries can cause.
constexpr double no_better = 1e-7;

void normalise(Eigen::VectorXcd &x) {
    Eigen::Index largest = 0;
    x.cwiseAbs2().maxCoeff(&largest);
    x /= x(largest);
}

/// Rounding of the entries of Q(l) against the derivative.
double rounding_of(const ComplexQuadratic &Q, Complex l, const Eigen::VectorXcd &x,
                   const Eigen::VectorXcd &y, Complex derivative) {
    const Eigen::VectorXd a = x.cwiseAbs();
    const Eigen::VectorXd b = y.cwiseAbs();
    const double size = std::abs(l);
    const Eigen::SparseMatrix<double> M = Q.M.cwiseAbs();
    const Eigen::SparseMatrix<double> D = Q.D.cwiseAbs();
    const Eigen::SparseMatrix<double> K = Q.K.cwiseAbs();
    const double entries = b.dot(K * a) + size * b.dot(D * a) + size * size * b.dot(M * a);
    return std::numeric_limits<double>::epsilon() * entries / (std::abs(derivative) * size);
}

} // namespace

LinearSynchronous::LinearSynchronous(ComplexQuadratic from, ComplexQuadratic to, double s_from,
                                     double s_to)
    : _from(std::move(from)), _to(std::move(to)), _s_from(s_from), _s_to(s_to) {
    const Eigen::VectorXd size = _from.K.diagonal().cwiseAbs() +
                                 s_to * s_to * Eigen::VectorXd(_from.M.diagonal().cwiseAbs());
    _scale = unit_diagonal(size);
    const Eigen::VectorXcd scale = _scale.cast<Complex>();
    for (ComplexQuadratic *Q : {&_from, &_to})
        for (ComplexSparse *A : {&Q->M, &Q->D, &Q->K})
            *A = scale.asDiagonal() * ComplexSparse(*A * scale.asDiagonal());
    _D_slope = (_to.D - _from.D) / (s_to - s_from);
    _K_slope = (_to.K - _from.K) / (s_to - s_from);
}

std::optional<BranchPoint> LinearSynchronous::point(double s, Complex l,
                                                    const Eigen::VectorXcd &start,
                                                    double tolerance) const {
    const double t = s - _s_from;
    const ComplexQuadratic Q{_from.M, _from.D + t * _D_slope, _from.K + t * _K_slope};
    BranchPoint out;
    Eigen::VectorXcd x = _scale.cwiseInverse().cwiseProduct(start);
    Eigen::VectorXcd y = x;
    linalg::SparseFactor<Complex> &lu = _factors;
    double last_step = std::numeric_limits<double>::infinity();
    for (int iteration = 0; iteration < 12; ++iteration) {
        const ComplexSparse slope = Q.slope(l);
        // Exactly singular is too much.
        if (!lu.factorize(Q.at(l)) && !lu.factorize(Q.at(l * (1 + 1e-13))) &&
            !lu.factorize(Q.at(l * (1 - 3e-13))))
            return std::nullopt;
        for (int repeat = 0; repeat < (iteration == 0 ? 2 : 1); ++repeat) {
            x = lu.solution(slope * x);
            y = lu.adjoint_solution(slope.adjoint() * y);
            normalise(x);
            normalise(y);
        }
        if (!x.allFinite() || !y.allFinite())
            return std::nullopt;
        const Complex derivative = y.dot(slope * x);
        const Complex step = y.dot(Q.at(l) * x) / derivative;
        l -= step;
        const double size = std::abs(step) / std::abs(l);
        const bool stays = size >= last_step / 4;
        if (size < tolerance || (stays && size < no_better) ||
            (stays && size < 10 * rounding_of(Q, l, x, y, derivative))) {
            out.eigenvalue = l;
            out.shape = _scale.cwiseProduct(x);
            normalise(out.shape);
            out.slope = -y.dot(l * (_D_slope * x) + _K_slope * x) / derivative;
            out.residual = size < tolerance ? 0 : size;
            out.rounding = rounding_of(Q, l, x, y, derivative);
            out.pushes_down = x.dot(Q.M * x).real() > 0;
            return out;
        }
        last_step = size;
    }
    return std::nullopt;
}

std::optional<BranchPoint> LinearSynchronous::standing(double s, Complex l,
                                                       const Eigen::VectorXcd &x) const {
    Eigen::VectorXcd shape = x;
    const double slack = 1e-9 * _s_to;
    double last_step = std::numeric_limits<double>::infinity();
    for (int iteration = 0; iteration < 20; ++iteration) {
        std::optional<BranchPoint> here = point(s, l, shape);
        if (!here)
            return std::nullopt;
        const double slope = here->slope.imag() - 1;
        const double step = (here->eigenvalue.imag() - s) / -slope;
        const double size = std::abs(step) / s;
        const bool stays = size >= last_step / 4;
        if (size <= 4e-14 || (stays && (size < no_better || size < 10 * here->rounding))) {
            // The speed answers to an error of l by 1 / |Im dl/ds - 1|.
            const double gain = std::max(1.0, 1 / std::abs(slope));
            here->eigenvalue.imag(s);
            here->residual = gain * here->residual + (size <= 4e-14 ? 0 : size);
            here->rounding *= gain;
            return here;
        }
        last_step = size;
        s += step;
        l = here->eigenvalue + step * here->slope;
        shape = here->shape;
        if (!(s >= _s_from - slack && s <= _s_to + slack))
            return std::nullopt;
    }
    return std::nullopt;
}

const LinearSynchronous &WholeRoots::piece(std::size_t i) const {
    const std::vector<double> &rows = _problem.rows();
    const std::size_t from = i == 0 ? 0 : i - 1;
    const std::size_t to = std::min(i, rows.size() - 1);
    if (!_pieces[i]) {
        const double length = from == to ? 1 : rows[to] - rows[from];
        _pieces[i] = std::make_unique<LinearSynchronous>(_problem.at_row(from), _problem.at_row(to),
                                                         rows[from], rows[from] + length);
    }
    return *_pieces[i];
}

std::size_t WholeRoots::piece_of(double speed) const {
    const std::vector<double> &rows = _problem.rows();
    return static_cast<std::size_t>(std::ranges::upper_bound(rows, speed) - rows.begin());
}

std::optional<BranchPoint> WholeRoots::in_piece(std::size_t i, double s, Complex l,
                                                const Eigen::VectorXcd &x) const {
    const std::vector<double> &rows = _problem.rows();
    if (_problem.constant())
        return piece(0).point(rows.front(), l, x);
    if (i > 0 && i < rows.size())
        return piece(i).standing(s, l, x);
    constexpr double at_a_row = 1e-9; // relative: beyond what rounding moves a root by
    const double row = i == 0 ? rows.front() : rows.back();
    std::optional<BranchPoint> found = piece(i).point(row, l, x);
    const double speed = found ? found->eigenvalue.imag() : 0;
    if (i == 0 ? speed > row * (1 + at_a_row) : speed < row * (1 - at_a_row))
        return std::nullopt;
    return found;
}

std::optional<BranchPoint> WholeRoots::near(double s, Complex l, const Eigen::VectorXcd &x) const {
    if (_problem.constant())
        return in_piece(0, s, l, x);
    const auto here = static_cast<int>(piece_of(s));
    for (const int aside : {0, -1, 1, -2, 2})
        if (const int i = here + aside; i >= 0 && i < static_cast<int>(_pieces.size()))
            if (auto found = in_piece(static_cast<std::size_t>(i), s, l, x))
                return found;
    return std::nullopt;
}

} // namespace whirl::synchronous
