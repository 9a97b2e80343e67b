#include "analyses/rigid_limit.h"

#include "analyses/stability.h"
#include "assembly/discretization.h"
#include "balancers/pendulum4.h"
#include "criterion/pendulum.h"
#include "criterion/rotor.h"
#include "linalg/check.h"
#include "linalg/roots.h"
#include "mesh_error/estimate.h"
#include "model/errors.h"
#include "model/variants.h"
#include "modes/formulation.h"
#include "process/progress.h"
#include "results/formulation.h"
#include "results/model_summary.h"
#include "rigid/model.h"
#include "rigid/shaft.h"

#include <boost/math/statistics/linear_regression.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>

namespace whirl::analyses {

namespace {

using results::Sentence;
namespace as = results::as;

constexpr double infinite = std::numeric_limits<double>::infinity();
constexpr double one_percent = 0.01;
using Values = std::vector<std::optional<rigid::ModelValue>>;

/// Infinite where the model has no such value.
double difference(const rigid::RigidTarget &target, const std::optional<rigid::ModelValue> &found) {
    return found ? std::abs(found->value - target.closed_form) / target.closed_form : infinite;
}

/// The speed that differs most, and by how much: infinitely where one does not exist.
struct Worst {
    double difference = 0;
    Sentence quantity;
};

/// The comparison at any stiffness; what has been computed is kept.
class Comparison {
  public:
    Comparison(const model::Rotor &rotor, int order, const std::vector<rigid::RigidTarget> &targets)
        : _rotor(rotor), _order(order), _targets(targets) {}

    const Values &at(double factor) {
        const auto found = _kept.find(factor);
        if (found != _kept.end())
            return found->second;
        process::report_progress(std::min(0.9, 0.03 * static_cast<double>(_kept.size())));
        return _kept
            .emplace(factor,
                     rigid::model_values(model::stiffened(_rotor, factor), _order, _targets))
            .first->second;
    }

    Worst worst(double factor) {
        Worst out;
        const Values &values = at(factor);
        for (std::size_t i = 0; i < _targets.size(); ++i) {
            if (!_targets[i].speed())
                continue;
            const double d = difference(_targets[i], values[i]);
            if (d > out.difference || out.quantity.empty())
                out = {d, _targets[i].quantity};
        }
        return out;
    }

    /// Some speed is still told from the closed form by more than its rounding.
    bool above_rounding(double factor) {
        const Values &values = at(factor);
        for (std::size_t i = 0; i < _targets.size(); ++i)
            if (!values[i] || (_targets[i].speed() &&
                               difference(_targets[i], values[i]) > margin * values[i]->noise))
                return true;
        return false;
    }

    static constexpr double margin = 10; ///< differences this many times the rounding count

