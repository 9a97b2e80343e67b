#include "analyses/weights.h"

#include "analyses/weights/model_vibration.h"
#include "analyses/weights/procedure.h"
#include "balancing/identify.h"
#include "balancing/split.h"
#include "balancing/weights.h"
#include "model/errors.h"
#include "model/mass.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <complex>
#include <limits>
#include <map>
#include <numeric>
#include <utility>

namespace whirl::analyses {

namespace {

using results::Sentence;
using results::WeightsResult;
namespace as = results::as;

using Complex = std::complex<double>;
using balancing::Balance;
using balancing::Scatter;
using balancing::Solution;
using model::ReadingPlace;
using model::WeightsSettings;

/// Shares of the true values that lie in the circles of scatter.
constexpr double confidence = 0.95;

/// Planes whose columns differ by less are told to be nearly dependent: the weights are then ten
/// times what the vibration asks for, and so are the errors of the readings in them.
constexpr double nearly_dependent = 0.1;

/// Up to here all choices of planes are tried.
constexpr std::size_t most_choices = 10;

Eigen::Index index(std::size_t i) { return static_cast<Eigen::Index>(i); }

[[noreturn]] void refuse(const model::Case &scene, const std::string &problem) {
    throw model::BadInput(fmt::format("{}: {}", scene.file.string(), problem));
}

/// What is known before weights are chosen: vibration and coefficients, and how the readings come
/// into them.
struct Known {
    std::vector<ReadingPlace> places;
    Eigen::VectorXcd a; ///< without trial weights
    Eigen::MatrixXcd H;
    Eigen::MatrixXd error; ///< of the model's H, relative; NaN: not known; none: of readings
    Eigen::VectorXcd on;   ///< trial weights that stay on
    /// Of each place: a and its row of H as combinations of its readings (of a alone where the
    /// coefficients are not measured), and the scatter of a reading.
    std::vector<Eigen::MatrixXcd> of_readings;
    std::vector<Scatter> scatter;
    std::vector<std::vector<Scatter>> scatter_of_reading;
};

/// Weights on the rotor in every run, the initial one first; last what stays on.
Eigen::MatrixXcd weights_of_runs(const WeightsSettings &settings, std::size_t planes,
                                 Eigen::VectorXcd &kept) {
    Eigen::MatrixXcd on = Eigen::MatrixXcd::Zero(index(settings.runs.size() + 1), index(planes));
    kept = Eigen::VectorXcd::Zero(index(planes));
    for (std::size_t run = 1; run <= settings.runs.size(); ++run) {
        on.row(index(run)) = kept.transpose();
        for (const model::TrialWeight &trial : settings.trials)
            if (trial.run == run) {
                on(index(run), index(trial.plane)) += trial.weight;
                if (trial.kept)
                    kept(index(trial.plane)) += trial.weight;
            }
    }
    return on;
}

/// From the readings: a, with trial runs H too; scatter of the readings.
class Measured {
  public:
    Measured(const model::Case &scene, WeightsResult &result)
        : _scene(scene), _settings(*scene.weights), _result(result) {}

    void take(Known &known) {
        known.places = _settings.places;
        const std::size_t planes = _scene.rotor.planes.size();
        const bool trials = !_settings.trials.empty();
        Eigen::MatrixXcd weights = weights_of_runs(_settings, planes, known.on);
        if (!trials)
            weights.resize(1, 0);
        else if (!balancing::tells_apart(weights))
            refuse(_scene, "trial: expected trial weights that tell the planes apart, got runs "
                           "whose weights in some planes are always in the same ratio, or that "
                           "never change");
        read_by_place();
        known.a.resize(index(known.places.size()));
        known.H = Eigen::MatrixXcd::Zero(known.a.size(), index(planes));
        const balancing::Identification identification(weights);
        for (std::size_t i = 0; i < known.places.size(); ++i) {
            std::vector<balancing::Reading> readings;
            for (const model::RunReading *reading : _of_place[i])
                readings.push_back({reading->run, reading->value});
            const auto found = identification.of(readings, _settings.readings.size());
            known.a(index(i)) = found.x(0);
            if (trials)
                known.H.row(index(i)) = found.x.tail(index(planes)).transpose();
            known.of_readings.push_back(found.M);
            known.scatter.push_back(
                {found.freedom > 0 ? found.squares / found.freedom : 0, found.freedom});
            add_outliers(i, found);
        }
        if (trials)
            refuse_idle_trials(known, weights);
        add_scatter(known);
    }

