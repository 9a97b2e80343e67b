#include "linalg/harmonic_solve.h"

#include "linalg/check.h"
#include "linalg/handles.h"
#include "linalg/unit_scales.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

namespace whirl::linalg {

namespace {

/// A term of A(s) = K + s Kc - s^2 M + i s C + i s^2 G.
enum Factor { one, speed_once, minus_speed_squared, i_speed, i_speed_squared, factor_count };

/// The entry of the real matrix is value times the factor at the speed.
struct Entry {
    PetscInt row;
    PetscInt column;
    double value;
    Factor factor;
};

void add_term(std::vector<Entry> &entries, const Matrix *term, Factor factor,
              const Eigen::VectorXd &scales) {
    if (term == nullptr)
        return;
    const bool imaginary = factor == i_speed || factor == i_speed_squared;
    const SparseView view = term->view();
    for (int row = 0; row < view.outerSize(); ++row)
        for (SparseView::InnerIterator entry(view, row); entry; ++entry) {
            const PetscInt i = 2 * row;
            const auto j = static_cast<PetscInt>(2 * entry.col());
            const double a = scales(row) * entry.value() * scales(entry.col());
            if (a == 0)
                continue;
            entries.push_back({i, imaginary ? j + 1 : j, imaginary ? -a : a, factor});
            entries.push_back({i + 1, imaginary ? j : j + 1, a, factor});
        }
}

/// Signs without a pattern, the same at every call (a linear congruential generator, Knuth).
Eigen::VectorXd signs(Eigen::Index size) {
    Eigen::VectorXd out(size);
    unsigned long long state = 1;
    for (Eigen::Index i = 0; i < size; ++i) {
        state = state * 6364136223846793005ULL + 1442695040888963407ULL;
        out(i) = (state >> 63U) != 0 ? 1 : -1;
    }
    return out;
}

/// n x n matrix with room at the places of the entries, which may repeat.
MatOwner matrix_with_places(PetscInt n, const std::vector<Entry> &entries) {
    std::vector<PetscInt> rows;
    std::vector<PetscInt> columns;
    rows.reserve(entries.size());
    columns.reserve(entries.size());
    for (const Entry &entry : entries) {
        rows.push_back(entry.row);
        columns.push_back(entry.column);
    }
    Mat handle = nullptr;
    check(MatCreate(PETSC_COMM_SELF, &handle));
    MatOwner A(handle);
    check(MatSetSizes(handle, n, n, n, n));
    check(MatSetType(handle, MATSEQAIJ));
    check(MatSetPreallocationCOO(handle, static_cast<PetscCount>(rows.size()), rows.data(),
                                 columns.data()));
    return A;
}

VecOwner vector_over_foreign_memory(PetscInt n) {
    Vec handle = nullptr;
    check(VecCreateSeqWithArray(PETSC_COMM_SELF, 1, n, nullptr, &handle));
    return VecOwner(handle);
}

} // namespace

struct HarmonicSolver::Data {
    int size = 0;           ///< complex unknowns
    Eigen::VectorXd scales; ///< of the unknowns, powers of two
    std::vector<Entry> entries;
    std::vector<PetscScalar> values;
    MatOwner A;
    MatOwner factors;
    VecOwner right;
    VecOwner left;

    /// A^-1 b.
    [[nodiscard]] Eigen::VectorXd solve(const Eigen::VectorXd &b) const {
        Eigen::VectorXd x(b.size());
        check(VecPlaceArray(right.get(), b.data()));
        check(VecPlaceArray(left.get(), x.data()));
        const PetscErrorCode code = MatSolve(factors.get(), right.get(), left.get());
        check(VecResetArray(right.get()));
        check(VecResetArray(left.get()));
        check(code);
        return x;
    }

    /// r = f - A q and the sizes |A| |q| + |f| that it is to be compared with, |A| the sum of the
    /// moduli of the terms: what K and s^2 M lose against each other counts as rounding.
    void residual(const Eigen::VectorXd &f, const Eigen::VectorXd &q, Eigen::VectorXd &r,
                  Eigen::VectorXd &sizes) const {
        r = f;
        sizes = f.cwiseAbs();
        for (std::size_t i = 0; i < entries.size(); ++i) {
            const double product = values[i] * q(entries[i].column);
            r(entries[i].row) -= product;
            sizes(entries[i].row) += std::abs(product);
        }
    }