  private:
    const model::Rotor &_rotor;
    int _order;
    const std::vector<rigid::RigidTarget> &_targets;
    std::map<double, Values> _kept;
};

/// Factors of E and G, two a decade, up to 1e6 or until rounding takes over.
std::vector<double> stiffness_factors(Comparison &comparison) {
    constexpr int last = 12;
    constexpr int fewest = 5;
    std::vector<double> factors;
    for (int i = 0; i <= last; ++i) {
        const double factor = std::pow(10, i / 2.0);
        if (i >= fewest && !comparison.above_rounding(factor))
            break;
        factors.push_back(factor);
    }
    return factors;
}

/// The factor above which every speed is within 1 %: searched downwards from a stiff shaft.
std::optional<double> one_percent_factor(Comparison &comparison) {
    constexpr double stiffest = 1e12;
    constexpr double softest = 1e-9;
    const double step = std::sqrt(10.0);
    double within = 1;
    while (comparison.worst(within).difference > one_percent) {
        within *= step;
        if (within > stiffest)
            throw model::AnalysisFailure(
                Sentence("the model does not approach the rigid rotor: {} stays more than 1 % off, "
                         "or cannot be found, however stiff the shaft",
                         comparison.worst(1).quantity));
    }
    double beyond = within;
    for (; comparison.worst(beyond).difference <= one_percent; beyond /= step)
        if (beyond < softest)
            return std::nullopt;
        else
            within = beyond;
    // In the logarithms the difference is nearly straight.
    const auto excess = [&comparison](double log_factor) {
        return std::log(comparison.worst(std::exp(log_factor)).difference / one_percent);
    };
    const double inside = std::log(within);
    const double outside = std::log(beyond);
    return std::exp(linalg::root_between(excess, inside, excess(inside), outside, excess(outside)));
}

/// The i-th value of every point. Fits the rate over points well above rounding and in the range
/// where the first order dominates.
void close_row(results::RigidLimitRow &row, const rigid::RigidTarget &target, std::size_t i,
               const std::vector<Values> &points, const std::vector<double> &abscissa) {
    constexpr double first_order = 0.01;
    std::vector<double> log_x;
    std::vector<double> log_d;
    for (std::size_t k = 0; k < points.size(); ++k) {
        const std::optional<rigid::ModelValue> &found = points[k][i];
        if (!found) {
            row.fe.emplace_back();
            row.relative_difference.emplace_back();
            row.rounding.emplace_back();
            continue;
        }
        const double d = difference(target, found);
        row.fe.emplace_back(found->value);
        row.relative_difference.emplace_back(d);
        row.rounding.emplace_back(found->noise);
        if (std::isfinite(abscissa[k]) && d < first_order &&
            d > Comparison::margin * found->noise) {
            log_x.push_back(std::log(abscissa[k]));
            log_d.push_back(std::log(d));
        }
    }
    if (log_x.size() >= 3 && std::ranges::max(log_x) > std::ranges::min(log_x))
        row.rate = boost::math::statistics::simple_ordinary_least_squares(log_x, log_d).second;
}

results::RigidLimitRow row_of(const rigid::RigidTarget &target, int order) {
    results::RigidLimitRow row;
    row.quantity = target.quantity;
    row.of = target.of;
    row.closed_form = target.closed_form;
    row.speed = target.speed();
    row.order = order;
    return row;
}

/// Largest difference of the model without elastic unknowns, which is that of rounding alone.
/// @throws model::AnalysisFailure where it is not.
double rigid_difference(const std::vector<rigid::RigidTarget> &targets, const Values &rigid) {
    constexpr double rounding = 1e-6; // near A = C the inertias leave few digits
    double largest = 0;
    for (std::size_t i = 0; i < targets.size(); ++i) {
        const double d = difference(targets[i], rigid[i]);
        if (!(d <= rounding))
            throw model::AnalysisFailure(results::Sentence(
                "{}: the rigid model does not agree with its closed form {}", targets[i].quantity,
                model::ValueOf{targets[i].of}(targets[i].closed_form)));
        largest = std::max(largest, d);
    }
    return largest;
}

void add_stiffness_rows(results::RigidLimitResult &result,
                        const std::vector<rigid::RigidTarget> &targets,
                        const std::vector<double> &factors, const std::vector<Values> &points,
                        const Values &rigid) {
    for (std::size_t i = 0; i < targets.size(); ++i) {
        results::RigidLimitRow row = row_of(targets[i], result.model.order);
        row.factor = factors;
        for (const double factor : factors)
            row.stiffness.push_back(std::isfinite(factor) ? factor * result.stiffness : infinite);
        close_row(row, targets[i], i, points, row.stiffness);
        if (rigid[i])
            row.rigid = rigid[i]->value;
        result.rows.push_back(row);
    }
}

/// Mass, centre, inertias of the model on rigid motions, against the sum over the parts.
void add_inertia_rows(results::RigidLimitResult &result, const rigid::Inertia &exact, double length,
                      const std::vector<model::Rotor> &meshes, int order) {
    std::vector<rigid::Inertia> found;
    for (const model::Rotor &mesh : meshes)
        found.push_back(rigid::model_inertia(mesh, order));
    using model::Quantity;
    const auto add = [&](const char *name, model::Quantity of, double scale, auto number) {
        results::RigidLimitRow row;
        row.quantity = name;
        row.of = of;
        row.closed_form = number(exact);
        row.speed = false;
        row.inertia = true;
        row.order = order;
        for (std::size_t k = 0; k < meshes.size(); ++k) {
            row.elements.push_back(rigid::element_count(meshes[k]));
            row.factor.push_back(result.mesh_factor);
            row.fe.emplace_back(number(found[k]));
            row.relative_difference.emplace_back(std::abs(*row.fe.back() - row.closed_form) /
                                                 (scale > 0 ? scale : 1));
        }
        result.rows.push_back(row);
    };
    add("mass", Quantity::mass, exact.mass, [](const rigid::Inertia &r) { return r.mass; });
    add("centre of mass", Quantity::length, length,
        [](const rigid::Inertia &r) { return r.center(); });
    add("mean diametral inertia", Quantity::inertia, exact.diametral(),
        [](const rigid::Inertia &r) { return r.diametral(); });
    add("polar inertia", Quantity::inertia, exact.polar,
        [](const rigid::Inertia &r) { return r.polar; });
    if (meshes.front().rotating_anisotropy())
        add("anisotropy", Quantity::inertia,
            std::abs(exact.a) > 0 ? std::abs(exact.a) : exact.diametral(),
            [](const rigid::Inertia &r) { return std::abs(r.a); });
}

void add_mesh_rows(results::RigidLimitResult &result, const model::Rotor &rotor,
                   const rigid::RigidForms &forms) {
    constexpr int most_elements = 32;
    const bool rigid = rotor.shaft.rigid;
    const model::Rotor stiff = rigid ? rotor : model::stiffened(rotor, result.mesh_factor);
    const std::vector<model::Rotor> meshes = rigid::meshes_to_coarsest(stiff, most_elements);
    std::vector<int> orders{result.model.order};
    if (orders.front() != 1 && !rigid)
        orders.push_back(1);
    for (const int order : orders) {
        std::vector<Values> points;
        for (const model::Rotor &mesh : meshes)
            points.push_back(rigid::model_values(mesh, order, forms.targets));
        for (std::size_t i = 0; i < forms.targets.size(); ++i) {
            results::RigidLimitRow row = row_of(forms.targets[i], order);
            for (const model::Rotor &mesh : meshes) {
                row.elements.push_back(rigid::element_count(mesh));
                row.factor.push_back(result.mesh_factor);
            }
            close_row(row, forms.targets[i], i, points, {row.elements.begin(), row.elements.end()});
            result.rows.push_back(row);
        }
        add_inertia_rows(result, forms.inertia, rotor.shaft.length(), meshes, order);
    }
}

results::RigidShaft shaft_at(Comparison &comparison, const results::RigidLimitResult &result,
                             double factor) {
    const Worst worst = comparison.worst(factor);
    const double stiffness = factor * result.stiffness;
    return {factor, stiffness, stiffness / result.bearing_stiffness, worst.difference,
            worst.quantity};
}

Sentence percent(double share) {
    return share >= 1e-4 ? Sentence("{} %", as::number(100 * share, 3))
                         : Sentence("{}", as::number(share, 2));
}

Sentence stiffness_text(const results::RigidShaft &shaft) {
    return Sentence("48 EI/L^3 = {}, {} times the bearings together",
                    as::stiffness(shaft.stiffness, 4), as::number(shaft.over_bearings, 3));
}

Sentence sentence_of(const results::RigidLimitResult &result) {
    if (!result.one_percent)
        return "The rigid formulas are within 1 % however soft the shaft: it does not bend.";
    const results::RigidShaft &limit = *result.one_percent;
    if (limit.factor > 1)
        return Sentence("The rigid formulas are within 1 % once the shaft is {} times as stiff as "
                        "it is ({}); {}.",
                        as::number(limit.factor, 4), stiffness_text(limit),
                        result.as_is
                            ? Sentence("with the shaft as it is they err by up to {} ({})",
                                       percent(result.as_is->largest), result.as_is->quantity)
                            : Sentence("with the shaft as it is not all of these speeds exist"));
    return Sentence("The rigid formulas are within 1 % with the shaft as it is ({}): they err by "
                    "up to {} ({}); they reach 1 % with a shaft of {} times its stiffness ({}).",
                    stiffness_text(*result.as_is), percent(result.as_is->largest),
                    result.as_is->quantity, as::number(limit.factor, 4), stiffness_text(limit));
}

/// Sweep, 1 % stiffness and sentence of an elastic shaft.
void stiffen(results::RigidLimitResult &result, const model::Rotor &rotor,
             const rigid::RigidForms &forms) {
    constexpr double stiff_enough = 1e-3; // for the mesh sweep
    result.stiffness = rigid::bending_stiffness(rotor);
    Comparison comparison(rotor, result.model.order, forms.targets);
    if (const auto factor = one_percent_factor(comparison))
        result.one_percent = shaft_at(comparison, result, *factor);
    const std::vector<double> factors = stiffness_factors(comparison);
    std::vector<Values> points;
    for (const double factor : factors)
        points.push_back(comparison.at(factor));
    const Values rigid =
        rigid::model_values(model::without_elasticity(rotor), result.model.order, forms.targets);
    static_cast<void>(rigid_difference(forms.targets, rigid));
    add_stiffness_rows(result, forms.targets, factors, points, rigid);
    if (std::isfinite(comparison.worst(1).difference))
        result.as_is = shaft_at(comparison, result, 1);
    result.sentence = sentence_of(result);
    const auto stiff = std::ranges::find_if(factors, [&comparison](double factor) {
        return comparison.worst(factor).difference <= stiff_enough;
    });
    result.mesh_factor = stiff == factors.end() ? factors.back() : *stiff;
}

/// What asks for free balancers: where small motions about the balanced position of balls begin or
/// cease to grow, within the speeds of the case, and how far pendulums reduce the deflection at
/// some of them. The closed form is the rotor without elastic unknowns, a rigid body with its balls
/// in the equations of the papers.
class FreeBalancers {
  public:
    explicit FreeBalancers(const model::Case &scene) : _scene(scene) {
        if (!scene.speeds || scene.speeds->values().size() < 2)
            return;
        _pendulums = !balancers::pendulums_in(scene.rotor).empty();
        _balls = !_pendulums && !scene.rotor.balancers.empty();
        if (_pendulums)
            _scene.speeds->count = std::min(_scene.speeds->count, most_speeds);
    }
    [[nodiscard]] bool any() const { return _pendulums || _balls; }