  private:
    const model::Case &_scene;
    const WeightsSettings &_settings;
    WeightsResult &_result;
    std::vector<std::vector<const model::RunReading *>> _of_place;

    /// Coefficients that are the rounding of readings would ask for weights without limit.
    void refuse_idle_trials(const Known &known, const Eigen::MatrixXcd &weights) const {
        constexpr double rounding = 1e-9; // of the largest reading: those have some five digits
        for (Eigen::Index p = 0; p < known.H.cols(); ++p)
            if (known.H.col(p).cwiseAbs().maxCoeff() * weights.col(p).cwiseAbs().maxCoeff() <=
                rounding * known.a.cwiseAbs().maxCoeff())
                refuse(_scene,
                       fmt::format("trial: expected a trial weight in plane \"{}\" that changes a "
                                   "reading, got runs that read as they do without it",
                                   _scene.rotor.plane_name(static_cast<std::size_t>(p))));
    }

    /// In an order of their own: the table may have any.
    void read_by_place() {
        _of_place.resize(_settings.places.size());
        for (const model::RunReading &reading : _settings.readings)
            _of_place[reading.place].push_back(&reading);
        for (auto &readings : _of_place)
            std::ranges::stable_sort(readings, {},
                                     [](const model::RunReading *reading) { return reading->run; });
    }

    void add_outliers(std::size_t place, const balancing::Identified &found) {
        for (const balancing::Outlier &outlier : found.outliers) {
            const model::RunReading &reading = *_of_place[place][outlier.reading];
            _result.outliers.push_back(
                {_settings.places[place].probe, _settings.places[place].speed,
                 reading.run == 0 ? "initial" : _settings.runs[reading.run - 1], reading.line,
                 std::abs(outlier.apart), outlier.probability});
        }
    }

