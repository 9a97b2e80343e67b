#include "forced/shape_terms.h"

#include "assembly/rotating_system.h"
#include "forced/forced_motion.h"
#include "linalg/matrix.h"
#include "synchronous/parts.h"

#include <Eigen/SparseCore>

#include <algorithm>
#include <vector>

namespace whirl::forced {

namespace {

using Sparse = Eigen::SparseMatrix<double>;
using Complex = std::complex<double>;
using Wide = long double;

/// A V of the unknowns row, row + step, ... and column, column + step, ..., summed as `Number`.
template <class Number>
Eigen::MatrixXd forces(const Sparse &A, const Eigen::MatrixXd &V, int row, int column, int step) {
    Eigen::MatrixXd out(V.rows(), V.cols());
    std::vector<Number> sums(static_cast<std::size_t>(V.rows()));
    for (Eigen::Index shape = 0; shape < V.cols(); ++shape) {
        std::fill(sums.begin(), sums.end(), Number(0));
        for (int j = 0; j < V.rows(); ++j)
            for (Sparse::InnerIterator entry(A, step * j + column); entry; ++entry)
                if (entry.row() % step == row)
                    sums[static_cast<std::size_t>(entry.row() / step)] +=
                        static_cast<Number>(entry.value()) * static_cast<Number>(V(j, shape));
        for (Eigen::Index i = 0; i < V.rows(); ++i)
            out(i, shape) = static_cast<double>(sums[static_cast<std::size_t>(i)]);
    }
    return out;
}

/// V^T A V. Short elements are stiffer than the rotor by many powers of ten, and all of that
/// cancels in A V, which is the forces on the nodes: in double precision what is left would be off
/// by 1e-10 and peaks by that times their amplification.
/// @param parts  1: over planar unknowns; 2: in pairs (x, y), the shapes for both directions
template <class Number>
Eigen::MatrixXcd shape_product(const Eigen::MatrixXd &V, const linalg::Matrix &A, int parts) {
    const Sparse entries = A.view();
    Eigen::MatrixXcd out(parts * V.cols(), parts * V.cols());
    for (int row = 0; row < parts; ++row)
        for (int column = 0; column < parts; ++column) {
            const Eigen::MatrixXd part =
                V.transpose() * forces<Number>(entries, V, row, column, parts);
            for (Eigen::Index k = 0; k < V.cols(); ++k)
                for (Eigen::Index i = 0; i < V.cols(); ++i)
                    out(parts * i + row, parts * k + column) = part(i, k);
        }
    return out;
}

} // namespace

Eigen::Matrix2cd ShapeTerms::constant_block(const Eigen::Matrix2d &k,
                                            const Eigen::Matrix2d &c) const {
    if (_form == results::Form::rotating)
        return all_round(k).cast<Complex>();
    return k.cast<Complex>() + imaginary_unit * _sweep.frequency * c.cast<Complex>();
}

Eigen::Matrix2cd ShapeTerms::linear_block(const Eigen::Matrix2d &c) const {
    if (_form != results::Form::rotating)
        return imaginary_unit * _sweep.frequency_rate * c.cast<Complex>();
    const Eigen::Matrix2d b = all_round(c);
    Eigen::Matrix2cd out = quarter_turned(b).cast<Complex>();
    if (_weight)
        out += imaginary_unit * b.cast<Complex>();
    return out;
}

Eigen::MatrixXd ShapeTerms::columns_of(const assembly::Combination &combination) const {
    Eigen::VectorXd planar = Eigen::VectorXd::Zero(_V.cols());
    for (const auto &[unknown, value] : combination)
        planar += value * _V.row(unknown).transpose();
    Eigen::MatrixXd out = Eigen::MatrixXd::Zero(planes() * _V.cols(), planes());
    for (Eigen::Index p = 0; p < planes(); ++p)
        out.col(p)(Eigen::seqN(p, _V.cols(), planes())) = planar;
    return out;
}

void ShapeTerms::add_bearings(double bearing_speed, double share, QuadraticTerms &out) const {
    const auto add = [&](Eigen::MatrixXcd &target, int i, int j, const Eigen::Matrix2cd &block) {
        const Eigen::MatrixXcd product =
            (share * (_V.row(i).transpose() * _V.row(j))).cast<Complex>();
        for (Eigen::Index p = 0; p < planes(); ++p)
            for (Eigen::Index q = 0; q < planes(); ++q)
                target(Eigen::seqN(p, _V.cols(), planes()), Eigen::seqN(q, _V.cols(), planes())) +=
                    block(p, q) * product;
    };
    const Eigen::Matrix2d none = Eigen::Matrix2d::Zero();
    assembly::assemble_bearings(
        _discretization, bearing_speed,
        [&](assembly::Term term, int i, int j, const Eigen::Matrix2d &block) {
            if (term == assembly::Term::stiffness)
                add(out.P0, i, j, constant_block(block, none));
            if (term == assembly::Term::damping) {
                add(out.P0, i, j, constant_block(none, block));
                add(out.P1, i, j, linear_block(block));
            }
        });
}

QuadraticTerms ShapeTerms::at(double bearing_speed) const {
    const int parts = _form == results::Form::planar ? 1 : 2;
    const auto product = [&](const linalg::Matrix &A) { return shape_product<Wide>(_V, A, parts); };
    const auto mass = [&](const linalg::Matrix &A) { return shape_product<double>(_V, A, parts); };
    if (_form == results::Form::rotating) {
        const assembly::RotatingSystem s =
            assembly::assemble_rotating(_discretization, bearing_speed, {});
        if (_weight) // lambda = i s in rotating axes
            return {product(s.K), product(s.Ks) + imaginary_unit * product(s.C),
                    product(s.Kss) + imaginary_unit * product(s.Cs) - mass(s.M)};
        return {product(s.K), product(s.Ks), product(s.Kss)};
    }
    const assembly::FixedSystem s =
        synchronous::turned_system(_discretization, _form == results::Form::planar, bearing_speed);
    // K + W Kc + i w (C + W G) - w^2 M, W and w linear in s.
    const auto &[W, W_rate, w, w_rate] = _sweep;
    const Eigen::MatrixXcd Kc = product(s.Kc);
    const Eigen::MatrixXcd iC = imaginary_unit * product(s.C);
    const Eigen::MatrixXcd iG = imaginary_unit * mass(s.G);
    const Eigen::MatrixXcd M = mass(s.M);
    return {product(s.K) + W * Kc + w * iC + w * W * iG - w * w * M,
            W_rate * Kc + w_rate * iC + (w * W_rate + w_rate * W) * iG - 2 * w * w_rate * M,
            w_rate * W_rate * iG - w_rate * w_rate * M};
}

} // namespace whirl::forced
