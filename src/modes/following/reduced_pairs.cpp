#include "modes/following/reduced_pairs.h"

#include "linalg/check.h"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace whirl::modes {

namespace {

using Complex = std::complex<double>;
using Group = std::vector<Eigen::Index>;

/// Whether coordinates are of nearly the same motion.
bool alike(const Eigen::VectorXcd &a, const Eigen::VectorXcd &b) {
    constexpr double cosine = 0.8;
    return std::norm(a.dot(b)) > cosine * cosine * a.squaredNorm() * b.squaredNorm();
}

/// Indices of values that lie close together, by groups of two and more.
std::vector<Group> close_groups(const std::vector<SymmetricPair> &pairs) {
    constexpr double close = 0.03;
    std::vector<bool> taken(pairs.size(), false);
    std::vector<Group> out;
    for (std::size_t i = 0; i < pairs.size(); ++i) {
        if (taken[i])
            continue;
        Group group{static_cast<Eigen::Index>(i)};
        for (std::size_t k = 0; k < group.size(); ++k) {
            const Complex value = pairs[static_cast<std::size_t>(group[k])].value;
            for (std::size_t j = i + 1; j < pairs.size(); ++j)
                if (!taken[j] &&
                    std::norm(pairs[j].value - value) < close * close * std::norm(value)) {
                    taken[j] = true;
                    group.push_back(static_cast<Eigen::Index>(j));
                }
        }
        if (group.size() > 1)
            out.push_back(std::move(group));
    }
    return out;
}

/// For each row the column it has its largest entry in, each column once.
Group columns_by_rows(Eigen::MatrixXd sizes) {
    Group out(static_cast<std::size_t>(sizes.rows()));
    for (Eigen::Index k = 0; k < sizes.rows(); ++k) {
        Eigen::Index row = 0;
        Eigen::Index column = 0;
        sizes.maxCoeff(&row, &column);
        out[static_cast<std::size_t>(row)] = column;
        sizes.row(row).setConstant(-1);
        sizes.col(column).setConstant(-1);
    }
    return out;
}

/// The lower triangle of Q(l), its parts apart.
void set_Q(const ReducedMatrices &matrices, Complex l, Eigen::MatrixXd &re, Eigen::MatrixXd &im) {
    const Eigen::MatrixXd &all = matrices.all;
    const Eigen::Index n = all.cols() / 2;
    const double l_re = l.real();
    const double l_im = l.imag();
    const double square_re = (l * l).real();
    const double square_im = (l * l).imag();
    re.resize(n, n);
    im.resize(n, n);
    for (Eigen::Index j = 0; j < n; ++j) {
        const double *a = &all(0, j);     // real parts of M, D and K
        const double *b = &all(0, n + j); // imaginary ones
        double *__restrict out_re = &re(0, j);
        double *__restrict out_im = &im(0, j);
        for (Eigen::Index i = j; i < n; ++i) {
            out_re[i] = square_re * a[i] - square_im * b[i] + l_re * a[n + i] - l_im * b[n + i] +
                        a[2 * n + i];
            out_im[i] = square_re * b[i] + square_im * a[i] + l_re * b[n + i] + l_im * a[n + i] +
                        b[2 * n + i];
        }
    }
}

class ReducedSolution {
  public:
    ReducedSolution(const ReducedModel &model, double speed, std::vector<SymmetricPair> &pairs,
                    const std::vector<const SymmetricPair *> &nearest,
                    std::vector<NearbyFactors> &nearby)
        : _matrices(model.at(speed)), _pairs(pairs), _nearest(nearest), _nearby(nearby),
          _Y(model.size(), std::ssize(pairs)), _grouped(pairs.size(), false),
          _upper(model.conjugates()) {
        for (std::size_t i = 0; i < pairs.size(); ++i)
            _Y.col(static_cast<Eigen::Index>(i)) = pairs[i].reduced.normalized();
        _guesses = _Y;
        const Eigen::MatrixXcd all = _matrices.times(_Y);
        _MY = all.topRows(_Y.rows());
        _DY = all.middleRows(_Y.rows(), _Y.rows());
        _KY = all.bottomRows(_Y.rows());
    }

    /// Mixtures of guesses whose values lie close together.
    void unmix() {
        for (const Group &group : close_groups(_pairs))
            unmix(group);
    }