    /// Of every reading: what the case says, or what the readings of its place show; where these
    /// are no more than needed, what the others show in the mean.
    void add_scatter(Known &known) const {
        double squares = 0, freedom = 0;
        for (const Scatter &own : known.scatter) {
            squares += own.square * own.freedom;
            freedom += own.freedom;
        }
        for (std::size_t i = 0; i < known.places.size(); ++i) {
            const Scatter shown = known.scatter[i].freedom > 0 ? known.scatter[i]
                                  : freedom > 0                ? Scatter{squares / freedom, freedom}
                                                               : Scatter{};
            std::vector<Scatter> each;
            for (const model::RunReading *reading : _of_place[i]) {
                const double given = _settings.scatter.value_or(0) * std::abs(reading->value);
                each.push_back(_settings.scatter
                                   ? Scatter{given * given, std::numeric_limits<double>::infinity()}
                                   : shown);
            }
            known.scatter_of_reading.push_back(std::move(each));
        }
        if (!_settings.scatter && freedom == 0)
            known.scatter_of_reading.clear(); // nothing is known of it
    }
};

Balance balance_of(const Known &known, const model::Rotor &rotor) {
    Balance balance{known.H, known.a + known.H * known.on, Eigen::VectorXd(known.a.size()),
                    Eigen::VectorXd(known.H.cols())};
    for (std::size_t i = 0; i < known.places.size(); ++i)
        balance.factors(index(i)) = known.places[i].factor;
    for (std::size_t p = 0; p < rotor.planes.size(); ++p)
        balance.largest(index(p)) =
            rotor.planes[p].max.value_or(std::numeric_limits<double>::infinity());
    return balance;
}

using Method = Solution (*)(const Balance &);
Method method_of(const WeightsSettings &settings) {
    return settings.method == model::WeightsMethod::minimax ? balancing::minimax
                                                            : balancing::least_squares;
}

double rms_of(const Eigen::VectorXcd &vibration) {
    return vibration.norm() / std::sqrt(static_cast<double>(vibration.size()));
}
double max_of(const Eigen::VectorXcd &vibration) { return vibration.lpNorm<Eigen::Infinity>(); }

/// What the scatter of readings makes of weights by least squares, to first order: w = -G^-1 H^H D
/// a with G = H^H D H, so that dw = -G^-1 (H^H D (da + dH w) + dH^H D r). Each reading enters by
/// itself and by its conjugate.
std::vector<std::optional<double>> scatter_of_weights(const Known &known, const Balance &balance,
                                                      const Eigen::VectorXcd &all) {
    const Eigen::Index planes = known.H.cols();
    std::vector<std::optional<double>> out(static_cast<std::size_t>(planes));
    if (known.scatter_of_reading.empty())
        return out;
    const Eigen::VectorXd D = balance.factors.cwiseAbs2();
    const Eigen::MatrixXcd G = known.H.adjoint() * D.asDiagonal() * known.H;
    const Eigen::MatrixXcd inverse = Eigen::FullPivLU<Eigen::MatrixXcd>(G).inverse();
    if (!inverse.allFinite())
        return out;
    const Eigen::VectorXcd r = known.a + known.H * all;
    std::vector<std::vector<Scatter>> parts(static_cast<std::size_t>(planes));
    Eigen::VectorXcd crossed = Eigen::VectorXcd::Zero(planes); // sum of 2 u v s^2
    for (std::size_t i = 0; i < known.places.size(); ++i) {
        const Eigen::MatrixXcd &M = known.of_readings[i];
        const bool coefficients = M.rows() > 1;
        std::vector<Scatter> of_place(static_cast<std::size_t>(planes));
        for (Eigen::Index k = 0; k < M.cols(); ++k) {
            const Scatter &own = known.scatter_of_reading[i][static_cast<std::size_t>(k)];
            Complex prediction = M(0, k);
            if (coefficients)
                prediction += (all.transpose() * M.col(k).tail(planes)).value();
            const Eigen::VectorXcd u =
                -D(index(i)) * inverse * known.H.row(index(i)).adjoint() * prediction;
            Eigen::VectorXcd v = Eigen::VectorXcd::Zero(planes);
            if (coefficients)
                v = -D(index(i)) * inverse * M.col(k).tail(planes).conjugate() * r(index(i));
            for (Eigen::Index p = 0; p < planes; ++p) {
                Scatter &part = of_place[static_cast<std::size_t>(p)];
                part.square += (std::norm(u(p)) + std::norm(v(p))) * own.square;
                part.freedom = own.freedom;
                crossed(p) += 2.0 * u(p) * v(p) * own.square;
            }
        }
        for (std::size_t p = 0; p < of_place.size(); ++p)
            parts[p].push_back(of_place[p]);
    }
    for (std::size_t p = 0; p < parts.size(); ++p) {
        Scatter sum = balancing::sum_of(parts[p]);
        // A circle about the ellipse: its longer axis on all sides.
        sum.square += std::abs(crossed(index(p)));
        out[p] = balancing::radius_of(sum, confidence);
    }
    return out;
}

/// Of what is predicted for a place with these weights on.
std::optional<double> scatter_of_prediction(const Known &known, std::size_t place,
                                            const Eigen::VectorXcd &all) {
    if (known.scatter_of_reading.empty())
        return std::nullopt;
    const Eigen::MatrixXcd &M = known.of_readings[place];
    Scatter sum;
    for (Eigen::Index k = 0; k < M.cols(); ++k) {
        const Scatter &own = known.scatter_of_reading[place][static_cast<std::size_t>(k)];
        Complex prediction = M(0, k);
        if (M.rows() > 1)
            prediction += (all.transpose() * M.col(k).tail(all.size())).value();
        sum.square += std::norm(prediction) * own.square;
        sum.freedom = own.freedom;
    }
    return balancing::radius_of(sum, confidence);
}

/// The best of all choices of `count` planes by least squares without bounds.
/// @param reduced  of the balance (balancing::reduced)
std::vector<std::size_t> best_planes(const Balance &reduced, std::size_t count) {
    const auto planes = static_cast<std::size_t>(reduced.H.cols());
    std::vector<std::size_t> best;
    double least = std::numeric_limits<double>::infinity();
    for (unsigned choice = 0; choice < (1U << planes); ++choice) {
        if (static_cast<std::size_t>(std::popcount(choice)) != count)
            continue;
        std::vector<std::size_t> chosen;
        for (std::size_t p = 0; p < planes; ++p)
            if ((choice >> p & 1U) != 0)
                chosen.push_back(p);
        const double value = balancing::least_squares(reduced.of_planes(chosen)).value;
        if (value < least) {
            least = value;
            best = std::move(chosen);
        }
    }
    return best;
}

/// All that follows from the matrix and the vibration.
class Answer {
  public:
    Answer(const model::Case &scene, const Known &known, WeightsResult &result)
        : _scene(scene), _rotor(scene.rotor), _known(known), _result(result),
          _balance(balance_of(known, scene.rotor)), _method(method_of(*scene.weights)) {}

