#include "operation/level1.h"

#include "assembly/planar_part.h"
#include "assembly/system.h"
#include "ends/all_motions.h"
#include "ends/branches.h"
#include "ends/finer_ends.h"
#include "ends/resolved_reach.h"
#include "ends/stability_ends.h"
#include "linalg/check.h"
#include "linalg/definite_pair.h"
#include "model/errors.h"
#include "model/variants.h"
#include "operation/level1_verdict.h"
#include "reduction/planar_shapes.h"
#include "results/damping.h"
#include "results/sentence.h"
#include "rigid/shaft.h"
#include "synchronous/critical_speeds.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <iterator>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <utility>

namespace whirl::operation {

namespace {

using Complex = std::complex<double>;

constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

void require_axisymmetric(const model::Rotor &rotor) {
    if (rotor.rotating_anisotropy())
        throw model::BadInput(
            "level1: expected an axisymmetric rotor, got one with [[anisotropy]], "
            "[[balancer]] or an asymmetric segment");
}

double log_dec_of(Complex eigenvalue) { return *results::damping_of(eigenvalue).log_dec; }

/// The rotor with its bearings as they are at a speed, and a support at z that holds nothing.
model::Rotor at_speed(model::Rotor rotor, double speed, double z) {
    for (model::Bearing &bearing : rotor.bearings) {
        bearing.rows = {bearing.at(speed)};
        bearing.speeds.clear();
    }
    model::Bearing coupling;
    coupling.seal = true;
    coupling.z = z;
    coupling.rows.emplace_back();
    rotor.bearings.push_back(coupling);
    return rotor;
}

/// A stiffness of the size of the rotor's own, N/m.
double stiffness_scale(const model::Rotor &rotor) {
    double sum = 0;
    for (const model::Bearing &bearing : rotor.bearings)
        sum += bearing.rows.front().k.cwiseAbs().trace() / 2;
    return sum > 0 ? sum : 1;
}

/// The maximum continuous speed over the first undamped critical speed on rigid supports, without
/// seals and pedestals; 0 of a rigid shaft. None of a rotor that two supports do not hold.
std::optional<double> critical_speed_ratio(const model::Rotor &rotor, int order, double speed) {
    constexpr double rigid = 1e6; // of the shaft's stiffness: critical speeds off by 1e-6
    if (rotor.shaft.rigid)
        return 0;
    model::Rotor held = model::with_support_stiffness(model::isotropic_without_damping(rotor), {},
                                                      {rigid * rigid::bending_stiffness(rotor)});
    std::erase_if(held.bearings, [](const model::Bearing &bearing) { return bearing.seal; });
    for (model::Bearing &bearing : held.bearings)
        bearing.pedestal.reset();
    if (held.bearings.size() < 2)
        return std::nullopt;
    try {
        const assembly::Discretization d(held, order);
        for (const modes::WhirlMode &mode :
             synchronous::synchronous_modes(d, results::Form::planar, speed, 2))
            if (mode.whirl == results::Whirl::forward && mode.eigenvalue.imag() > 0)
                return speed / mode.eigenvalue.imag();
    } catch (const linalg::SolverError &) { // said to be unknown
    }
    return std::nullopt;
}

/// The rotor at its maximum continuous speed under cross coupling q, which takes the place of the
/// spin speed in everything that follows motions over a range: what `ends` calls a speed is
/// s = q/largest times the spin speed, so that it is of the order of frequencies.
struct CouplingRange {
    double speed = 0;        ///< rad/s
    double z = 0;            ///< m
    double from = 0, to = 0; ///< N/m

    [[nodiscard]] double s(double q) const { return q / to * speed; }
    [[nodiscard]] double q(double s) const { return s / speed * to; }

