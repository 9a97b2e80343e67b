#include "linalg/harmonic_solve.h"

#include "linalg/check.h"
#include "linalg/unit_scales.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace whirl::linalg {

namespace {

/// Numbers about 1 and -1 without a pattern, the same at every call (a linear congruential
/// generator, Knuth). Not all of one size: two of them would cancel.
Eigen::VectorXd signs(Eigen::Index size) {
    Eigen::VectorXd out(size);
    unsigned long long state = 1;
    for (Eigen::Index i = 0; i < size; ++i) {
        state = state * 6364136223846793005ULL + 1442695040888963407ULL;
        const double share = static_cast<double>((state >> 32U) & 0x7fffffffU) / 0x80000000U;
        out(i) = ((state >> 63U) != 0 ? 1 : -1) * (0.75 + 0.5 * share);
    }
    return out;
}

/// Moduli of real and imaginary parts, as parts.
Eigen::ArrayXcd moduli(const Eigen::ArrayXcd &x) {
    Eigen::ArrayXcd out(x.size());
    out.real() = x.real().abs();
    out.imag() = x.imag().abs();
    return out;
}

/// Largest modulus of a real or imaginary part.
double largest_part(const Eigen::VectorXcd &x) {
    return std::max(x.real().lpNorm<Eigen::Infinity>(), x.imag().lpNorm<Eigen::Infinity>());
}

/// Entries as of A at a factor 1.
HarmonicSolver::Entries entries_of(const Matrix &term, std::complex<double> factor) {
    HarmonicSolver::Entries out;
    if (term.size() == 0)
        return out;
    const SparseView view = term.view();
    out.reserve(static_cast<std::size_t>(view.nonZeros()));
    for (Eigen::Index i = 0; i < view.outerSize(); ++i)
        for (SparseView::InnerIterator entry(view, i); entry; ++entry)
            if (entry.value() != 0)
                out.emplace_back(static_cast<int>(entry.row()), static_cast<int>(entry.col()),
                                 factor * entry.value());
    return out;
}

Eigen::VectorXd scales_of(const HarmonicTerms &terms, bool pairs) {
    Eigen::VectorXd scales = unit_scales(terms.K, terms.M);
    for (Eigen::Index i = 0; pairs && i < scales.size(); i += 2)
        scales(i) = scales(i + 1) = std::min(scales(i), scales(i + 1));
    return scales;
}

bool same_entry(const Eigen::Triplet<std::complex<double>> &a,
                const Eigen::Triplet<std::complex<double>> &b) {
    return a.row() == b.row() && a.col() == b.col() && a.value() == b.value();
}

constexpr std::complex<double> i_unit(0, 1);

/// A backward stable solution leaves some 1e-15. With the pivots of the A before, which serve as
/// long as A changes little, it may be more: then A gets its own.
constexpr double residual_of_old_pivots = 1e-14;

} // namespace

HarmonicSolver::HarmonicSolver(const HarmonicTerms &terms, bool pairs, const Entries &changes,
                               bool smooth)
    : _pairs(pairs), _smooth(smooth), _scales(scales_of(terms, pairs)) {
    std::array<Sparse, factor_count> of;
    of[one] = solved_for(entries_of(terms.K, 1));
    of[spin_once] = solved_for(entries_of(terms.Kc, 1));
    of[spin_squared] = solved_for(entries_of(terms.Kss, 1));
    of[minus_frequency_squared] = solved_for(entries_of(terms.M, 1));
    of[i_frequency] = solved_for(entries_of(terms.C, i_unit));
    of[i_frequency_spin] = solved_for(entries_of(terms.G, i_unit));
    Eigen::SparseMatrix<double> pattern(size(), size());
    Entries places;
    for (const auto &change : changes) // all that a pair may couple
        for (int k = 0; k < (_pairs ? 4 : 1); ++k)
            places.emplace_back(_pairs ? change.row() / 2 * 2 + k / 2 : change.row(),
                                _pairs ? change.col() / 2 * 2 + k % 2 : change.col(), 1);
    Sparse changed(size(), size());
    changed.setFromTriplets(places.begin(), places.end());
    pattern = changed.cwiseAbs();
    for (Sparse &term : of) {
        term.prune([](Eigen::Index, Eigen::Index, const auto &value) { return value != 0.0; });
        pattern = Eigen::SparseMatrix<double>(pattern + term.cwiseAbs());
    }
    _A = pattern.cast<std::complex<double>>();
    for (std::size_t i = 0; i < factor_count; ++i) {
        if (of[i].nonZeros() == 0)
            continue;
        const Sparse on_pattern = 0.0 * _A + of[i];
        for (Eigen::Index place = 0; place < on_pattern.nonZeros(); ++place) {
            const std::complex<double> entry = on_pattern.coeffs()(place);
            if (entry.real() != 0)
                _terms[i].real.emplace_back(place, entry.real());
            if (entry.imag() != 0)
                _terms[i].imaginary.emplace_back(place, entry.imag());
        }
    }
}