    Eigen::VectorXcd add() {
        leave_out_idle_planes();
        std::vector<std::size_t> all(_rotor.planes.size());
        std::iota(all.begin(), all.end(), 0);
        const Solution best = with(all);
        note_solution(best);
        _w = best.w;
        clear_rounding();
        Eigen::VectorXcd after = _balance.residual(_w);
        const Eigen::VectorXd terms = _balance.a.cwiseAbs() + _balance.H.cwiseAbs() * _w.cwiseAbs();
        for (Eigen::Index i = 0; i < after.size(); ++i)
            after(i) = balancing::without_rounding(after(i), terms(i));
        const double places = std::sqrt(static_cast<double>(after.size()));
        const bool squares = _scene.weights->method == model::WeightsMethod::least_squares;
        _result.reached = squares ? best.value / places : best.value;
        _result.bound = squares ? best.bound / places : best.bound;
        _result.rms = rms_of(after);
        _result.max = max_of(after);
        _result.rms_before = rms_of(_known.a);
        _result.max_before = max_of(_known.a);
        add_weights();
        add_readings(after);
        add_influence();
        add_dependence();
        add_choices();
        add_split();
        return _w;
    }

  private:
    const model::Case &_scene;
    const model::Rotor &_rotor;
    const Known &_known;
    WeightsResult &_result;
    Balance _balance;
    Method _method;
    std::map<std::vector<std::size_t>, Solution> _solutions; ///< of sets of planes
    Eigen::VectorXcd _w;

    [[nodiscard]] std::string name(std::size_t plane) const { return _rotor.plane_name(plane); }
    [[nodiscard]] std::vector<std::string> names(const std::vector<std::size_t> &planes) const {
        std::vector<std::string> out;
        for (const std::size_t plane : planes)
            out.push_back(name(plane));
        return out;
    }
    [[nodiscard]] double permissible_of(std::size_t plane) const {
        return _result.weights[plane].permissible.value_or(0);
    }

    /// A plane that moves no probe gets no weight; of one that moves them little it is said.
    void leave_out_idle_planes() {
        constexpr double nothing = 1e-9; // of what the plane that does most does, for one weight
        constexpr double little = 1e-2;
        const double most = _balance.H.colwise().norm().maxCoeff();
        for (Eigen::Index p = 0; p < _balance.H.cols(); ++p) {
            const double share = most > 0 ? _balance.H.col(p).norm() / most : 1;
            const std::string plane = name(static_cast<std::size_t>(p));
            if (share <= nothing) {
                _balance.H.col(p).setZero();
                _result.model.notes.emplace_back(
                    model::Weight::warning, "plane {} moves none of the probes: no weight in it",
                    plane);
            } else if (share < little) {
                _result.model.notes.emplace_back(
                    model::Weight::warning,
                    "plane {} moves the probes little, by {} of what another plane does with the "
                    "same weight: its weight is large, and errors of readings count most there",
                    plane, results::as::number(share, 2));
            }
        }
    }

    /// A weight counts as nothing where it moves the probes by the rounding of all that moves them.
    void clear_rounding() {
        const Eigen::VectorXd moves = _balance.H.colwise().norm();
        double size = _known.a.norm() + (_balance.H * _known.on).norm();
        for (std::size_t p = 0; p < _rotor.planes.size(); ++p)
            for (const Complex &fixed : _rotor.planes[p].fixed)
                size += moves(index(p)) * std::abs(fixed);
        for (Eigen::Index p = 0; p < _w.size(); ++p)
            if (moves(p) > 0)
                _w(p) = balancing::without_rounding(_w(p), size / moves(p));
    }

