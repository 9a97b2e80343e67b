#include "stability/rotor_at_speeds.h"

#include "assembly/rotating_system.h"
#include "assembly/system.h"
#include "linalg/check.h"
#include "linalg/quadratic/quadratic_eigen.h"
#include "linalg/sparse_factor.h"
#include "linalg/sparse_sum.h"
#include "linalg/symmetric_eigen.h"
#include "mesh_error/estimate.h"
#include "model/errors.h"
#include "modes/formulation.h"
#include "modes/roots/whole_pencil.h"
#include "modes/stiffness_sign.h"
#include "modes/zero_modes.h"
#include "reduction/projection.h"
#include "results/formulation.h"
#include "stability/hill/hill_solver.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

namespace whirl::stability {

namespace {

/// det[K + W Ks + W^2 Kss] = 0.
struct ZeroRootSystem {
    Eigen::SparseMatrix<double> K, Ks, Kss;
};

/// What holds parts on their way across a diameter, put into the terms with speed^2, the only ones
/// that their rows have besides.
/// @param first  unknown of the first balancer
void hold_by_speed(const std::vector<balancers::BalancerElement> &balancers, int first,
                   ZeroRootSystem &system) {
    for (const balancers::BalancerElement &balancer : balancers) {
        const int size = 2 * balancer.unknowns();
        if (balancer.parts.diameter)
            for (int column = first; column < first + size; ++column)
                for (int row = first; row < first + size; ++row)
                    if (const double held = system.K.coeff(row, column); held != 0) {
                        system.Kss.coeffRef(row, column) += held;
                        system.K.coeffRef(row, column) = 0;
                    }
        first += size;
    }
}

/// Rows of balancers have speed^2 as a factor, but for those with a drift: without it they have no
/// root at zero.
ZeroRootSystem zero_root_system(const assembly::Discretization &discretization,
                                const balancers::Arrangement &arrangement, bool frozen) {
    const auto balancers = balancers::balancer_elements(discretization.rotor(), arrangement);
    const assembly::RotatingSystem system =
        assembly::assemble_rotating(discretization, 0, balancers, frozen);
    ZeroRootSystem out{system.K.view(), system.Ks.view(), system.Kss.view()};
    if (!frozen)
        hold_by_speed(balancers, 2 * discretization.planar_size(), out);
    Eigen::VectorXd alone = Eigen::VectorXd::Zero(out.K.rows()); // rows with Kss alone
    alone.tail(out.K.rows() - 2 * discretization.planar_size()).setOnes();
    for (Eigen::Index column = 0; column < out.K.outerSize(); ++column)
        for (Eigen::SparseMatrix<double>::InnerIterator entry(out.K, column); entry; ++entry)
            if (entry.value() != 0)
                alone(entry.row()) = 0;
    out.K += Eigen::SparseMatrix<double>(alone.asDiagonal() * out.Kss);
    out.Kss = (Eigen::VectorXd::Ones(out.K.rows()) - alone).asDiagonal() * out.Kss;
    return out;
}

/// Part of the largest speed below which a root is one at zero that rounding blurs (of several
/// balls it is a multiple one).
constexpr double at_rest = 1e-6;

/// Below this part of the largest speed a root at zero, blurred, may still look like one.
constexpr double suspicious = 1e-3;

/// Size of the inverse at a speed, by inverse iteration from a vector without zeros.
double inverse_size(const ZeroRootSystem &system, double speed) {
    Eigen::SparseMatrix<double> A =
        linalg::sum(1, system.K, speed, system.Ks, speed * speed, system.Kss);
    A.makeCompressed();
    linalg::SparseFactor<double> lu;
    if (!lu.factorize(A))
        return HUGE_VAL;
    Eigen::VectorXd x = linalg::deterministic_vector(static_cast<int>(A.rows())).normalized();
    double size = 0;
    // Steps of inverse iteration from any vector: the order of size is asked for.
    constexpr int enough = 4;
    for (int k = 0; k < enough; ++k) {
        lu.solve(x);
        size = x.norm();
        x /= size;
    }
    return size;
}

/// At a root the matrix is all but singular and beside it it is not; a root at zero that rounding
/// blurs leaves no trace at another speed.
bool is_at_rest(const ZeroRootSystem &system, double speed, double top) {
    if (speed >= suspicious * top)
        return false;
    const double there = inverse_size(system, speed);
    const bool leaves_a_trace = there > 10 * inverse_size(system, 0.75 * speed) &&
                                there > 10 * inverse_size(system, 1.3 * speed);
    return !leaves_a_trace;
}

/// A root at zero of several balls comes blurred: of nothing it has a digit right.
bool is_known(const linalg::ComplexPair &pair) { return 100 * pair.rounding + pair.residual < 0.1; }

/// 0 < Re W <= top and |Im W| < Re W.
/// @param beyond  how far beyond the top, as a factor
bool is_asked_for(const linalg::ComplexPair &pair, double top, double beyond = 1) {
    const double speed = pair.value.real();
    return is_known(pair) && speed > at_rest * top && speed <= beyond * top &&
           std::abs(pair.value.imag()) < speed;
}

/// Those that are asked for, ascending, equal ones once.
std::vector<ZeroRootSpeed> zero_roots(const ZeroRootSystem &system,
                                      const std::vector<linalg::ComplexPair> &pairs, double top) {
    std::vector<ZeroRootSpeed> out;
    for (const linalg::ComplexPair &pair : pairs) {
        const double speed = pair.value.real();
        if (is_asked_for(pair, top))
            out.push_back({speed, std::abs(pair.value.imag()) <= 1e-7 * speed});
    }
    std::erase_if(out, [&](const auto &root) { return is_at_rest(system, root.speed, top); });
    std::ranges::sort(out, {}, &ZeroRootSpeed::speed);
    const auto same = [](const auto &a, const auto &b) {
        return b.speed - a.speed <= 1e-7 * b.speed;
    };
    out.erase(std::unique(out.begin(), out.end(), same), out.end());
    return out;
}

/// All W next to the range, of the whole system.
/// @throws linalg::SolverError where they are not resolved among the others
std::vector<linalg::ComplexPair> pairs_up_to(const ZeroRootSystem &system, double top) {
    linalg::QuadraticOptions options;
    options.fewest = 1;
    options.negligible = suspicious * top; // blurred: judged by themselves
    constexpr int small = 150; // unknowns up to which all roots are found densely without trying
    const auto all = static_cast<int>(system.K.rows());
    const int most = all <= small ? 0 : all / 5; // small: all finite roots, there may be few
    options.method = linalg::QuadraticMethod::toar;
    options.shift = 0.41 * top;
    for (options.wanted = 8; options.wanted <= most; options.wanted *= 2)
        try {
            auto found = linalg::solve_quadratic(system.Kss, system.Ks, system.K, options);
            if (found.complete_radius >= top)
                return std::move(found.pairs);
        } catch (const linalg::SolverError &) {
            break;
        }
    options.method = linalg::QuadraticMethod::dense;
    options.wanted = 1;
    for (int tries = 1;; ++tries)
        try {
            options.enough = top - options.shift;
            auto found = linalg::solve_quadratic(system.Kss, system.Ks, system.K, options);
            if (found.complete_radius < top - options.shift)
                throw linalg::SolverError("roots in the range are not resolved among the others");
            return std::move(found.pairs);
        } catch (const linalg::SolverError &) {
            if (tries == 4)
                throw;
            options.shift *= 0.63; // an unlucky neighbour of a root, or not resolved from there
        }
}

/// Roots of the reduced system, each refined on the whole one; nothing where one of them has no
/// counterpart.
std::optional<std::vector<linalg::ComplexPair>> refined(const ZeroRootSystem &system,
                                                        const Eigen::MatrixXd &shapes, double top) {
    const reduction::Projection basis(shapes);
    const auto reduced = [&basis](const Eigen::SparseMatrix<double> &A) {
        return Eigen::SparseMatrix<double>(basis.of(A).sparseView());
    };
    constexpr double beyond = 1.01; // the top of the range
    // Of its modulus: what is farther is another root than the reduced rotor's.
    constexpr double same_root = 1e-3;
    modes::WholePencil<double> pencil; // W in the place of an eigenvalue
    pencil.set({system.Kss, system.Ks, system.K, {}, {}}, top);
    std::vector<linalg::ComplexPair> out;
    try {
        for (linalg::ComplexPair &pair : pairs_up_to(
                 {reduced(system.K), reduced(system.Ks), reduced(system.Kss)}, beyond * top)) {
            if (!is_asked_for(pair, top, beyond))
                continue;
            const double speed = pair.value.real();
            const Eigen::VectorXcd vector = basis.lifted(pair.vector);
            const auto found = pencil.refined({pair.value, vector, vector});
            if (found && std::abs(found->value - pair.value) <= same_root * std::abs(pair.value)) {
                pair.value = found->value;
                pair.vector = found->right;
                out.push_back(std::move(pair));
            } else if (!is_at_rest(system, speed, top)) {
                return std::nullopt;
            }
        }
    } catch (const linalg::SolverError &) {
        return std::nullopt;
    }
    return out;
}

/// Sets from which of the speeds on Hill's series settles (hill_motions.h), and its harmonics
/// there, the most that are needed as a rule: they lie 2 x speed apart, so that at low speed none
/// are enough. Speeds are given up from below, by powers of two; those above are judged when they
/// are used.
/// @throws NotSettled where the series does not settle at the fastest speed either.
void settle_series(StabilityModel &model, const std::vector<double> &speeds) {
    std::vector<double> moduli;
    for (const double speed : speeds)
        if (speed != 0)
            moduli.push_back(std::abs(speed));
    std::ranges::sort(moduli);
    model.harmonics = 1;
    if (moduli.empty())
        return; // at rest the terms of the series do not see each other
    const HillSolver solver(model, balancers::arrangement_at_balance(model.rotor));
    for (std::size_t first = 0;;) {
        try {
            (void)solver.at(moduli[first]);
            model.harmonics = solver.harmonics();
            model.from = first == 0 ? 0 : moduli[first];
            return;
        } catch (const model::AnalysisFailure &) {
            // A series that cannot even be solved at this speed is not enough either.
            if (moduli[first] == moduli.back())
                throw;
        }
        // The next rung: twice as fast.
        const double faster = 2 * moduli[first];
        while (first + 1 < moduli.size() && moduli[first] < faster)
            ++first;
    }
}

/// StabilityModel::resisted.
bool resisted(const model::Rotor &rotor, int order) {
    const auto resists = [](const model::BearingCoefficients &at) {
        return model::symmetric(at.k) && model::symmetric(at.kt) && at.m.isZero(0) &&
               !model::pushes_away(at.c) && !model::pushes_away(at.ct);
    };
    const auto no_internal_damping = [&] {
        const assembly::Discretization d(rotor, order);
        return Eigen::SparseMatrix<double>(assembly::assemble_fixed(d, 0).Kc.view()).norm() == 0;
    };
    return rotor.every_row(resists) && rotor.shaft.axial_torque == 0 && no_internal_damping() &&
           modes::stiffness_positive(rotor, order);
}

} // namespace

StabilityModel stability_model(const model::Case &scene, const std::vector<double> &speeds) {
    StabilityModel out;
    out.rotor = scene.rotor;
    out.reduction = scene.reduction;
    const results::Formulation chosen = modes::choose_formulation(scene);
    out.form_of_lines = chosen.form;
    out.formulation = modes::without_planar_damped(chosen, scene.rotor);
    out.order = mesh_error::resolve_order(scene, out.formulation);
    const results::Form form = out.formulation.form;
    // On the reduced rotor its fast motions would grow where those of the whole rotor do not.
    if (!scene.rotor.shaft.torque_has_potential() && form != results::Form::hill)
        out.reduction = false;
    if (results::in_rotating_axes(form)) {
        out.form = form;
        for (const double speed : speeds)
            out.top = std::max(out.top, std::abs(speed));
        if (form == results::Form::hill && !out.reduction)
            settle_series(out, speeds);
    } else if (form != results::Form::general) {
        out.conservative = modes::stiffness_positive(scene.rotor, out.order);
        if (!out.conservative) {
            out.formulation = {results::Form::general,
                               "the stiffness is not positive definite: all eigenvalues are looked "
                               "at, whether or not they are frequencies"};
            out.form_of_lines = results::Form::general;
        }
    } else {
        out.resisted = resisted(scene.rotor, out.order);
    }
    return out;
}

bool same_at_all_speeds(const StabilityModel &model,
                        const assembly::Discretization &discretization) {
    if (results::in_rotating_axes(model.form) || model.rotor.bearings_depend_on_speed())
        return false;
    const model::Rotor &rotor = model.rotor;
    const bool gyroscopic =
        rotor.shaft.rigid || rotor.shaft.rotary_inertia ||
        std::ranges::any_of(rotor.discs, [](const model::Disc &disc) { return disc.Ip != 0; });
    return !gyroscopic &&
           Eigen::SparseMatrix<double>(assembly::assemble_fixed(discretization, 0).Kc.view())
                   .norm() == 0;
}

std::vector<double> search_speeds(const model::SpeedRange &range) {
    // Speeds: steps of 1 % of the range, halved where motions are not followed.
    constexpr int fewest = 101;
    model::SpeedRange finer = range;
    if (range.count > 1)
        while (finer.count < fewest)
            finer.count = 2 * finer.count - 1; // halves every step: the given speeds stay
    return finer.values();
}

std::vector<ZeroRootSpeed> zero_root_speeds(const assembly::Discretization &discretization,
                                            const balancers::Arrangement &arrangement, bool frozen,
                                            double top, const Eigen::MatrixXd *shapes) {
    if (top <= 0)
        return {};
    const ZeroRootSystem system = zero_root_system(discretization, arrangement, frozen);
    if (shapes != nullptr)
        if (const auto pairs = refined(system, *shapes, top))
            return zero_roots(system, *pairs, top);
    return zero_roots(system, pairs_up_to(system, top), top);
}

} // namespace whirl::stability
