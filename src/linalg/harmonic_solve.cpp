#include "linalg/harmonic_solve.h"

#include "linalg/check.h"
#include "linalg/handles.h"

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

void add_term(std::vector<Entry> &entries, const Matrix *term, Factor factor) {
    if (term == nullptr)
        return;
    const bool imaginary = factor == i_speed || factor == i_speed_squared;
    const SparseView view = term->view();
    for (int row = 0; row < view.outerSize(); ++row)
        for (SparseView::InnerIterator entry(view, row); entry; ++entry) {
            const PetscInt i = 2 * row;
            const auto j = static_cast<PetscInt>(2 * entry.col());
            const double a = entry.value();
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

} // namespace

struct HarmonicSolver::Data {
    int size = 0; ///< complex unknowns
    std::vector<Entry> entries;
    std::vector<PetscScalar> values;
    Matrix A;
    MatOwner factors;
    VecOwner right, left;
    bool analysed = false;

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

    void solve_column(Eigen::Ref<Eigen::VectorXcd> column, HarmonicSolution &quality) const;
};

HarmonicSolver::HarmonicSolver(const HarmonicTerms &terms) : _data(std::make_unique<Data>()) {
    Data &d = *_data;
    d.size = terms.K->size();
    add_term(d.entries, terms.K, one);
    add_term(d.entries, terms.Kc, speed_once);
    add_term(d.entries, terms.M, minus_speed_squared);
    add_term(d.entries, terms.C, i_speed);
    add_term(d.entries, terms.G, i_speed_squared);
    const PetscInt n = 2 * d.size;
    for (PetscInt i = 0; i < n; ++i)
        d.entries.push_back({i, i, 0, one}); // the whole diagonal is stored
    // from_entries would fix the values; here the same places get new values at every speed.
    std::vector<Eigen::Triplet<double>> places;
    places.reserve(d.entries.size());
    for (const Entry &entry : d.entries)
        places.emplace_back(entry.row, entry.column, entry.value);
    d.A = Matrix::from_places(n, places);
    d.values.resize(d.entries.size());
    Vec vector = nullptr;
    check(VecCreateSeqWithArray(PETSC_COMM_SELF, 1, n, nullptr, &vector));
    d.right.reset(vector);
    check(VecCreateSeqWithArray(PETSC_COMM_SELF, 1, n, nullptr, &vector));
    d.left.reset(vector);
}
