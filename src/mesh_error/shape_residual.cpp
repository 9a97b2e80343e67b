#include "mesh_error/shape_residual.h"

#include "assembly/planar_part.h"
#include "assembly/planes.h"
#include "elements/beam.h"
#include "results/formulation.h"
#include "results/whirl.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace whirl::mesh_error {

namespace {

using Complex = std::complex<double>;
constexpr Complex i_unit(0, 1);

/// The next function of either parity.
constexpr int further_orders = 2;

/// Further functions of an element of order 1, the most: 2 * (1 + further_orders) - 1.
constexpr int most_further = 5;
using Block = Eigen::Matrix<Complex, Eigen::Dynamic, Eigen::Dynamic, 0, most_further, most_further>;

/// L D L^T of a symmetric matrix in place, the pivots on the diagonal. Further functions vanish at
/// the nodes and are far stiffer than the modes: no pivot comes near zero.
void factorize(Block &A) {
    for (Eigen::Index k = 0; k < A.rows(); ++k)
        for (Eigen::Index j = k + 1; j < A.rows(); ++j) {
            const Complex factor = A(j, k) / A(k, k);
            for (Eigen::Index i = j; i < A.rows(); ++i)
                A(i, j) -= A(i, k) * factor;
            A(k, j) = factor;
        }
}

/// r^H A^-1 r from these factors: above the diagonal L^T.
template <class Vector> Complex inverse_form(const Block &factors, const Vector &r) {
    Vector x = r;
    const Eigen::Index n = factors.rows();
    for (Eigen::Index k = 0; k < n; ++k)
        for (Eigen::Index i = k + 1; i < n; ++i)
            x(i) -= factors(k, i) * x(k);
    for (Eigen::Index k = n - 1; k >= 0; --k) {
        x(k) /= factors(k, k);
        for (Eigen::Index i = k + 1; i < n; ++i)
            x(k) -= factors(k, i) * x(i);
    }
    return r.dot(x);
}

/// A row of a real matrix times a complex vector.
Complex product(const Eigen::SparseMatrix<double, Eigen::RowMajor> &A, Eigen::Index row,
                const Eigen::VectorXcd &x) {
    double re = 0;
    double im = 0;
    const int *columns = A.innerIndexPtr();
    const double *values = A.valuePtr();
    const Complex *in = x.data();
    for (int p = A.outerIndexPtr()[row]; p < A.outerIndexPtr()[row + 1]; ++p) {
        re += values[p] * in[columns[p]].real();
        im += values[p] * in[columns[p]].imag();
    }
    return {re, im};
}

/// A block on the unknowns of an element as rows over those of the shaft.
void add_rows(std::vector<Eigen::Triplet<double>> &entries, const Eigen::MatrixXd &block,
              const std::vector<assembly::Combination> &own, int first) {
    for (int row = 0; row < static_cast<int>(block.rows()); ++row)
        for (std::size_t j = 0; j < own.size(); ++j)
            for (const auto &[place, value] : own[j])
                entries.emplace_back(first + row, place,
                                     value * block(row, static_cast<Eigen::Index>(j)));
}

} // namespace

ShapeResidual::ShapeResidual(const assembly::Discretization &discretization, results::Form form)
    : _discretization(discretization), _form(form),
      _mass(assembly::planar_part(discretization, assembly::Term::mass)) {
    const assembly::Discretization &d = discretization;
    if (d.rigid())
        return;
    const int order = d.order();
    const int higher = order + further_orders;
    std::vector<Eigen::Triplet<double>> M;
    std::vector<Eigen::Triplet<double>> G;
    std::vector<Eigen::Triplet<double>> K;
    for (int span = 0; span < static_cast<int>(d.shaft_mesh().spans.size()); ++span) {
        const elements::Beam beam = elements::beam_of(
            d.rotor().shaft, d.shaft_mesh().spans[static_cast<std::size_t>(span)]);
        std::vector<int> own{0, 1, 2, 3};
        for (const int place : elements::internal_places(beam, order, higher))
            own.push_back(4 + place);
        std::vector<int> further;
        for (int i = 4; i < 4 + elements::internal_unknowns(higher); ++i)
            if (std::find(own.begin(), own.end(), i) == own.end())
                further.push_back(i);
        const elements::PlanarMatrices m = elements::beam_matrices(beam, higher);
        _further = static_cast<int>(further.size());
        add_rows(M, m.M(further, own), own_motion(span), _further * span);
        add_rows(G, m.G(further, own), own_motion(span), _further * span);
        add_rows(K, (m.K + m.K_axial)(further, own), own_motion(span), _further * span);
        Element e{m.M(further, further), m.G(further, further),
                  (m.K + m.K_axial)(further, further)};
        e.like_last = span > 0 && e.M2 == _elements.back().M2 && e.G2 == _elements.back().G2 &&
                      e.K2 == _elements.back().K2;
        _elements.push_back(std::move(e));
    }
    const auto rows = static_cast<Eigen::Index>(_elements.size()) * _further;
    for (auto &[matrix, entries] : {std::pair(&_M, &M), std::pair(&_G, &G), std::pair(&_K, &K)}) {
        matrix->resize(rows, d.planar_size());
        matrix->setFromTriplets(entries->begin(), entries->end());
    }
}