    void note_solution(const Solution &best) {
        std::vector<Sentence> &notes = _result.model.notes;
        if (!best.unique) {
            const bool many = _balance.H.cols() > _balance.H.rows();
            if (best.shortest)
                notes.emplace_back(
                    many ? "more planes than readings: other weights leave the same; these are the "
                           "smallest, by the sum of their squares"
                         : "some planes do nothing that others cannot do: other weights leave the "
                           "same; these are the smallest, by the sum of their squares");
            else
                notes.emplace_back(
                    many ? "more planes than readings: other weights may leave the same"
                         : "some planes do nothing that others cannot do: other weights may leave "
                           "the same");
        }
        if (balancing::bounds_cost(_balance, best, _method))
            notes.emplace_back("a weight is at its bound (plane.max): without bounds less would "
                               "stay");
        for (const results::DoubtfulReading &reading : _result.outliers)
            notes.emplace_back("the reading of {} in the run {} at line {} of the table lies {} "
                               "from what the other readings say, more than they scatter: read it "
                               "again",
                               reading.probe, reading.run, reading.line,
                               as::amplitude(reading.apart, 3));
    }

    void add_weights() {
        const std::vector<std::optional<double>> scatter =
            _scene.weights->method == model::WeightsMethod::least_squares
                ? scatter_of_weights(_known, _balance, _w + _known.on)
                : std::vector<std::optional<double>>(_rotor.planes.size());
        const balancing::Dependence dependence = balancing::dependence(_balance);
        const std::vector<std::optional<double>> permissible = permissible_residuals(_scene);
        for (std::size_t p = 0; p < _rotor.planes.size(); ++p) {
            const model::CorrectionPlane &plane = _rotor.planes[p];
            Complex fixed;
            for (const Complex &weight : plane.fixed)
                fixed += weight;
            _result.weights.push_back({name(p), plane.z, _w(index(p)), _known.on(index(p)), fixed,
                                       scatter[p], plane.max, dependence.significance(index(p)),
                                       permissible[p]});
        }
        _result.singular_values.assign(dependence.singular_values.begin(),
                                       dependence.singular_values.end());
        if (std::isfinite(dependence.condition))
            _result.condition = dependence.condition;
    }

    void add_readings(const Eigen::VectorXcd &after) {
        for (std::size_t i = 0; i < _known.places.size(); ++i)
            _result.residual.push_back({_known.places[i].probe,
                                        _known.places[i].speed,
                                        _known.a(index(i)),
                                        after(index(i)),
                                        scatter_of_prediction(_known, i, _w + _known.on),
                                        {}});
    }

    void add_influence() {
        for (std::size_t i = 0; i < _known.places.size(); ++i)
            for (std::size_t p = 0; p < _rotor.planes.size(); ++p) {
                const double error = _known.error.size() > 0
                                         ? _known.error(index(i), index(p))
                                         : std::numeric_limits<double>::quiet_NaN();
                _result.influence.push_back(
                    {_known.places[i].probe, _known.places[i].speed, name(p),
                     _known.H(index(i), index(p)),
                     std::isnan(error) ? std::nullopt : std::optional(error)});
            }
    }

    /// Solved with some of the planes: once, whatever asks for it.
    const Solution &with(const std::vector<std::size_t> &planes) {
        const auto known = _solutions.find(planes);
        return known != _solutions.end()
                   ? known->second
                   : _solutions.emplace(planes, _method(_balance.of_planes(planes))).first->second;
    }
    [[nodiscard]] Eigen::VectorXcd left_by(const std::vector<std::size_t> &planes,
                                           const Solution &solution) const {
        return _balance.of_planes(planes).residual(solution.w);
    }

