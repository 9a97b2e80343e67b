#include "operation/level1.h"

#include "linalg/roots.h"
#include "mesh_error/estimate.h"
#include "mesh_error/safety.h"
#include "model/errors.h"
#include "modes/spectrum.h"
#include "results/damping.h"
#include "results/sentence.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <optional>

namespace whirl::operation {

namespace {

using Complex = std::complex<double>;

constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
constexpr double root_width = 1e-12; ///< of the critical cross coupling, relative
constexpr int fewest_modes = 8;

model::Rotor coupled(model::Rotor rotor, double z, double q) {
    model::Bearing coupling;
    coupling.seal = true;
    coupling.z = z;
    coupling.rows.emplace_back().k << 0, q, -q, 0;
    rotor.bearings.push_back(coupling);
    return rotor;
}

void require_axisymmetric(const model::Rotor &rotor) {
    if (rotor.rotating_anisotropy())
        throw model::BadInput(
            "level1: expected an axisymmetric rotor, got one with [[anisotropy]], "
            "[[balancer]] or an asymmetric segment");
}

/// With the coupling, which is the same from every direction: a rotor that is so, too, is still
/// described by w = x + i y.
results::Form form_with_coupling(results::Form without) {
    return results::is_planar(without) ? results::Form::planar_damped : results::Form::general;
}

double log_dec_of(Complex eigenvalue) { return *results::damping_of(eigenvalue).log_dec; }

/// Eigenvalues of the motions that are followed; none: it no longer swings.
using Followed = std::vector<std::optional<Complex>>;

/// Index of the one that dies out most slowly, or grows fastest, in a turn of its own.
std::size_t least_damped(const Followed &set) {
    const auto rank = [](const std::optional<Complex> &l) {
        return l ? log_dec_of(*l) : std::numeric_limits<double>::infinity();
    };
    return static_cast<std::size_t>(std::ranges::min_element(set, {}, rank) - set.begin());
}

double least_log_dec(const Followed &set) {
    const auto &least = set[least_damped(set)];
    return least ? log_dec_of(*least) : std::numeric_limits<double>::infinity();
}

/// Which value continues each of the set: pairs in the order of their distances.
/// @param clear  set true where no other value could have been meant
Followed matched(const Followed &set, const std::vector<modes::WhirlMode> &values, bool &clear) {
    constexpr double near = 0.5;     // of the eigenvalue
    constexpr double distinct = 0.3; // of the distance to values that continue none
    struct Pair {
        double distance;
        std::size_t of, value;
    };
    std::vector<Pair> pairs;
    for (std::size_t i = 0; i < set.size(); ++i)
        for (std::size_t k = 0; set[i] && k < values.size(); ++k)
            pairs.push_back({std::abs(values[k].eigenvalue - *set[i]), i, k});
    std::ranges::stable_sort(pairs, {}, &Pair::distance);
    Followed out(set.size());
    std::vector<double> distances(set.size(), 0);
    std::vector<bool> taken(values.size(), false);
    for (const Pair &pair : pairs)
        if (!out[pair.of] && !taken[pair.value] &&
            pair.distance <= near * std::abs(*set[pair.of])) {
            out[pair.of] = values[pair.value].eigenvalue;
            distances[pair.of] = pair.distance;
            taken[pair.value] = true;
        }
    clear = true;
    for (const Pair &pair : pairs)
        if (!taken[pair.value] && distances[pair.of] > distinct * pair.distance)
            clear = false;
    for (std::size_t i = 0; i < set.size(); ++i)
        clear = clear && out[i].has_value() == set[i].has_value();
    return out;
}

/// The rotor at one speed under any cross coupling.
class CoupledRotor {
  public:
    CoupledRotor(const model::Case &scene, results::Form form, int order)
        : _scene(scene), _form(form), _order(order) {}

    [[nodiscard]] std::vector<modes::WhirlMode> modes(double q) const {
        constexpr int most_solved = 5000; // some hundred do
        if (++_solved > most_solved)
            throw model::AnalysisFailure(
                "level1: the first forward mode could not be followed over "
                "the added cross coupling");
        const modes::SpectrumSolver solver(coupled(_scene.rotor, _scene.level1->z, q), _form,
                                           _order);
        const int wanted = std::max(fewest_modes, _scene.campbell.modes);
        std::vector<modes::WhirlMode> all = solver.at(_scene.operation->to, wanted).modes;
        // Where all is the same from every direction the coupling only damps backward whirl, and
        // both senses may have one eigenvalue: they are told apart by their sense.
        if (results::is_planar(_form))
            std::erase_if(all, [](const modes::WhirlMode &mode) {
                return mode.whirl == results::Whirl::backward;
            });
        if (all.empty())
            throw model::AnalysisFailure("level1: no whirl mode was found at the maximum "
                                         "continuous speed");
        return all;
    }