    [[nodiscard]] bool refine(int slowest) {
        const std::vector<double> enough = enough_errors(_pairs, slowest);
        std::vector<double> distances;
        for (std::size_t i = 0; i < _pairs.size(); ++i)
            distances.push_back(distance_from_others(_pairs, i));
        for (std::size_t i = 0; i < _pairs.size(); ++i)
            if (!refine(static_cast<Eigen::Index>(i), distances[i], 0.2 * enough[i]))
                return false;
        return distinct();
    }

  private:
    const ReducedMatrices _matrices;
    std::vector<SymmetricPair> &_pairs;
    const std::vector<const SymmetricPair *> &_nearest;
    std::vector<NearbyFactors> &_nearby;
    Eigen::MatrixXd _Q_re, _Q_im;
    Eigen::MatrixXcd _Y, _MY, _DY, _KY; ///< coordinates, and what the matrices make of them
    Eigen::MatrixXcd _guesses;
    std::vector<bool> _grouped;
    bool _upper; ///< of two conjugates the upper one is meant

    SymmetricPair &pair(Eigen::Index i) { return _pairs[static_cast<std::size_t>(i)]; }

    /// The problem on the span of a group, linear in the distance from the mean of the values.
    void unmix(const Group &group) {
        const Eigen::MatrixXcd Y = _Y(Eigen::all, group);
        const Eigen::MatrixXcd MY = _MY(Eigen::all, group);
        const Eigen::MatrixXcd DY = _DY(Eigen::all, group);
        const Eigen::MatrixXcd KY = _KY(Eigen::all, group);
        const Eigen::MatrixXcd M = Y.transpose() * MY;
        const Eigen::MatrixXcd D = Y.transpose() * DY;
        Complex mean = 0;
        for (const Eigen::Index i : group)
            mean += pair(i).value / static_cast<double>(group.size());
        const Eigen::MatrixXcd there = mean * mean * M + mean * D + Y.transpose() * KY;
        const Eigen::PartialPivLU<Eigen::MatrixXcd> slope(2.0 * mean * M + D);
        const Eigen::ComplexEigenSolver<Eigen::MatrixXcd> solver(-slope.solve(there));
        if (solver.info() != Eigen::Success || !solver.eigenvectors().allFinite())
            return;
        const Group mine = columns_by_rows(solver.eigenvectors().cwiseAbs());
        for (std::size_t k = 0; k < group.size(); ++k) {
            const Eigen::VectorXcd share = solver.eigenvectors().col(mine[k]);
            _Y.col(group[k]) = Y * share;
            const double scale = 1 / _Y.col(group[k]).norm();
            _Y.col(group[k]) *= scale;
            _MY.col(group[k]) = MY * (scale * share);
            _DY.col(group[k]) = DY * (scale * share);
            _KY.col(group[k]) = KY * (scale * share);
            _grouped[static_cast<std::size_t>(group[k])] = true;
            pair(group[k]).value = mean + solver.eigenvalues()(mine[k]);
        }
    }

    /// The Rayleigh quotient, and its error as with the full matrices.
    double assess(Eigen::Index i, double distance) {
        const auto y = _Y.col(i);
        const Complex M = y.cwiseProduct(_MY.col(i)).sum();
        const Complex D = y.cwiseProduct(_DY.col(i)).sum();
        Complex &l = pair(i).value;
        l = nearest_root(M, D, y.cwiseProduct(_KY.col(i)).sum(), l);
        const double derivative = std::abs(l * (2.0 * l * M + D));
        if (!(derivative > 0) || !std::isfinite(derivative))
            return std::numeric_limits<double>::infinity();
        // With the norm of K^-1: that of (K + |l|^2 M)^-1 is smaller.
        const double energy = ((l * l) * _MY.col(i) + l * _DY.col(i) + _KY.col(i)).squaredNorm();
        return energy / (derivative * std::min(1.0, distance));
    }

    [[nodiscard]] Eigen::VectorXcd slope(Eigen::Index i) {
        return (2.0 * pair(i).value) * _MY.col(i) + _DY.col(i);
    }

    void set(Eigen::Index i, const Eigen::VectorXcd &y) {
        _Y.col(i) = y.normalized();
        const Eigen::VectorXcd all = _matrices.times(Eigen::VectorXcd(_Y.col(i)));
        _MY.col(i) = all.head(y.size());
        _DY.col(i) = all.segment(y.size(), y.size());
        _KY.col(i) = all.tail(y.size());
    }

