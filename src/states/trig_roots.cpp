#include "states/trig_roots.h"

#include "linalg/check.h"

#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace whirl::states {

namespace {

using Eigen::Index;
using std::numbers::pi;

/// Cells narrower than this are not halved any more, rad: next to a double root values below their
/// rounding reach as far as its square root, 3e-7 rad.
constexpr double narrowest = 1e-8;
/// Roots this close are one, found from two cells that touch.
constexpr double same_root = 1e-9;
/// Isolated roots take some thousands of cells; of a line of them there is no end.
constexpr long most_cells = 400000;

/// Several polynomials at a point, with their derivatives.
class Values {
  public:
    explicit Values(const std::vector<TrigPolynomial> &polynomials) : _n(std::ssize(polynomials)) {
        for (Index i = 0; i < _n; ++i) {
            for (const TrigPolynomial::Term &term :
                 polynomials[static_cast<std::size_t>(i)].terms()) {
                _highest = std::max(_highest, term.k.cwiseAbs().maxCoeff());
                _terms.push_back({i, term.k, term.c});
            }
        }
        value.resize(_n);
        slope.resize(_n, _n);
        _powers.resize(2 * _highest + 1, _n);
    }

    void at(const Eigen::VectorXd &x) {
        for (Index j = 0; j < _n; ++j) {
            const std::complex<double> one = std::polar(1.0, x(j));
            _powers(_highest, j) = 1;
            for (int k = 1; k <= _highest; ++k) {
                _powers(_highest + k, j) = _powers(_highest + k - 1, j) * one;
                _powers(_highest - k, j) = std::conj(_powers(_highest + k, j));
            }
        }
        value.setZero();
        slope.setZero();
        for (const Term &term : _terms) {
            std::complex<double> e = term.c;
            for (Index j = 0; j < _n; ++j)
                e *= _powers(_highest + term.k(j), j);
            value(term.of) += e.real();
            for (Index j = 0; j < _n; ++j)
                slope(term.of, j) -= term.k(j) * e.imag();
        }
    }

    Eigen::VectorXd value;
    Eigen::MatrixXd slope;

  private:
    struct Term {
        Index of;
        Eigen::VectorXi k;
        std::complex<double> c;
    };
    Index _n;
    int _highest = 0;
    std::vector<Term> _terms;
    Eigen::MatrixXcd _powers;
};

double distance(const Eigen::VectorXd &a, const Eigen::VectorXd &b) {
    double most = 0;
    for (Index j = 0; j < a.size(); ++j)
        most = std::max(most, std::abs(std::remainder(a(j) - b(j), 2 * pi)));
    return most;
}

void add_new(std::vector<Eigen::VectorXd> &roots, Eigen::VectorXd root, double same) {
    for (Index j = 0; j < root.size(); ++j) {
        root(j) -= 2 * pi * std::floor(root(j) / (2 * pi));
        if (root(j) >= 2 * pi) // -1e-20 on the way round
            root(j) = 0;
    }
    if (std::ranges::none_of(roots,
                             [&](const auto &other) { return distance(other, root) < same; }))
        roots.push_back(std::move(root));
}

class Search {
  public:
    explicit Search(const std::vector<TrigPolynomial> &polynomials)
        : _n(std::ssize(polynomials)), _values(polynomials), _bends(_n, _n), _sizes(_n) {
        for (Index i = 0; i < _n; ++i) {
            const TrigPolynomial &one = polynomials[static_cast<std::size_t>(i)];
            _bends.row(i) = one.bends().transpose();
            _sizes(i) = one.size();
        }
        _bend_sums = _bends.rowwise().sum();
    }

    TrigRoots run() {
        const int a_side = _n == 1 ? 16 : _n == 2 ? 8 : 4;
        const double half = pi / a_side;
        const auto cells = static_cast<long>(std::pow(a_side, _n));
        for (long cell = 0; cell < cells; ++cell) {
            Eigen::VectorXd centre(_n);
            for (long j = 0, rest = cell; j < _n; ++j, rest /= a_side)
                centre(j) = half * (1 + 2 * static_cast<double>(rest % a_side));
            _cells.emplace_back(std::move(centre), half);
        }
        long looked_at = 0;
        while (!_cells.empty()) {
            const auto [centre, half_width] = std::move(_cells.back());
            _cells.pop_back();
            if (++looked_at > most_cells)
                throw linalg::SolverError("steady states that are not isolated");
            look_at(centre, half_width);
        }
        // Of a pair at the limit one may have been found from beside it.
        std::erase_if(_out.undecided, [this](const Eigen::VectorXd &place) {
            return std::ranges::any_of(_out.roots, [&](const Eigen::VectorXd &root) {
                return distance(root, place) < 10 * narrowest;
            });
        });
        return std::move(_out);
    }

  private:
    Index _n;
    Values _values;
    Eigen::MatrixXd _bends;
    Eigen::VectorXd _sizes, _bend_sums;
    std::vector<std::pair<Eigen::VectorXd, double>> _cells;
    TrigRoots _out;