HarmonicSolver::Sparse HarmonicSolver::solved_for(const Entries &entries) const {
    Entries out;
    out.reserve((_pairs ? 4 : 1) * entries.size());
    for (const auto &entry : entries) {
        const std::complex<double> value =
            _scales(entry.row()) * _scales(entry.col()) * entry.value();
        if (!_pairs) {
            out.emplace_back(entry.row(), entry.col(), value);
            continue;
        }
        // x = a + d, y = -i (a - d); half the equation of x plus and minus i times that of y
        const int row = entry.row() / 2 * 2;
        const int column = entry.col() / 2 * 2;
        const bool of_y = entry.row() != row;
        const bool by_y = entry.col() != column;
        for (const int against : {0, 1})
            for (const int by_against : {0, 1})
                out.emplace_back(row + against, column + by_against,
                                 0.5 * (of_y ? (against != 0 ? -i_unit : i_unit) : 1.0) * value *
                                     (by_y ? (by_against != 0 ? i_unit : -i_unit) : 1.0));
    }
    Sparse A(size(), size());
    A.setFromTriplets(out.begin(), out.end());
    return A;
}

Eigen::MatrixXcd HarmonicSolver::parts_of(Eigen::MatrixXcd scaled) const {
    if (!_pairs)
        return scaled;
    auto first = scaled(Eigen::seqN(0, size() / 2, 2), Eigen::all);
    auto second = scaled(Eigen::seqN(1, size() / 2, 2), Eigen::all);
    first = (0.5 * (first + i_unit * second)).eval();
    second = -i_unit * second + first;
    return scaled;
}

Eigen::MatrixXcd HarmonicSolver::pairs_of(Eigen::MatrixXcd parts) const {
    if (!_pairs)
        return parts;
    auto first = parts(Eigen::seqN(0, size() / 2, 2), Eigen::all);
    auto second = parts(Eigen::seqN(1, size() / 2, 2), Eigen::all);
    first += second;
    second = i_unit * (2.0 * second - first);
    return parts;
}

void HarmonicSolver::set(double spin, double frequency, const Entries &changes) {
    const long double W = spin;
    const long double w = frequency;
    const std::array<long double, factor_count> factors{1, W, W * W, -w * w, w, w * W};
    if (factors == _factors && std::ranges::equal(changes, _added, same_entry))
        return;
    _factors = factors;
    _added = changes;
    _factorized = false;
    _real.setZero(_A.nonZeros());
    _imaginary.setZero(_A.nonZeros());
    for (std::size_t i = 0; i < factor_count; ++i)
        if (_factors[i] != 0) {
            for (const auto &[place, value] : _terms[i].real)
                _real(place) += _factors[i] * static_cast<long double>(value);
            for (const auto &[place, value] : _terms[i].imaginary)
                _imaginary(place) += _factors[i] * static_cast<long double>(value);
        }
    _changes = changes.empty() ? Sparse(size(), size()) : solved_for(changes);
    for (Eigen::Index column = 0; column < _changes.outerSize() && !changes.empty(); ++column)
        for (Sparse::InnerIterator entry(_changes, column); entry; ++entry) {
            const auto place = &_A.coeffRef(entry.row(), entry.col()) - _A.valuePtr();
            _real(place) += static_cast<long double>(entry.value().real());
            _imaginary(place) += static_cast<long double>(entry.value().imag());
        }
    _A.coeffs().real() = _real.cast<double>();
    _A.coeffs().imag() = _imaginary.cast<double>();
    _sizes = Sparse();
}

const HarmonicSolver::Sparse &HarmonicSolver::sizes() const {
    if (_sizes.size() > 0)
        return _sizes;
    _sizes = _A;
    _sizes.coeffs().setZero();
    for (std::size_t i = 0; i < factor_count; ++i) {
        const auto factor = static_cast<double>(std::abs(_factors[i]));
        for (const auto &[place, value] : _terms[i].real)
            _sizes.coeffs()(place) += factor * std::abs(value);
        for (const auto &[place, value] : _terms[i].imaginary)
            _sizes.coeffs()(place) += std::complex<double>(0, factor * std::abs(value));
    }
    for (Eigen::Index column = 0; column < _changes.outerSize(); ++column)
        for (Sparse::InnerIterator entry(_changes, column); entry; ++entry)
            _sizes.coeffRef(entry.row(), entry.col()) += std::complex<double>(
                std::abs(entry.value().real()), std::abs(entry.value().imag()));
    return _sizes;
}

/// |A| |q| + |f| of real and imaginary parts: what K and s^2 M lose against each other counts as
/// rounding.
Eigen::VectorXcd HarmonicSolver::sizes_of(const Eigen::VectorXcd &f,
                                          const Eigen::VectorXcd &q) const {
    const Eigen::VectorXcd x = moduli(q);
    Eigen::VectorXcd out = moduli(f);
    out.real() += (sizes() * x.conjugate()).real();
    out.imag() += (sizes() * x).imag();
    return out;
}