    /// M q'' + (C + speed G) q' + (K + speed Kc + s dq/ds [0 1; -1 0] at z) q = 0
    [[nodiscard]] modes::FormMatrices matrices(const assembly::Discretization &d) const {
        assembly::FixedSystem system = assembly::assemble_fixed(d, speed);
        const int n = system.M.size();
        std::vector<Eigen::Triplet<double>> coupling;
        for (const auto &[i, a] : d.deflection_at(z))
            for (const auto &[j, b] : d.deflection_at(z)) {
                coupling.emplace_back(2 * i, 2 * j + 1, a * b * q(1));
                coupling.emplace_back(2 * i + 1, 2 * j, -a * b * q(1));
            }
        using linalg::Matrix;
        const assembly::FixedSystem coupled{
            std::move(system.M), Matrix::sum(1, system.C, speed, system.G),
            Matrix::from_entries(n, {}), Matrix::sum(1, system.K, speed, system.Kc),
            Matrix::from_entries(n, coupling)};
        return {d, coupled};
    }
};

/// Which motions of a rotor count, and planar shapes that describe them.
struct Counted {
    std::shared_ptr<const Eigen::MatrixXd> shapes; ///< none: the whole rotor, which is as small
    /// Frequency up to which the elements resolve motions (or twice the spin speed, where that is
    /// more) and the shapes describe them, rad/s: how little faster ones are damped is a matter of
    /// the mesh. What is found with shapes is found again with the whole rotor.
    double up_to = std::numeric_limits<double>::infinity();
};

/// Of the last of so many modes at rest, with the bearings of a speed, rad/s.
/// @throws linalg::SolverError where bearings push away
double frequency_at_rest(const assembly::Discretization &d, double speed, int modes) {
    const auto pair = assembly::planar_pair(d, speed);
    return linalg::DefinitePair(linalg::Matrix::from_sparse(pair.K),
                                linalg::Matrix::from_sparse(pair.M))
        .smallest(modes)
        .back()
        .value;
}

Counted counted_motions(const assembly::Discretization &d, double speed) {
    constexpr int small = 24; // planar unknowns
    constexpr int modes = 16; // at rest; beside them the deflections under what acts on the shaft
    Counted out;
    if (d.rigid())
        return out;
    if (d.planar_size() > small)
        try {
            constexpr double well = 0.5; // of the last mode's frequency
            out.up_to = well * frequency_at_rest(d, speed, modes);
            out.shapes = std::make_shared<const Eigen::MatrixXd>(
                reduction::PlanarShapes(d, speed, modes).matrix());
        } catch (const linalg::SolverError &) { // bearings push away
            out = {};
        }
    out.up_to =
        std::min(out.up_to, std::max(2 * speed, ends::resolved_up_to(d, out.shapes.get(), speed)));
    return out;
}

/// A motion is one that the standard judges, the first forward mode as a rule, up to so many times
/// the spin speed, or the first mode at rest where that is more. Bending modes of high order that
/// supports hardly damp grow with less on paper; no gas drives them.
constexpr double judged_up_to = 2;

/// The first mode at rest with the bearings of a speed, rad/s; 0 where they push away.
double first_at_rest(const assembly::Discretization &d, double speed) {
    try {
        return frequency_at_rest(d, speed, 1);
    } catch (const linalg::SolverError &) {
        return 0;
    }
}

/// The rotor under cross coupling over a range of it.
class CoupledRotor {
  public:
    CoupledRotor(const assembly::Discretization &d, const CouplingRange &range,
                 const Counted &counted)
        : _range(range),
          _motions(d, range.matrices(d), counted.shapes, range.s(range.from), range.speed) {
        _motions.count_up_to(counted.up_to);
    }
    [[nodiscard]] const CouplingRange &range() const { return _range; }
    [[nodiscard]] const ends::AllMotions &motions() const { return _motions; }

    /// Of largest real part, 1/s; a real part of 0: zero within rounding.
    [[nodiscard]] Complex least_damped(double q) const {
        return _motions.fastest_growing(_range.s(q), 0, _motions.resolved_up_to()).value;
    }

    /// What the motion of eigenvalue `value` at one coupling is at another: values and rates at
    /// both ends of a step say which root continues which. Where two meet and neither does, either
    /// is as good.
    [[nodiscard]] Complex followed(double from, Complex value, double to, int halvings = 0) const {
        // 1/16384 of the range: roots that meet in less are continued by the nearest.
        constexpr int most_halvings = 14;
        const std::shared_ptr<const ends::Spectrum> before = at(from);
        const std::shared_ptr<const ends::Spectrum> after = at(to);
        const ends::Root &root = before->nearest(value);
        const ends::Branches branches = ends::followed(*before, *after);
        for (const ends::Branch &branch : branches.branches)
            if (branch.from == &root && branch.cluster == 0)
                return branch.to->value;
        if (halvings == most_halvings)
            return after->nearest(root.value).value;
        const double middle = (from + to) / 2;
        return followed(middle, followed(from, value, middle, halvings + 1), to, halvings + 1);
    }

