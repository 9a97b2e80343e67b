#include "criterion/first_order.h"

#include "assembly/planes.h"
#include "assembly/system.h"
#include "balancers/balanced_position.h"
#include "criterion/bands.h"
#include "criterion/rotor.h"
#include "linalg/check.h"
#include "linalg/dense/general_eigen.h"
#include "linalg/dense/products.h"
#include "linalg/roots.h"
#include "mesh_error/safety.h"

#include <Eigen/LU>
#include <Eigen/SVD>

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <utility>

namespace whirl::criterion {

namespace {

using Complex = std::complex<double>;
using Eigen::Index;

/// All balancers: their small motions (balancers/kind.h) in real unknowns x, y = basis x, of parts
/// on one diameter across it alone.
struct Parts {
    Eigen::MatrixXcd basis;
    Eigen::MatrixXcd pull, conjugate; ///< a column each balancer, kg
    Eigen::MatrixXd inertia, damping; ///< of x, kg and kg/s
};

Parts parts_of(const std::vector<balancers::BalancerElement> &balancers) {
    const Index size = balancers::unknowns_of(balancers);
    const auto count = static_cast<Index>(balancers.size());
    Parts out;
    out.pull = out.conjugate = Eigen::MatrixXcd::Zero(size, count);
    out.basis = Eigen::MatrixXcd::Zero(size, 2 * size);
    Eigen::MatrixXcd inertia = Eigen::MatrixXcd::Zero(size, size);
    Eigen::MatrixXcd damping = inertia;
    Index row = 0;
    Index column = 0;
    for (Index k = 0; k < count; ++k) {
        const balancers::SmallMotions &of = balancers[static_cast<std::size_t>(k)].parts;
        const Index n = of.pull.size();
        out.pull.col(k).segment(row, n) = of.pull.cast<Complex>();
        out.conjugate.col(k).segment(row, n) = of.conjugate;
        inertia.block(row, row, n, n) = of.inertia.cast<Complex>();
        damping.block(row, row, n, n) = of.damping.cast<Complex>();
        std::vector<Complex> directions{1, assembly::i_unit};
        if (of.diameter) // y = -D conj(y)
            directions = {assembly::i_unit * std::sqrt(*of.diameter)};
        for (Index j = 0; j < n; ++j)
            for (const Complex direction : directions)
                out.basis(row + j, column++) = direction;
        row += n;
    }
    out.basis.conservativeResize(size, column);
    out.inertia = (out.basis.adjoint() * inertia * out.basis).real();
    out.damping = (out.basis.adjoint() * damping * out.basis).real();
    return out;
}

/// What a = -B pull^T y does in the equations of x: 1/2 (pull a - conjugate conj(a)).
Eigen::MatrixXd driven(const Parts &parts, const Eigen::MatrixXcd &B) {
    const Eigen::MatrixXcd a = -B * parts.pull.transpose() * parts.basis;
    return (parts.basis.adjoint() * (parts.pull * a - parts.conjugate * a.conjugate())).real() / 2;
}

/// The matrix of all sums of two different eigenvalues of A (bialternate product 2 A . I).
Eigen::MatrixXd sums_of_roots(const Eigen::MatrixXd &A) {
    const Index n = A.rows();
    Eigen::MatrixXd out = Eigen::MatrixXd::Zero(n * (n - 1) / 2, n * (n - 1) / 2);
    const auto same = [](Index i, Index j) { return i == j ? 1.0 : 0.0; };
    Index row = 0;
    for (Index p = 1; p < n; ++p)
        for (Index q = 0; q < p; ++q, ++row) {
            Index column = 0;
            for (Index r = 1; r < n; ++r)
                for (Index s = 0; s < r; ++s, ++column)
                    out(row, column) = A(p, r) * same(q, s) - A(p, s) * same(q, r) -
                                       A(q, r) * same(p, s) + A(q, s) * same(p, r);
        }
    return out;
}

double largest_real_part(const Eigen::VectorXcd &roots) { return roots.real().maxCoeff(); }

/// How far rounding moves an eigenvalue of A that is zero, 1/s.
double noise(const Eigen::MatrixXd &A) {
    return 4 * std::numeric_limits<double>::epsilon() * A.norm();
}

bool dies_out(const Eigen::MatrixXd &A) {
    return largest_real_part(linalg::general_eigenvalues(A)) < -noise(A);
}

} // namespace

SlowMotions::SlowMotions(model::Rotor rotor, PlacesOverSpeed places, int order)
    : _rotor(std::move(rotor)), _places(std::move(places)) {
    model::Rotor held = _rotor;
    held.balancers.clear();
    // Mass and mean inertia are the same wherever the parts stand.
    for (const model::Balancer &balancer : _rotor.balancers) {
        const double polar = balancers::added_inertias(balancer).polar();
        held.discs.push_back(
            {"", balancer.z, balancers::mass_of(balancer), polar / 2, polar, 0, 0});
    }
    _mesh = std::make_unique<assembly::Discretization>(held, order);
    const std::vector<assembly::Combination> planes = deflections_at(*_mesh, _rotor.balancers);
    const Eigen::MatrixXcd w =
        assembly::unit_loads(planes, _mesh->planar_size()).cast<std::complex<double>>();
    _forward = std::sqrt(0.5) * assembly::in_pairs(w, -assembly::i_unit * w);
    set_bearings(0);
}

void SlowMotions::set_bearings(double speed) {
    _terms = assembly::assemble_fixed(*_mesh, speed);
    _solver.emplace(_terms, true);
}

// Z = K + W Kc + s (C + W G) + s^2 M, H = F^H Z^-1 F, H' = -F^H Z^-1 Z' Z^-1 F.
SlowMotions::Accelerations SlowMotions::accelerations(double speed) {
    if (_rotor.bearings_depend_on_speed())
        set_bearings(speed);
    const Complex s(0, speed);
    const Eigen::MatrixXcd q = _solver->solve(speed, _forward);
    Accelerations out;
    const auto times = [&q](const linalg::Matrix &A) {
        const Eigen::SparseMatrix<Complex> of = A.view().cast<Complex>();
        return Eigen::MatrixXcd(of * q);
    };
    const Eigen::MatrixXcd change =
        2.0 * s * times(_terms.M) + times(_terms.C) + speed * times(_terms.G);
    const Eigen::MatrixXcd H = linalg::adjoint_times(_forward, q);
    const Eigen::MatrixXcd rate = -linalg::adjoint_times(_forward, _solver->solve(speed, change));
    const Complex cubed = s * s * s;
    out.B = s * cubed * H;
    out.rate = 4.0 * cubed * H + s * cubed * rate;
    return out;
}

const std::optional<SlowMotions::Equations> &SlowMotions::at(double speed) {
    if (_speed == speed)
        return _equations;
    _speed.reset();
    _equations.reset();
    const auto places = _places(speed);
    if (places) {
        const Parts parts = parts_of(balancers::balancer_elements(_rotor, *places));
        const Accelerations a = accelerations(speed);
        const Eigen::PartialPivLU<Eigen::MatrixXd> inertia(parts.inertia);
        // Where a displacement changes nothing only its rate matters: differences of masses in one
        // plane, or of several planes that make no force together.
        constexpr double nothing = 1e-11; // of the largest: the rounding of B
        const Eigen::JacobiSVD<Eigen::MatrixXd> restoring(
            inertia.solve(driven(parts, a.B)), Eigen::ComputeThinU | Eigen::ComputeThinV);
        const Eigen::VectorXd &sizes = restoring.singularValues();
        const Index held = (sizes.array() > nothing * sizes(0)).count();
        const Index n = sizes.size();
        const double rate = std::sqrt(sizes(0));
        Equations out;
        out.rest = Eigen::MatrixXd::Zero(held + n, held + n);
        out.of_drag = out.rest;
        out.rest.topRightCorner(held, n) = rate * restoring.matrixV().leftCols(held).transpose();
        out.rest.bottomLeftCorner(n, held) =
            -restoring.matrixU().leftCols(held) * (sizes.head(held) / rate).asDiagonal();
        out.rest.bottomRightCorner(n, n) = -inertia.solve(driven(parts, a.rate));
        out.of_drag.bottomRightCorner(n, n) = -inertia.solve(parts.damping);
        _equations = std::move(out);
    }
    _speed = speed;
    return _equations;
}

Eigen::VectorXcd SlowMotions::roots(double speed, double drag) {
    const auto &of = at(speed);
    return of ? linalg::general_eigenvalues(of->rest + drag * of->of_drag) : Eigen::VectorXcd();
}

double SlowMotions::growth(double speed) {
    const auto &of = at(speed);
    if (!of)
        return std::abs(speed);
    return largest_real_part(roots(speed)) + noise(of->rest + of->of_drag);
}

double SlowMotions::rounding(double speed) {
    const auto &of = at(speed);
    if (!of)
        return 0;
    const Eigen::MatrixXcd q = _solver->solve(speed, _forward);
    double relative = 0;
    for (Index j = 0; j < q.cols(); ++j)
        relative = std::max(relative, _solver->rounding(_forward.col(j), q.col(j)));
    return relative * of->rest.norm() + noise(of->rest + of->of_drag);
}

std::optional<double> SlowMotions::least_drag(double speed) {
    const auto &of = at(speed);
    const double unit = of ? of->of_drag.norm() : 0;
    if (unit == 0)
        return std::nullopt;
    // Two roots add up to zero, as i w and -i w do, at eigenvalues of these matrices alone: R + d
    // D. Looked at from a negative drag, about as large as the rest; without any, masses that
    // nothing but drag holds make R singular.
    const double natural = of->rest.norm() / unit;
    const double from = -0.7391 * natural; // no number that people choose
    const Eigen::MatrixXd D = sums_of_roots(of->of_drag);
    const Eigen::MatrixXd at_first = sums_of_roots(of->rest + from * of->of_drag);
    const Eigen::VectorXcd inverse = linalg::general_eigenvalues(-at_first.partialPivLu().solve(D));
    // Two equal eigenvalues part by the root of rounding (of R: `nothing` in at()). No drag at all
    // is such a pair where nothing but drag holds a mass.
    constexpr double parted = 1e-6;
    const double as_good_as_none = parted * natural;
    // Beyond, the slowest of the roots is lost in the rounding of the fastest.
    const double most_looked_at = 1e5 * natural;
    std::vector<double> borders;
    for (const Complex value : inverse) {
        const Complex drag = from + 1.0 / value;
        if (drag.real() > as_good_as_none && drag.real() < most_looked_at &&
            std::abs(drag.imag()) <= parted * std::abs(drag))
            borders.push_back(drag.real());
    }
    borders.push_back(0);
    std::ranges::sort(borders, std::greater());
    double above = 4 * std::max(borders.front(), natural);
    std::optional<double> least;
    for (const double border : borders) {
        if (!dies_out(of->rest + (border + above) / 2 * of->of_drag))
            break;
        least = above = border;
    }
    return least;
}

namespace {

struct Sample {
    double speed, value;
};

/// Where a function changes its sign between two speeds: halved until it is next to straight
/// against its size.
void changes_between(const SpeedFunction &of, Sample a, Sample b, std::vector<double> &out) {
    constexpr double narrow = 1e-7; // of the speed: bands narrower than this are not looked for
    const bool change = (a.value < 0) != (b.value < 0);
    const Sample middle{(a.speed + b.speed) / 2, of((a.speed + b.speed) / 2)};
    const double bend = std::abs(middle.value - (a.value + b.value) / 2);
    const double least = std::min({std::abs(a.value), std::abs(middle.value), std::abs(b.value)});
    const bool straight = change ? bend <= std::abs(b.value - a.value) / 4
                                 : bend <= least / 2 && (middle.value < 0) == (a.value < 0);
    if (straight || b.speed - a.speed < narrow * b.speed) {
        if (change)
            out.push_back(linalg::root_between(of, a.speed, a.value, b.speed, b.value));
        return;
    }
    changes_between(of, a, middle, out);
    changes_between(of, middle, b, out);
}

std::vector<results::Interval> stable_bands(const SpeedFunction &growth,
                                            const std::vector<double> &seeds) {
    std::vector<double> changes;
    Sample before{seeds.front(), growth(seeds.front())};
    for (std::size_t i = 1; i < seeds.size(); ++i) {
        const Sample next{seeds[i], growth(seeds[i])};
        changes_between(growth, before, next, changes);
        before = next;
    }
    return bands_between_changes(growth, changes, seeds.front(), seeds.back());
}

} // namespace

results::FirstOrder first_order(const model::Rotor &rotor, const PlacesOverSpeed &places, int order,
                                std::vector<double> seeds, const std::vector<double> &speeds,
                                std::vector<results::Sentence> &notes) {
    SlowMotions motions(rotor, places, order);
    SlowMotions finer(rotor, places, mesh_error::finer_order(order));
    const SpeedFunction growth = [&](double speed) { return motions.growth(speed); };
    const SpeedFunction fine = [&](double speed) { return finer.growth(speed); };
    std::ranges::sort(seeds);
    seeds.erase(std::unique(seeds.begin(), seeds.end()), seeds.end());
    results::FirstOrder out;
    out.bands = stable_bands(growth, seeds);
    out.errors =
        end_errors("first order in the balancers' mass", out.bands, {seeds.front(), seeds.back()},
                   {growth, [&](double speed) { return motions.rounding(speed); }},
                   rotor.shaft.rigid ? nullptr : &fine, notes);
    for (const double speed : speeds)
        out.least_drag.push_back(speed > 0 ? motions.least_drag(speed) : std::nullopt);
    return out;
}

} // namespace whirl::criterion
