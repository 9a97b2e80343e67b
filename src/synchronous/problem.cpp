#include "synchronous/problem.h"

#include "assembly/assemble.h"
#include "assembly/planes.h"
#include "assembly/rotating_system.h"
#include "assembly/system.h"
#include "synchronous/parts.h"

#include <algorithm>
#include <functional>
#include <utility>

namespace whirl::synchronous {

namespace {

using assembly::Discretization;
using assembly::i_unit;
using Complex = std::complex<double>;
using QSparse = ComplexQuadratic::Sparse;
using Real = Eigen::SparseMatrix<double>;
using linalg::Matrix;

QSparse complex(const Matrix &A) { return Real(A.view()).cast<Complex>(); }

QSparse nothing(Eigen::Index n) { return {n, n}; }

ComplexQuadratic problem_at(const Discretization &d, results::Form form, int spin, int whirl_sign,
                            double bearing_speed) {
    const Complex turn = static_cast<double>(spin) * i_unit;
    if (form == results::Form::planar) {
        const assembly::PlanarSystem system = assembly::assemble_planar(d, bearing_speed);
        return {complex(Matrix::sum(1, system.M, -whirl_sign, system.G)), nothing(d.planar_size()),
                complex(system.K)};
    }
    if (form == results::Form::rotating) {
        const assembly::RotatingSystem system = held_in_rotating_axes(d, bearing_speed);
        return {-complex(system.Kss), -turn * complex(system.Ks), complex(system.K)};
    }
    const assembly::FixedSystem system = assembly::assemble_fixed(d, bearing_speed);
    if (form == results::Form::hyperbolic)
        return {complex(Matrix::sum(1, system.M, 1, assembly::hyperbolic_coupling(d))),
                nothing(2 * d.planar_size()), complex(system.K)};
    return {complex(system.M) - turn * complex(system.G),
            complex(system.C) - turn * complex(system.Kc), complex(system.K)};
}

/// Seen by a spin of that sign.
/// @param speeds  ascending
std::vector<double> turned(std::vector<double> speeds, int spin) {
    if (spin > 0)
        return speeds;
    std::ranges::reverse(speeds);
    std::ranges::transform(speeds, speeds.begin(), std::negate{});
    return speeds;
}

bool hermitian(const QSparse &A) {
    constexpr double rounding = 1e-14; // of the largest entry
    const QSparse difference = A - QSparse(A.adjoint());
    return difference.norm() <= rounding * A.norm();
}

} // namespace

SynchronousProblem::SynchronousProblem(const Discretization &rotor, results::Form form, int spin,
                                       int whirl_sign, std::optional<double> bearing_speed)
    : _d(rotor), _spin(spin),
      _rows(
          turned(bearing_speed ? std::vector{*bearing_speed} : table_speeds(rotor.rotor()), spin)),
      _bends(turned(rotor.rotor().table_bends(), spin)), _pairs(form != results::Form::planar) {
    if (_rows.empty())
        _rows = {0};
    const auto at = [&](double row) {
        return problem_at(rotor, form, spin, whirl_sign, spin * row);
    };
    _first = at(_rows.front());
    const Eigen::Index n = _first.K.rows();
    _changes.assign(_rows.size(), {nothing(n), nothing(n), nothing(n)});
    if (form == results::Form::rotating) { // in which damping turns with the rotor
        for (std::size_t i = 1; i < _rows.size(); ++i) {
            const ComplexQuadratic here = at(_rows[i]);
            _changes[i].D = here.D - _first.D;
            _changes[i].K = here.K - _first.K;
        }
    } else {
        add_bearing_changes(form);
    }
    _conservative = _first.D.norm() == 0 && hermitian(_first.M) && hermitian(_first.K);
    for (const ComplexQuadratic &change : _changes)
        _conservative = _conservative && change.D.norm() == 0 && hermitian(change.K);
}

/// Nothing but the bearings changes with their tables.
void SynchronousProblem::add_bearing_changes(results::Form form) {
    using Entries = std::vector<Eigen::Triplet<Complex>>;
    const bool planar = form == results::Form::planar;
    const bool damped = form == results::Form::general;
    const auto add = [&](double speed, double sign, Entries &D, Entries &K) {
        assembly::assemble_bearings(
            _d, speed, [&](assembly::Term term, int i, int j, const Eigen::Matrix2d &block) {
                const bool stiffness = term == assembly::Term::stiffness;
                if (!stiffness && !(damped && term == assembly::Term::damping))
                    return;
                Entries &to = stiffness ? K : D;
                if (planar) {
                    to.emplace_back(i, j, sign * block.trace() / 2);
                    return;
                }
                for (int a = 0; a < 2; ++a)
                    for (int b = 0; b < 2; ++b)
                        if (block(a, b) != 0)
                            to.emplace_back(2 * i + a, 2 * j + b, sign * block(a, b));
            });
    };
    for (std::size_t row = 1; row < _rows.size(); ++row) {
        Entries D;
        Entries K;
        add(_spin * _rows.front(), -1, D, K);
        add(_spin * _rows[row], 1, D, K);
        _changes[row].D.setFromTriplets(D.begin(), D.end());
        _changes[row].K.setFromTriplets(K.begin(), K.end());
    }
}

ComplexQuadratic SynchronousProblem::at_row(std::size_t row) const {
    return {_first.M, _first.D + _changes[row].D, _first.K + _changes[row].K};
}

} // namespace whirl::synchronous
