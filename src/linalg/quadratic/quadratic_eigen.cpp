#include "linalg/quadratic/quadratic_eigen.h"

#include "linalg/check.h"
#include "linalg/handles.h"
#include "linalg/quadratic/quadratic_problem.h"
#include "linalg/unit_scales.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace whirl::linalg {

namespace {

using Sparse = Eigen::SparseMatrix<double>;

/// Below this size the dense route costs less than a millisecond or two and finds everything;
/// TOAR of SLEPc 3.18 fails in LAPACK on small systems of which a large part is wanted.
bool prefers_dense(int unknowns, int wanted) { return unknowns <= 24 || 5 * wanted >= unknowns; }

/// All eigenvalues of more unknowns take a minute and more.
constexpr int largest_dense = 600;

/// A pair is accepted with a residual below this, which is reported with it; a usual one has
/// 1e-13, only matrices of very many tiny elements come near.
constexpr double acceptable_residual = 1e-6;

VecOwner new_vector(int size) {
    Vec vec = nullptr;
    check(VecCreateSeq(PETSC_COMM_SELF, size, &vec));
    return VecOwner(vec);
}

Eigen::VectorXcd complex_vector(Vec re, Vec im, int size) {
    const PetscScalar *a = nullptr;
    const PetscScalar *b = nullptr;
    check(VecGetArrayRead(re, &a));
    check(VecGetArrayRead(im, &b));
    Eigen::VectorXcd out(size);
    out.real() = Eigen::Map<const Eigen::VectorXd>(a, size);
    out.imag() = Eigen::Map<const Eigen::VectorXd>(b, size);
    check(VecRestoreArrayRead(re, &a));
    check(VecRestoreArrayRead(im, &b));
    return out;
}

/// One attempt of TOAR. Its small dense problem can fail in LAPACK, by bad luck of the subspace:
/// another beginning and size of it then helps.
struct Attempt {
    double tolerance = 1e-11;
    double phase = 1; ///< of the starting vector
    int spare = 30;   ///< vectors of the subspace beside the wanted ones
};

void configure(PEP pep, const QuadraticOptions &options, int size, const Attempt &attempt) {
    // Conjugate pairs come together, so twice as many values are asked for.
    const int nev = std::min(2 * size - 2, 2 * options.wanted + 2);
    check(PEPSetDimensions(pep, nev, std::min(2 * size, nev + attempt.spare), PETSC_DEFAULT));
    check(PEPSetProblemType(pep, PEP_GENERAL));
    check(PEPSetType(pep, PEPTOAR));
    check(PEPSetScale(pep, PEP_SCALE_SCALAR, PETSC_DEFAULT, nullptr, nullptr, 0, 0));
    check(PEPSetTolerances(pep, attempt.tolerance, 100));
    check(PEPSetTarget(pep, options.shift));
    check(PEPSetWhichEigenpairs(pep, PEP_TARGET_MAGNITUDE));
    ST st = nullptr;
    check(PEPGetST(pep, &st));
    check(STSetType(st, STSINVERT));
    KSP ksp = nullptr;
    PC pc = nullptr;
    check(STGetKSP(st, &ksp));
    check(KSPSetType(ksp, KSPPREONLY));
    check(KSPGetPC(ksp, &pc));
    check(PCSetType(pc, PCLU));
    check(PCFactorSetMatSolverType(pc, MATSOLVERKLU)); // SuiteSparse, partial pivoting
}

/// Matrices in PETSc's form, for its solver.
struct Operators {
    Matrix M, D, K;
};

std::vector<ComplexPair> toar(const Operators &operators, const QuadraticOptions &options,
                              const Attempt &attempt) {
    PEP raw = nullptr;
    check(PEPCreate(PETSC_COMM_SELF, &raw));
    const PepOwner pep(raw);
    Mat matrices[3] = {operators.K.handle(), operators.D.handle(), operators.M.handle()};
    check(PEPSetOperators(raw, 3, matrices));
    const int n = operators.M.size();
    configure(raw, options, n, attempt);
    const VecOwner re = new_vector(n);
    const VecOwner im = new_vector(n);
    PetscScalar *array = nullptr;
    check(VecGetArrayWrite(re.get(), &array));
    for (int i = 0; i < n; ++i) // without symmetry between planes or along the shaft
        array[i] = 1 + 0.5 * std::sin(attempt.phase + 1.7 * i);
    check(VecRestoreArrayWrite(re.get(), &array));
    Vec start = re.get();
    check(PEPSetInitialSpace(raw, 1, &start));
    check(PEPSolve(raw));
    PetscInt converged = 0;
    check(PEPGetConverged(raw, &converged));
    std::vector<ComplexPair> pairs;
    for (PetscInt i = 0; i < converged; ++i) {
        PetscScalar l_re = 0;
        PetscScalar l_im = 0;
        check(PEPGetEigenpair(raw, i, &l_re, &l_im, re.get(), im.get()));
        if (l_im >= 0)
            pairs.push_back({{l_re, l_im}, complex_vector(re.get(), im.get(), n), 0, 0});
    }
    return pairs;
}

void sort_by_distance(std::vector<ComplexPair> &pairs, double shift) {
    std::stable_sort(pairs.begin(), pairs.end(), [shift](const auto &a, const auto &b) {
        return std::abs(a.value - shift) < std::abs(b.value - shift);
    });
}

/// Eigenvalues that are known to be zero come blurred, a double one as +-sqrt(rounding), and have
/// no relative residual: the largest modulus among them.
double blur_of_zeros(const std::vector<ComplexPair> &pairs, int zeros) {
    std::vector<double> sizes;
    for (const ComplexPair &pair : pairs)
        sizes.insert(sizes.end(), pair.value.imag() != 0 ? 2 : 1, std::abs(pair.value));
    std::sort(sizes.begin(), sizes.end());
    const auto count = std::min(static_cast<std::size_t>(zeros), sizes.size());
    return count > 0 ? sizes[count - 1] : -1;
}

/// How near to the shift each eigenvalue of the dense route can be, resolved or not: by the error
/// that its residual shows, or by that of its inverse distance. This is a multiple of rounding for
/// simple eigenvalues and of its root for the double ones at infinity of parts without mass.
std::vector<double> nearest_places(const std::vector<ComplexPair> &pairs, double shift) {
    constexpr double of_inverse = 1e-6; // some 70 times the root of rounding
    std::vector<double> out;
    const double first = pairs.empty() ? 0 : std::abs(pairs.front().value - shift);
    for (const ComplexPair &pair : pairs) { // ascending by distance
        const double distance = std::abs(pair.value - shift);
        out.push_back(std::max(distance - 2 * pair.residual * std::abs(pair.value),
                               1 / (1 / distance + of_inverse / first)));
    }
    return out;
}

/// Drops everything from the first pair, by distance from the shift, that does not solve the
/// problem or lies beyond it. @returns whether enough pairs are left.
bool keep_resolved(std::vector<ComplexPair> &pairs, const QuadraticOptions &options,
                   double acceptable) {
    const double blur = std::max(blur_of_zeros(pairs, options.zeros), options.negligible);
    const auto bad = std::find_if(pairs.begin(), pairs.end(), [&](const ComplexPair &pair) {
        // Beside a shift, an eigenvalue near zero is known to a part of the shift, not of itself.
        const double size = std::abs(pair.value);
        const double error = pair.residual * size;
        const double scale = std::max(size, std::abs(options.shift));
        return !(size <= blur || error <= acceptable * scale) || !std::isfinite(size);
    });
    pairs.erase(bad, pairs.end());
    return static_cast<int>(pairs.size()) >= options.wanted;
}

/// All eigenvalues that double precision resolves, with where they are complete up to: nowhere
/// (negative) where they are too few.
QuadraticResult solve_dense(QuadraticProblem &problem, const QuadraticOptions &options,
                            bool otherwise) {
    QuadraticResult result;
    result.method = QuadraticMethod::dense;
    result.pairs = problem.dense(otherwise);
    sort_by_distance(result.pairs, options.shift);
    const std::vector<double> nearest = nearest_places(result.pairs, options.shift);
    const std::size_t all = result.pairs.size();
    const int fewest = options.fewest > 0 ? options.fewest : options.wanted;
    (void)keep_resolved(result.pairs, options, acceptable_residual);
    if (result.pairs.size() == all)
        result.complete_radius = std::numeric_limits<double>::infinity();
    else if (static_cast<int>(result.pairs.size()) < fewest)
        result.complete_radius = -1;
    else
        result.complete_radius =
            std::max(std::abs(result.pairs.back().value - options.shift),
                     *std::min_element(nearest.begin() + std::ssize(result.pairs), nearest.end()));
    return result;
}

/// Where not enough are resolved, by another decomposition too, and the better of both.
QuadraticResult solve_dense(QuadraticProblem &problem, const QuadraticOptions &options) {
    QuadraticResult result;
    result.complete_radius = -1;
    for (const bool otherwise : {false, true}) {
        try {
            QuadraticResult next = solve_dense(problem, options, otherwise);
            if (next.complete_radius > result.complete_radius)
                result = std::move(next);
        } catch (const SolverError &) { // it did not converge: the other one decides
        }
        if (result.complete_radius >= options.enough ||
            (options.fewest == 0 && static_cast<int>(result.pairs.size()) >= options.wanted))
            return result;
    }
    if (result.complete_radius < 0)
        throw SolverError("the eigenvalues differ by too many orders of magnitude");
    return result;
}

/// @param too_many  what TOAR did not find of this problem before, nor will it find more
QuadraticResult solve_problem(QuadraticProblem &problem, const Sparse &M, const Sparse &D,
                              const Sparse &K, const QuadraticOptions &options, int &too_many) {
    const bool rather_dense =
        options.method == QuadraticMethod::dense || (options.method == QuadraticMethod::automatic &&
                                                     prefers_dense(problem.size(), options.wanted));
    const bool try_toar =
        options.method == QuadraticMethod::toar || (!rather_dense && options.wanted < too_many);
    QuadraticResult result;
    Operators operators;
    if (try_toar)
        operators = {Matrix::from_sparse(M), Matrix::from_sparse(D), Matrix::from_sparse(K)};
    // Rounding in ill-conditioned matrices can keep the residual above the first tolerance.
    for (const Attempt &attempt :
         {Attempt{1e-11, 1, 30}, Attempt{1e-11, 2, 47}, Attempt{1e-8, 1, 30}}) {
        if (!try_toar)
            break;
        try {
            result.pairs = toar(operators, options, attempt);
            problem.assess(result.pairs);
        } catch (const SolverError &) {
            result.pairs.clear(); // the next way decides
        }
        sort_by_distance(result.pairs, options.shift);
        const bool all = keep_resolved(result.pairs, options, acceptable_residual);
        const bool few = options.method == QuadraticMethod::toar && options.fewest > 0 &&
                         static_cast<int>(result.pairs.size()) >= options.fewest;
        if (all || few) {
            result.complete_radius = std::abs(result.pairs.back().value - options.shift);
            return result;
        }
        if (problem.size() <= 200)
            break; // dense is cheaper than another try
    }
    if (try_toar)
        too_many = std::min(too_many, options.wanted);
    if (options.method == QuadraticMethod::toar ||
        (!rather_dense && problem.size() > largest_dense))
        throw SolverError("the quadratic eigensolver did not converge");
    return solve_dense(problem, options);
}

/// The matrices with d on both sides, which makes their entries comparable at the shift.
struct Scaled {
    Eigen::VectorXd d;
    Sparse M, D, K;