    /// The motions that `set` with coupling `from` becomes with coupling `to`, in the same order.
    /// Two of the set may pass each other closely: which of them continues which does not matter
    /// then, and none outside of it is taken for one of them.
    [[nodiscard]] Followed followed(double from, const Followed &set, double to,
                                    int halvings = 0) const {
        constexpr int most_halvings = 12;
        bool clear = false;
        const Followed there = matched(set, modes(to), clear);
        if (clear || halvings == most_halvings)
            return there;
        const double middle = (from + to) / 2;
        return followed(middle, followed(from, set, middle, halvings + 1), to, halvings + 1);
    }

  private:
    const model::Case &_scene;
    results::Form _form;
    int _order;
    mutable int _solved = 0;
};

/// The first forward mode, with the slower ones before it: where bearings differ between their
/// directions cross coupling makes the forward mode of a pair out of both. Heavily damped ones are
/// no modes in this sense; where all are, the least damped one counts. The other one of a pair may
/// follow the forward one.
std::vector<modes::WhirlMode> first_modes(std::vector<modes::WhirlMode> all) {
    std::vector<modes::WhirlMode> light;
    for (const modes::WhirlMode &mode : all)
        if (!results::damping_of(mode.eigenvalue).heavy())
            light.push_back(mode);
    if (light.empty())
        return {*std::ranges::min_element(
            all, {}, [](const auto &mode) { return log_dec_of(mode.eigenvalue); })};
    std::ranges::stable_sort(light, {}, [](const auto &mode) { return mode.eigenvalue.imag(); });
    const auto forward =
        std::ranges::find(light, results::Whirl::forward, &modes::WhirlMode::whirl);
    const auto pair = static_cast<std::ptrdiff_t>(std::min<std::size_t>(light.size(), 2));
    constexpr double close = 1.2; // ratio of two frequencies of a pair
    auto end = forward == light.end() ? light.begin() + pair : forward + 1;
    if (end != light.end() && end->eigenvalue.imag() < close * (end - 1)->eigenvalue.imag())
        ++end;
    light.erase(end, light.end());
    return light;
}

/// A stiffness of the size of the rotor's own, N/m.
double stiffness_scale(const model::Case &scene) {
    double sum = 0;
    for (const model::Bearing &bearing : scene.rotor.bearings)
        sum += bearing.at(scene.operation->to).k.cwiseAbs().trace() / 2;
    return sum > 0 ? sum : 1;
}

/// The motions followed, at a coupling.
struct State {
    double q = 0;
    Followed set;
};

/// Where the first of the motions stops dying out; none up to far beyond any stiffness.
/// @param creeps  true where they stop swinging before that
std::optional<State> threshold(const CoupledRotor &rotor, State low, double first, bool &creeps) {
    constexpr double last = 1e14; // of the first step
    constexpr double step = 4;
    for (double q = std::max(first, step * low.q); q <= last * first; q *= step) {
        const State high{q, rotor.followed(low.q, low.set, q)};
        const double at_high = least_log_dec(high.set);
        if (at_high <= 0) {
            const double root = linalg::root_between(
                [&](double at) { return least_log_dec(rotor.followed(low.q, low.set, at)); }, low.q,
                least_log_dec(low.set), q, at_high, root_width);
            return State{root, rotor.followed(low.q, low.set, root)};
        }
        creeps = !std::isfinite(at_high);
        if (creeps)
            return std::nullopt;
        low = high;
    }
    return std::nullopt;
}

/// Relative difference of the root to that of finer elements.
double error_of(const State &root, const model::Case &scene, results::Form form, int order) {
    constexpr double rounding = 100 * root_width;
    if (scene.rotor.shaft.rigid)
        return rounding;
    const CoupledRotor finer(scene, form, mesh_error::finer_order(order));
    bool clear = false; // the models differ by less than their modes lie apart, or it is not known
    const Followed start = matched(root.set, finer.modes(root.q), clear);
    constexpr double beside = 0.05;
    const auto f = [&](double q) { return least_log_dec(finer.followed(root.q, start, q)); };
    const double low = (1 - beside) * root.q;
    const double high = (1 + beside) * root.q;
    const double at_low = f(low);
    const double at_high = f(high);
    if (!clear || !(at_low > 0 && at_high <= 0))
        return unknown;
    const double better = linalg::root_between(f, low, at_low, high, at_high, root_width);
    return mesh_error::estimate_safety * std::abs(better - root.q) / root.q + rounding;
}

/// One of the motions of `start` over the couplings of the curve.
void fill_curve(const CoupledRotor &rotor, const State &start, std::size_t of,
                results::Level1 &out) {
    out.log_dec.assign(out.q.size(), unknown);
    out.frequency.assign(out.q.size(), unknown);
    const auto walk = [&](auto first, auto last) { // over indices, away from the start
        State now = start;
        for (auto i = first; i != last; ++i) {
            now = {out.q[*i], rotor.followed(now.q, now.set, out.q[*i])};
            if (!now.set[of])
                return;
            out.log_dec[*i] = log_dec_of(*now.set[of]);
            out.frequency[*i] = now.set[of]->imag();
        }
    };
    std::vector<std::size_t> below;
    std::vector<std::size_t> above;
    for (std::size_t i = 0; i < out.q.size(); ++i)
        (out.q[i] <= start.q ? below : above).push_back(i);
    walk(below.rbegin(), below.rend());
    walk(above.begin(), above.end());
}

/// The curve up to a coupling, and the decrement with that anticipated.
void fill_answers(const CoupledRotor &rotor, const State &start, std::size_t of,
                  const model::Level1Settings &settings, double to, results::Level1 &out) {
    for (int i = 0; i < settings.count; ++i)
        out.q.push_back(to * i / (settings.count - 1));
    fill_curve(rotor, start, of, out);
    if (settings.anticipated)
        if (const auto with = rotor.followed(start.q, start.set, *settings.anticipated)[of])
            out.anticipated_log_dec = log_dec_of(*with);
}

/// Without a threshold the curve goes as far as the case says.
void fill_without_threshold(const CoupledRotor &rotor, const State &start,
                            const model::Level1Settings &settings, results::Level1 &out) {
    const std::size_t of = least_damped(start.set);
    if (const auto to = settings.to ? settings.to : settings.anticipated) {
        fill_answers(rotor, start, of, settings, *to, out);
        return;
    }
    out.q = {0};
    out.log_dec = {least_log_dec(start.set)};
    out.frequency = {start.set[of]->imag()};
}

/// The modes that grow with such a coupling: the one followed may not be among them.
std::vector<modes::WhirlMode> growing(const CoupledRotor &rotor, double q) {
    constexpr double clearly = 1e-9;
    std::vector<modes::WhirlMode> all = rotor.modes(q);
    std::erase_if(all, [](const modes::WhirlMode &mode) {
        return log_dec_of(modes::determined_value(mode)) >= -clearly;
    });
    return all;
}

void note_no_threshold(const CoupledRotor &rotor, double scale, bool grows, bool creeps,
                       std::vector<results::Sentence> &notes) {
    for (double q = 1e-3 * scale; !grows && q < 200 * scale; q *= 10)
        if (!growing(rotor, q).empty()) {
            notes.push_back(
                fmt::format("level1: the motion that was followed does not begin to "
                            "grow, but another one grows with a cross coupling of {:.3g} "
                            "N/m: the threshold lies below that and is not known",
                            q));
            return;
        }
    if (grows)
        notes.emplace_back("level1: the motion grows at the maximum continuous speed without any "
                           "added cross coupling");
    else if (creeps)
        notes.emplace_back("level1: the motion that was followed stops swinging before it grows: "
                           "with which cross coupling the rotor becomes unstable is not known");
    else
        notes.emplace_back("level1: no added cross coupling makes the motion followed grow; others "
                           "were not followed: "
                           "with a [[seal]] of some kxy the growth of all is known");
}

/// Another motion that grows already with the coupling at which the one followed begins to.
void note_others(const CoupledRotor &rotor, const State &root,
                 std::vector<results::Sentence> &notes) {
    for (const modes::WhirlMode &mode : growing(rotor, root.q))
        notes.push_back(fmt::format("level1: another motion, of frequency {:.6g} rad/s, grows "
                                    "already with the critical cross coupling of the first one",
                                    mode.eigenvalue.imag()));
}

} // namespace

results::Level1 level1(const model::Case &asked, results::Form without, int order,
                       std::vector<results::Sentence> &notes) {
    require_axisymmetric(asked.rotor);
    const results::Form form = form_with_coupling(without);
    const model::Level1Settings &settings = *asked.level1;
    results::Level1 out;
    out.z = settings.z;
    out.speed = asked.operation->to;
    out.anticipated = settings.anticipated;
    const CoupledRotor rotor(asked, form, order);
    const std::vector<modes::WhirlMode> first = first_modes(rotor.modes(0));
    State start;
    double at_none = std::numeric_limits<double>::infinity(); // no damping is exactly none
    for (const modes::WhirlMode &mode : first) {
        start.set.emplace_back(mode.eigenvalue);
        at_none = std::min(at_none, log_dec_of(modes::determined_value(mode)));
    }
    const double scale = stiffness_scale(asked);
    std::optional<State> root;
    bool creeps = false;
    if (at_none > 0)
        root = threshold(rotor, start, 1e-6 * scale, creeps);
    else if (at_none == 0)
        root = start;
    if (!root) {
        note_no_threshold(rotor, scale, at_none < 0, creeps, notes);
        fill_without_threshold(rotor, start, settings, out);
        return out;
    }
    const std::size_t of = least_damped(root->set);
    out.critical_cross_coupling = root->q;
    out.critical_frequency = root->set[of]->imag();
    out.error = root->q > 0 ? error_of(*root, asked, form, order) : unknown;
    fill_answers(rotor, *root, of, settings,
                 settings.to.value_or(root->q > 0 ? 1.5 * root->q : 1e-3 * scale), out);
    note_others(rotor, *root, notes);
    return out;
}

} // namespace whirl::operation