    /// As the whole rotor has it; none where it does not swing or is not found there.
    [[nodiscard]] std::optional<Complex> of_whole(double q, Complex value) const {
        const ends::Root root = at(q)->nearest(value);
        const auto whole = _motions.of_whole(_motions.lifted(root, _range.s(q)));
        constexpr double same = 0.01; // the reduced rotor is better than that
        Complex found = root.value;
        if (whole && std::abs(whole->value - root.value) <= same * std::abs(root.value))
            found = {std::abs(whole->value.real()) <= whole->noise ? 0 : whole->value.real(),
                     whole->value.imag()};
        else if (_motions.reduced())
            return std::nullopt;
        if (std::abs(found.imag()) <= root.noise)
            return std::nullopt;
        return Complex(found.real(), std::abs(found.imag()));
    }

  private:
    CouplingRange _range;
    ends::AllMotions _motions;
    /// A step ends where the next one begins.
    mutable std::map<double, std::shared_ptr<const ends::Spectrum>> _known;

    [[nodiscard]] std::shared_ptr<const ends::Spectrum> at(double q) const {
        constexpr std::size_t most = 20; // as deep as steps are halved
        if (_known.size() > most)
            _known.clear();
        std::shared_ptr<const ends::Spectrum> &known = _known[q];
        if (!known)
            known = std::make_shared<const ends::Spectrum>(_motions.at(_range.s(q)));
        return known;
    }
};

/// A motion at a coupling, N/m.
struct State {
    double q = 0;
    Complex value;
};

/// The answers to one case.
class Answer {
  public:
    /// @param up_to  motions that are faster do not count, rad/s
    Answer(const model::Case &scene, int order, double up_to, std::vector<results::Sentence> &notes)
        : _settings(*scene.level1), _speed(scene.operation->to),
          _rotor(at_speed(scene.rotor, _speed, _settings.z)), _d(_rotor, order),
          _counted(counted_motions(_d, _speed)), _scale(stiffness_scale(_rotor)), _notes(notes) {
        _counted.up_to = std::min(_counted.up_to, up_to);
        _out.z = _settings.z;
        _out.speed = _speed;
        _out.anticipated = _settings.anticipated;
        for (const model::Stage &stage : _settings.stages) {
            _out.stages.push_back(stage_of(stage, _speed));
            _out.anticipated = _out.anticipated.value_or(0) + _out.stages.back().cross_coupling;
        }
        _out.gas_density = _settings.gas_density;
        if (_out.gas_density && _out.anticipated)
            _out.critical_speed_ratio = critical_speed_ratio(scene.rotor, order, _speed);
    }

    results::Level1 found() {
        const Complex without = rotor(0, least * _scale).least_damped(0);
        if (without.real() > 0) {
            say_none({model::Weight::warning,
                      "a motion grows at the maximum continuous speed without any added cross "
                      "coupling"});
            add_without_threshold(without);
        } else if (const auto driven = without.real() == 0 ? grows_at_once() : std::nullopt) {
            _out.critical_cross_coupling = 0;
            add_curve(*driven, _settings.to.value_or(in_sight * _scale));
            _out.critical_frequency = _out.frequency.front();
        } else if (!add_threshold()) {
            add_without_threshold(without);
        }
        add_verdict(_out, _searched);
        return std::move(_out);
    }

  private:
    /// Parts of the stiffness of all bearings: the range of the first search, the largest coupling
    /// tried, that with which undamped motions are seen to grow.
    static constexpr double least = 1e-2;
    static constexpr double largest = 1e4;
    static constexpr double at_once = 1e-7;
    static constexpr double in_sight = 1e-3; ///< the curve where the case does not say

    const model::Level1Settings &_settings;
    double _speed;
    model::Rotor _rotor;
    assembly::Discretization _d;
    Counted _counted;
    double _scale; ///< N/m
    std::vector<results::Sentence> &_notes;
    results::Level1 _out;
    Searched _searched;

    /// Why there is no critical cross coupling.
    void say_none(results::Sentence why) {
        _notes.emplace_back(why.weight(), "level1: {}", why);
        _out.no_critical = std::move(why);
    }

