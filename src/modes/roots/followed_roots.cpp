#include "modes/roots/followed_roots.h"

#include "linalg/dense/products.h"

#include <algorithm>
#include <cmath>
#include <type_traits>
#include <utility>

namespace whirl::modes {

namespace {

using Complex = std::complex<double>;
using Vector = Eigen::VectorXcd;

} // namespace

template <class Scalar>
FollowedRoots<Scalar>::FollowedRoots(const ReducedForm &form, std::function<All(double)> all)
    : _form(form), _all(std::move(all)) {}

template <class Scalar> void FollowedRoots<Scalar>::add(double speed) {
    _known.try_emplace(speed, _all(speed));
    _range = _known.rbegin()->first - _known.begin()->first;
}

/// Clear where each root within reach at one end has one at the other whose vectors are nearly its
/// own, and nobody else's.
template <class Scalar>
typename FollowedRoots<Scalar>::Step FollowedRoots<Scalar>::step(double from, double to) const {
    constexpr double alike = 0.4; // |products of vectors|, 1 for the same
    constexpr double rival = 0.5; // of that
    const All &a = _known.at(from);
    const All &b = _known.at(to);
    if (a.roots.empty() || b.roots.empty())
        return {};
    const auto within = [](const All &all, std::size_t i) {
        return std::abs(all.roots[i].value) <= all.reach;
    };
    const auto near = [](const All &all, std::size_t i) {
        constexpr double beyond = 1.2;
        return std::abs(all.roots[i].value) <= beyond * all.reach;
    };
    Step out;
    const Problem p = _form.at<Scalar>((from + to) / 2);
    using Matrix = Eigen::MatrixXcd;
    const Matrix M = p.M.template cast<Complex>();
    const Matrix D = p.D.template cast<Complex>();
    const auto columns = [&](const All &all, auto root_vector) {
        Matrix of(p.M.rows(), static_cast<Eigen::Index>(all.roots.size()));
        for (std::size_t i = 0; i < all.roots.size(); ++i)
            of.col(static_cast<Eigen::Index>(i)) = root_vector(all.roots[i]);
        return of;
    };
    const auto right = [](const Root &root) -> const Vector & { return root.right; };
    const auto left = [](const Root &root) -> const Vector & { return root.left; };
    const Matrix xa = columns(a, right);
    const Matrix xb = columns(b, right);
    const Matrix ya = columns(a, left);
    const Matrix yb = columns(b, left);
    const auto between = [&](const Matrix &y, const Matrix &x) {
        return std::pair(linalg::adjoint_times(y, linalg::times(M, x)),
                         linalg::adjoint_times(y, linalg::times(D, x)));
    };
    const auto [Mab, Dab] = between(ya, xb); // rows: a
    const auto [Mba, Dba] = between(yb, xa); // rows: b
    const Eigen::Index rows = xa.cols();
    const Eigen::Index cols = xb.cols();
    Matrix forth(rows, cols);
    Matrix back(rows, cols);
    Eigen::MatrixXd size(rows, cols);
    for (Eigen::Index i = 0; i < rows; ++i)
        for (Eigen::Index j = 0; j < cols; ++j) {
            const Root &one = a.roots[static_cast<std::size_t>(i)];
            const Root &other = b.roots[static_cast<std::size_t>(j)];
            const Complex sum = one.value + other.value;
            forth(i, j) = (sum * Mab(i, j) + Dab(i, j)) / one.slope;
            back(i, j) = (sum * Mba(j, i) + Dba(j, i)) / other.slope;
            size(i, j) = std::abs(forth(i, j) * back(i, j));
        }
    std::vector<char> taken(b.roots.size(), 0);
    for (Eigen::Index i = 0; i < rows; ++i) {
        Eigen::Index j = 0;
        const double best = cols > 0 ? size.row(i).maxCoeff(&j) : 0;
        bool sure = best > alike && best < 1 / alike && taken[static_cast<std::size_t>(j)] == 0;
        for (Eigen::Index k = 0; sure && k < cols; ++k)
            sure = k == j || size(i, k) < rival * best;
        for (Eigen::Index k = 0; sure && k < rows; ++k)
            sure = k == i || size(k, j) < rival * best;
        if (sure) {
            taken[static_cast<std::size_t>(j)] = 1;
            if (!near(a, static_cast<std::size_t>(i)) && !near(b, static_cast<std::size_t>(j)))
                continue; // far beyond those wanted
            out.pairs.push_back({static_cast<std::size_t>(i), static_cast<std::size_t>(j),
                                 1.0 / forth(i, j), 1.0 / std::conj(back(i, j))});
        } else if (within(a, static_cast<std::size_t>(i))) {
            return out;
        }
    }
    for (std::size_t j = 0; j < taken.size(); ++j)
        if (taken[j] == 0 && within(b, j))
            return out;
    out.clear = true;
    return out;
}

template <class Scalar> std::optional<std::vector<Root>> FollowedRoots<Scalar>::at(double speed) {
    constexpr double finest = 1.0 / 100; // of the range: such a step is halved no more
    if (const auto known = _known.find(speed); known != _known.end())
        return known->second.roots;
    auto above = _known.upper_bound(speed);
    if (above == _known.begin() || above == _known.end())
        return std::nullopt;
    for (;;) {
        const auto below = std::prev(above);
        const double from = below->first;
        const double to = above->first;
        auto found = _steps.find(from);
        if (found == _steps.end())
            found = _steps.emplace(from, step(from, to)).first;
        if (found->second.clear)
            break;
        if (to - from < finest * _range)
            return std::nullopt;
        _steps.erase(found);
        const double middle = (from + to) / 2;
        const auto added = _known.emplace(middle, _all(middle)).first;
        above = speed < middle ? added : std::next(added);
        if (speed == middle)
            return added->second.roots;
    }
    const auto below = std::prev(above);
    const Step &of = _steps.at(below->first);
    const double t = (speed - below->first) / (above->first - below->first);
    std::vector<Root> out;
    for (const Pair &pair : of.pairs) {
        const Root &a = below->second.roots[pair.from];
        const Root &b = above->second.roots[pair.to];
        Root guess;
        guess.value = (1 - t) * a.value + t * b.value;
        guess.right = (1 - t) * a.right + t * pair.scale * b.right;
        guess.left = (1 - t) * a.left + t * pair.left_scale * b.left;
        out.push_back(std::move(guess));
    }
    return out;
}

template class FollowedRoots<double>;
template class FollowedRoots<Complex>;

} // namespace whirl::modes
