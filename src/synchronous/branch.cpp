#include "synchronous/branch.h"

#include "linalg/check.h"

#include <algorithm>
#include <cmath>

namespace whirl::synchronous {

WholeRoots::WholeRoots(const SynchronousProblem &problem) : _problem(problem) {}

/// 0 below the first row, i between rows i - 1 and i, the number of rows above the last one.
std::size_t WholeRoots::piece_of(double speed) const {
    const std::vector<double> &rows = _problem.rows();
    return _problem.constant()
               ? 0
               : static_cast<std::size_t>(std::ranges::upper_bound(rows, speed) - rows.begin());
}

WholeRoots::Piece WholeRoots::piece(std::size_t i) const {
    const std::vector<double> &rows = _problem.rows();
    const std::size_t from = i == 0 ? 0 : i - 1;
    const std::size_t to = std::min(i, rows.size() - 1);
    Piece out{_problem.at_row(from), {}, rows[from], rows[to]};
    if (from < to) {
        const ComplexQuadratic &a = _problem.change(from);
        const ComplexQuadratic &b = _problem.change(to);
        out.rate.D = (b.D - a.D) / (out.to - out.from);
        out.rate.K = (b.K - a.K) / (out.to - out.from);
    }
    return out;
}

ComplexQuadratic WholeRoots::Piece::at(double speed) const {
    ComplexQuadratic out = first;
    if (from < to) {
        out.D += (speed - from) * rate.D;
        out.K += (speed - from) * rate.K;
    }
    return out;
}

std::optional<BranchPoint> WholeRoots::in_piece(const Piece &piece, Complex l,
                                                const Eigen::VectorXcd &start) const {
    constexpr int most_steps = 20;    // a guard: quadratic
    constexpr double settled = 1e-13; // relative
    // Steps below this part that shrink no more are rounding, which very stiff meshes have; so are
    // larger ones within what rounding of the entries can cause.
    constexpr double no_better = 1e-7;
    constexpr double most_rounding = 1e-3; // of a root that is one
    const bool tables = piece.from < piece.to;
    modes::WholeRoot root{l, start, start};
    double last_step = 1;
    for (int step = 0; step < most_steps; ++step) {
        const double speed = root.value.imag();
        const ComplexQuadratic at = piece.at(speed);
        if (tables || !_is_set)
            _pencil.set({at.M, at.D, at.K, {}, {}}, std::abs(l));
        _is_set = !tables && _problem.constant();
        auto found = _pencil.refined(root);
        if (!found)
            return std::nullopt;
        root = *std::move(found);
        BranchPoint out;
        double size = 0;
        if (tables) { // Im (l + slope ds) = speed + ds
            const Complex value = root.value;
            const Complex derivative = root.left.dot(at.slope(value) * root.right);
            const Complex change = value * root.left.dot(piece.rate.D * root.right) +
                                   root.left.dot(piece.rate.K * root.right);
            out.slope = -change / derivative;
            const double ds = (value.imag() - speed) / (1 - out.slope.imag());
            root.value = {value.real() + out.slope.real() * ds, speed + ds};
            size = std::abs(root.value - Complex(value.real(), speed)) / std::abs(value);
            if (!std::isfinite(size))
                return std::nullopt;
        }
        // The speed answers to an error of l by 1 / |Im dl/ds - 1|.
        const double gain = std::max(1.0, 1 / std::abs(1 - out.slope.imag()));
        const bool done = size * std::min(1.0, size / last_step) < settled;
        const bool stays = step > 0 && size >= last_step / 4;
        if (done ||
            (stays && (size < no_better || size < std::min(10 * root.rounding, most_rounding)))) {
            out.eigenvalue = root.value;
            out.shape = root.right;
            Eigen::Index largest = 0;
            out.shape.cwiseAbs2().maxCoeff(&largest);
            out.shape /= out.shape(largest);
            out.residual = gain * (root.residual + (stays ? size : 0));
            out.rounding = gain * root.rounding;
            out.pushes_down = root.right.dot(at.M * root.right).real() > 0;
            return out;
        }
        last_step = std::min(size, 1.0);
    }
    return std::nullopt;
}

int WholeRoots::negative_eigenvalues(double speed) const {
    const ComplexQuadratic at = piece(piece_of(speed)).at(speed);
    const ComplexQuadratic::Sparse Q = at.K - (speed * speed) * at.M;
    _inertia.compute(Q);
    if (_inertia.info() != Eigen::Success)
        throw linalg::SolverError("an inertia count met a zero pivot");
    return static_cast<int>((_inertia.vectorD().real().array() < 0).count());
}

std::optional<BranchPoint> WholeRoots::near(Complex l, const Eigen::VectorXcd &x) const {
    constexpr double at_a_row = 1e-9; // relative: beyond what rounding moves a root by
    const auto here = static_cast<int>(piece_of(l.imag()));
    const auto last = static_cast<int>(_problem.constant() ? 0 : _problem.rows().size());
    for (const int aside : {0, -1, 1, -2, 2}) {
        const int i = here + aside;
        if (i < 0 || i > last)
            continue;
        const Piece at = piece(static_cast<std::size_t>(i));
        const auto found = in_piece(at, l, x);
        const double speed = found ? found->eigenvalue.imag() : 0;
        const bool below = i > 0 && speed < at.from * (1 - at_a_row);
        const bool above = i < last && speed > at.to * (1 + at_a_row);
        if (found && !below && !above)
            return found;
    }
    return std::nullopt;
}

std::optional<BranchPoint> WholeRoots::near_across(Complex l, const Eigen::VectorXcd &x,
                                                   const Eigen::VectorXcd &root) const {
    constexpr double hardly = 0.01; // of the energy
    const ComplexQuadratic::Sparse &M = _problem.first().M;
    const Eigen::VectorXcd of_root = M * root;
    const Eigen::VectorXcd across = x - (of_root.dot(x) / of_root.dot(root)) * root;
    const double left = std::abs(across.dot(M * across));
    return left > hardly * std::abs(x.dot(M * x)) ? near(l, across) : std::nullopt;
}

} // namespace whirl::synchronous
