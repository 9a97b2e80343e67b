#include "periodic/modal_series.h"

#include "assembly/hill_system.h"
#include "linalg/check.h"
#include "linalg/dense/general_eigen.h"
#include "linalg/dense/products.h"
#include "periodic/half_turn.h"

#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

namespace whirl::periodic {

namespace {

using Complex = std::complex<double>;
using Eigen::Index;
using Eigen::MatrixXcd;
using Eigen::MatrixXd;
using Eigen::VectorXcd;

/// A mode whose left and right vectors have a smaller product than this (both of length 1) is
/// defective within rounding.
constexpr double defective = 1e-9;
constexpr Index fewest_terms = 2 * 3 + 1;

Complex product(const MatrixXcd &a, const MatrixXcd &b) {
    return a.conjugate().cwiseProduct(b).sum();
}

/// s - 2 i k speed - l of all modes, a column for each term.
MatrixXcd off(const VectorXcd &steady, double speed, Complex l, Index terms) {
    MatrixXcd out(steady.size(), terms);
    const Index middle = terms / 2;
    for (Index k = 0; k < terms; ++k)
        out.col(k) = steady.array() - (l + Complex(0, 2 * speed * static_cast<double>(k - middle)));
    // At a mode that the supports do not touch.
    const double least = 1e-14 * (std::abs(l) + std::abs(speed));
    return (out.array().abs() > least).select(out, least);
}

} // namespace

/// (d_k x_k - acts f_k) = r_k with f_k = up observed x_k-1 + down observed x_k+1 for all terms.
struct ModalSeries::Chain {
    const MatrixXcd &acts, &observed, &up, &down;
    MatrixXcd inverse; ///< 1/d, a column each

    [[nodiscard]] MatrixXcd solve(const MatrixXcd &right) const;