    void look_at(const Eigen::VectorXd &centre, double h) {
        _values.at(centre);
        constexpr double rounding = 1e-13; // of sums of some hundred terms, over their size
        for (Index i = 0; i < _n; ++i)
            if (std::abs(_values.value(i)) > _values.slope.row(i).cwiseAbs().sum() * h +
                                                 _bend_sums(i) * h * h / 2 + rounding * _sizes(i))
                return;
        const Eigen::FullPivLU<Eigen::MatrixXd> factors(_values.slope);
        if (factors.isInvertible()) {
            const Eigen::MatrixXd inverse = factors.inverse();
            const Eigen::MatrixXd size = inverse.cwiseAbs();
            const Eigen::VectorXd step = inverse * _values.value;
            const Eigen::VectorXd bent = size * _bend_sums * (h * h / 2) + size * _sizes * rounding;
            if (((step.cwiseAbs() - bent).array() > h).any())
                return;
            // Twice the cell: from its centre the iterates stay in there.
            if ((size * _bends).rowwise().sum().maxCoeff() * 2 * h <= 0.5) {
                follow(centre, h, inverse);
                return;
            }
        }
        if (h < narrowest) {
            add_new(_out.undecided, centre, 100 * narrowest);
            return;
        }
        for (long part = 0; part < (1L << _n); ++part) {
            Eigen::VectorXd next = centre;
            for (Index j = 0; j < _n; ++j)
                next(j) += (part >> j & 1) != 0 ? h / 2 : -h / 2;
            _cells.emplace_back(std::move(next), h / 2);
        }
    }

    /// The one root that the cell can have, if it has it: by a contraction to half the distance.
    void follow(const Eigen::VectorXd &centre, double h, const Eigen::MatrixXd &inverse) {
        Eigen::VectorXd x = centre;
        constexpr int halvings = 60;
        for (int i = 0; i < halvings; ++i) {
            _values.at(x);
            const Eigen::VectorXd step = inverse * _values.value;
            x -= step;
            if ((x - centre).cwiseAbs().maxCoeff() > 2 * h)
                return;
            if (step.cwiseAbs().maxCoeff() < 1e-12)
                break;
        }
        // A last step with the matrix of the place itself.
        _values.at(x);
        x -= _values.slope.fullPivLu().solve(_values.value);
        if ((x - centre).cwiseAbs().maxCoeff() <= h * (1 + 1e-6) + same_root)
            add_new(_out.roots, x, same_root);
    }
};

} // namespace

double TrigPolynomial::size() const {
    double sum = 0;
    for (const Term &term : _terms)
        sum += std::abs(term.c);
    return sum;
}

Eigen::VectorXd TrigPolynomial::bends() const {
    if (_terms.empty())
        return {};
    Eigen::VectorXd out = Eigen::VectorXd::Zero(_terms.front().k.size());
    for (const Term &term : _terms)
        out += std::abs(term.c) * term.k.cwiseAbs().sum() * term.k.cwiseAbs().cast<double>();
    return out;
}

std::vector<TrigPolynomial>
interpolated(const Eigen::VectorXi &degrees, const Eigen::VectorXd &sizes,
             const std::function<Eigen::VectorXd(const Eigen::VectorXd &)> &values) {
    const Index d = degrees.size();
    const Eigen::VectorXi points = 2 * degrees.array() + 1;
    const Index all = points.prod();
    Eigen::MatrixXcd table(all, d); // first angle fastest
    for (Index row = 0; row < all; ++row) {
        Eigen::VectorXd x(d);
        for (Index j = 0, rest = row; j < d; rest /= points(j), ++j)
            x(j) = 2 * pi * static_cast<double>(rest % points(j)) / points(j);
        table.row(row) = values(x).transpose().cast<std::complex<double>>();
    }
    // One angle after the other: values over the angle become coefficients of k = -degree..degree.
    for (Index j = 0, stride = 1; j < d; stride *= points(j), ++j) {
        const int n = points(j);
        Eigen::MatrixXcd transform(n, n);
        for (int k = 0; k < n; ++k)
            for (int i = 0; i < n; ++i)
                transform(k, i) = std::polar(1.0 / n, -2 * pi * (k - degrees(j)) * i / n);
        for (Index start = 0; start < all; ++start) {
            if (start / stride % n != 0)
                continue;
            Eigen::MatrixXcd line(n, d);
            for (int i = 0; i < n; ++i)
                line.row(i) = table.row(start + i * stride);
            line = Eigen::MatrixXcd(transform * line);
            for (int i = 0; i < n; ++i)
                table.row(start + i * stride) = line.row(i);
        }
    }
    std::vector<TrigPolynomial> out;
    for (Index column = 0; column < d; ++column) {
        std::vector<TrigPolynomial::Term> terms;
        // Of k and -k, whose coefficients are conjugates, the first twice: rows above the middle.
        for (Index row = all / 2; row < all; ++row) {
            const std::complex<double> c = table(row, column) * (row == all / 2 ? 1.0 : 2.0);
            if (std::abs(c) <= TrigPolynomial::rounding * sizes(column))
                continue;
            Eigen::VectorXi k(d);
            for (Index j = 0, rest = row; j < d; rest /= points(j), ++j)
                k(j) = static_cast<int>(rest % points(j)) - degrees(j);
            terms.push_back({k, c});
        }
        if (terms.empty()) // zero at every point
            throw linalg::SolverError("steady states that are not isolated");
        out.emplace_back(std::move(terms));
    }
    return out;
}

TrigRoots all_roots(const std::vector<TrigPolynomial> &polynomials) {
    return Search(polynomials).run();
}

} // namespace whirl::states
