#include "reduction/planar_shapes.h"

#include "assembly/planar_part.h"
#include "assembly/planes.h"
#include "linalg/check.h"
#include "linalg/definite_pair.h"
#include "linalg/dense/products.h"
#include "linalg/symmetric_eigen.h"
#include "reduction/orthonormal.h"

#include <Eigen/SparseCholesky>

#include <algorithm>
#include <cmath>
#include <utility>

namespace whirl::reduction {

namespace {

using Sparse = Eigen::SparseMatrix<double>;

/// What loads act on that the modes at rest do not know.
std::vector<assembly::Combination> loaded_quantities(const assembly::Discretization &d) {
    std::vector<assembly::Combination> loaded;
    const model::Rotor &rotor = d.rotor();
    for (const model::Bearing &b : rotor.bearings) {
        loaded.push_back(d.deflection_at(b.z));
        const bool tilts = std::any_of(b.rows.begin(), b.rows.end(), [](const auto &row) {
            return !row.kt.isZero(0) || !row.ct.isZero(0);
        });
        if (tilts)
            loaded.push_back(d.slope_at(b.z));
    }
    for (const model::Disc &disc : rotor.discs)
        loaded.push_back(d.slope_at(disc.z));
    for (const model::Anisotropy &anisotropy : rotor.anisotropies)
        loaded.push_back(d.slope_at(anisotropy.z));
    for (const model::Balancer &balancer : rotor.balancers) {
        loaded.push_back(d.deflection_at(balancer.z));
        loaded.push_back(d.slope_at(balancer.z));
    }
    return loaded;
}

/// Under unit loads on the quantities, a column each.
/// @throws linalg::SolverError where H is not positive definite
Eigen::MatrixXd static_deflections(const Sparse &H, const Eigen::MatrixXd &loads) {
    const Eigen::SimplicialLDLT<Sparse> factors(H);
    if (factors.info() != Eigen::Success || factors.vectorD().minCoeff() <= 0)
        throw linalg::SolverError("the bearings push away: no shapes to reduce the rotor to");
    return factors.solve(loads);
}

/// Modes at rest far above what is to be described: the static deflections stand for the rest.
constexpr double above_top = 2;

/// The lowest modes at rest. Those whose digits rounding takes beside far slower ones (of a shaft
/// nearly without mass, beside its discs on their supports) are found held by the mass as well: of
/// K + s^2 M, s next to them.
/// @param pair  of H and M
std::vector<linalg::RealPair> modes_at_rest(const linalg::DefinitePair &pair, const Sparse &H,
                                            const Sparse &M, int wanted) {
    constexpr double sharp = 1e-6;  // error, relative
    constexpr double dropped = 3e6; // DefinitePair: a ratio at which the faster ones are zero
    std::vector<linalg::RealPair> out = pair.smallest(wanted);
    double held = 0; // 1/s
    for (std::size_t known = 0;;) {
        const std::size_t before = known;
        while (known < out.size() && out[known].residual + out[known].rounding < sharp)
            ++known;
        if (known == static_cast<std::size_t>(wanted) || known == before)
            return out;
        held =
            known < out.size() ? std::hypot(out[known].value, held) : dropped * out[before].value;
        std::vector<linalg::RealPair> found;
        try {
            found = linalg::DefinitePair(linalg::Matrix::from_sparse(H + held * held * M),
                                         linalg::Matrix::from_sparse(M))
                        .smallest(wanted);
        } catch (const linalg::SolverError &) {
            return out; // as found before: with fewer digits
        }
        out.resize(known);
        for (std::size_t i = known; i < found.size(); ++i)
            out.push_back(std::move(found[i]));
    }
}

} // namespace

PlanarShapes::PlanarShapes(const assembly::Discretization &discretization, double top,
                           const Eigen::MatrixXd &columns) {
    const assembly::PlanarPair pair = assembly::planar_pair(discretization, 0);
    const Sparse H = pair.K + top * top * pair.M;
    _H = Sparse(Eigen::VectorXd(H.diagonal().cwiseAbs()).asDiagonal());
    _shapes.resize(_H.rows(), 0);
    add(columns, 1e-12);
}

PlanarShapes::PlanarShapes(const assembly::Discretization &discretization, double top, int modes) {
    const assembly::PlanarPair pair = assembly::planar_pair(discretization, 0);
    _H = pair.K + top * top * pair.M;
    _shapes.resize(_H.rows(), 0);
    const Eigen::MatrixXd bent =
        static_deflections(_H, assembly::unit_loads(loaded_quantities(discretization), _H.rows()));
    const linalg::DefinitePair held(linalg::Matrix::from_sparse(_H),
                                    linalg::Matrix::from_sparse(pair.M));
    // (K + top^2 M - s^2 M) x = 0: at rest the frequency is sqrt(s^2 - top^2).
    const double bound = std::hypot(above_top * top, top);
    const int wanted = std::max(modes, bound > 0 ? held.count_below(bound) : 0);
    for (const linalg::RealPair &mode :
         modes_at_rest(held, _H, pair.M, std::min(wanted, discretization.planar_size())))
        add(mode.vector, 1e-6);
    add(bent, 1e-6);
}

void PlanarShapes::add_static(const std::vector<assembly::Combination> &loaded) {
    add(static_deflections(_H, assembly::unit_loads(loaded, _H.rows())), 1e-6);
}

void PlanarShapes::add(const Eigen::MatrixXd &columns, double newness) {
    take_in(_shapes, _H, columns, newness);
}

Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>
PlanarShapes::principal(const std::vector<const Eigen::MatrixXd *> &parts) const {
    const Eigen::MatrixXd to_amplitudes = _shapes.transpose() * _H;
    Eigen::MatrixXd squares = Eigen::MatrixXd::Zero(_shapes.cols(), _shapes.cols());
    for (const Eigen::MatrixXd *of_motion : parts) {
        Eigen::MatrixXd amplitudes = linalg::times(to_amplitudes, *of_motion);
        amplitudes /= std::max(amplitudes.colwise().norm().maxCoeff(), 1e-300);
        squares += linalg::times(amplitudes, Eigen::MatrixXd(amplitudes.transpose()));
    }
    return linalg::symmetric_eigenpairs(squares);
}

void PlanarShapes::keep(const Eigen::MatrixXd &combinations) {
    _shapes = (_shapes * combinations).eval();
}

void PlanarShapes::add_newest_first(Eigen::MatrixXd columns, double newness) {
    take_in_newest_first(_shapes, _H, std::move(columns), newness);
}

void PlanarShapes::add_longest_first(Eigen::MatrixXd columns, double shortest) {
    take_in_longest_first(_shapes, _H, std::move(columns), shortest);
}

Eigen::MatrixXd planar_parts(const Eigen::VectorXcd &vector, Eigen::Index N, Eigen::Index term) {
    const Eigen::Index terms = vector.size() / term;
    Eigen::MatrixXd out(N, 4 * terms);
    for (Eigen::Index k = 0; k < terms; ++k) {
        const assembly::Planes planes(vector.segment(k * term, 2 * N));
        out.middleCols(4 * k, 4) << planes.x.real(), planes.x.imag(), planes.y.real(),
            planes.y.imag();
    }
    // What is small beside the rest of the motion is rounding, or does not matter.
    const double largest = out.colwise().norm().maxCoeff();
    for (Eigen::Index j = 0; j < out.cols(); ++j)
        if (out.col(j).norm() < 1e-6 * largest)
            out.col(j).setZero();
    return out;
}

} // namespace whirl::reduction
