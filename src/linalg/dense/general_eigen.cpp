#include "linalg/dense/general_eigen.h"

#include "linalg/check.h"

#include <Eigen/Eigenvalues>
#include <petscsys.h>
#include <slepcblaslapack.h>

#include <algorithm>

extern "C" { // not in PETSc's headers
void dlahqr_(const PetscBLASInt *schur, const PetscBLASInt *vectors, const PetscBLASInt *n,
             const PetscBLASInt *low, const PetscBLASInt *high, double *H, const PetscBLASInt *ldh,
             double *real, double *imaginary, const PetscBLASInt *first, const PetscBLASInt *last,
             double *Z, const PetscBLASInt *ldz, PetscBLASInt *failed);
void zgehrd_(const PetscBLASInt *n, const PetscBLASInt *low, const PetscBLASInt *high,
             std::complex<double> *A, const PetscBLASInt *lda, std::complex<double> *tau,
             std::complex<double> *work, const PetscBLASInt *room, PetscBLASInt *failed);
void zunghr_(const PetscBLASInt *n, const PetscBLASInt *low, const PetscBLASInt *high,
             std::complex<double> *A, const PetscBLASInt *lda, const std::complex<double> *tau,
             std::complex<double> *work, const PetscBLASInt *room, PetscBLASInt *failed);
void zlahqr_(const PetscBLASInt *schur, const PetscBLASInt *vectors, const PetscBLASInt *n,
             const PetscBLASInt *low, const PetscBLASInt *high, std::complex<double> *H,
             const PetscBLASInt *ldh, std::complex<double> *values, const PetscBLASInt *first,
             const PetscBLASInt *last, std::complex<double> *Z, const PetscBLASInt *ldz,
             PetscBLASInt *failed);
void ztrevc_(const char *side, const char *which, const PetscBLASInt *selected,
             const PetscBLASInt *n, std::complex<double> *T, const PetscBLASInt *ldt,
             std::complex<double> *left, const PetscBLASInt *ldl, std::complex<double> *right,
             const PetscBLASInt *ldr, const PetscBLASInt *columns, PetscBLASInt *found,
             std::complex<double> *work, double *real_work, PetscBLASInt *failed);
}

