#include "modes/following/symmetric_problem.h"

#include "linalg/check.h"
#include "modes/following/symmetric_parts.h"

#include <Eigen/SparseCholesky>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <utility>

namespace whirl::modes {

namespace {

using Complex = SymmetricProblem::Complex;
using RealSparse = SymmetricProblem::Sparse;

/// A row of a real matrix times a vector.
template <class Rows>
WHIRL_INLINED void row_times(const Rows &A, std::size_t r, const linalg::Vector4 &x,
                             linalg::Complex4 &sum) {
    const linalg::Complex4 *in = x.data();
    const int *columns = A.column.data();
    const double *values = A.value.data();
    const int last = A.start[r + 1];
    for (int p = A.start[r]; p < last; ++p) {
        sum.re += values[p] * in[columns[p]].re;
        sum.im += values[p] * in[columns[p]].im;
    }
}

/// @param turned  times i
template <class Rows>
WHIRL_INLINED void add_rows(const Rows &A, const linalg::Vector4 &x, bool turned,
                            linalg::Vector4 &out) {
    for (std::size_t r = 0; r < A.row.size(); ++r) {
        linalg::Complex4 sum{};
        row_times(A, r, x, sum);
        linalg::Complex4 &to = out[static_cast<std::size_t>(A.row[r])];
        to.re += turned ? -sum.im : sum.re;
        to.im += turned ? sum.re : sum.im;
    }
}

struct Factor {
    SymmetricProblem::Part part;
    linalg::Complex4 factor;
};

bool positive_definite(const RealSparse &A) {
    return Eigen::SimplicialLLT<RealSparse>(A).info() == Eigen::Success;
}

} // namespace

std::unique_ptr<SymmetricProblem> SymmetricProblem::of(const assembly::Discretization &d,
                                                       results::Form form) {
    const bool planar = form == results::Form::planar_damped;
    if ((!planar && form != results::Form::general) || d.rotor().bearings_depend_on_speed())
        return nullptr;
    std::vector<RealSparse> matrices = planar ? planar_parts(d) : general_parts(d);
    if (matrices.empty() || !positive_definite(matrices[stiffness]) ||
        !positive_definite(matrices[mass]))
        return nullptr;
    return std::unique_ptr<SymmetricProblem>(new SymmetricProblem(matrices, form));
}

SymmetricProblem::SymmetricProblem(const std::vector<Sparse> &matrices, results::Form form)
    : _size(static_cast<int>(matrices[mass].rows())), _form(form), _parts(parts),
      _scales(matrices[stiffness].diagonal().cwiseSqrt().cwiseInverse()),
      _inverse_scales(_scales.cwiseInverse()) {
    Sparse all(_size, _size);
    all.setIdentity();
    for (Sparse A : matrices) {
        A.prune(0.0); // hierarchical functions hardly couple
        if (A.nonZeros() > 0)
            all += A.cwiseAbs();
    }
    _Q = all.cast<Complex>();
    _Q.makeCompressed();
    _absolute_sums.resize(static_cast<std::size_t>(_size));
    for (int part = 0; part < parts; ++part)
        add_part(static_cast<Part>(part), matrices[static_cast<std::size_t>(part)]);
    _factor = std::make_unique<linalg::SymmetricFactor>(_Q);
    _factors = std::make_unique<linalg::SymmetricFactors>(*_factor);
    _entries.resize(_factors->entries());
    const std::vector<int> entries = _factors->places(static_cast<std::size_t>(_Q.nonZeros()));
    for (Rows &rows : _parts)
        for (std::size_t p = 0; p < rows.place.size(); ++p)
            if (const int entry = entries[static_cast<std::size_t>(rows.place[p])]; entry >= 0)
                rows.triangle.emplace_back(entry, rows.value[p]);
    set_everywhere();
}

void SymmetricProblem::set_everywhere() {
    _everywhere.resize(_entries.size());
    std::vector<Everywhere> common(static_cast<std::size_t>(_Q.nonZeros()));
    for (const auto &[part, of] :
         {std::pair(mass, &Everywhere::M), std::pair(gyroscopic, &Everywhere::G),
          std::pair(stiffness, &Everywhere::K)}) {
        const Rows &rows = _parts[static_cast<std::size_t>(part)];
        for (const auto &[entry, value] : rows.triangle)
            _everywhere[static_cast<std::size_t>(entry)].*of = value;
        for (std::size_t p = 0; p < rows.place.size(); ++p)
            common[static_cast<std::size_t>(rows.place[p])].*of = rows.value[p];
    }
    for (int row = 0; row < _size; ++row) { // the column of a symmetric matrix
        for (int p = _Q.outerIndexPtr()[row]; p < _Q.outerIndexPtr()[row + 1]; ++p) {
            const Everywhere &entry = common[static_cast<std::size_t>(p)];
            if (entry.M == 0 && entry.G == 0 && entry.K == 0)
                continue;
            _rows.column.push_back(_Q.innerIndexPtr()[p]);
            _rows.entry.push_back(entry);
        }
        _rows.start.push_back(static_cast<int>(_rows.column.size()));
    }
}

void SymmetricProblem::add_part(Part part, const Sparse &matrix) {
    Sparse A = matrix;
    A.prune(0.0);
    A = _scales.asDiagonal() * A * _scales.asDiagonal();
    const Eigen::VectorXd sums = A.cwiseAbs() * Eigen::VectorXd::Ones(_size);
    for (int k = 0; k < _size; ++k)
        _absolute_sums[static_cast<std::size_t>(k)][part] = sums(k);
    Rows &rows = _parts[static_cast<std::size_t>(part)];
    for (int j = 0; j < _size; ++j) { // a row of a symmetric matrix is its column
        const int *first = _Q.innerIndexPtr() + _Q.outerIndexPtr()[j];
        const int *last = _Q.innerIndexPtr() + _Q.outerIndexPtr()[j + 1];
        for (Sparse::InnerIterator entry(A, j); entry; ++entry) {
            rows.column.push_back(static_cast<int>(entry.row()));
            rows.value.push_back(entry.value());
            rows.place.push_back(static_cast<int>(
                std::lower_bound(first, last, rows.column.back()) - _Q.innerIndexPtr()));
        }
        if (static_cast<int>(rows.column.size()) > rows.start.back()) {
            rows.row.push_back(j);
            rows.start.push_back(static_cast<int>(rows.column.size()));
        }
    }
}

const linalg::RealEnergy &SymmetricProblem::energy_of(int exponent) const {
    auto known = _energy.find(exponent);
    if (known == _energy.end()) {
        const double s = std::ldexp(1.0, exponent);
        _Q.coeffs().setZero();
        add(stiffness, 1);
        add(mass, s * s);
        _factor->factorize(_Q);
        known = _energy.emplace(exponent, linalg::RealEnergy(*_factor)).first;
    }
    return known->second;
}

std::array<double, linalg::lanes>
SymmetricProblem::energies(const linalg::Vector4 &b,
                           const std::array<double, linalg::lanes> &sizes) const {
    Exponents exponents{};
    for (std::size_t lane = 0; lane < linalg::lanes; ++lane)
        exponents[lane] = std::ilogb(sizes[lane]);
    auto known = _energies.find(exponents);
    if (known == _energies.end()) {
        std::array<const linalg::RealEnergy *, linalg::lanes> each{};
        for (std::size_t lane = 0; lane < linalg::lanes; ++lane)
            each[lane] = &energy_of(exponents[lane]);
        known = _energies.emplace(exponents, linalg::RealEnergies(each)).first;
    }
    return known->second(b);
}

// The pairs (x, y = i y') as p and q, and back, in real numbers: these are done for each mode of a
// sweep.

Eigen::VectorXcd SymmetricProblem::from_form(const Eigen::VectorXcd &shape) const {
    if (!conjugates())
        return shape.cwiseProduct(_inverse_scales);
    Eigen::VectorXcd out(_size);
    const auto *in = reinterpret_cast<const double *>(shape.data());
    auto *to = reinterpret_cast<double *>(out.data());
    const double *scale = _inverse_scales.data();
    constexpr double half = 0.5 * std::numbers::sqrt2;
    for (const double *end = in + 2 * _size; in != end; in += 4, to += 4, scale += 2) {
        const double first = half * scale[0];
        const double second = half * scale[1];
        to[0] = first * (in[0] + in[3]);
        to[1] = first * (in[1] - in[2]);
        to[2] = second * (in[0] - in[3]);
        to[3] = second * (in[1] + in[2]);
    }
    return out;
}

/// @param sign  of i in y = i y': -1 for covectors
Eigen::VectorXcd SymmetricProblem::scaled_to_form(const Eigen::VectorXcd &vector,
                                                  const Eigen::VectorXd &scales,
                                                  double sign) const {
    if (!conjugates())
        return vector.cwiseProduct(scales);
    Eigen::VectorXcd out(_size);
    const auto *in = reinterpret_cast<const double *>(vector.data());
    auto *to = reinterpret_cast<double *>(out.data());
    const double *scale = scales.data();
    constexpr double half = 0.5 * std::numbers::sqrt2;
    for (const double *end = in + 2 * _size; in != end; in += 4, to += 4, scale += 2) {
        const double first = half * scale[0];
        const double second = half * scale[1];
        to[0] = first * in[0] + second * in[2];
        to[1] = first * in[1] + second * in[3];
        to[2] = -sign * (first * in[1] - second * in[3]);
        to[3] = sign * (first * in[0] - second * in[2]);
    }
    return out;
}

Eigen::VectorXcd SymmetricProblem::to_form(const Eigen::VectorXcd &vector) const {
    return scaled_to_form(vector, _scales, 1);
}

Eigen::VectorXcd SymmetricProblem::conjugate(const Eigen::VectorXcd &vector) const {
    return from_form(to_form(vector).conjugate());
}

Eigen::VectorXcd SymmetricProblem::covector_to_form(const Eigen::VectorXcd &vector) const {
    return scaled_to_form(vector, _inverse_scales, -1);
}

void SymmetricProblem::multiply(const linalg::Vector4 &x, const linalg::Real4 &speed,
                                Products &out) const {
    const auto rows = [this](Part part) -> const Rows & {
        return _parts[static_cast<std::size_t>(part)];
    };
    for (linalg::Vector4 *y : {&out.M, &out.D, &out.K, &out.D1})
        y->resize(x.size());
    out.K1.resize(rows(circulatory).row.empty() ? 0 : x.size());
    linalg::in_lanes([&]() __attribute__((always_inline)) {
        const linalg::Complex4 *in = x.data();
        const int *columns = _rows.column.data();
        const Everywhere *entries = _rows.entry.data();
        for (std::size_t k = 0; k < x.size(); ++k) {
            linalg::Complex4 M{};
            linalg::Complex4 G{};
            linalg::Complex4 K{};
            const int last = _rows.start[k + 1];
            for (int p = _rows.start[k]; p < last; ++p) {
                const linalg::Complex4 &from = in[columns[p]];
                const Everywhere of = entries[p];
                M.re += of.M * from.re;
                M.im += of.M * from.im;
                G.re += of.G * from.re;
                G.im += of.G * from.im;
                K.re += of.K * from.re;
                K.im += of.K * from.im;
            }
            out.M[k] = M;
            out.K[k] = K;
            out.D1[k] = {-G.im, G.re};
            out.D[k] = {speed * out.D1[k].re, speed * out.D1[k].im};
        }
        add_rows(rows(stiffness_turned), x, true, out.K);
        add_rows(rows(damping), x, false, out.D);
        add_rows(rows(damping_turned), x, true, out.D);
        if (!out.K1.empty()) {
            std::fill(out.K1.begin(), out.K1.end(), linalg::Complex4{});
            add_rows(rows(circulatory), x, true, out.K1);
            for (std::size_t k = 0; k < x.size(); ++k) {
                out.K[k].re += speed * out.K1[k].re;
                out.K[k].im += speed * out.K1[k].im;
            }
        }
    });
}

std::array<double, linalg::lanes> SymmetricProblem::absolute_forms(const linalg::Real4 &l,
                                                                   const linalg::Real4 &speed,
                                                                   const linalg::Vector4 &x) const {
    std::array<linalg::Real4, parts> form{};
    linalg::in_lanes([&]() __attribute__((always_inline)) {
        std::array<linalg::Real4, parts> sum{};
        for (std::size_t k = 0; k < x.size(); ++k) {
            const linalg::Real4 square = x[k].re * x[k].re + x[k].im * x[k].im;
            for (std::size_t part = 0; part < parts; ++part)
                sum[part] += _absolute_sums[k][part] * square;
        }
        form = sum;
    });
    const linalg::Real4 turn = speed < 0 ? -speed : speed;
    const linalg::Real4 sum =
        form[stiffness] + form[stiffness_turned] + turn * form[circulatory] +
        l * (form[damping] + form[damping_turned] + turn * form[gyroscopic] + l * form[mass]);
    return {sum[0], sum[1], sum[2], sum[3]};
}

void SymmetricProblem::add(Part part, double factor) const {
    const Rows &A = _parts[static_cast<std::size_t>(part)];
    Complex *Q = _Q.valuePtr();
    for (std::size_t p = 0; p < A.value.size(); ++p)
        Q[A.place[p]] += factor * A.value[p];
}

bool SymmetricProblem::factorized(const linalg::Complex4 &l, const linalg::Real4 &speed,
                                  const linalg::Real4 &damped) const {
    linalg::in_lanes([&]() __attribute__((always_inline)) {
        linalg::Complex4 square;
        linalg::set_product(square, l, l);
        const linalg::Complex4 l_turned{-l.im, l.re};
        const linalg::Complex4 turning{l_turned.re * speed, l_turned.im * speed};
        for (std::size_t entry = 0; entry < _entries.size(); ++entry) {
            const Everywhere &of = _everywhere[entry];
            linalg::Complex4 &Q = _entries[entry];
            Q.re = of.M * square.re + of.G * turning.re + of.K;
            Q.im = of.M * square.im + of.G * turning.im;
        }
        const linalg::Real4 none{};
        const linalg::Complex4 some{l.re * damped, l.im * damped};
        for (const auto &[part, factor] :
             {Factor{damping, some}, Factor{damping_turned, {-some.im, some.re}},
              Factor{stiffness_turned, {none, damped}}, Factor{circulatory, {none, speed * damped}}})
            for (const auto &[entry, value] : _parts[static_cast<std::size_t>(part)].triangle) {
                linalg::Complex4 &to = _entries[static_cast<std::size_t>(entry)];
                to.re += value * factor.re;
                to.im += value * factor.im;
            }
    });
    const std::array<bool, linalg::lanes> sound = _factors->factorize(_entries);
    return std::count(sound.begin(), sound.end(), true) == linalg::lanes;
}

linalg::SymmetricFactors &SymmetricProblem::factorize(linalg::Complex4 l,
                                                      const linalg::Real4 &speed,
                                                      const linalg::Real4 &damped) const {
    if (factorized(l, speed, damped))
        return *_factors;
    constexpr double beside = 1 + 1e-14;
    l.re *= beside;
    l.im *= beside;
    if (!factorized(l, speed, damped))
        throw linalg::SolverError("a pivot of the symmetric factorisation is zero");
    return *_factors;
}

} // namespace whirl::modes
