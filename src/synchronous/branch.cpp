#include "synchronous/branch.h"

#include "linalg/check.h"
#include "synchronous/parts.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace whirl::synchronous {

namespace {

using PatternMap = Eigen::Map<const ComplexQuadratic::Sparse>;

/// A sparse matrix of the pattern of another one.
PatternMap with_values(const ComplexQuadratic::Sparse &pattern, const Eigen::VectorXcd &values) {
    return {pattern.rows(),          pattern.cols(),          pattern.nonZeros(),
            pattern.outerIndexPtr(), pattern.innerIndexPtr(), values.data()};
}

void normalise(Eigen::VectorXcd &x) {
    Eigen::Index largest = 0;
    x.cwiseAbs2().maxCoeff(&largest);
    x /= x(largest);
}

} // namespace

WholeRoots::WholeRoots(const SynchronousProblem &problem) : _problem(problem), _factors(true) {
    const ComplexQuadratic &first = problem.first();
    // Cancelled entries keep their places: the pattern is that of all matrices at every speed.
    _Q = first.M.cwiseAbs().cast<Complex>() + first.D.cwiseAbs().cast<Complex>() +
         first.K.cwiseAbs().cast<Complex>();
    for (std::size_t i = 1; i < problem.rows().size(); ++i)
        _Q = ComplexQuadratic::Sparse(_Q + problem.change(i).D + problem.change(i).K);
    _Q.makeCompressed();
    const double speed = problem.rows().back();
    _scale = unit_diagonal(first.K.diagonal().cwiseAbs() +
                           speed * speed * Eigen::VectorXd(first.M.diagonal().cwiseAbs()));
    for (const auto &[values, matrix] :
         {std::pair(&_M, &first.M), std::pair(&_D, &first.D), std::pair(&_K, &first.K)}) {
        *values = Eigen::VectorXcd::Zero(_Q.nonZeros());
        for (const auto &[place, value] : entries_of(*matrix))
            (*values)(place) = value;
    }
    for (std::size_t i = 0; i < problem.rows().size(); ++i)
        _changes.push_back({entries_of(problem.change(i).D), entries_of(problem.change(i).K)});
}

/// Scaled, with their places in the pattern.
WholeRoots::Entries WholeRoots::entries_of(const ComplexQuadratic::Sparse &A) const {
    Entries out;
    for (int j = 0; j < A.outerSize(); ++j) {
        const auto *begin = _Q.innerIndexPtr() + _Q.outerIndexPtr()[j];
        const auto *end = _Q.innerIndexPtr() + _Q.outerIndexPtr()[j + 1];
        for (ComplexQuadratic::Sparse::InnerIterator it(A, j); it; ++it)
            out.emplace_back(std::lower_bound(begin, end, static_cast<int>(it.row())) -
                                 _Q.innerIndexPtr(),
                             _scale(it.row()) * _scale(j) * it.value());
    }
    return out;
}

/// 0 below the first row, i between rows i - 1 and i, the number of rows above the last one.
std::size_t WholeRoots::piece_of(double speed) const {
    const std::vector<double> &rows = _problem.rows();
    return _problem.constant()
               ? 0
               : static_cast<std::size_t>(std::ranges::upper_bound(rows, speed) - rows.begin());
}

/// D and K at its beginning.
WholeRoots::At WholeRoots::piece(std::size_t i) const {
    const std::vector<double> &rows = _problem.rows();
    const std::size_t from = i == 0 ? 0 : i - 1;
    const std::size_t to = std::min(i, rows.size() - 1);
    At out{_D, _K, {}, {}, rows[from], rows[to]};
    for (const auto &[place, value] : _changes[from].D)
        out.D(place) += value;
    for (const auto &[place, value] : _changes[from].K)
        out.K(place) += value;
    if (from == to)
        return out;
    const double length = out.to - out.from;
    for (const auto &[entries, which] :
         {std::pair(&out.D_rate, &Change::D), std::pair(&out.K_rate, &Change::K)}) {
        for (const auto &[place, value] : _changes[to].*which)
            entries->emplace_back(place, value / length);
        for (const auto &[place, value] : _changes[from].*which)
            entries->emplace_back(place, -value / length);
    }
    return out;
}

void WholeRoots::read_at(const At &piece, double speed, At &out) const {
    if (piece.from == piece.to)
        return;
    const double t = speed - piece.from;
    for (const auto &[place, value] : piece.D_rate)
        out.D(place) = piece.D(place);
    for (const auto &[place, value] : piece.K_rate)
        out.K(place) = piece.K(place);
    for (const auto &[place, value] : piece.D_rate)
        out.D(place) += t * value;
    for (const auto &[place, value] : piece.K_rate)
        out.K(place) += t * value;
}

bool WholeRoots::factorize(const At &at, Complex l) const {
    // Exactly singular is too much.
    for (const double offset : {0.0, 1e-13, -3e-13}) {
        const Complex m = l * (1 + offset);
        Eigen::Map<Eigen::VectorXcd>(_Q.valuePtr(), _Q.nonZeros()) = (m * m) * _M + m * at.D + at.K;
        if (_factors.factorize(_Q))
            return true;
        _factors.forget_pivots();
    }
    return false;
}

/// y^H A x
std::complex<double> WholeRoots::product(const Eigen::VectorXcd &y, const Eigen::VectorXcd &values,
                                         const Eigen::VectorXcd &x) const {
    return y.dot(with_values(_Q, values) * x);
}