    /// One right-hand side; updates the quality of the whole solution.
    [[nodiscard]] Eigen::VectorXd solve_checked(const Eigen::VectorXd &f,
                                                HarmonicSolution &quality) const {
        Eigen::VectorXd q = solve(f);
        if (!q.allFinite())
            throw SolverError("the dynamic stiffness matrix is singular");
        if (q.isZero(0))
            return q;
        Eigen::VectorXd r;
        Eigen::VectorXd sizes;
        residual(f, q, r, sizes);
        quality.residual = std::max(quality.residual,
                                    r.lpNorm<Eigen::Infinity>() / sizes.lpNorm<Eigen::Infinity>());
        // Rounding of the entries of A changes each row of A q by about epsilon times its size.
        const Eigen::VectorXd rounded =
            std::numeric_limits<double>::epsilon() * sizes.cwiseProduct(signs(f.size()));
        const double change = solve(rounded).norm() / q.norm();
        quality.rounding = std::max(quality.rounding, change);
        return q;
    }
};

HarmonicSolver::HarmonicSolver(const HarmonicTerms &terms) : _data(std::make_unique<Data>()) {
    Data &d = *_data;
    d.size = terms.K->size();
    d.scales = unit_scales(*terms.K, terms.M);
    add_term(d.entries, terms.K, one, d.scales);
    add_term(d.entries, terms.Kc, speed_once, d.scales);
    add_term(d.entries, terms.M, minus_speed_squared, d.scales);
    add_term(d.entries, terms.C, i_speed, d.scales);
    add_term(d.entries, terms.G, i_speed_squared, d.scales);
    const PetscInt n = 2 * d.size;
    for (PetscInt i = 0; i < n; ++i)
        d.entries.push_back({i, i, 0, one}); // the factorisation needs the whole diagonal
    d.values.resize(d.entries.size());
    d.A = matrix_with_places(n, d.entries);
    d.right = vector_over_foreign_memory(n);
    d.left = vector_over_foreign_memory(n);
}

HarmonicSolver::~HarmonicSolver() = default;

int HarmonicSolver::size() const { return _data->size; }

void HarmonicSolver::factorise(double speed) {
    Data &d = *_data;
    std::array<double, factor_count> factors{};
    factors[one] = 1;
    factors[speed_once] = speed;
    factors[minus_speed_squared] = -speed * speed;
    factors[i_speed] = speed;
    factors[i_speed_squared] = speed * speed;
    for (std::size_t i = 0; i < d.entries.size(); ++i)
        d.values[i] = d.entries[i].value * factors[d.entries[i].factor];
    check(MatSetValuesCOO(d.A.get(), d.values.data(), INSERT_VALUES));
    MatFactorInfo info;
    check(MatFactorInfoInitialize(&info));
    if (!d.factors) {
        Mat handle = nullptr;
        check(MatGetFactor(d.A.get(), MATSOLVERKLU, MAT_FACTOR_LU, &handle));
        d.factors.reset(handle);
        check(MatLUFactorSymbolic(handle, d.A.get(), nullptr, nullptr, &info));
    }
    check(MatLUFactorNumeric(d.factors.get(), d.A.get(), &info));
}

HarmonicSolution HarmonicSolver::solve(double speed, const Eigen::MatrixXcd &forces) {
    // A backward stable solution leaves some 1e-15; far more means that elimination went wrong.
    constexpr double residual_allowed = 1e-8;
    factorise(speed);
    HarmonicSolution out;
    out.displacements.resize(forces.rows(), forces.cols());
    for (Eigen::Index column = 0; column < forces.cols(); ++column) {
        Eigen::VectorXd f(2 * size());
        const Eigen::ArrayXd scales = _data->scales.array();
        f(Eigen::seqN(0, size(), 2)) = forces.col(column).real().array() * scales;
        f(Eigen::seqN(1, size(), 2)) = forces.col(column).imag().array() * scales;
        const Eigen::VectorXd q = _data->solve_checked(f, out);
        out.displacements.col(column).real() = q(Eigen::seqN(0, size(), 2)).array() * scales;
        out.displacements.col(column).imag() = q(Eigen::seqN(1, size(), 2)).array() * scales;
    }
    if (!(out.residual <= residual_allowed))
        throw SolverError("the linear system of the forced motion left a large residual");
    return out;
}

} // namespace whirl::linalg