    void add_dependence() {
        const std::size_t planes = _rotor.planes.size();
        if (planes < 2)
            return;
        for (const auto &set : balancing::dependent_sets(_balance, nearly_dependent)) {
            results::DependentPlanes dependent{names(set), "", 0, 0, _w.lpNorm<Eigen::Infinity>(),
                                               0};
            double least = std::numeric_limits<double>::infinity();
            for (const std::size_t out : set) {
                std::vector<std::size_t> others;
                for (std::size_t p = 0; p < planes; ++p)
                    if (p != out)
                        others.push_back(p);
                const Solution &without = with(others);
                if (!(without.value < least))
                    continue;
                least = without.value;
                const Eigen::VectorXcd left = left_by(others, without);
                dependent.leave_out = name(out);
                dependent.rms = rms_of(left);
                dependent.max = max_of(left);
                dependent.largest_without = without.w.lpNorm<Eigen::Infinity>();
            }
            _result.model.notes.emplace_back(
                "the weights of {} nearly do the same: without {} the root mean square is {} in "
                "place of {}, and the largest weight {} in place of {}",
                fmt::format("{}", fmt::join(dependent.planes, ", ")), dependent.leave_out,
                as::amplitude(dependent.rms, 4), as::amplitude(_result.rms, 4),
                as::imbalance(dependent.largest_without, 4),
                as::imbalance(dependent.largest_weight, 4));
            _result.dependent.push_back(std::move(dependent));
        }
    }

    void add_choices() {
        const std::size_t planes = _rotor.planes.size();
        if (planes > most_choices) {
            _result.model.notes.emplace_back("choices among more than {} planes are not tried",
                                             most_choices);
            return;
        }
        const Balance reduced = balancing::reduced(_balance);
        for (std::size_t count = 1; count <= planes; ++count) {
            const std::vector<std::size_t> chosen = best_planes(reduced, count);
            const Solution &solution = with(chosen);
            const Eigen::VectorXcd left = left_by(chosen, solution);
            _result.choices.push_back(
                {names(chosen), rms_of(left), max_of(left), solution.w.lpNorm<Eigen::Infinity>()});
        }
    }

    void add_split() {
        Eigen::VectorXcd sums = _w;
        bool any = false;
        for (std::size_t p = 0; p < _rotor.planes.size(); ++p) {
            const model::CorrectionPlane &plane = _rotor.planes[p];
            const bool stock = !_scene.weights->stock.empty() && plane.radius;
            if (plane.holes == 0 && !stock)
                continue;
            any = true;
            const balancing::Split split = balancing::split(
                _w(index(p)), {plane.holes, plane.hole_angle, plane.radius.value_or(0),
                               stock ? _scene.weights->stock : std::vector<double>{}});
            results::SplitPlane out{name(p), {}, split.sum, _w(index(p)) - split.sum};
            for (const balancing::Piece &piece : split.pieces)
                out.pieces.push_back(
                    {name(p),
                     piece.hole ? std::optional(static_cast<int>(*piece.hole) + 1) : std::nullopt,
                     std::remainder(piece.angle, 2 * std::numbers::pi),
                     piece.mass     ? piece.mass
                     : plane.radius ? std::optional(piece.mr / *plane.radius)
                                    : std::nullopt,
                     piece.mr});
            if (!split.complete)
                _result.model.notes.emplace_back(
                    plane.holes == 0 ? "two of the heaviest weights at hand are too light for the "
                                       "plane {}"
                                     : "plane {}: not all ways to fill its holes were tried, there "
                                       "may be a better one",
                    name(p));
            sums(index(p)) = split.sum;
            _result.split.push_back(std::move(out));
        }
        if (!any)
            return;
        const Eigen::VectorXcd left = _balance.residual(sums);
        _result.rms_split = rms_of(left);
        _result.max_split = max_of(left);
        for (std::size_t i = 0; i < _result.residual.size(); ++i)
            _result.residual[i].split = std::abs(left(index(i)));
    }