Eigen::VectorXcd HarmonicSolver::rest(const Eigen::Ref<const Eigen::VectorXcd> &f,
                                      const Eigen::Ref<const Eigen::VectorXcd> &q) const {
    if (!_smooth)
        return f - _A * q;
    Eigen::ArrayX<long double> real = f.real().cast<long double>();
    Eigen::ArrayX<long double> imaginary = f.imag().cast<long double>();
    for (Eigen::Index column = 0; column < _A.cols(); ++column) {
        const auto x = static_cast<long double>(q(column).real());
        const auto y = static_cast<long double>(q(column).imag());
        for (auto i = _A.outerIndexPtr()[column]; i < _A.outerIndexPtr()[column + 1]; ++i) {
            const auto row = _A.innerIndexPtr()[i];
            real(row) -= _real(i) * x - _imaginary(i) * y;
            imaginary(row) -= _real(i) * y + _imaginary(i) * x;
        }
    }
    Eigen::VectorXcd out(f.size());
    out.real() = real.cast<double>().matrix();
    out.imag() = imaginary.cast<double>().matrix();
    return out;
}

double HarmonicSolver::refine(const Eigen::Ref<const Eigen::VectorXcd> &f, Eigen::MatrixXcd &q,
                              Eigen::Index column, const Eigen::VectorXcd &rest) {
    constexpr double epsilon = std::numeric_limits<double>::epsilon();
    constexpr auto longer = static_cast<double>(std::numeric_limits<long double>::epsilon());
    constexpr int most = 6; // a guard
    Eigen::VectorXcd step = _lu.solution(rest);
    double size = step.norm() / q.col(column).norm();
    double noise = size * (longer / epsilon); // what the digits of the rest leave
    for (int i = 0; i < most; ++i) {
        q.col(column) += step;
        if (!_smooth || !(size > epsilon) || size * size <= epsilon / 2)
            break;
        step = _lu.solution(this->rest(f, q.col(column)));
        const double next = step.norm() / q.col(column).norm();
        if (!(next < size / 2)) { // as it stands
            noise = std::max(noise, next);
            break;
        }
        size = next;
    }
    constexpr double of_sums = 16; // behind a deflection
    return std::max(noise, of_sums * epsilon);
}

double HarmonicSolver::solved(const Eigen::MatrixXcd &f, Eigen::MatrixXcd &q) {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    _factorized = _factorized || _lu.factorize(_A);
    if (!_factorized)
        return infinity;
    q = f;
    _lu.solve(q);
    _noise = 0;
    if (!q.allFinite())
        return infinity;
    double out = 0;
    for (Eigen::Index column = 0; column < q.cols(); ++column) {
        const Eigen::VectorXcd rest = this->rest(f.col(column), q.col(column));
        // The diagonal alone is most of it: where that is enough, nothing else is summed up.
        double size = _A.diagonal().cwiseProduct(q.col(column)).cwiseAbs().maxCoeff() / 2;
        if (!(largest_part(rest) <= residual_of_old_pivots * size))
            size = largest_part(sizes_of(f.col(column), q.col(column)));
        if (size > 0)
            out = std::max(out, largest_part(rest) / size);
        _noise = std::max(_noise, refine(f.col(column), q, column, rest));
    }
    return out;
}

Eigen::MatrixXcd HarmonicSolver::solve(double spin, double frequency,
                                       const Eigen::MatrixXcd &forces, const Entries &changes) {
    // Far more means that elimination went wrong.
    constexpr double residual_allowed = 1e-8;
    set(spin, frequency, changes);
    const Eigen::MatrixXcd f = parts_of(_scales.asDiagonal() * forces);
    Eigen::MatrixXcd q;
    double residual = solved(f, q);
    if (!(residual <= residual_of_old_pivots)) {
        _lu.forget_pivots();
        _factorized = false;
        residual = solved(f, q);
    }
    if (std::isinf(residual))
        throw SolverError("the dynamic stiffness matrix is singular");
    if (!(residual <= residual_allowed))
        throw SolverError("the linear system of the forced motion left a large residual");
    return _scales.asDiagonal() * pairs_of(std::move(q));
}

double HarmonicSolver::rounding(const Eigen::VectorXcd &forces,
                                const Eigen::VectorXcd &displacements) const {
    const Eigen::VectorXcd q = parts_of(_scales.cwiseInverse().asDiagonal() * displacements);
    if (q.isZero(0))
        return 0;
    // Rounding of the entries of A changes each row of A q by about epsilon times its size.
    Eigen::VectorXcd change = sizes_of(parts_of(_scales.asDiagonal() * forces), q);
    Eigen::Map<Eigen::VectorXd>(reinterpret_cast<double *>(change.data()), 2 * change.size())
        .array() *= std::numeric_limits<double>::epsilon() * signs(2 * change.size()).array();
    return _lu.solution(change).norm() / q.norm();
}

double HarmonicSolver::absolute_form(const Eigen::VectorXcd &displacements) const {
    const Eigen::VectorXcd q = parts_of(_scales.cwiseInverse().asDiagonal() * displacements)
                                   .cwiseAbs()
                                   .cast<std::complex<double>>();
    const std::complex<double> form = q.dot(sizes() * q);
    return form.real() + form.imag();
}

bool HarmonicSolver::conserves() const {
    return _terms[i_frequency].zero() && _terms[spin_once].zero();
}

} // namespace whirl::linalg