    [[nodiscard]] CoupledRotor rotor(double from, double to) const {
        return {_d, {_speed, _settings.z, from, to}, _counted};
    }

    /// Without damping: the slowest motion that any coupling drives.
    [[nodiscard]] std::optional<State> grows_at_once() const {
        const double q = at_once * _scale;
        const CoupledRotor coupled = rotor(0, q);
        std::optional<State> out;
        for (const ends::Root &root : coupled.motions().at(coupled.range().speed).roots)
            if (root.sign() > 0 && root.value.imag() > 0 &&
                std::abs(root.value) <= _counted.up_to &&
                (!out || root.value.imag() < out->value.imag()))
                out = {q, root.value};
        return out;
    }

    /// @returns whether there is one
    bool add_threshold() {
        double from = 0;
        for (double to = least * _scale; to <= largest * _scale; from = to, to *= 100) {
            const CoupledRotor coupled = rotor(from, to);
            const ends::EndsFound found = ends::find_ends(coupled.motions());
            const auto first = std::ranges::find_if(found.ends, [](const auto &end) {
                return end.resolved.motion && end.resolved.below <= 0 && end.resolved.above > 0;
            });
            const bool ends_there = first != found.ends.end();
            note_doubts(coupled, found, ends_there ? first->speed : coupled.range().speed);
            if (!ends_there)
                continue;
            add_end(coupled.range(), *first, found.roots);
            return true;
        }
        _searched.never_below = from;
        say_none({"no added cross coupling up to {} makes a motion grow",
                  results::as::stiffness(from, 3)});
        return false;
    }

    /// What may grow with less coupling than that at s = `end`.
    void note_doubts(const CoupledRotor &coupled, const ends::EndsFound &found, double end) {
        const CouplingRange &range = coupled.range();
        for (const results::Interval &step : found.doubtful)
            if (step.to < end && coupled.least_damped(range.q(step.to)).real() > 0) {
                _searched.grows_with = range.q(step.to);
                _notes.emplace_back(model::Weight::warning,
                                    "level1: some modes could not be followed over the added cross "
                                    "coupling, and one is unstable at {}: the threshold may be "
                                    "lower than stated",
                                    results::as::stiffness(range.q(step.to)));
                return;
            }
        if (coupled.motions().reduced())
            return; // its fast motions are none of this mesh
        for (const results::StabilityEnd &faster : found.ends)
            if (faster.speed < end && !faster.resolved.motion) {
                _notes.emplace_back("level1: a mode above {}, which this mesh does not resolve, "
                                    "becomes unstable at {} and is not counted",
                                    results::as::frequency(_counted.up_to, 4),
                                    results::as::stiffness(range.q(faster.speed)));
                return;
            }
    }

    void add_end(const CouplingRange &range, const results::StabilityEnd &end,
                 const std::vector<ends::EndOfGrowth> &roots) {
        const double q = range.q(end.speed);
        _out.critical_cross_coupling = q;
        _out.critical_frequency = end.frequency.value_or(0);
        const auto root = std::ranges::find(roots, end.speed, &ends::EndOfGrowth::speed);
        if (root != roots.end()) {
            _out.critical_frequency = std::abs(root->value.imag());
            _out.error = error_of(range, *root);
        }
        if (*_out.critical_frequency == 0)
            _notes.emplace_back("level1: the mode that becomes unstable does not oscillate "
                                "(real eigenvalue)");
        add_curve({q, {0, *_out.critical_frequency}}, _settings.to.value_or(1.5 * q));
    }

    /// Relative difference to that of finer elements.
    [[nodiscard]] double error_of(const CouplingRange &range, const ends::EndOfGrowth &root) const {
        // Of the threshold: thousand times what its refinement leaves.
        constexpr double rounding = 1e-10;
        if (_d.rigid())
            return rounding;
        const ends::FinerEnds finer(
            _d, [&](const assembly::Discretization &d) { return range.matrices(d); });
        // Of the threshold: farther off the finer elements' root is another motion.
        constexpr double nearby = 0.3;
        const auto error = finer.error(root, 1, nearby * root.speed);
        return error ? *error / root.speed + rounding : unknown;
    }