    void inverse_step(Eigen::Index i) {
        const Complex l = pair(i).value;
        const auto factorize = [&](Complex value) {
            set_Q(_matrices, value, _Q_re, _Q_im);
            _nearby[static_cast<std::size_t>(i)].factor.factorize(_Q_re, _Q_im);
        };
        try {
            factorize(l);
        } catch (const linalg::SolverError &) { // on the eigenvalue itself
            factorize(l * (1 + 1e-14));
        }
        NearbyFactors &nearby = _nearby[static_cast<std::size_t>(i)];
        set(i, nearby.factor.solve(slope(i)));
        nearby.coordinates = _Y.col(i);
    }

    /// Residual inverse iteration (A. Neumaier, SIAM J. Numer. Anal. 22, 1985) with the factors of
    /// another speed, along the pair there not at all: there they are next to singular. Linear
    /// convergence, as fast as that speed is near; false where that is slow.
    bool correct(Eigen::Index i, double distance, double enough, double &error) {
        constexpr int most_steps = 3;
        constexpr double near = 1e-4;
        constexpr double fast = 1e-2;
        const NearbyFactors &nearby = _nearby[static_cast<std::size_t>(i)];
        if (nearby.factor.size() != _Y.rows() || nearby.coordinates.size() != _Y.rows())
            return false;
        for (int step = 0; step < most_steps && error < near; ++step) {
            const Complex l = pair(i).value;
            const Eigen::VectorXcd before = _Y.col(i);
            const Eigen::VectorXcd along = slope(i);
            Eigen::VectorXcd change =
                nearby.factor.solve((l * l) * _MY.col(i) + l * _DY.col(i) + _KY.col(i));
            change -= nearby.coordinates * (along.cwiseProduct(change).sum() /
                                            along.cwiseProduct(nearby.coordinates).sum());
            set(i, before - change);
            const double last = error;
            error = assess(i, distance);
            if (error <= enough)
                return true;
            if (!(error <= last)) { // no better
                set(i, before);
                pair(i).value = l;
                error = last;
            }
            if (!(error <= fast * last))
                return false;
        }
        return false;
    }

    bool refine(Eigen::Index i, double distance, double enough) {
        constexpr int most_steps = 6;
        const double settled = std::max(1e-12, enough); ///< the full problem finishes it
        double error = assess(i, distance);
        int step = 0;
        if (!(error <= enough) && correct(i, distance, enough, error))
            step = 1;
        for (; step < most_steps && !(error <= enough); ++step) {
            const double last = error;
            inverse_step(i);
            error = assess(i, distance);
            if (error <= settled && error > 0.1 * last)
                break; // rounding
        }
        SymmetricPair &found = pair(i);
        found.solved = step > 0;
        found.reduced = _Y.col(i);
        found.mixed = !alike(_nearest[static_cast<std::size_t>(i)]->reduced, _Y.col(i));
        return error <= settled &&
               (_grouped[static_cast<std::size_t>(i)] || alike(_guesses.col(i), _Y.col(i))) &&
               !(_upper && found.value.imag() < -1e-6 * std::abs(found.value));
    }

    [[nodiscard]] bool distinct() const {
        for (std::size_t i = 0; i < _pairs.size(); ++i)
            for (std::size_t j = i + 1; j < _pairs.size(); ++j)
                if (std::norm(_pairs[i].value - _pairs[j].value) <
                        1e-14 * std::norm(_pairs[i].value) &&
                    std::abs(_pairs[i].reduced.dot(_pairs[j].reduced)) > 0.999)
                    return false;
        return true;
    }
};

} // namespace

bool solve_reduced(const ReducedModel &model, double speed, std::vector<SymmetricPair> &pairs,
                   const std::vector<const SymmetricPair *> &nearest, int slowest,
                   std::vector<NearbyFactors> &nearby) try {
    nearby.resize(pairs.size());
    ReducedSolution solution(model, speed, pairs, nearest, nearby);
    solution.unmix();
    return solution.refine(slowest);
} catch (const linalg::SolverError &) {
    return false; // a pivot that happens to be zero
}

} // namespace whirl::modes