namespace whirl::linalg {

namespace {

/// A = Q T Q^T, T with 1 x 1 and 2 x 2 blocks on its diagonal.
struct RealSchurForm {
    Eigen::MatrixXd Q, T;
    Eigen::VectorXcd values;
};

/// @param whole  false: the values alone, at a third of the cost
RealSchurForm real_schur(Eigen::MatrixXd A, bool whole) {
    const auto n = static_cast<PetscBLASInt>(A.rows());
    const PetscBLASInt one = 1;
    const PetscBLASInt room = std::max<PetscBLASInt>(n, 1); // so little: column by column
    PetscBLASInt failed = 0;
    Eigen::VectorXd work(room);
    Eigen::VectorXd tau(std::max<PetscBLASInt>(n, 1));
    LAPACKgehrd_(&n, &one, &n, A.data(), &n, tau.data(), work.data(), &room, &failed);
    RealSchurForm out;
    if (whole)
        out.Q = A;
    if (failed == 0 && whole)
        LAPACKorghr_(&n, &one, &n, out.Q.data(), &n, tau.data(), work.data(), &room, &failed);
    for (Eigen::Index j = 0; j + 2 < A.cols(); ++j)
        A.col(j).tail(n - j - 2).setZero();
    Eigen::VectorXd real(n);
    Eigen::VectorXd imaginary(n);
    const PetscBLASInt vectors = whole ? 1 : 0;
    if (failed == 0)
        dlahqr_(&vectors, &vectors, &n, &one, &n, A.data(), &n, real.data(), imaginary.data(), &one,
                &n, out.Q.data(), &n, &failed);
    if (failed != 0)
        throw SolverError("the dense eigensolver did not converge");
    out.T = std::move(A);
    out.values.resize(n);
    out.values.real() = real;
    out.values.imag() = imaginary;
    return out;
}

/// A = Q T Q^H, T upper triangular.
struct ComplexSchurForm {
    Eigen::MatrixXcd Q, T;
    Eigen::VectorXcd values;
};

/// @param whole  false: the values alone, at a third of the cost
ComplexSchurForm complex_schur(Eigen::MatrixXcd A, bool whole) {
    const auto n = static_cast<PetscBLASInt>(A.rows());
    const PetscBLASInt one = 1;
    const PetscBLASInt room = 34 * std::max<PetscBLASInt>(n, 1); // blocks of up to 33 columns
    PetscBLASInt failed = 0;
    Eigen::VectorXcd work(room);
    Eigen::VectorXcd tau(std::max<PetscBLASInt>(n, 1));
    zgehrd_(&n, &one, &n, A.data(), &n, tau.data(), work.data(), &room, &failed);
    ComplexSchurForm out;
    if (whole)
        out.Q = A;
    if (failed == 0 && whole)
        zunghr_(&n, &one, &n, out.Q.data(), &n, tau.data(), work.data(), &room, &failed);
    for (Eigen::Index j = 0; j + 2 < A.cols(); ++j)
        A.col(j).tail(n - j - 2).setZero();
    out.values.resize(n);
    const PetscBLASInt vectors = whole ? 1 : 0;
    if (failed == 0)
        zlahqr_(&vectors, &vectors, &n, &one, &n, A.data(), &n, out.values.data(), &one, &n,
                out.Q.data(), &n, &failed);
    if (failed != 0)
        throw SolverError("the dense eigensolver did not converge");
    out.T = std::move(A);
    return out;
}

} // namespace

std::complex<double> packed_product(const Eigen::MatrixXd &a, const Eigen::MatrixXd &b,
                                    Eigen::Index j, bool pair) {
    const double real = a.col(j).dot(b.col(j));
    if (!pair)
        return real;
    return {real + a.col(j + 1).dot(b.col(j + 1)),
            a.col(j).dot(b.col(j + 1)) - a.col(j + 1).dot(b.col(j))};
}

Eigen::VectorXcd unpacked(const Eigen::MatrixXd &a, Eigen::Index j, bool pair) {
    Eigen::VectorXcd out = a.col(j).cast<std::complex<double>>();
    if (pair)
        out.imag() = a.col(j + 1);
    return out;
}

GeneralEigen general_eigen(Eigen::MatrixXd A, Vectors which) {
    const RealSchurForm schur = real_schur(std::move(A), true);
    const auto n = static_cast<PetscBLASInt>(schur.T.rows());
    const bool both = which == Vectors::both;
    GeneralEigen out{schur.values, Eigen::MatrixXd::Zero(n, n), {}, {}};
    out.left = Eigen::MatrixXd::Zero(n, both ? n : 1);
    PetscBLASInt found = 0;
    PetscBLASInt failed = 0;
    Eigen::VectorXd work(3 * std::max<PetscBLASInt>(n, 1));
    LAPACKtrevc_(both ? "B" : "R", "A", nullptr, &n, schur.T.data(), &n, out.left.data(), &n,
                 out.right.data(), &n, &n, &found, work.data(), &failed);
    if (failed != 0)
        throw SolverError("the dense eigensolver found no vectors");
    out.products = Eigen::VectorXcd::Zero(both ? n : 0);
    for (Eigen::Index j = 0; j < out.products.size(); ++j) {
        out.products(j) = packed_product(out.left, out.right, j, out.is_pair(j));
        if (out.is_pair(j)) {
            out.products(j + 1) = std::conj(out.products(j));
            ++j;
        }
    }
    out.right = (schur.Q * out.right).eval();
    if (both)
        out.left = (schur.Q * out.left).eval();
    return out;
}

Eigen::VectorXcd general_eigenvalues(Eigen::MatrixXd A) {
    return real_schur(std::move(A), false).values;
}

ComplexEigen general_eigen(Eigen::MatrixXcd A) {
    ComplexSchurForm schur = complex_schur(std::move(A), true);
    const auto n = static_cast<PetscBLASInt>(schur.T.rows());
    ComplexEigen out{std::move(schur.values), Eigen::MatrixXcd(n, n), Eigen::MatrixXcd(n, n), {}};
    PetscBLASInt found = 0;
    PetscBLASInt failed = 0;
    Eigen::VectorXcd work(2 * std::max<PetscBLASInt>(n, 1));
    Eigen::VectorXd real_work(std::max<PetscBLASInt>(n, 1));
    ztrevc_("B", "A", nullptr, &n, schur.T.data(), &n, out.left.data(), &n, out.right.data(), &n,
            &n, &found, work.data(), real_work.data(), &failed);
    if (failed != 0)
        throw SolverError("the dense eigensolver found no vectors");
    out.products.resize(n);
    for (Eigen::Index j = 0; j < n; ++j)
        out.products(j) = out.left.col(j).dot(out.right.col(j));
    out.right = (schur.Q * out.right).eval();
    out.left = (schur.Q * out.left).eval();
    return out;
}

Eigen::VectorXcd complex_eigenvalues(Eigen::MatrixXcd A) {
    return complex_schur(std::move(A), false).values;
}

GeneralEigen general_eigen_otherwise(const Eigen::MatrixXd &A) {
    const Eigen::EigenSolver<Eigen::MatrixXd> solver(A);
    if (solver.info() != Eigen::Success)
        throw SolverError("the dense eigensolver did not converge");
    return {solver.eigenvalues(), solver.pseudoEigenvectors(), {}, {}};
}

} // namespace whirl::linalg
