#include "linalg/rational_curve.h"

#include "linalg/check.h"
#include "linalg/dense/general_eigen.h"

#include <Eigen/LU>
#include <Eigen/QR>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <utility>

namespace whirl::linalg {

namespace {

using Complex = std::complex<double>;

/// Places solved for to begin with.
constexpr int first_places = 9;
/// Part of the misfit accepted at new places that the fit of known ones is allowed.
constexpr double share_of_fit = 0.1;
/// Part of its usual size that a quantity which passes zero is measured by there.
constexpr double passing_zero = 1e-2;

/// With columns of zeros behind its own.
Eigen::MatrixXcd widened(const Eigen::MatrixXcd &values, Eigen::Index columns) {
    Eigen::MatrixXcd out = Eigen::MatrixXcd::Zero(values.rows(), columns);
    out.leftCols(values.cols()) = values;
    return out;
}

Eigen::MatrixXcd difference(const Eigen::MatrixXcd &a, const Eigen::MatrixXcd &b) {
    const Eigen::Index columns = std::max(a.cols(), b.cols());
    return widened(a, columns) - widened(b, columns);
}

/// Geometric mean of the size of each quantity over the places: what peaks do not decide. The
/// nearest power of two, so that the digits of all that follows are the same in other units.
/// @param above  a quantity is taken to be as large as its rounding over this
Eigen::VectorXd usual_sizes(const std::map<double, RationalCurve::Values> &solved,
                            double above = std::numeric_limits<double>::infinity()) {
    Eigen::VectorXd sums = Eigen::VectorXd::Zero(solved.begin()->second.numbers.rows());
    Eigen::VectorXd counts = sums;
    for (const auto &[place, values] : solved)
        for (Eigen::Index i = 0; i < sums.size(); ++i)
            if (const double size =
                    std::max(values.numbers.row(i).norm(), values.rounding(i) / above);
                size > 0) {
                sums(i) += std::log2(size);
                counts(i) += 1;
            }
    return (sums.array() / counts.array().max(1)).round().unaryExpr([](double power) {
        return std::exp2(power);
    });
}

/// Largest difference of a quantity over its size, beyond its rounding.
double relative(const Eigen::MatrixXcd &differences, const RationalCurve::Values &of,
                const Eigen::VectorXd &usual) {
    constexpr double of_fit = 10; // the fit adds up rounding of many places
    double worst = 0;
    for (Eigen::Index i = 0; i < usual.size(); ++i) {
        const double here = of.numbers.row(i).norm();
        const double size = here + passing_zero * usual(i);
        // Next to a pole the fit makes more of rounding, by as much as the values are larger.
        const double rounding = of.rounding(i) * std::max(1.0, usual(i) > 0 ? here / usual(i) : 1);
        const double beyond = differences.row(i).norm() - of_fit * rounding;
        if (std::isnan(beyond))
            return std::numeric_limits<double>::infinity();
        if (beyond > 0)
            worst = std::max(worst, beyond / size);
    }
    return worst;
}

/// A few combinations of all functions, each by its usual size: their poles are those of all.
Eigen::MatrixXcd mixtures(const std::map<double, RationalCurve::Values> &solved,
                          Eigen::Index columns, const Eigen::VectorXd &usual) {
    constexpr Eigen::Index count = 6;
    std::mt19937 random; // any phases do, the same at every call
    std::uniform_real_distribution<double> phase(0, 2 * std::numbers::pi);
    Eigen::MatrixXcd mix(count, usual.size() * columns);
    for (Complex &entry : mix.reshaped())
        entry = std::polar(1.0, phase(random));
    Eigen::MatrixXcd out(count, static_cast<Eigen::Index>(solved.size()));
    Eigen::Index column = 0;
    for (const auto &[place, values] : solved) {
        const Eigen::MatrixXcd scaled =
            usual.cwiseMax(std::numeric_limits<double>::min()).cwiseInverse().asDiagonal() *
            widened(values.numbers, columns);
        out.col(column++) = mix * scaled.reshaped();
    }
    return out;
}

/// x of length 1 with the least |A x|: inverse iteration with the triangular factor of A, which has
/// no fewer rows than columns.
Eigen::VectorXcd least_direction(const Eigen::MatrixXcd &A) {
    if (A.isZero(0)) // a constant: any do
        return Eigen::VectorXcd::Ones(A.cols()).normalized();
    const Eigen::HouseholderQR<Eigen::MatrixXcd> factors(A);
    Eigen::MatrixXcd R = factors.matrixQR().topRows(A.cols());
    const double rounding = std::max(std::numeric_limits<double>::epsilon() * A.norm(),
                                     std::numeric_limits<double>::min());
    for (Complex &entry : R.diagonal())
        if (std::abs(entry) < rounding)
            entry = rounding;
    const auto upper = R.triangularView<Eigen::Upper>();
    Eigen::VectorXcd x = Eigen::VectorXcd::Ones(A.cols()).normalized();
    constexpr int steps = 4; // two do where one direction is much less than the others
    for (int i = 0; i < steps; ++i) {
        upper.adjoint().solveInPlace(x);
        x.normalize();
        upper.solveInPlace(x);
        x.normalize();
    }
    return x;
}

} // namespace

RationalCurve::RationalCurve(double from, double to, Solve solve, double enough, std::size_t most)
    : _from(from), _to(to), _solve(std::move(solve)), _enough(enough) {
    for (int i = 0; i < first_places; ++i) { // Chebyshev's points of the second kind
        const double part = (1 - std::cos(std::numbers::pi * i / (first_places - 1))) / 2;
        this->solve(from + (to - from) * part);
    }
    if (_solved.empty())
        throw SolverError("no value of a curve was solved for");
    fit();
    constexpr double small = 1e-6; // no function of few poles is misfitted by so little for long
    for (double before = std::numeric_limits<double>::infinity();
         !_settled && _solved.size() + _none.size() <= most; before = _misfit) {
        const std::size_t known = _solved.size() + _none.size();
        take_in(places_between());
        if (_solved.size() + _none.size() == known)
            break; // no place is left between them
        _settled = _misfit <= _enough || (_misfit < small && _misfit > before / 2);
    }
}

bool RationalCurve::only_rounding(std::size_t quantity) const {
    constexpr double allowance = 100; // a fit adds up rounding of many places
    const auto i = static_cast<Eigen::Index>(quantity);
    double above = 0;
    for (const auto &[place, values] : _solved) {
        const double size = values.numbers.row(i).norm();
        if (size > 0 && values.rounding(i) == 0)
            return false;
        if (size > 0)
            above += std::log(size / (allowance * values.rounding(i)));
    }
    return above <= 0;
}

bool RationalCurve::solve(double place) {
    if (_solved.contains(place) || _none.contains(place))
        return false;
    std::optional<Values> values = _solve(place);
    if (values && values->numbers.allFinite())
        _solved.emplace(place, std::move(*values));
    else
        _none.insert(place);
    return _solved.contains(place);
}

double RationalCurve::take_in(const std::vector<double> &places) {
    const Eigen::VectorXd usual = usual_sizes(_solved);
    double misfit = 0;
    bool news = false;
    for (const double place : places) {
        if (!solve(place))
            continue;
        news = true;
        const Values &values = _solved.at(place);
        misfit = std::max(misfit, relative(difference(at(place), values.numbers), values, usual));
    }
    if (news) {
        _misfit = misfit;
        fit();
    }
    return misfit;
}

/// r = sum of c_k f_k / sum of c_k, c_k = w_k / (s - s_k), and
/// r' = sum of c_k (r - f_k) / (s - s_k) / sum of c_k (C. Schneider, W. Werner, Math. Comp. 47
/// (1986) 285), with the nearest support put aside, so that nothing cancels next to it.
std::pair<Eigen::MatrixXcd, Eigen::MatrixXcd> RationalCurve::with_slope(double place) const {
    const auto apart = [&](double support) { return std::abs(place - support); };
    const auto nearest = std::ranges::min_element(_support, {}, apart) - _support.begin();
    const double beside = place - _support[static_cast<std::size_t>(nearest)];
    Eigen::VectorXcd once(_weights.size());  // c_k
    Eigen::VectorXcd twice(_weights.size()); // c_k / (s - s_k)
    for (Eigen::Index k = 0; k < once.size(); ++k) {
        const double inverse =
            k == nearest ? 0 : 1 / (place - _support[static_cast<std::size_t>(k)]);
        once(k) = _weights(k) * inverse;
        twice(k) = once(k) * inverse;
    }
    const Complex weight = _weights(nearest);
    const Complex all = weight + beside * once.sum(); // times beside
    const Eigen::VectorXcd here = _values.col(nearest);
    // (r - f) / beside of the nearest, and r'.
    const Eigen::VectorXcd divided = (_values * once - once.sum() * here) / all;
    const Eigen::VectorXcd value = here + beside * divided;
    const Eigen::VectorXcd slope =
        (weight * divided + beside * (twice.sum() * value - _values * twice)) / all;
    const Eigen::Index rows = _solved.begin()->second.numbers.rows();
    return {value.reshaped(rows, value.size() / rows), slope.reshaped(rows, value.size() / rows)};
}

/// The weights by which the linear misfit at the other places is least: rows and columns by the
/// sizes that the functions have there, which differ by many orders beside poles.
Eigen::VectorXcd RationalCurve::weights(const std::vector<double> &others,
                                        const Eigen::MatrixXcd &mixed,
                                        const std::vector<double> &places) const {
    const auto column_of = [&places](double place) {
        return static_cast<Eigen::Index>(std::ranges::lower_bound(places, place) - places.begin());
    };
    Eigen::VectorXd sizes = mixed.colwise().norm();
    for (double &size : sizes)
        size = size > 0 ? size : 1;
    const Eigen::Index count = mixed.rows();
    Eigen::MatrixXcd loewner(count * std::ssize(others), std::ssize(_support));
    Eigen::VectorXd by_size(_support.size());
    for (Eigen::Index k = 0; k < by_size.size(); ++k) {
        const double support = _support[static_cast<std::size_t>(k)];
        const Eigen::Index there = column_of(support);
        by_size(k) = 1 / sizes(there);
        for (Eigen::Index j = 0; j < std::ssize(others); ++j) {
            const double other = others[static_cast<std::size_t>(j)];
            const Eigen::Index here = column_of(other);
            loewner.block(count * j, k, count, 1) = (mixed.col(here) - mixed.col(there)) *
                                                    (by_size(k) / sizes(here)) *
                                                    ((_to - _from) / (other - support));
        }
    }
    return by_size.asDiagonal() * least_direction(loewner);
}

void RationalCurve::fit() {
    const Eigen::VectorXd usual = usual_sizes(_solved);
    Eigen::Index columns = 0;
    std::vector<double> places;
    for (const auto &[place, values] : _solved) {
        columns = std::max(columns, values.numbers.cols());
        places.push_back(place);
    }
    // One that is nothing but rounding is so large that it is no misfit of the others.
    const Eigen::VectorXd sizes = usual_sizes(_solved, share_of_fit * _enough / 10);
    const Eigen::MatrixXcd mixed = mixtures(_solved, columns, sizes);
    if (_support.empty())
        _support = {places.front()};
    while (true) {
        std::vector<double> others;
        for (const double place : places)
            if (std::ranges::find(_support, place) == _support.end())
                others.push_back(place);
        _weights = others.empty() ? Eigen::VectorXcd::Ones(std::ssize(_support))
                                  : weights(others, mixed, places);
        _values.resize(usual.size() * columns, std::ssize(_support));
        for (Eigen::Index k = 0; k < _values.cols(); ++k)
            _values.col(k) =
                widened(_solved.at(_support[static_cast<std::size_t>(k)]).numbers, columns)
                    .reshaped();
        if (others.empty())
            break;
        std::vector<std::pair<double, double>> misfits; // and places
        for (const double place : others) {
            const Values &values = _solved.at(place);
            misfits.emplace_back(relative(difference(at(place), values.numbers), values, usual),
                                 place);
        }
        std::ranges::sort(misfits, std::greater());
        if (misfits.front().first <= share_of_fit * _enough || 2 * _support.size() >= places.size())
            break;
        // One more at a time of few, so that none is in vain; of many the worst together.
        const std::size_t more = std::min(1 + _support.size() / 16, misfits.size());
        for (std::size_t i = 0; i < more; ++i)
            if (misfits[i].first > share_of_fit * _enough)
                _support.push_back(misfits[i].second);
    }
    find_poles(sizes);
}

/// Zeros of the sum of w_k / (s - s_k): eigenvalues of an arrow pencil A - s B, of which B has two
/// zeros; as those of (A - shift B)^-1 B.
void RationalCurve::find_poles(const Eigen::VectorXd &usual) {
    _poles.clear();
    if (_support.size() < 2) // constant
        return;
    const Eigen::Index n = std::ssize(_support) + 1;
    const double middle = (_from + _to) / 2;
    const double half = (_to - _from) / 2;
    const Complex shift(0, 3); // in half ranges: off the places asked for
    Eigen::MatrixXcd A = Eigen::MatrixXcd::Zero(n, n);
    Eigen::MatrixXcd B = Eigen::MatrixXcd::Identity(n, n);
    B(0, 0) = 0;
    for (Eigen::Index k = 1; k < n; ++k) {
        // Alike in row and column: weights beside a pole are small.
        A(0, k) = A(k, 0) = std::sqrt(_weights(k - 1));
        A(k, k) = (_support[static_cast<std::size_t>(k - 1)] - middle) / half - shift;
    }
    constexpr double far = 10; // half ranges
    const Eigen::VectorXcd values =
        complex_eigenvalues(Eigen::PartialPivLU<Eigen::MatrixXcd>(A).solve(B).eval());
    for (const Complex value : values) {
        const Complex pole = refined_pole(middle + half * (shift + 1.0 / value));
        if (std::abs(value) * far > 1 && felt(pole, usual))
            _poles.push_back(pole);
    }
}

/// By Newton's method, as long as it moves by little.
Complex RationalCurve::refined_pole(Complex pole) const {
    constexpr int most = 8; // a guard: quadratic
    double before = 1e-3 * (_to - _from);
    for (int i = 0; i < most; ++i) {
        Complex sum = 0;
        Complex slope = 0;
        for (Eigen::Index k = 0; k < _weights.size(); ++k) {
            const Complex inverse = 1.0 / (pole - _support[static_cast<std::size_t>(k)]);
            sum += _weights(k) * inverse;
            slope -= _weights(k) * inverse * inverse;
        }
        const Complex step = sum / slope;
        if (!(std::abs(step) < before))
            break;
        pole -= step;
        before = std::abs(step);
    }
    return pole;
}

/// The residue of a pole is large enough to matter. Functions interpolated at more places than they
/// have poles get spurious ones from rounding, with residues near zero.
bool RationalCurve::felt(Complex pole, const Eigen::VectorXd &usual) const {
    Eigen::VectorXcd once(_weights.size());
    Complex slope = 0; // of the sum of w_k / (s - s_k), but for its sign
    for (Eigen::Index k = 0; k < once.size(); ++k) {
        const Complex apart = pole - _support[static_cast<std::size_t>(k)];
        once(k) = _weights(k) / apart;
        slope += once(k) / apart;
    }
    const Eigen::VectorXcd sums = _values * once;
    const Eigen::VectorXd residues =
        (sums / slope).reshaped(usual.size(), sums.size() / usual.size()).rowwise().norm();
    constexpr double faint = 1e-2; // of the misfit accepted
    return (residues.array() > faint * _enough * (_to - _from) / 2 * usual.array()).any();
}

/// Where the curve has not been confirmed: in the middle of the largest step between places solved
/// for, between any two that it is interpolated at, and about its poles.
std::vector<double> RationalCurve::places_between() const {
    std::vector<double> places;
    for (const auto &[place, values] : _solved)
        places.push_back(place);
    places.insert(places.end(), _none.begin(), _none.end());
    std::ranges::sort(places);
    std::vector<double> ends = _support;
    ends.push_back(_from);
    ends.push_back(_to);
    std::ranges::sort(ends);
    const double least = 1e-9 * (_to - _from);
    std::vector<double> out;
    for (std::size_t i = 0; i + 1 < ends.size(); ++i) {
        double widest = least;
        double middle = 0;
        const auto last = std::ranges::lower_bound(places, ends[i + 1]);
        for (auto at = std::ranges::lower_bound(places, ends[i]); at < last; ++at)
            if (*(at + 1) - *at > widest) {
                widest = *(at + 1) - *at;
                middle = (*at + *(at + 1)) / 2;
            }
        if (widest > least)
            out.push_back(middle);
    }
    constexpr double nearest = 1e-4; // of the range, to a pole
    for (const Complex pole : _poles) {
        const double apart = std::max(std::abs(pole.imag()), nearest * (_to - _from));
        for (const int side : {-1, 1}) {
            const double place = pole.real() + side * apart;
            const auto next = std::ranges::lower_bound(places, place);
            const bool known = (next != places.end() && *next - place < apart / 2) ||
                               (next != places.begin() && place - *std::prev(next) < apart / 2);
            if (place > _from && place < _to && !known)
                out.push_back(place);
        }
    }
    return out;
}

} // namespace whirl::linalg