    /// Without a threshold the curve goes as far as the case says.
    void add_without_threshold(Complex without) {
        const double none = _out.anticipated.value_or(0);
        add_curve({0, without}, _settings.to.value_or(none));
    }

    /// The motion of `start` from none up to a coupling, and with that anticipated.
    void add_curve(const State &start, double to) {
        const double anticipated = _out.anticipated.value_or(0);
        const double all = std::max({start.q, to, anticipated, in_sight * _scale});
        const CoupledRotor coupled = rotor(0, all);
        const int count = to > 0 ? _settings.count : 1;
        for (int i = 0; i < count; ++i)
            _out.q.push_back(to > 0 ? to * i / (count - 1) : 0);
        _out.log_dec.assign(_out.q.size(), unknown);
        _out.frequency.assign(_out.q.size(), unknown);
        std::vector<std::pair<double, int>> places; // -1: with that anticipated
        for (int i = 0; i < count; ++i)
            places.emplace_back(_out.q[static_cast<std::size_t>(i)], i);
        if (_out.anticipated)
            places.emplace_back(anticipated, -1);
        std::ranges::sort(places);
        const auto above =
            std::ranges::find_if(places, [&](const auto &place) { return place.first > start.q; });
        walk(coupled, start, above, places.end());
        walk(coupled, start, std::reverse_iterator(above), places.rend());
    }

    /// Over couplings away from the start.
    template <class Place>
    void walk(const CoupledRotor &coupled, State now, Place first, Place last) {
        for (Place place = first; place != last; ++place) {
            const auto [q, i] = *place;
            if (q != now.q)
                now = {q, coupled.followed(now.q, now.value, q)};
            const auto value = coupled.of_whole(q, now.value);
            if (!value)
                continue;
            if (i < 0) {
                _out.anticipated_log_dec = log_dec_of(*value);
                continue;
            }
            _out.log_dec[static_cast<std::size_t>(i)] = log_dec_of(*value);
            _out.frequency[static_cast<std::size_t>(i)] = value->imag();
        }
    }
};

/// Of the motion that begins to grow first, where that takes cross coupling; else of that damped
/// least. 0 where one grows without.
double frequency_of(const results::Level1 &found) {
    if (found.critical_frequency)
        return *found.critical_frequency;
    return !found.log_dec.empty() && found.log_dec.front() >= 0 ? found.frequency.front() : 0;
}

/// Where the first motion to grow is too fast for the standard to mean it, the first of those that
/// are not is judged.
void judge_slow_motions(const model::Case &scene, int order, results::Level1 &found,
                        std::vector<results::Sentence> &notes) {
    const double speed = scene.operation->to;
    const double frequency = frequency_of(found);
    // Bending of a rigid shaft is none; else a mesh is made where the spin speed does not decide.
    if (scene.rotor.shaft.rigid || !(frequency > judged_up_to * speed))
        return;
    const double first = first_at_rest(assembly::Discretization(scene.rotor, order), speed);
    const double up_to = judged_up_to * std::max(speed, first);
    if (!(frequency > up_to))
        return;
    std::vector<results::Sentence> of_slow; // they repeat those of all motions
    results::Level1 slow = Answer(scene, order, up_to, of_slow).found();
    notes.emplace_back(
        "level1: the motion that begins to grow first, or is damped least, has {}, "
        "more than twice the spin speed and twice the first mode at rest: level I judges "
        "the first of the slower ones (`judged`)",
        results::as::frequency(frequency, 4));
    found.judged = results::Level1Judged{slow.critical_cross_coupling, slow.critical_frequency,
                                         slow.anticipated_log_dec};
    found.checks = std::move(slow.checks);
    found.level_two = slow.level_two;
    found.verdict = std::move(slow.verdict);
}

} // namespace

results::Level1 level1(const model::Case &scene, int order, std::vector<results::Sentence> &notes) {
    require_axisymmetric(scene.rotor);
    try {
        constexpr double all = std::numeric_limits<double>::infinity();
        results::Level1 found = Answer(scene, order, all, notes).found();
        judge_slow_motions(scene, order, found, notes);
        return found;
    } catch (const linalg::SolverError &failure) {
        throw model::AnalysisFailure(
            fmt::format("level1: the eigenvalues with cross coupling could not be "
                        "found: {}",
                        failure.what()));
    }
}

} // namespace whirl::operation
