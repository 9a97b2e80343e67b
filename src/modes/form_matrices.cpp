#include "modes/form_matrices.h"

#include "assembly/rotating_system.h"
#include "assembly/system.h"
#include "results/formulation.h"

#include <algorithm>
#include <cmath>
#include <complex>

namespace whirl::modes {

namespace {

using Sparse = Eigen::SparseMatrix<double>;
using Entries = std::vector<Eigen::Triplet<double>>;

bool mirror_is_transpose(const Sparse &A) {
    Sparse mirrored = A.transpose();
    for (Eigen::Index column = 0; column < mirrored.outerSize(); ++column)
        for (Sparse::InnerIterator entry(mirrored, column); entry; ++entry)
            if ((entry.row() + entry.col()) % 2 != 0)
                entry.valueRef() = -entry.value();
    return (mirrored - A).norm() <= 1e-14 * A.norm();
}

/// A + f B, many of which are empty.
Sparse sum(const Sparse &A, double f, const Sparse &B) {
    if (B.nonZeros() == 0)
        return A;
    if (A.nonZeros() == 0)
        return f * B;
    return A + f * B;
}

bool mirrored_bearings(const model::Rotor &rotor) {
    const auto mirrored = [](const Eigen::Matrix2d &k) { return k(0, 1) == -k(1, 0); };
    return std::all_of(rotor.bearings.begin(), rotor.bearings.end(), [&](const auto &bearing) {
        return std::all_of(bearing.rows.begin(), bearing.rows.end(), [&](const auto &row) {
            return mirrored(row.k) && mirrored(row.c) && mirrored(row.m) && mirrored(row.kt) &&
                   mirrored(row.ct);
        });
    });
}

/// Block on (x, y) in a form's unknowns; in rotating axes the part that is the same from every
/// direction, `turned` by i.
void put(Entries &entries, results::Form form, int i, int j, const Eigen::Matrix2d &block,
         bool turned = false) {
    if (results::is_planar(form)) {
        entries.emplace_back(i, j, block(0, 0));
        return;
    }
    Eigen::Matrix2d in_form = block;
    if (results::in_rotating_axes(form)) {
        const double a = block.trace() / 2;
        const double b = (block(1, 0) - block(0, 1)) / 2;
        if (turned)
            in_form << -b, -a, a, -b;
        else
            in_form << a, -b, b, a;
    }
    for (int p = 0; p < 2; ++p)
        for (int q = 0; q < 2; ++q)
            if (in_form(p, q) != 0)
                entries.emplace_back(2 * i + p, 2 * j + q, in_form(p, q));
}

/// The nearest speeds of table rows below and above, infinite beyond the tables.
std::pair<double, double> neighbours(const model::Rotor &rotor, double speed) {
    double below = -INFINITY;
    double above = INFINITY;
    for (const model::Bearing &bearing : rotor.bearings)
        for (const double row : bearing.speeds) {
            if (row < speed)
                below = std::max(below, row);
            if (row > speed)
                above = std::min(above, row);
        }
    return {below, above};
}

} // namespace

FormMatrices::FormMatrices(const assembly::Discretization &d, results::Form form,
                           const std::vector<balancers::BalancerElement> &balancers)
    : _discretization(d), _form(form) {
    if (results::in_rotating_axes(form)) {
        set_rotating(assembly::assemble_rotating(d, 0, balancers));
        return;
    }
    if (form == results::Form::general) {
        set_general(assembly::assemble_fixed(d, 0));
        return;
    }
    if (form == results::Form::planar_damped) {
        set_damped_planar();
        return;
    }
    if (form == results::Form::planar) {
        const assembly::PlanarSystem system = assembly::assemble_planar(d, 0);
        _M = -system.M.view();
        _Ds = system.G.view();
        _K = system.K.view();
    } else {
        const assembly::FixedSystem system = assembly::assemble_fixed(d, 0);
        _M = -system.M.view();
        _Ds = -assembly::hyperbolic_coupling(d).view();
        _K = system.K.view();
    }
    for (Sparse *none : {&_D, &_Ks, &_Kss})
        none->resize(_M.rows(), _M.cols());
}

FormMatrices::FormMatrices(const assembly::Discretization &d, const assembly::FixedSystem &system)
    : _discretization(d), _form(results::Form::general) {
    set_general(system);
}

FormMatrices::FormMatrices(const assembly::Discretization &d,
                           const assembly::RotatingSystem &system)
    : _discretization(d), _form(results::Form::rotating) {
    set_rotating(system);
}

void FormMatrices::set_rotating(const assembly::RotatingSystem &system) {
    _M = system.M.view();
    _D = system.C.view();
    _Ds = system.Cs.view();
    _K = system.K.view();
    _Ks = system.Ks.view();
    _Kss = system.Kss.view();
    for (const Sparse *A : {&_M, &_D, &_Ds, &_K, &_Ks, &_Kss})
        _mirrored = _mirrored && mirror_is_transpose(*A);
}

void FormMatrices::set_general(const assembly::FixedSystem &system) {
    const model::Rotor &rotor = _discretization.rotor();
    _M = system.M.view();
    _D = system.C.view();
    _Ds = system.G.view();
    _K = system.K.view();
    _Ks = system.Kc.view();
    _Kss.resize(_M.rows(), _M.cols());
    _mirrored = mirrored_bearings(rotor) && rotor.shaft.axial_torque == 0;
}

void FormMatrices::set_damped_planar() {
    const assembly::DampedPlanarSystem system =
        assembly::assemble_damped_planar(_discretization, 0);
    _M = system.M.view();
    _D = system.C.view();
    _iD = system.Cx.view();
    _iDs = -system.G.view();
    _K = system.K.view();
    _iK = system.Kx.view();
    _iKs = -system.Kc.view();
    for (Sparse *none : {&_Ds, &_Ks, &_Kss})
        none->resize(_M.rows(), _M.cols());
}

FormMatrices::Supports FormMatrices::support_change(double from, double to, Part part) const {
    Entries D;
    Entries K;
    Entries Ks;
    for (const auto &[speed, sign] : {std::pair(from, -1.0), std::pair(to, 1.0)})
        assembly::assemble_bearings( // nothing else changes with speed
            _discretization, speed,
            [&, s = sign](assembly::Term term, int i, int j, Eigen::Matrix2d block) {
                if (part == Part::imaginary) // [a b; -b a] is a - i b
                    block = -block(0, 1) * Eigen::Matrix2d::Identity();
                if (term == assembly::Term::stiffness)
                    put(K, _form, i, j, s * block);
                if (term != assembly::Term::damping)
                    return;
                put(D, _form, i, j, s * block);
                if (results::in_rotating_axes(_form))
                    put(Ks, _form, i, j, s * block, true);
            });
    Supports out;
    for (auto &[matrix, entries] :
         {std::pair(&out.D, &D), std::pair(&out.K, &K), std::pair(&out.Ks, &Ks)}) {
        matrix->resize(size(), size());
        matrix->setFromTriplets(entries->begin(), entries->end());
    }
    return out;
}

FormMatrices::SupportRates FormMatrices::support_rates(double speed, Part part) const {
    const auto rate_to = [&](double end) -> std::optional<Supports> {
        if (!std::isfinite(end))
            return std::nullopt;
        Supports out = support_change(speed, end, part);
        for (Sparse *A : {&out.D, &out.K, &out.Ks})
            *A /= end - speed;
        return out;
    };
    const auto [below, above] = neighbours(_discretization.rotor(), speed);
    return {rate_to(below), rate_to(above)};
}

void FormMatrices::add_tables(QuadraticAt &problem, double speed, Part part) const {
    const Supports now = support_change(0, speed, part);
    problem.smooth = false;
    problem.D = sum(problem.D, 1, now.D);
    problem.K = sum(problem.K, 1, sum(now.K, speed, now.Ks));
    const SupportRates change = support_rates(speed, part);
    for (const auto &[rates, of] :
         {std::pair(&problem.below, &change.below), std::pair(&problem.above, &change.above)}) {
        rates->K = sum(rates->K, 1, now.Ks);
        if (!*of)
            continue;
        rates->D = sum(rates->D, 1, (*of)->D);
        rates->K = sum(rates->K, 1, sum((*of)->K, speed, (*of)->Ks));
    }
}

QuadraticAt FormMatrices::at(double speed) const {
    QuadraticAt out;
    out.M = _M;
    out.D = sum(_D, speed, _Ds);
    out.K = sum(sum(_K, speed, _Ks), speed * speed, _Kss);
    out.below = {_Ds, sum(_Ks, 2 * speed, _Kss)};
    out.above = out.below;
    if (_discretization.rotor().bearings_depend_on_speed())
        add_tables(out, speed, Part::real);
    return out;
}

ComplexQuadraticAt FormMatrices::complex_at(double speed) const {
    const QuadraticAt re = at(speed);
    QuadraticAt im;
    im.D = _iD + speed * _iDs;
    im.K = _iK + speed * _iKs;
    im.below = {_iDs, _iKs};
    im.above = im.below;
    if (_discretization.rotor().bearings_depend_on_speed())
        add_tables(im, speed, Part::imaginary);
    const auto joined = [](const Sparse &a, const Sparse &b) {
        using Complex = std::complex<double>;
        return ComplexQuadraticAt::Sparse(a.cast<Complex>() + Complex(0, 1) * b.cast<Complex>());
    };
    return {re.M.cast<std::complex<double>>(),
            joined(re.D, im.D),
            joined(re.K, im.K),
            {joined(re.below.D, im.below.D), joined(re.below.K, im.below.K)},
            {joined(re.above.D, im.above.D), joined(re.above.K, im.above.K)},
            re.smooth};
}

} // namespace whirl::modes