  private:
    /// An end of the chain eliminated up to a term: f = constant + factor f_next.
    struct End {
        VectorXcd constant;
        MatrixXcd factor;
    };
    /// Motion of the places under the forces of a term.
    [[nodiscard]] MatrixXcd back(Index k) const {
        const MatrixXcd motion = inverse.col(k).asDiagonal() * acts;
        return linalg::times(observed, motion);
    }
    /// Forces of the motion without forces.
    [[nodiscard]] MatrixXcd alone(const MatrixXcd &right) const {
        const MatrixXcd motion = inverse.cwiseProduct(right);
        const MatrixXcd at_places = linalg::times(observed, motion);
        const Index others = right.cols() - 1;
        MatrixXcd out = MatrixXcd::Zero(acts.cols(), right.cols());
        out.rightCols(others) += linalg::times(up, at_places).leftCols(others);
        out.leftCols(others) += linalg::times(down, at_places).rightCols(others);
        return out;
    }
    /// A term with the end of the chain eliminated.
    /// @param behind  back() of the end's term through up or down; empty at the first term
    /// @param ahead   of the next one
    [[nodiscard]] static End longer(const VectorXcd &constant, const End &end,
                                    const MatrixXcd &behind, const MatrixXcd &ahead) {
        if (behind.size() == 0)
            return {constant, ahead};
        MatrixXcd own = -linalg::times(behind, end.factor);
        own.diagonal().array() += 1;
        const Eigen::PartialPivLU<MatrixXcd> lu(own);
        const VectorXcd forces = constant + linalg::times(behind, end.constant);
        return {linalg::solved(lu, forces), linalg::solved(lu, ahead)};
    }
};

/// Elimination from both ends: what is singular at a root is the equation of the middle term.
MatrixXcd ModalSeries::Chain::solve(const MatrixXcd &right) const {
    const Index terms = right.cols();
    const Index middle = terms / 2;
    const Index m = acts.cols();
    MatrixXcd forces = alone(right);
    std::vector<End> ends(static_cast<std::size_t>(terms));
    const auto end = [&](Index k) -> End & { return ends[static_cast<std::size_t>(k)]; };
    MatrixXcd below, above; // back() of the last term on either side, as the next one meets it
    for (Index k = 0; k < middle; ++k) {
        end(k) = longer(forces.col(k), k > 0 ? end(k - 1) : End{}, below,
                        linalg::times(down, back(k + 1)));
        below = linalg::times(up, back(k));
    }
    for (Index k = terms - 1; k > middle; --k) {
        end(k) = longer(forces.col(k), k + 1 < terms ? end(k + 1) : End{}, above,
                        linalg::times(up, back(k - 1)));
        above = linalg::times(down, back(k));
    }
    MatrixXcd last = MatrixXcd::Identity(m, m);
    last -= linalg::times(below, end(middle - 1).factor);
    last -= linalg::times(above, end(middle + 1).factor);
    VectorXcd force = forces.col(middle);
    force += linalg::times(below, end(middle - 1).constant);
    force += linalg::times(above, end(middle + 1).constant);
    force = linalg::solved(last.partialPivLu(), force);
    forces.col(middle) = force;
    const auto follow = [&](Index k, Index next) {
        force = forces.col(next);
        forces.col(k) = end(k).constant + linalg::times(end(k).factor, force);
    };
    for (Index k = middle - 1; k >= 0; --k)
        follow(k, k + 1);
    for (Index k = middle + 1; k < terms; ++k)
        follow(k, k - 1);
    return inverse.cwiseProduct(right + linalg::times(acts, forces));
}

ModalSeries::ModalSeries(const System &system, double speed) : _speed(speed) {
    const System::Steady steady = system.steady(speed);
    const Index n = system.size();
    const MatrixXd &P = system.places();
    const Index m = P.cols();
    _weights = weights_of(steady, speed);
    const Eigen::PartialPivLU<MatrixXd> mass(steady.M);
    constexpr double massless = 1e-14; // reciprocal condition of the mass matrix: no digit is left
    if (!(mass.rcond() > massless))
        throw linalg::SolverError("a rotor with massless unknowns has fewer modes");
    MatrixXd A = MatrixXd::Zero(2 * n, 2 * n);
    A.topRightCorner(n, n).setIdentity();
    A.bottomLeftCorner(n, n) = -linalg::solved(mass, steady.K);
    A.bottomRightCorner(n, n) = -linalg::solved(mass, steady.D);
    take_modes(linalg::general_eigen(
        _weights.asDiagonal() * A * _weights.cwiseInverse().asDiagonal(), linalg::Vectors::both));
    MatrixXd B = MatrixXd::Zero(2 * n, m);
    if (m > 0) // nothing turns where the equations are constant
        B.bottomRows(n) = _weights.tail(n).asDiagonal() * linalg::solved(mass, P);
    const MatrixXd at_start = system.turning(speed, 0);
    const MatrixXd quarter = system.turning(speed, std::numbers::pi / 2);
    MatrixXd Y = MatrixXd::Zero(at_start.cols(), 2 * n);
    Y.topLeftCorner(m, n) = P.transpose() * _weights.head(n).cwiseInverse().asDiagonal();
    if (at_start.cols() > m)
        Y.bottomRightCorner(m, n) = P.transpose() * _weights.tail(n).cwiseInverse().asDiagonal();
    _acts = linalg::times(_L, MatrixXcd(B.cast<Complex>()));
    _seen = linalg::times(MatrixXcd(Y.cast<Complex>()), _R);
    const Complex i(0, 1);
    _up = (at_start.cast<Complex>() - i * quarter) / 2;
    _down = (at_start.cast<Complex>() + i * quarter) / 2;
}

void ModalSeries::take_modes(const linalg::GeneralEigen &found) {
    const Index states = found.values.size();
    _steady = found.values;
    _R.resize(states, states);
    _L.resize(states, states);
    for (Index i = 0; i < states; ++i) {
        const VectorXcd right = vector_of(found, found.right, i).normalized();
        const VectorXcd left = vector_of(found, found.left, i);
        const Complex dual = left.dot(right);
        if (!(std::abs(dual) > defective * left.norm()))
            throw linalg::SolverError("a mode is defective");
        _R.col(i) = right;
        _L.row(i) = left.adjoint() / dual;
    }
}

MatrixXcd ModalSeries::solve(Complex l, const MatrixXcd &right) const {
    return Chain{_acts, _seen, _up, _down, off(_steady, _speed, l, right.cols()).cwiseInverse()}
        .solve(right);
}

MatrixXcd ModalSeries::solve_adjoint(Complex l, const MatrixXcd &right) const {
    const MatrixXcd acts = _seen.adjoint();
    const MatrixXcd observed = _acts.adjoint();
    const MatrixXcd up = _down.adjoint();
    const MatrixXcd down = _up.adjoint();
    return Chain{acts, observed, up, down,
                 off(_steady, _speed, l, right.cols()).conjugate().cwiseInverse()}
        .solve(right);
}

Complex ModalSeries::quotient(const MatrixXcd &left, const MatrixXcd &a) const {
    const Index terms = a.cols();
    MatrixXcd image = off(_steady, _speed, 0, terms).cwiseProduct(a);
    const MatrixXcd at_places = linalg::times(_seen, a);
    const MatrixXcd upwards = linalg::times(_acts, linalg::times(_up, at_places));
    const MatrixXcd downwards = linalg::times(_acts, linalg::times(_down, at_places));
    image.rightCols(terms - 1) -= upwards.leftCols(terms - 1);
    image.leftCols(terms - 1) -= downwards.rightCols(terms - 1);
    return product(left, image) / product(left, a);
}

struct ModalSeries::Settled {
    Complex value;
    MatrixXcd a, b; ///< b^H a = 1
};

std::optional<ModalSeries::Settled> ModalSeries::settled(MatrixXcd a, MatrixXcd b) const {
    constexpr int steps = 8;       // a guard: cubic with both vectors
    constexpr double same = 1e-12; // relative to value and speed: some thousand units of rounding
    Complex value = quotient(b, a);
    double before = std::numeric_limits<double>::infinity();
    for (int step = 0; step < steps; ++step) {
        a = solve(value, a);
        a /= a.norm();
        b = solve_adjoint(value, b);
        b /= b.norm();
        const Complex next = quotient(b, a);
        const double change = std::abs(next - value) / (std::abs(next) + std::abs(_speed));
        value = next;
        if (!a.allFinite() || !b.allFinite() || !std::isfinite(change))
            return std::nullopt;
        // Rounding of modes much faster than these limits convergence.
        if (change <= same || (change <= 1e-10 && change >= before)) {
            b /= std::conj(product(b, a));
            return Settled{value, std::move(a), std::move(b)};
        }
        before = change;
    }
    return std::nullopt;
}

/// With as few terms as it needs, the largest in the middle; nothing where there are too few.
std::optional<SeriesMotion> ModalSeries::whole(const Settled &found) const {
    constexpr double nothing = 1e-9; // its square is what the value is off by
    // Of the motion: a thousandth of `nothing`, so that the next speed needs no more again.
    constexpr double far_too_many = 1e-12;
    const MatrixXcd z = linalg::times(_R, found.a);
    const Index terms = z.cols();
    const auto ends = [&](Index from_end) {
        return std::max(z.col(from_end).norm(), z.col(terms - 1 - from_end).norm()) / z.norm();
    };
    if (ends(0) > nothing)
        return std::nullopt;
    Index places = 0;
    z.colwise().norm().maxCoeff(&places);
    places -= terms / 2;
    Index fewer = 0;
    while (places == 0 && terms - 2 * fewer > fewest_terms && ends(fewer + 1) < far_too_many)
        ++fewer;
    const auto shown = [&](const MatrixXcd &states) {
        return assembly::middle_terms(assembly::moved_terms(states, places), terms - 2 * fewer);
    };
    return SeriesMotion{found.value + Complex(0, 2 * _speed * static_cast<double>(places)),
                        shown(_weights.cwiseInverse().asDiagonal() * z),
                        shown(_weights.asDiagonal() * linalg::adjoint_times(_L, found.b))};
}

std::optional<SeriesMotion> ModalSeries::next_to(const SeriesMotion &guess) const {
    // Terms: 80 harmonics of twice the speed reach motions 160 times as fast as it.
    constexpr Index most = 2 * 80 + 1;
    // Overlap with the guess: above a half no other motion has as much.
    constexpr double mostly = 0.5;
    const auto weights = _weights.asDiagonal();
    const auto back = _weights.cwiseInverse().asDiagonal();
    const bool both = guess.left.size() > 0;
    const MatrixXcd first = linalg::times(_L, MatrixXcd(weights * guess.right));
    const MatrixXcd first_left = both ? linalg::adjoint_times(_R, MatrixXcd(back * guess.left))
                                      : solve_adjoint(guess.value, first);
    for (Index terms = std::max(fewest_terms, first.cols()); terms <= most; terms += 4) {
        MatrixXcd a = assembly::middle_terms(first, terms);
        MatrixXcd b = assembly::middle_terms(first_left, terms);
        b /= std::conj(product(b, a));
        const std::optional<Settled> found = settled(a, b);
        if (!found)
            return std::nullopt;
        const double kept = both ? std::abs(product(b, found->a) * product(found->b, a))
                                 : std::norm(product(found->a, a)) / a.squaredNorm();
        if (!(kept > mostly && kept < 1 / mostly))
            return std::nullopt;
        if (std::optional<SeriesMotion> out = whole(*found))
            return out;
    }
    return std::nullopt;
}

} // namespace whirl::periodic