    [[nodiscard]] std::vector<rigid::RigidTarget> targets() {
        std::vector<rigid::RigidTarget> out;
        const std::vector<rigid::ModelValue> rigid =
            numbers(model::without_elasticity(_scene.rotor));
        for (std::size_t i = 0; i < rigid.size(); ++i) {
            if (!(rigid[i].value > 0))
                continue;
            rigid::RigidTarget target;
            target.kind = rigid::RigidQuantity::permissible; // no speed that the 1 % are of
            target.of = _pendulums ? model::Quantity::number : model::Quantity::speed;
            target.closed_form = rigid[i].value;
            target.index = static_cast<int>(i);
            target.quantity = name_of(i);
            out.push_back(std::move(target));
        }
        return out;
    }

    /// With another shaft.
    [[nodiscard]] Values at(const model::Rotor &rotor,
                            const std::vector<rigid::RigidTarget> &targets) {
        constexpr double same = 0.5; // one that is farther off is another
        const std::vector<rigid::ModelValue> found = numbers(rotor);
        Values out;
        for (const rigid::RigidTarget &target : targets) {
            std::optional<rigid::ModelValue> nearest;
            const auto off = [&](const rigid::ModelValue &one) {
                return std::abs(one.value - target.closed_form);
            };
            const auto index = static_cast<std::size_t>(target.index);
            if (_pendulums && index < found.size() && found[index].value > 0)
                nearest = found[index];
            for (const rigid::ModelValue &end : found)
                if (!_pendulums && (!nearest || off(end) < off(*nearest)))
                    nearest = end;
            if (nearest && !(off(*nearest) < same * target.closed_form))
                nearest.reset();
            out.push_back(nearest);
        }
        return out;
    }