    Scaled(const Sparse &mass, const Sparse &damping, const Sparse &stiffness, double shift)
        : d(scales_at(shift, mass.diagonal(), stiffness.diagonal())), M(of(mass)), D(of(damping)),
          K(of(stiffness)) {}

  private:
    [[nodiscard]] Sparse of(const Sparse &A) const { return linalg::scaled(A, d); }
};

} // namespace

QuadraticResult solve_quadratic(const Matrix &M, const Matrix &D, const Matrix &K,
                                const QuadraticOptions &options) {
    return solve_quadratic(Sparse(M.view()), Sparse(D.view()), Sparse(K.view()), options);
}

struct QuadraticSolver::Data {
    Scaled scaled;
    QuadraticProblem problem;
    int too_many = std::numeric_limits<int>::max(); ///< for TOAR

    Data(const Sparse &M, const Sparse &D, const Sparse &K, double shift)
        : scaled(M, D, K, shift), problem(scaled.M, scaled.D, scaled.K, shift) {}
};

QuadraticSolver::QuadraticSolver(const Sparse &M, const Sparse &D, const Sparse &K, double shift)
    : _data(std::make_unique<Data>(M, D, K, shift)) {}

QuadraticSolver::~QuadraticSolver() = default;

QuadraticResult QuadraticSolver::solve(const QuadraticOptions &options) {
    const Scaled &scaled = _data->scaled;
    QuadraticResult result =
        solve_problem(_data->problem, scaled.M, scaled.D, scaled.K, options, _data->too_many);
    if (options.condition)
        _data->problem.assess_condition(result.pairs);
    for (ComplexPair &pair : result.pairs) {
        pair.vector = scaled.d.asDiagonal() * pair.vector;
        Eigen::Index largest = 0;
        pair.vector.cwiseAbs2().maxCoeff(&largest);
        pair.vector /= pair.vector(largest);
        if (pair.left.size() > 0)
            pair.left = scaled.d.asDiagonal() * pair.left;
    }
    return result;
}

QuadraticResult solve_quadratic(const Sparse &M, const Sparse &D, const Sparse &K,
                                const QuadraticOptions &options) {
    return QuadraticSolver(M, D, K, options.shift).solve(options);
}

void assess_condition(const Sparse &M, const Sparse &D, const Sparse &K, double shift,
                      std::vector<ComplexPair> &pairs) {
    const Scaled scaled(M, D, K, shift);
    std::vector<ComplexPair> copies = pairs;
    for (ComplexPair &pair : copies)
        pair.vector = (scaled.d.cwiseInverse().asDiagonal() * pair.vector).normalized();
    QuadraticProblem(scaled.M, scaled.D, scaled.K, shift).assess_condition(copies);
    for (std::size_t i = 0; i < pairs.size(); ++i) {
        pairs[i].residual = copies[i].residual;
        pairs[i].rounding = copies[i].rounding;
    }
}

} // namespace whirl::linalg
