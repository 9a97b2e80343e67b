#include "forced/shape_terms.h"

#include "assembly/rotating_system.h"
#include "assembly/system.h"
#include "forced/forced_motion.h"
#include "linalg/matrix.h"
#include "modes/support_damping.h"

#include <Eigen/SparseCore>

#include <array>
#include <vector>

namespace whirl::forced {

namespace {

using Sparse = Eigen::SparseMatrix<double>;
using Complex = std::complex<double>;
using Wide = long double;
template <class Number> using Dense = Eigen::Matrix<Number, Eigen::Dynamic, Eigen::Dynamic>;

/// V^T A V. Short elements are stiffer than the rotor by many powers of ten, and all of that
/// cancels in A V, which is the forces on the nodes: in double precision what is left would be off
/// by 1e-10 and peaks by that times their amplification.
template <class Number>
Eigen::MatrixXcd planar_product(const Dense<Number> &V, const Eigen::SparseMatrix<Number> &A) {
    const Eigen::MatrixXd forces = Dense<Number>(A * V).template cast<double>();
    return (V.template cast<double>().transpose() * forces).template cast<Complex>();
}

/// The same over unknowns in pairs (x, y), the shapes for both directions: pairs again.
template <class Number>
Eigen::MatrixXcd paired_product(const Dense<Number> &V, const Eigen::SparseMatrix<Number> &A) {
    std::array<std::vector<Eigen::Triplet<Number>>, 4> entries;
    for (Eigen::Index column = 0; column < A.outerSize(); ++column)
        for (typename Eigen::SparseMatrix<Number>::InnerIterator entry(A, column); entry; ++entry)
            entries[static_cast<std::size_t>(2 * (entry.row() % 2) + column % 2)].emplace_back(
                static_cast<int>(entry.row() / 2), static_cast<int>(column / 2), entry.value());
    Eigen::MatrixXcd out = Eigen::MatrixXcd::Zero(2 * V.cols(), 2 * V.cols());
    for (Eigen::Index block = 0; block < 4; ++block) {
        const auto &list = entries[static_cast<std::size_t>(block)];
        if (list.empty())
            continue;
        Eigen::SparseMatrix<Number> part(V.rows(), V.rows());
        part.setFromTriplets(list.begin(), list.end());
        out(Eigen::seqN(block / 2, V.cols(), 2), Eigen::seqN(block % 2, V.cols(), 2)) =
            planar_product(V, part);
    }
    return out;
}

Eigen::SparseMatrix<Wide> wide(const linalg::Matrix &A) { return Sparse(A.view()).cast<Wide>(); }

/// Of a block on (x, y) the part that is the same from all sides.
Eigen::Matrix2d all_round(const Eigen::Matrix2d &block) {
    const double along = block.trace() / 2;
    const double across = (block(1, 0) - block(0, 1)) / 2;
    return Eigen::Matrix2d{{along, -across}, {across, along}};
}

} // namespace

Eigen::Matrix2cd ShapeTerms::stiffness_block(const Eigen::Matrix2d &k) const {
    return (_form == results::Form::rotating ? all_round(k) : k).cast<Complex>();
}

Eigen::Matrix2cd ShapeTerms::damping_block(const Eigen::Matrix2d &c) const {
    if (_form != results::Form::rotating)
        return imaginary_unit * c.cast<Complex>();
    const Eigen::Matrix2d b = all_round(c); // of the axes that turn: i times the block
    Eigen::Matrix2cd out =
        Eigen::Matrix2d{{-b(1, 0), -b(0, 0)}, {b(0, 0), -b(1, 0)}}.cast<Complex>();
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
    assembly::assemble_bearings(_discretization, bearing_speed,
                                [&](assembly::Term term, int i, int j, Eigen::Matrix2d block) {
                                    if (term == assembly::Term::stiffness)
                                        add(out.P0, i, j, stiffness_block(block));
                                    if (term == assembly::Term::damping)
                                        add(out.P1, i, j, damping_block(block));
                                });
}

QuadraticTerms ShapeTerms::at(double bearing_speed) const {
    const Eigen::MatrixXd &plain = _V;
    const Dense<Wide> V = plain.cast<Wide>();
    if (_form == results::Form::planar) {
        const assembly::PlanarSystem s = assembly::assemble_planar(_discretization, bearing_speed);
        const linalg::Matrix C = linalg::Matrix::from_entries(
            _discretization.planar_size(),
            modes::planar_support_damping(_discretization, bearing_speed));
        return {planar_product(V, wide(s.K)), imaginary_unit * planar_product(V, wide(C)),
                planar_product<double>(plain, s.G.view()) -
                    planar_product<double>(plain, s.M.view())};
    }
    const auto product = [&V](const linalg::Matrix &A) { return paired_product(V, wide(A)); };
    const auto mass = [&plain](const linalg::Matrix &A) {
        return paired_product<double>(plain, Sparse(A.view()));
    };
    if (_form == results::Form::rotating) {
        const assembly::RotatingSystem s =
            assembly::assemble_rotating(_discretization, bearing_speed, {});
        if (_weight) // lambda = i s in rotating axes
            return {product(s.K), product(s.Ks) + imaginary_unit * product(s.C),
                    product(s.Kss) + imaginary_unit * product(s.Cs) - mass(s.M)};
        return {product(s.K), product(s.Ks), product(s.Kss)};
    }
    const assembly::FixedSystem s = assembly::assemble_fixed(_discretization, bearing_speed);
    return {product(s.K), product(s.Kc) + imaginary_unit * product(s.C),
            imaginary_unit * mass(s.G) - mass(s.M)};
}

} // namespace whirl::forced