  private:
    static constexpr int most_speeds = 5;
    model::Case _scene;
    bool _pendulums = false, _balls = false;

    /// Ends of the unstable speeds inside of the range; or over balancers and speeds the least
    /// deflection with pendulums over that with them held, 0: there is no such motion.
    [[nodiscard]] std::vector<rigid::ModelValue> numbers(const model::Rotor &rotor) {
        constexpr double refined = 1e-8; // to which motions are found, and ends not known as roots
        _scene.rotor = rotor;
        std::vector<rigid::ModelValue> out;
        if (_balls) {
            const std::vector<double> speeds = _scene.speeds->values();
            const UnstableBands found = unstable_bands_of(_scene, false);
            for (const results::Interval &band : found.bands)
                for (const double end : {band.from, band.to})
                    if (end > speeds.front() && end < speeds.back()) {
                        double rounding = refined;
                        for (const ends::EndOfGrowth &root : found.roots)
                            if (std::abs(root.speed - end) <= refined * end)
                                rounding = std::max(rounding, root.blur / end);
                        out.push_back({end, rounding});
                    }
            return out;
        }
        std::vector<Sentence> ignored;
        for (const results::PendulumBalance &one :
             criterion::pendulum_balance(_scene, criterion::BalanceScene(_scene), ignored))
            for (const std::vector<results::PendulumState> &states : one.states)
                out.push_back({states.empty() ? 0 : states.front().ratio, refined});
        return out;
    }

