#include "modes/following/symmetric_problem.h"

#include "linalg/check.h"

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

bool positive_definite(const RealSparse &A) {
    // In the order of the shaft the matrix is a band.
    return Eigen::SimplicialLLT<RealSparse, Eigen::Lower, Eigen::NaturalOrdering<int>>(A).info() ==
           Eigen::Success;
}

} // namespace

std::unique_ptr<SymmetricProblem> SymmetricProblem::of(const assembly::Discretization &d,
                                                       results::Form form) {
    if (d.rotor().bearings_depend_on_speed())
        return nullptr;
    const std::vector<RealSparse> matrices = parts_of(d, form, 0);
    if (matrices.empty() || !positive_definite(matrices[stiffness]) ||
        !positive_definite(matrices[mass]))
        return nullptr;
    return std::unique_ptr<SymmetricProblem>(
        new SymmetricProblem(matrices, form, Relaxation::of(d.rotor().shaft)));
}

std::unique_ptr<SymmetricProblem>
SymmetricProblem::with_bearings_at(double speed, const assembly::Discretization &d,
                                   results::Form form) {
    const std::vector<RealSparse> matrices = parts_of(d, form, speed);
    if (matrices.empty() || !positive_definite(matrices[stiffness]))
        return nullptr;
    return std::unique_ptr<SymmetricProblem>(
        new SymmetricProblem(matrices, form, Relaxation::of(d.rotor().shaft)));
}

SymmetricProblem::SymmetricProblem(const std::vector<Sparse> &matrices, results::Form form,
                                   const Relaxation &relaxation)
    : _size(static_cast<int>(matrices[mass].rows())), _form(form), _relaxation(relaxation),
      _parts(parts), _scales(matrices[stiffness].diagonal().cwiseSqrt().cwiseInverse()),
      _inverse_scales(_scales.cwiseInverse()) {
    Sparse all(_size, _size);
    all.setIdentity();
    for (Sparse A : matrices) {
        A.prune(0.0); // hierarchical functions hardly couple
        if (A.nonZeros() > 0)
            all += A.cwiseAbs();
    }
    _pattern = all.cast<Complex>();
    _pattern.makeCompressed();
    _absolute_sums.resize(static_cast<std::size_t>(_size));
    for (int part = 0; part < parts; ++part)
        add_part(static_cast<Part>(part), matrices[static_cast<std::size_t>(part)]);
    _factors = std::make_unique<linalg::SymmetricFactors>(_pattern);
    _of_energies = std::make_unique<linalg::SymmetricFactors>(*_factors);
    _entries.resize(_factors->entries());
    const std::vector<int> entries =
        _factors->places(static_cast<std::size_t>(_pattern.nonZeros()));
    for (Rows &rows : _parts)
        for (std::size_t p = 0; p < rows.place.size(); ++p)
            if (const int entry = entries[static_cast<std::size_t>(rows.place[p])]; entry >= 0)
                rows.triangle.emplace_back(entry, rows.value[p]);
    set_everywhere();
}

void SymmetricProblem::set_everywhere() {
    _everywhere.resize(_entries.size());
    std::vector<Everywhere> common(static_cast<std::size_t>(_pattern.nonZeros()));
    for (const auto &[part, of] :
         {std::pair(mass, &Everywhere::M), std::pair(gyroscopic, &Everywhere::G),
          std::pair(stiffness, &Everywhere::K)}) {
        const Rows &rows = _parts[static_cast<std::size_t>(part)];
        for (const auto &[entry, value] : rows.triangle)
            _everywhere[static_cast<std::size_t>(entry)].*of = value;
        for (std::size_t p = 0; p < rows.place.size(); ++p)
            common[static_cast<std::size_t>(rows.place[p])].*of = rows.value[p];
    }
    set_rows(common);
}

/// @param common  by entries of the pattern
/// @param work    of each column of the row and what stands there
template <class Work>
void SymmetricProblem::for_row(const std::vector<Everywhere> &common, int row,
                               const Work &work) const {
    // The column of a symmetric matrix is its row.
    for (int p = _pattern.outerIndexPtr()[row]; p < _pattern.outerIndexPtr()[row + 1]; ++p)
        work(_pattern.innerIndexPtr()[p], common[static_cast<std::size_t>(p)]);
}

/// Whether both rows of a pair are alike, but for what is across.
bool SymmetricProblem::in_pairs(const std::vector<Everywhere> &common, int pair) const {
    std::vector<std::pair<int, Everywhere>> of_p;
    std::vector<std::pair<int, Everywhere>> of_q;
    for_row(common, 2 * pair, [&](int column, const Everywhere &entry) {
        if (column % 2 == 0)
            of_p.emplace_back(column / 2, entry);
    });
    for_row(common, 2 * pair + 1, [&](int column, const Everywhere &entry) {
        if (column % 2 == 1)
            of_q.emplace_back(column / 2, entry);
    });
    return std::equal(of_p.begin(), of_p.end(), of_q.begin(), of_q.end(),
                      [](const auto &p, const auto &q) {
                          return p.first == q.first && p.second.M == q.second.M &&
                                 p.second.K == q.second.K && p.second.G == -q.second.G;
                      });
}

void SymmetricProblem::set_rows(const std::vector<Everywhere> &common) {
    _rows.pairs = conjugates();
    for (int pair = 0; pair < _size / 2 && _rows.pairs; ++pair)
        _rows.pairs = in_pairs(common, pair);
    const int each = _rows.pairs ? 2 : 1;
    for (int row = 0; row < _size; row += each) {
        for_row(common, row, [&](int column, const Everywhere &entry) {
            if (column % each != 0)
                return;
            if (entry.M != 0 || entry.K != 0) {
                _rows.column.push_back(column);
                _rows.entry.push_back({entry.M, entry.K});
            }
            if (entry.G != 0) {
                _rows.G_column.push_back(column);
                _rows.G.push_back(entry.G);
            }
        });
        _rows.start.push_back(static_cast<int>(_rows.column.size()));
        _rows.G_start.push_back(static_cast<int>(_rows.G.size()));
    }
    if (!_rows.pairs)
        return;
    set_across(common, &Everywhere::M, _M_across);
    set_across(common, &Everywhere::K, _K_across);
}

/// What one unknown of a pair has to do with the others of other pairs, or of its own.
void SymmetricProblem::set_across(const std::vector<Everywhere> &common, double Everywhere::*of,
                                  Rows &across) {
    for (int row = 0; row < _size; ++row) {
        for_row(common, row, [&](int column, const Everywhere &entry) {
            if (column % 2 == row % 2 || entry.*of == 0)
                return;
            across.column.push_back(column);
            across.value.push_back(entry.*of);
        });
        if (static_cast<int>(across.column.size()) > across.start.back()) {
            across.row.push_back(row);
            across.start.push_back(static_cast<int>(across.column.size()));
        }
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
        const int *first = _pattern.innerIndexPtr() + _pattern.outerIndexPtr()[j];
        const int *last = _pattern.innerIndexPtr() + _pattern.outerIndexPtr()[j + 1];
        for (Sparse::InnerIterator entry(A, j); entry; ++entry) {
            rows.column.push_back(static_cast<int>(entry.row()));
            rows.value.push_back(entry.value());
            rows.place.push_back(static_cast<int>(
                std::lower_bound(first, last, rows.column.back()) - _pattern.innerIndexPtr()));
        }
        if (static_cast<int>(rows.column.size()) > rows.start.back()) {
            rows.row.push_back(j);
            rows.start.push_back(static_cast<int>(rows.column.size()));
        }
    }
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

} // namespace whirl::modes