std::complex<double> WholeRoots::product(const Eigen::VectorXcd &y, const Entries &entries,
                                         const Eigen::VectorXcd &x) const {
    Complex sum = 0;
    for (const auto &[place, value] : entries) {
        const auto *column =
            std::upper_bound(_Q.outerIndexPtr(), _Q.outerIndexPtr() + _Q.outerSize() + 1, place) -
            1;
        sum += std::conj(y(_Q.innerIndexPtr()[place])) * value * x(column - _Q.outerIndexPtr());
    }
    return sum;
}

/// Rounding of the entries of Q(l) against the derivative.
double WholeRoots::rounding(const At &at, Complex l, const Eigen::VectorXcd &x,
                            const Eigen::VectorXcd &y, Complex derivative) const {
    const double size = std::abs(l);
    const Eigen::VectorXd a = x.cwiseAbs();
    const Eigen::VectorXd b = y.cwiseAbs();
    double entries = 0;
    for (Eigen::Index j = 0; j < _Q.outerSize(); ++j)
        for (auto place = _Q.outerIndexPtr()[j]; place < _Q.outerIndexPtr()[j + 1]; ++place)
            entries += b(_Q.innerIndexPtr()[place]) * a(j) *
                       (std::abs(at.K(place)) + size * std::abs(at.D(place)) +
                        size * size * std::abs(_M(place)));
    return std::numeric_limits<double>::epsilon() * entries / (std::abs(derivative) * size);
}

std::optional<BranchPoint> WholeRoots::in_piece(const At &piece, Complex l,
                                                const Eigen::VectorXcd &start) const {
    constexpr int most_steps = 20;    // a guard: cubic with both vectors
    constexpr double settled = 1e-13; // relative, of the step that would follow
    // Steps below this part that shrink no more are rounding, which very stiff meshes have; so are
    // larger ones within what rounding of the entries can cause.
    constexpr double no_better = 1e-7;
    constexpr double most_rounding = 1e-3; // of a root that is one
    const bool tables = piece.from < piece.to;
    At at = piece;
    Eigen::VectorXcd x = _scale.cwiseInverse().cwiseProduct(start);
    Eigen::VectorXcd y = x;
    double last_step = 1;
    for (int step = 0; step < most_steps; ++step) {
        read_at(piece, l.imag(), at);
        if (!factorize(at, l))
            return std::nullopt;
        const Eigen::VectorXcd slope = (2.0 * l) * _M + at.D;
        const PatternMap S = with_values(_Q, slope);
        for (int repeat = 0; repeat < (step == 0 ? 2 : 1); ++repeat) {
            x = _factors.solution(S * x);
            y = _factors.adjoint_solution(S.adjoint() * y);
            normalise(x);
            normalise(y);
        }
        if (!x.allFinite() || !y.allFinite())
            return std::nullopt;
        const Complex derivative = y.dot(S * x);
        const Eigen::VectorXcd values = (l * l) * _M + l * at.D + at.K;
        const Complex value = product(y, values, x) / derivative;
        // l = a + i s: value + da + (i + rate) ds = 0
        const Complex rate =
            tables ? (l * product(y, at.D_rate, x) + product(y, at.K_rate, x)) / derivative
                   : Complex(0);
        const double ds = -value.imag() / (1 + rate.imag());
        const Complex change(-value.real() - rate.real() * ds, ds);
        l += change;
        const double size = std::abs(change) / std::abs(l);
        if (!std::isfinite(size))
            return std::nullopt;
        const bool stays = step > 0 && size >= last_step / 4;
        const bool done = size * std::min(1.0, size / last_step) < settled;
        const double left = done || stays ? rounding(at, l, x, y, derivative) : 0;
        if (done || (stays && (size < no_better || size < std::min(10 * left, most_rounding)))) {
            BranchPoint out;
            out.eigenvalue = l;
            out.slope = -rate;
            // The root is known to the square of what its vector is; the same factors once more
            // leave of the other vectors what they left of them before.
            const Eigen::VectorXcd sharper = _factors.solution(S * x);
            out.shape = _scale.cwiseProduct(sharper.allFinite() ? sharper : x);
            normalise(out.shape);
            // The speed answers to an error of l by 1 / |Im dl/ds - 1|.
            const double gain = std::max(1.0, 1 / std::abs(1 + rate.imag()));
            out.residual = stays ? gain * size : 0;
            out.rounding = gain * left;
            out.pushes_down = product(x, _M, x).real() > 0;
            return out;
        }
        last_step = std::min(size, 1.0);
    }
    return std::nullopt;
}

int WholeRoots::negative_eigenvalues(double speed) const {
    const At from = piece(piece_of(speed));
    At at = from;
    read_at(from, speed, at);
    Eigen::Map<Eigen::VectorXcd>(_Q.valuePtr(), _Q.nonZeros()) = at.K - (speed * speed) * _M;
    if (_inertia.rows() == 0)
        _inertia.analyzePattern(_Q);
    _inertia.factorize(_Q);
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
        const At at = piece(static_cast<std::size_t>(i));
        auto found = in_piece(at, l, x);
        if (!found) { // the pivots of another matrix may not do
            _factors.forget_pivots();
            found = in_piece(at, l, x);
        }
        const double speed = found ? found->eigenvalue.imag() : 0;
        const bool below = i > 0 && speed < at.from * (1 - at_a_row);
        const bool above = i < last && speed > at.to * (1 + at_a_row);
        if (found && !below && !above)
            return found;
    }
    return std::nullopt;
}

} // namespace whirl::synchronous
