#include "linalg/semidefinite_pair.h"

#include "linalg/check.h"
#include "linalg/symmetric_eigen.h"

#include <cmath>

namespace whirl::linalg {

template <class Scalar>
CountedPair<Scalar>::CountedPair(const Sparse &K, const Sparse &A) : _K(K), _A(A) {
    if (_K.rows() == 0)
        return;
    // Moduli, so that nothing cancels in the pattern.
    const Eigen::SparseMatrix<double> pattern = _K.cwiseAbs() + _A.cwiseAbs();
    _factors.analyzePattern(pattern.template cast<Scalar>());
}

template <class Scalar> void CountedPair<Scalar>::factorise(double w) const {
    // A pivot that is exactly zero stops the factorisation; at a neighbouring speed it is not.
    // Where entries of K are 1e8 times w^2 A or more (short stiff spans), pivots come in steps of
    // their rounding, and such a one stays zero over as much as 1e-8 of the speed.
    for (const double nudge : {0.0, 1e-14, -3e-14, 1e-12, -3e-12, 1e-10, -3e-10, 1e-8, -3e-8}) {
        const double at = w * (1 + nudge);
        _factors.factorize(Sparse(_K - at * at * _A));
        if (_factors.info() == Eigen::Success)
            return;
    }
    throw SolverError("an inertia count met a zero pivot");
}

template <class Scalar> int CountedPair<Scalar>::count_below(double w) const {
    if (_K.rows() == 0)
        return 0;
    factorise(w);
    return static_cast<int>((_factors.vectorD().real().array() < 0).count());
}

/// The root between the two speeds by inverse iteration and Rayleigh's quotient; none where the
/// iteration leaves the interval.
template <class Scalar>
std::optional<double> CountedPair<Scalar>::refined(double from, double to) const {
    using Vector = Eigen::Matrix<Scalar, Eigen::Dynamic, 1>;
    Vector x = deterministic_vector(static_cast<int>(_K.rows())).template cast<Scalar>();
    double w = (from + to) / 2;
    double last_step = to - from;
    for (int iteration = 0; iteration < 15; ++iteration) {
        factorise(w);
        for (int repeat = 0; repeat < (iteration == 0 ? 4 : 1); ++repeat) {
            x = _factors.solve(Vector(_A * x));
            x /= x.norm();
        }
        const double kinetic = std::real(x.dot(_A * x));
        const double elastic = std::real(x.dot(_K * x));
        if (!(kinetic > 0) || !(elastic > 0))
            return std::nullopt;
        const double next = std::sqrt(elastic / kinetic);
        const double step = std::abs(next - w);
        if (!(next > from && next < to))
            return std::nullopt;
        // Steps fall with the third power, down to the rounding of the quotient.
        if (step <= 1e-14 * w || (step < 1e-9 * w && step >= last_step / 4))
            return next;
        last_step = step;
        w = next;
    }
    return std::nullopt;
}

template <class Scalar>
void CountedPair<Scalar>::split(double from, int below, double to, int above,
                                std::vector<double> &roots) const {
    const int inside = above - below;
    if (inside <= 0)
        return;
    const double middle = (from + to) / 2;
    if (to - from <= 1e-12 * to) {
        roots.insert(roots.end(), static_cast<std::size_t>(inside), middle);
        return;
    }
    if (inside == 1) {
        if (const std::optional<double> root = refined(from, to)) {
            roots.push_back(*root);
            return;
        }
    }
    const int at = count_below(middle);
    split(from, below, middle, at, roots);
    split(middle, at, to, above, roots);
}

template <class Scalar>
std::vector<double> CountedPair<Scalar>::roots(double from, double to) const {
    std::vector<double> out;
    if (_K.rows() > 0 && to > from)
        split(from, count_below(from), to, count_below(to), out);
    return out;
}

template class CountedPair<double>;
template class CountedPair<std::complex<double>>;

} // namespace whirl::linalg
