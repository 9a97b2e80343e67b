#include "linalg/symmetric_eigen.h"

#include "linalg/check.h"
#include "linalg/handles.h"

#include <petscblaslapack.h>

#include <algorithm>

namespace whirl::linalg {

namespace {

PetscErrorCode multiply(Mat matrix, Vec z, Vec y) {
    void *context = nullptr;
    PetscErrorCode code = MatShellGetContext(matrix, &context);
    if (code != 0)
        return code;
    const PetscScalar *in = nullptr;
    PetscScalar *out = nullptr;
    code = VecGetArrayRead(z, &in);
    if (code == 0)
        code = VecGetArrayWrite(y, &out);
    if (code != 0)
        return code;
    static_cast<const SymmetricOperator *>(context)->apply(in, out);
    VecRestoreArrayWrite(y, &out);
    return VecRestoreArrayRead(z, &in);
}

MatOwner shell_of(const SymmetricOperator &op) {
    Mat shell = nullptr;
    // PETSc's interface is not const-correct; the operator is only read.
    check(MatCreateShell(PETSC_COMM_SELF, op.size, op.size, op.size, op.size,
                         const_cast<SymmetricOperator *>(&op), &shell));
    MatOwner owner(shell);
    check(MatShellSetOperation(shell, MATOP_MULT, reinterpret_cast<void (*)()>(multiply)));
    return owner;
}

VecOwner vector_of(const Eigen::VectorXd &values) {
    Vec vec = nullptr;
    check(VecCreateSeq(PETSC_COMM_SELF, static_cast<PetscInt>(values.size()), &vec));
    VecOwner owner(vec);
    PetscScalar *array = nullptr;
    check(VecGetArrayWrite(vec, &array));
    std::copy(values.begin(), values.end(), array);
    check(VecRestoreArrayWrite(vec, &array));
    return owner;
}

void deflate(EPS eps, const std::vector<Eigen::VectorXd> &deflated) {
    std::vector<VecOwner> owners;
    std::vector<Vec> raw;
    for (const Eigen::VectorXd &vector : deflated) {
        owners.push_back(vector_of(vector));
        raw.push_back(owners.back().get());
    }
    check(EPSSetDeflationSpace(eps, static_cast<PetscInt>(raw.size()), raw.data()));
}

int wanted_of(const SymmetricOperator &op, int wanted, std::size_t deflated) {
    return std::min(wanted, op.size - static_cast<int>(deflated));
}

EpsOwner new_solver(Mat shell, EPSWhich which, int nev, int room) {
    EPS raw = nullptr;
    check(EPSCreate(PETSC_COMM_SELF, &raw));
    EpsOwner eps(raw);
    check(EPSSetOperators(raw, shell, nullptr));
    check(EPSSetProblemType(raw, EPS_HEP));
    check(EPSSetType(raw, EPSKRYLOVSCHUR));
    check(EPSSetWhichEigenpairs(raw, which));
    check(EPSSetDimensions(raw, nev, std::min(room, std::max(2 * nev + 8, 24)), PETSC_DEFAULT));
    check(EPSSetTolerances(raw, 1e-9, 500));
    // The projected tridiagonal problem by divide and conquer: QR rotations were a fifth of the
    // time.
    DS ds = nullptr;
    check(EPSGetDS(raw, &ds));
    check(DSSetMethod(ds, 2));
    return eps;
}

std::vector<std::pair<double, Eigen::VectorXd>> run(EPS eps, const SymmetricOperator &op, int nev) {
    const VecOwner start = vector_of(op.start);
    Vec space = start.get();
    check(EPSSetInitialSpace(eps, 1, &space));
    check(EPSSolve(eps));
    PetscInt converged = 0;
    check(EPSGetConverged(eps, &converged));
    if (converged < nev)
        throw SolverError("the symmetric eigensolver did not converge");
    std::vector<std::pair<double, Eigen::VectorXd>> pairs;
    for (PetscInt i = 0; i < converged; ++i) {
        PetscScalar value = 0;
        check(EPSGetEigenpair(eps, i, &value, nullptr, start.get(), nullptr));
        const PetscScalar *array = nullptr;
        check(VecGetArrayRead(start.get(), &array));
        pairs.emplace_back(value, Eigen::Map<const Eigen::VectorXd>(array, op.size));
        check(VecRestoreArrayRead(start.get(), &array));
    }
    return pairs;
}

std::vector<std::pair<double, Eigen::VectorXd>>
solve(const SymmetricOperator &op, EPSWhich which, int wanted,
      const std::vector<Eigen::VectorXd> &deflated) {
    const MatOwner shell = shell_of(op);
    const int nev = wanted_of(op, wanted, deflated.size());
    const EpsOwner eps =
        new_solver(shell.get(), which, nev, op.size - static_cast<int>(deflated.size()));
    if (!deflated.empty())
        deflate(eps.get(), deflated);
    return run(eps.get(), op, nev);
}

} // namespace

Eigen::MatrixXd matrix_of(const SymmetricOperator &op) {
    Eigen::MatrixXd out(op.size, op.size);
    for (Eigen::Index j = 0; j < op.size; ++j)
        op.apply(Eigen::VectorXd(Eigen::VectorXd::Unit(op.size, j)).data(), out.col(j).data());
    return out;
}

void sort_by_modulus(std::vector<RealPair> &pairs) {
    std::sort(pairs.begin(), pairs.end(), [](const RealPair &a, const RealPair &b) {
        return std::abs(a.value) < std::abs(b.value);
    });
}

bool keep_confirmed(std::vector<RealPair> &pairs, int wanted, double room,
                    const std::function<int(double bound)> &count_below) {
    sort_by_modulus(pairs);
    for (auto k = static_cast<std::size_t>(wanted); k < pairs.size(); ++k) {
        const double below = std::abs(pairs[k - 1].value);
        const double above = std::abs(pairs[k].value);
        if (above - below < room * above)
            continue;
        if (count_below(below + (above - below) / 2) != static_cast<int>(k))
            return false;
        pairs.resize(k);
        return true;
    }
    return false;
}

Eigen::VectorXd deterministic_vector(int size) {
    Eigen::VectorXd vector(size);
    unsigned state = 12345;
    for (double &value : vector) {
        state = state * 1664525U + 1013904223U;
        value = 0.5 + static_cast<double>(state >> 8U) / static_cast<double>(1U << 24U);
    }
    return vector;
}

struct RepeatedEigensolver::Kept {
    SymmetricOperator op; ///< the shell matrix refers to it
    int wanted = 0;
    MatOwner shell;
    EpsOwner eps;
};

RepeatedEigensolver::RepeatedEigensolver() : _kept(std::make_unique<Kept>()) {}
RepeatedEigensolver::~RepeatedEigensolver() = default;

std::vector<std::pair<double, Eigen::VectorXd>>
RepeatedEigensolver::largest_magnitude(const SymmetricOperator &op, int wanted) {
    const int nev = wanted_of(op, wanted, 0);
    const bool fits = _kept->eps && _kept->op.size == op.size && _kept->wanted == nev;
    _kept->op = op;
    if (!fits) {
        _kept->eps.reset();
        _kept->shell = shell_of(_kept->op);
        _kept->eps = new_solver(_kept->shell.get(), EPS_LARGEST_MAGNITUDE, nev, op.size);
        _kept->wanted = nev;
    }
    try {
        return run(_kept->eps.get(), op, nev);
    } catch (const SolverError &) {
        _kept->eps.reset(); // whatever state it is in
        throw;
    }
}

std::vector<std::pair<double, Eigen::VectorXd>>
largest_magnitude(const SymmetricOperator &op, int wanted,
                  const std::vector<Eigen::VectorXd> &deflated) {
    return solve(op, EPS_LARGEST_MAGNITUDE, wanted, deflated);
}

std::vector<std::pair<double, Eigen::VectorXd>>
largest_positive(const SymmetricOperator &op, int wanted,
                 const std::vector<Eigen::VectorXd> &deflated) {
    return solve(op, EPS_LARGEST_REAL, wanted, deflated);
}

Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> symmetric_eigenpairs(const Eigen::MatrixXd &A) {
    const Eigen::MatrixXd symmetric = (A + A.transpose()) / 2;
    Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(symmetric);
    if (solver.info() != Eigen::Success)
        throw SolverError("the dense symmetric eigensolver did not converge");
    return solver;
}

LeftSingular left_singular(Eigen::MatrixXd A) {
    const auto n = static_cast<PetscBLASInt>(A.rows());
    LeftSingular out{Eigen::VectorXd(n), {}};
    double no_right_vectors = 0;
    PetscBLASInt failed = 0;
    PetscBLASInt room = -1; // asks how much is best
    double best = 0;
    // "O": the vectors overwrite the matrix.
    const auto decompose = [&](double *work) {
        LAPACKgesvd_("O", "N", &n, &n, A.data(), &n, out.values.data(), nullptr, &n,
                     &no_right_vectors, &n, work, &room, &failed);
    };
    decompose(&best);
    room = static_cast<PetscBLASInt>(best);
    Eigen::VectorXd work(room);
    decompose(work.data());
    if (failed != 0)
        throw SolverError("the dense singular value decomposition did not converge");
    out.vectors = std::move(A);
    return out;
}

} // namespace whirl::linalg