    [[nodiscard]] Sentence name_of(std::size_t i) const {
        if (_balls)
            return Sentence("end {} of the unstable speeds with free balls", i + 1);
        const std::vector<double> speeds = _scene.speeds->values();
        return Sentence("efficiency of the pendulums at {}", as::speed(speeds[i % speeds.size()]));
    }
};

/// Rows of free balancers at whole decades of the factors.
void add_free_balancers(results::RigidLimitResult &result, const model::Case &scene) {
    FreeBalancers free(scene);
    if (!free.any())
        return;
    try {
        const std::vector<rigid::RigidTarget> targets = free.targets();
        std::vector<double> factors;
        std::vector<Values> points;
        constexpr double last = 1.5e4;
        for (double factor = 1; factor < last; factor *= 10) {
            factors.push_back(factor);
            points.push_back(free.at(model::stiffened(scene.rotor, factor), targets));
        }
        add_stiffness_rows(result, targets, factors, points,
                           free.at(model::without_elasticity(scene.rotor), targets));
    } catch (const model::AnalysisFailure &failure) {
        result.model.notes.emplace_back("no rows of free balancers: {}", failure.sentence());
    } catch (const linalg::SolverError &error) {
        result.model.notes.emplace_back("no rows of free balancers: {}", error.sentence());
    }
}

/// The model without elastic unknowns in the place of the sweep.
void compare_rigid(results::RigidLimitResult &result, const model::Rotor &rotor,
                   const rigid::RigidForms &forms) {
    result.stiffness = infinite;
    result.mesh_factor = infinite;
    const Values values = rigid::model_values(rotor, result.model.order, forms.targets);
    add_stiffness_rows(result, forms.targets, {infinite}, {values}, values);
    result.sentence = Sentence("The shaft is rigid: model and closed forms differ by {} at most.",
                               as::number(rigid_difference(forms.targets, values), 2));
}

} // namespace

results::RigidLimitResult rigid_limit(const model::Case &given) {
    results::RigidLimitResult result;
    results::ModelSummary &model = result.model;
    model::Case scene = rigid::rigid_limit_scene(given, model.notes);
    const rigid::RigidForms forms = rigid::rigid_forms(scene);
    model.notes.insert(model.notes.end(), forms.notes.begin(), forms.notes.end());
    model.order = mesh_error::resolve_order(scene, modes::choose_formulation(scene));
    model.formulation =
        scene.rotor.rotating_anisotropy()
            ? results::Formulation{results::Form::rotating,
                                   "something that turns is not axisymmetric: motions that "
                                   "stand still in axes that turn with the rotor"}
            : results::Formulation{results::Form::planar,
                                   "forward critical speeds without damping on isotropic "
                                   "bearings: symmetric matrices of half size"};
    const assembly::Discretization d(scene.rotor, model.order);
    model.elements = static_cast<int>(d.shaft_mesh().spans.size());
    model.unknowns = (scene.rotor.rotating_anisotropy() ? 2 : 1) * d.planar_size();
    result.bearing_stiffness = forms.bearing_stiffness;
    result.omega_0 = forms.omega_0;
    result.partial_frequencies = forms.partial_frequencies;
    result.z_max = forms.z_max;
    std::optional<process::Stage> stage(std::in_place, "stiffer and stiffer shafts", 0.0, 0.9);
    if (scene.rotor.shaft.rigid)
        compare_rigid(result, scene.rotor, forms);
    else
        stiffen(result, scene.rotor, forms);
    stage.emplace("finer and finer meshes", 0.9, 0.95);
    add_mesh_rows(result, scene.rotor, forms);
    if (!scene.rotor.shaft.rigid) {
        stage.emplace("free balancers", 0.95, 1.0);
        add_free_balancers(result, scene);
    }
    return result;
}

} // namespace whirl::analyses