/// Unknowns of an element by those of the shaft.
std::vector<assembly::Combination> ShapeResidual::own_motion(int span) const {
    const std::vector<int> unknowns = _discretization.beam_unknowns(span);
    const auto internal =
        static_cast<std::size_t>(elements::internal_unknowns(_discretization.order()));
    std::vector<assembly::Combination> out;
    for (int end = 0; end < 2; ++end) {
        out.push_back(_discretization.deflection_at_node(span + end));
        out.push_back(_discretization.slope_at_node(span + end));
    }
    for (std::size_t i = unknowns.size() - internal; i < unknowns.size(); ++i)
        out.push_back({{unknowns[i], 1.0}});
    return out;
}

/// Of w = x + i y, w(t) = w exp(rate t), or of x - i y with the speed reversed.
double ShapeResidual::energy(const Eigen::VectorXcd &plane, Complex rate, double speed) const {
    const Complex squared = rate * rate;
    const Complex coupling = -i_unit * rate * speed;
    Block Q2; // its factors
    Eigen::Matrix<Complex, Eigen::Dynamic, 1, 0, most_further, 1> r(_further);
    double sum = 0;
    for (std::size_t i = 0; i < _elements.size(); ++i) {
        const Element &e = _elements[i];
        if (!e.like_last) {
            Q2 = squared * e.M2 + coupling * e.G2 + e.K2;
            factorize(Q2);
        }
        for (int k = 0; k < _further; ++k) {
            const Eigen::Index row = static_cast<Eigen::Index>(i) * _further + k;
            r(k) = squared * product(_M, row, plane) + coupling * product(_G, row, plane) +
                   product(_K, row, plane);
        }
        sum += std::abs(inverse_form(Q2, r));
    }
    return sum;
}

double ShapeResidual::of(const modes::WhirlMode &mode, double speed) const {
    const double size = std::abs(mode.eigenvalue);
    if (_elements.empty() || size == 0)
        return 0;
    const auto kinetic = [&](const Eigen::VectorXcd &plane) {
        double sum = 0;
        for (Eigen::Index row = 0; row < plane.size(); ++row)
            sum += (std::conj(plane(row)) * product(_mass, row, plane)).real();
        return size * size * sum;
    };
    if (_form == results::Form::planar) {
        const bool positive = (mode.whirl == results::Whirl::forward) == (speed >= 0);
        const Complex rate = i_unit * (positive ? size : -size);
        return energy(mode.shape, rate, speed) / kinetic(mode.shape);
    }
    if (_form == results::Form::planar_damped)
        return energy(mode.shape, mode.rotating_value, speed) / kinetic(mode.shape);
    assembly::Planes planes(mode.shape.head(2 * _mass.rows())); // moving masses are none of them
    if (_form == results::Form::hyperbolic)                     // y stands for -i y
        planes.y *= i_unit;
    const Eigen::VectorXcd with = planes.towards();
    const Eigen::VectorXcd against = planes.against();
    return (energy(with, mode.eigenvalue, speed) + energy(against, mode.eigenvalue, -speed)) /
           (kinetic(with) + kinetic(against));
}

} // namespace whirl::mesh_error