    /// ISO 21940-11: the permissible residual imbalance of the rotor, e m with e the grade over the
    /// angular speed, shared equally among the planes; for two planes of a model by the distances
    /// of its centre of mass from them, within 0.3 to 0.7.
    [[nodiscard]] static std::vector<std::optional<double>>
    permissible_residuals(const model::Case &scene) {
        const WeightsSettings &settings = *scene.weights;
        const std::size_t planes = scene.rotor.planes.size();
        std::vector<std::optional<double>> out(planes);
        if (!settings.grade)
            return out;
        const double speed =
            settings.grade_speed ? *settings.grade_speed : service_speed(scene).value_or(0);
        if (!(speed > 0))
            refuse(scene,
                   "weights.grade_speed: missing, expected the speed at which the grade holds");
        constexpr double millimetre = 1e-3; // m
        const double mass =
            settings.mass ? *settings.mass : model::mass_of_shaft_and_discs(scene.rotor);
        const double all = *settings.grade * millimetre * mass / speed;
        for (auto &own : out)
            own = all / static_cast<double>(planes);
        if (planes == 2 && model::has_shaft(scene) &&
            scene.rotor.planes[0].z != scene.rotor.planes[1].z) {
            const double first = scene.rotor.planes[0].z, second = scene.rotor.planes[1].z;
            const double share =
                std::clamp((second - centre_of_mass(scene.rotor)) / (second - first), 0.3, 0.7);
            out = {share * all, (1 - share) * all};
        }
        return out;
    }
};

WeightsResult empty_result(const WeightsSettings &settings) {
    WeightsResult result;
    result.method = settings.method == model::WeightsMethod::minimax ? "minimax" : "least-squares";
    result.lag = settings.lag;
    result.measured = !settings.places.empty();
    result.source = !settings.trials.empty()      ? results::InfluenceSource::trials
                    : !settings.influence.empty() ? results::InfluenceSource::table
                                                  : results::InfluenceSource::model;
    return result;
}

/// How such a rotor is balanced, where the case says how fast it runs.
void add_procedure(const model::Case &scene, WeightsResult &result) {
    const std::optional<double> speed = service_speed(scene);
    if (!speed)
        return;
    try {
        result.procedure = balancing_procedure(scene, *speed, result.model.order);
    } catch (const model::AnalysisFailure &failure) {
        result.model.notes.emplace_back("how the rotor is balanced by ISO 21940-12 is not said: {}",
                                        failure.sentence());
    } catch (const linalg::SolverError &error) {
        result.model.notes.emplace_back("how the rotor is balanced by ISO 21940-12 is not said: {}",
                                        error.sentence());
    }
}

} // namespace

WeightsResult correction_weights(const model::Case &scene) {
    if (!scene.weights)
        refuse(scene,
               "weights: missing, expected a section [weights] with readings of the machine, as "
               "readings = \"runs.csv\", or with speeds of the model, as speeds = [\"3000 "
               "rpm\"]");
    const WeightsSettings &settings = *scene.weights;
    if (!settings.trials.empty() && settings.places.empty())
        refuse(scene, "weights.readings: missing, expected the table with the readings of the "
                      "trial runs");
    if (scene.rotor.planes.empty())
        refuse(scene, "plane: missing, expected at least one [[plane]] for correction weights");
    WeightsResult result = empty_result(settings);
    Known known;
    if (result.measured)
        Measured(scene, result).take(known);
    else
        known.on = Eigen::VectorXcd::Zero(index(scene.rotor.planes.size()));
    for (const model::GivenCoefficient &given : settings.influence)
        known.H(index(given.place), index(given.plane)) = given.value;
    if (result.source != results::InfluenceSource::model) {
        result.model.none = true;
        result.model.formulation.why = "readings alone: no model of the rotor";
        if (!settings.stations.empty() || settings.body || settings.removable)
            result.model.notes.emplace_back(
                "weights.stations, body and removable are for the model's influence: here it comes "
                "from readings alone");
        (void)Answer(scene, known, result).add();
        return result;
    }
    ModelVibration model(scene, result.model);
    if (!result.measured)
        known.places = model.places();
    ModelVibration::AtPlaces at = model.at(known.places);
    known.H = std::move(at.influence);
    known.error = std::move(at.error);
    if (!result.measured)
        known.a = std::move(at.vibration);
    const Eigen::VectorXcd w = Answer(scene, known, result).add();
    if (scene.speeds)
        model.add_curves(w, result);
    else if (!settings.stations.empty())
        result.model.notes.emplace_back("weights.stations: influence over speed needs [speeds]");
    add_procedure(scene, result);
    return result;
}

} // namespace whirl::analyses
