#include "modes/hill/series_basis.h"

#include "assembly/hill_system.h"
#include "assembly/planes.h"
#include "linalg/dense/products.h"
#include "modes/hill/modulation.h"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace whirl::modes {

namespace {

using Complex = std::complex<double>;
using Series = Eigen::MatrixXcd; ///< as of hill_terms

using assembly::i_unit;

/// At rest every term is the same motion. Just beside it the part of the shaft that turns with the
/// spin is the constant one in rotating axes, and the one that turns against it the next.
Series at_rest(Series terms, Eigen::Index parts) {
    const Eigen::Index middle = terms.cols() / 2;
    const assembly::Planes shaft(terms.col(middle).head(parts));
    const Eigen::VectorXcd with = shaft.towards() / 2;
    const Eigen::VectorXcd against = shaft.against() / 2;
    terms.col(middle).head(parts) = assembly::in_pairs(with, -i_unit * with);
    if (middle > 0)
        terms.col(middle + 1).head(parts) = assembly::in_pairs(against, i_unit * against);
    return terms;
}

/// Displacements and rates of all terms below each other; of unit energy with `scale` as the
/// frequency of displacements.
class State {
  public:
    State(const Eigen::SparseMatrix<double> &mass, double scale, double turn)
        : _mass(mass), _scale(scale), _turn(turn) {}

    void put(const Series &terms, Complex value, Eigen::Ref<Eigen::VectorXcd> state,
             Eigen::Ref<Eigen::VectorXcd> weighted) const {
        const Eigen::Index n = terms.rows();
        const Eigen::Index half = state.size() / 2;
        const Eigen::Index middle = terms.cols() / 2;
        for (Eigen::Index k = 0; k < terms.cols(); ++k) {
            const Eigen::VectorXcd x = terms.col(k);
            const Complex l = value + i_unit * (_turn * static_cast<double>(k - middle));
            const Eigen::VectorXcd Mx = _mass * x;
            state.segment(k * n, n) = x;
            state.segment(half + k * n, n) = l * x;
            weighted.segment(k * n, n) = _scale * _scale * Mx;
            weighted.segment(half + k * n, n) = l * Mx;
        }
        const double size = std::sqrt(std::max(0.0, weighted.dot(state).real()));
        if (size > 0) {
            state /= size;
            weighted /= size;
        }
    }

  private:
    const Eigen::SparseMatrix<double> &_mass;
    double _scale, _turn;
};

/// Left vectors of the first columns: dual to all.
Eigen::MatrixXcd dual(const Eigen::MatrixXcd &right, const Eigen::MatrixXcd &weighted,
                      Eigen::Index count) {
    // Motions that stand still in the rotor are their own conjugates.
    constexpr double same = 1e-6;
    const Eigen::MatrixXcd gram = linalg::adjoint_times(weighted, right);
    Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXcd> solver;
    solver.setThreshold(same);
    solver.compute(Eigen::MatrixXcd(gram.adjoint()));
    const Eigen::MatrixXcd unit = Eigen::MatrixXcd::Identity(gram.rows(), count);
    const Eigen::MatrixXcd factors = solver.solve(unit);
    Eigen::MatrixXcd left = linalg::times(weighted, factors).conjugate();
    for (Eigen::Index i = 0; i < count; ++i) {
        const Complex product = left.col(i).cwiseProduct(right.col(i)).sum();
        left.col(i) *= product != 0.0 ? 1.0 / product : 0.0;
    }
    return left;
}

} // namespace

ModeBasis series_basis(const Eigen::SparseMatrix<double> &mass, Eigen::Index parts, int harmonics,
                       bool slow, const Spectrum &spectrum) {
    const Eigen::SparseMatrix<double> M =
        (mass + Eigen::SparseMatrix<double>(mass.transpose())) / 2;
    const auto count = std::ssize(spectrum.modes);
    const Eigen::Index size = 2 * mass.rows() * (2 * harmonics + 1);
    double scale = 0;
    for (const WhirlMode &mode : spectrum.modes)
        scale += std::abs(mode.eigenvalue) / static_cast<double>(count);
    // The mode itself, moved one way and the other, conjugate, and that moved.
    constexpr Eigen::Index aliases = 6;
    const State state(M, scale, 2 * spectrum.speed);
    Eigen::MatrixXcd right(size, aliases * count);
    Eigen::MatrixXcd weighted(size, aliases * count);
    for (Eigen::Index i = 0; i < count; ++i) {
        const WhirlMode &mode = spectrum.modes[static_cast<std::size_t>(i)];
        SeriesTerms motion{mode.rotating_value,
                           assembly::hill_terms(mode.rotating_vector, mass.rows())};
        if (slow && spectrum.speed != 0)
            motion = without_modulation(M, spectrum.speed, motion);
        Series terms = assembly::middle_terms(motion.terms, 2 * harmonics + 1);
        if (spectrum.speed == 0)
            terms = at_rest(std::move(terms), parts);
        Eigen::Index column = i;
        const auto put = [&](const Series &alias, Complex value, int places) {
            const Complex moved_value = value + i_unit * (2 * places * spectrum.speed);
            state.put(assembly::moved_terms(alias, places), moved_value, right.col(column),
                      weighted.col(column));
            column += count;
        };
        const Series turned = terms.rowwise().reverse().conjugate();
        for (const int places : {0, 1, -1})
            put(terms, motion.value, places);
        for (const int places : {0, 1, -1})
            put(turned, std::conj(motion.value), places);
    }
    ModeBasis out;
    out.complex_left = dual(right, weighted, count);
    out.complex_right = right.leftCols(count);
    for (Eigen::Index alias = 1; alias < aliases; ++alias)
        out.aliases.emplace_back(right.middleCols(alias * count, count));
    // Back from where an alias was moved to; a conjugate alias is its own way back.
    out.ways_back = {1, 0, 2, 3, 4};
    const double unknown = std::numeric_limits<double>::quiet_NaN();
    out.rate_below = Eigen::VectorXcd::Constant(count, unknown);
    out.rate_above = out.rate_below;
    return out;
}

} // namespace whirl::modes
