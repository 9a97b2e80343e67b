#include "mesh_error/shape_residual.h"

#include "assembly/planar_part.h"
#include "elements/beam.h"
#include "results/formulation.h"
#include "results/whirl.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace whirl::mesh_error {

namespace {

using linalg::Complex4;
using linalg::Real4;

/// The next function of either parity.
constexpr int further_orders = 2;

/// Further functions of an element of order 1, the most: 2 * (1 + further_orders) - 1.
constexpr int most_further = 5;
/// Of four modes.
struct Block {
    std::array<std::array<Complex4, most_further>, most_further> at;
    Complex4 &operator()(int row, int column) {
        return at[static_cast<std::size_t>(row)][static_cast<std::size_t>(column)];
    }
};
using Column = std::array<Complex4, most_further>;

Complex4 &entry(Column &x, int k) { return x[static_cast<std::size_t>(k)]; }

WHIRL_INLINED void add_times(double a, const Complex4 &b, Complex4 &sum) {
    sum.re += a * b.re;
    sum.im += a * b.im;
}

/// L D L^T of n rows of a symmetric matrix in place, 1 / D on the diagonal, L^T above it. Further
/// functions vanish at the nodes and are far stiffer than the modes: no pivot comes near zero.
WHIRL_INLINED void factorize(Block &A, int n) {
    for (int k = 0; k < n; ++k) {
        linalg::set_inverse(A(k, k), Complex4(A(k, k)));
        for (int j = k + 1; j < n; ++j) {
            Complex4 factor;
            linalg::set_product(factor, A(j, k), A(k, k));
            for (int i = j; i < n; ++i)
                linalg::subtract_product(A(i, j), A(i, k), factor);
            A(k, j) = factor;
        }
    }
}

/// r^H A^-1 r from these factors.
WHIRL_INLINED Complex4 inverse_form(Block &factors, const Column &r, int n) {
    Column x = r;
    for (int k = 0; k < n; ++k)
        for (int i = k + 1; i < n; ++i)
            linalg::subtract_product(entry(x, i), factors(k, i), entry(x, k));
    for (int k = n - 1; k >= 0; --k) {
        linalg::set_product(entry(x, k), Complex4(entry(x, k)), factors(k, k));
        for (int i = k + 1; i < n; ++i)
            linalg::subtract_product(entry(x, k), factors(k, i), entry(x, i));
    }
    Complex4 sum{};
    for (int k = 0; k < n; ++k) {
        const Complex4 &left = r[static_cast<std::size_t>(k)];
        linalg::add_product(sum, {left.re, -left.im}, entry(x, k));
    }
    return sum;
}

/// A row of a real matrix times four complex vectors.
WHIRL_INLINED Complex4 product(const Eigen::SparseMatrix<double, Eigen::RowMajor> &A,
                               Eigen::Index row, const linalg::Vector4 &x) {
    Complex4 sum{};
    const int *columns = A.innerIndexPtr();
    const double *values = A.valuePtr();
    const Complex4 *in = x.data();
    const int last = A.outerIndexPtr()[row + 1];
    for (int p = A.outerIndexPtr()[row]; p < last; ++p)
        add_times(values[p], in[columns[p]], sum);
    return sum;
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

std::vector<ShapeResidual::Plane> ShapeResidual::planes_of(const Four &modes) const {
    const bool planar = results::is_planar(_form);
    const auto n = static_cast<std::size_t>(_mass.rows());
    std::vector<Plane> planes(planar ? 1 : 2);
    for (Plane &plane : planes)
        plane.w.resize(n);
    for (int lane = 0; lane < linalg::lanes; ++lane) {
        const auto &[mode, speed] = modes[static_cast<std::size_t>(lane)];
        const std::complex<double> *shape = mode->shape.data();
        std::complex<double> rate = mode->eigenvalue;
        if (_form == results::Form::planar) {
            const bool positive = (mode->whirl == results::Whirl::forward) == (speed >= 0);
            rate = {0, positive ? std::abs(rate) : -std::abs(rate)};
        } else if (_form == results::Form::planar_damped)
            rate = mode->rotating_value;
        // Of w = x + i y; x - i y is as seen with the speed reversed. Moving masses are none of
        // them.
        planes.front().speed[lane] = speed;
        planes.back().speed[lane] = planar ? speed : -speed;
        for (Plane &plane : planes)
            plane.rate.set(lane, rate);
        for (std::size_t k = 0; k < n && planar; ++k)
            planes.front().w[k].set(lane, shape[k]);
        const bool turned = _form == results::Form::hyperbolic; // y stands for -i y
        for (std::size_t k = 0; k < n && !planar; ++k) {
            const std::complex<double> y = shape[2 * k + 1];
            const std::complex<double> i_y =
                turned ? -y : std::complex<double>(-y.imag(), y.real());
            planes.front().w[k].set(lane, shape[2 * k] + i_y);
            planes.back().w[k].set(lane, shape[2 * k] - i_y);
        }
    }
    return planes;
}

void ShapeResidual::add_energies(const Plane &plane, Real4 &residual, Real4 &kinetic) const {
    linalg::in_lanes([&]() __attribute__((always_inline)) {
        Complex4 squared;
        linalg::set_product(squared, plane.rate, plane.rate);
        const Complex4 coupling{plane.rate.im * plane.speed, -plane.rate.re * plane.speed};
        Block Q2; // its factors
        Column r;
        for (std::size_t i = 0; i < _elements.size(); ++i) {
            const Element &e = _elements[i];
            if (!e.like_last) {
                for (int row = 0; row < _further; ++row)
                    for (int column = 0; column < _further; ++column) {
                        Complex4 &Q = Q2(row, column);
                        Q = {Real4{} + e.K2(row, column), Real4{}};
                        add_times(e.M2(row, column), squared, Q);
                        add_times(e.G2(row, column), coupling, Q);
                    }
                factorize(Q2, _further);
            }
            for (int k = 0; k < _further; ++k) {
                const Eigen::Index row = static_cast<Eigen::Index>(i) * _further + k;
                Complex4 &sum = entry(r, k);
                sum = product(_K, row, plane.w);
                linalg::add_product(sum, squared, product(_M, row, plane.w));
                linalg::add_product(sum, coupling, product(_G, row, plane.w));
            }
            const Complex4 form = inverse_form(Q2, r, _further);
            const Real4 square = form.re * form.re + form.im * form.im;
            for (int lane = 0; lane < linalg::lanes; ++lane)
                residual[lane] += std::sqrt(square[lane]);
        }
        const Real4 size = plane.rate.re * plane.rate.re + plane.rate.im * plane.rate.im;
        for (std::size_t k = 0; k < plane.w.size(); ++k) {
            const Complex4 momentum = product(_mass, static_cast<Eigen::Index>(k), plane.w);
            kinetic += size * (plane.w[k].re * momentum.re + plane.w[k].im * momentum.im);
        }
    });
}

std::vector<double> ShapeResidual::of(const std::vector<At> &modes) const {
    std::vector<double> out(modes.size());
    if (_elements.empty())
        return out;
    for (std::size_t first = 0; first < modes.size(); first += linalg::lanes) {
        Four four;
        for (std::size_t lane = 0; lane < linalg::lanes; ++lane)
            four[lane] = modes[std::min(first + lane, modes.size() - 1)];
        Real4 residual{};
        Real4 kinetic{};
        for (const Plane &plane : planes_of(four))
            add_energies(plane, residual, kinetic);
        for (std::size_t lane = 0; lane < linalg::lanes && first + lane < modes.size(); ++lane)
            if (four[lane].mode->eigenvalue != 0.0)
                out[first + lane] =
                    residual[static_cast<int>(lane)] / kinetic[static_cast<int>(lane)];
    }
    return out;
}

} // namespace whirl::mesh_error
