#include "input/csv_table.h"
#include "input/sections.h"

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <numbers>
#include <set>
#include <tuple>
#include <utility>

namespace whirl::input {

namespace {

const std::string initial_run = "initial";
const std::string runout_run = "runout";

/// Speeds of tables that differ by less are the same one, converted from other units.
constexpr double same_speed = 1e-9;

/// Mistakes of one kind that are told one by one; more are counted.
constexpr std::size_t told_one_by_one = 20;

bool same(const std::optional<double> &a, const std::optional<double> &b) {
    return a.has_value() == b.has_value() &&
           (!a || std::abs(*a - *b) <= same_speed * std::max(std::abs(*a), std::abs(*b)));
}

/// In the units of most tables: "314.159 rad/s (3000 rpm)".
std::string speed_text(double speed) {
    return fmt::format("{:.6g} rad/s ({:.7g} rpm)", speed, speed * 30 / std::numbers::pi);
}

/// " at 314.159 rad/s (3000 rpm)", or nothing without a speed.
std::string at_speed(const std::optional<double> &speed) {
    return speed ? " at " + speed_text(*speed) : "";
}

std::vector<std::string> plane_names(const model::Rotor &rotor) {
    std::vector<std::string> names;
    for (const model::CorrectionPlane &plane : rotor.planes)
        names.push_back(plane.name);
    return names;
}

std::vector<std::string> probe_names(const model::Rotor &rotor) {
    std::vector<std::string> names;
    for (std::size_t i = 0; i < rotor.probes.size(); ++i)
        names.push_back(rotor.probe_name(i));
    return names;
}

/// Place of a name in a list; none where it is not there.
std::optional<std::size_t> place_in(const std::vector<std::string> &names,
                                    const std::string &name) {
    const auto found = std::ranges::find(names, name);
    return found == names.end() ? std::nullopt
                                : std::optional(static_cast<std::size_t>(found - names.begin()));
}

std::complex<double> polar_or_nan(double amplitude, double phase) {
    return std::isnan(amplitude + phase) ? std::complex<double>(amplitude + phase, 0)
                                         : std::polar(amplitude, phase);
}

/// "expected the name of a plane, got "x", did you mean "y"?"
std::string unknown_name(const char *expected, const std::string &name,
                         const std::vector<std::string> &known) {
    return fmt::format("expected {}, got {}{}", expected, in_quotes(name), suggestion(name, known));
}

/// A row of the table of readings.
struct ReadRow {
    CsvRow row;
    std::string probe, run;
    std::optional<double> speed;
    std::complex<double> value;
};

/// A cell of a name that must be there.
std::string name_in_row(const CsvRow &row, const std::string &column) {
    const auto cell = row.text(column);
    if (!cell)
        row.fail(column, "expected a name, got an empty cell");
    return cell.value_or("");
}

/// Reads [weights] of one case.
class WeightsReader {
  public:
    WeightsReader(CheckedTable &table, CheckedTable &root, model::Case &scene)
        : _table(table), _root(root), _scene(scene), _planes(plane_names(scene.rotor)),
          _probes(probe_names(scene.rotor)) {}

    model::WeightsSettings read() {
        read_plain_entries();
        check_names();
        read_trials();
        read_tables();
        read_factors();
        return std::move(_settings);
    }

  private:
    CheckedTable &_table;
    CheckedTable &_root;
    model::Case &_scene;
    std::vector<std::string> _planes, _probes;
    model::WeightsSettings _settings;
    bool _trials_sound = true; ///< no trial weight in a plane that is not known

    void read_plain_entries() {
        _settings.method = static_cast<model::WeightsMethod>(
            _table.choice("method", {"least-squares", "minimax"}, 0));
        _settings.lag = _table.choice("phase", {"lead", "lag"}, 0) == 1;
        _settings.speeds = _table.numbers("speeds", Quantity::speed, Range::positive());
        if (const Node *list = _table.find("speeds");
            list && list->is_list() && list->items.empty())
            _table.fail("speeds", "expected at least one speed, got none");
        _settings.stations = _table.numbers("stations", Quantity::length);
        if (_table.has("body"))
            _settings.body = static_cast<model::RotorBody>(
                _table.choice("body", {"discs", "sections", "roll", "integral"}, 0));
        _settings.removable = _table.flag_or("removable", false);
        for (const char *key : {"stations", "body", "removable"})
            if (_table.has(key) && !_root.has("shaft"))
                _table.fail(key, "expected it with a rotor, a section [shaft], got readings alone");
        _settings.scatter =
            _table.optional_number("scatter", Quantity::number, Range::inside(0, 1));
        _settings.stock = _table.numbers("stock", Quantity::mass, Range::positive());
        if (_table.has("stock") && !_planes.empty() &&
            std::ranges::none_of(_scene.rotor.planes,
                                 [](const auto &plane) { return plane.radius.has_value(); }))
            _table.fail("stock", "expected a [[plane]] with a radius, at which these masses would "
                                 "be, got none");
        if (_table.has("grade"))
            _settings.grade = read_grade(_table);
        _settings.mass = _table.optional_number("mass", Quantity::mass, Range::positive());
        _settings.grade_speed =
            _table.optional_number("grade_speed", Quantity::speed, Range::positive());
        if (_settings.grade && !_settings.mass && !model::has_shaft(_scene))
            _table.fail("mass", "missing, expected the mass of the rotor in kg for which the grade "
                                "is meant: the case has no [shaft] that would say it");
    }

    /// Planes and probes are known by their names.
    void check_names() {
        if (_planes.empty())
            _root.fail("plane", "missing, expected at least one [[plane]] for correction weights");
        refuse_twice("plane", _planes);
        refuse_twice("probe", _probes);
        const bool measured = _table.has("readings") || _table.has("influence");
        for (std::size_t i = 0; i < _planes.size(); ++i)
            if (_planes[i].empty() && measured)
                _table.context().problems.add(
                    origin_of(_table.context().tree, fmt::format("plane[{}]", i)),
                    fmt::format("plane[{}].name", i),
                    "missing, expected a name, by which trial weights and coefficients know it");
    }

    void refuse_twice(const char *what, const std::vector<std::string> &names) {
        for (std::size_t i = 0; i < names.size(); ++i)
            if (!names[i].empty() && place_in(names, names[i]) != i) {
                const std::string path = fmt::format("{}[{}].name", what, i);
                _table.context().problems.add(
                    origin_of(_table.context().tree, path), path,
                    fmt::format("expected each name once, got \"{}\" twice", names[i]));
            }
    }

    void read_trials() {
        for (CheckedTable &trial : _root.tables("trial")) {
            read_trial(trial);
            trial.refuse_unknown();
        }
        if (!_settings.trials.empty() && _table.has("influence"))
            _table.fail("influence", "expected either trial weights, [[trial]], or coefficients "
                                     "from a table, got both");
    }

    void read_trial(CheckedTable &table) {
        const std::string run = required_text(table, "run", "the name of a run");
        const std::string plane = required_text(table, "plane", "the name of a plane");
        model::TrialWeight trial;
        if (run == initial_run || run == runout_run)
            table.fail("run", fmt::format("expected a run with trial weights, got \"{}\", which "
                                          "has none",
                                          run));
        const auto known = place_in(_planes, plane);
        if (!known && !plane.empty())
            table.fail("plane", unknown_name("the name of a plane", plane, _planes));
        trial.plane = known.value_or(0);
        trial.weight =
            read_weight(table, known ? _scene.rotor.planes[trial.plane].radius : std::nullopt);
        if (trial.weight == 0.0)
            table.fail(table.has("mr") ? "mr" : "mass",
                       "expected a trial weight other than 0, which moves nothing, got 0");
        trial.kept = table.flag_or("kept", false);
        const bool without = run.empty() || run == initial_run || run == runout_run;
        _trials_sound = _trials_sound && known && !without;
        if (without)
            return;
        if (!place_in(_settings.runs, run))
            _settings.runs.push_back(run);
        else if (_settings.runs.back() != run)
            table.fail("run", fmt::format("expected the trial weights of one run one after "
                                          "another, as the runs came, got {} again",
                                          in_quotes(run)));
        trial.run = *place_in(_settings.runs, run) + 1;
        if (known)
            _settings.trials.push_back(trial);
    }

    static std::string required_text(CheckedTable &table, const char *key, const char *what) {
        if (!table.has(key))
            table.fail(key, fmt::format("missing, expected {}", what));
        return table.text(key).value_or("");
    }

    std::optional<CsvTable> table_of(const char *key, const std::vector<CsvRule> &rules) {
        const auto asked = _table.text_entry(key);
        if (!asked)
            return std::nullopt;
        CsvTable csv(*asked, rules);
        bool whole = csv.usable();
        for (const CsvRule &rule : rules)
            if (csv.usable() && rule.name != "speed" && !csv.has(rule.name)) {
                csv.fail(rule.name, "missing, expected a column of that name");
                whole = false;
            }
        return whole ? std::optional(std::move(csv)) : std::nullopt;
    }

    /// Numbers without a unit are in SI: for vibrations that is seldom meant.
    void note_unit(const CsvTable &csv, const char *key, const char *column) {
        if (!csv.has_unit(column))
            _table.context().remarks.emplace_back(
                "weights.{}: the column {} has no unit, so its numbers are in SI; with one, as in "
                "\"{}\", they are read as what they are",
                key, column, std::string(column) == "phase" ? "phase [deg]" : "amplitude [um]");
    }

    void read_tables() {
        std::optional<CsvTable> readings = table_of("readings", {{"speed", Quantity::speed},
                                                                 {"probe", {}},
                                                                 {"run", {}},
                                                                 {"amplitude", Quantity::amplitude},
                                                                 {"phase", Quantity::angle}});
        if (readings) {
            note_unit(*readings, "readings", "amplitude");
            note_unit(*readings, "readings", "phase");
            read_readings(*readings);
        } else if (!_table.has("readings")) {
            check_without_readings();
        }
        if (_table.has("readings") && !_table.has("influence") && !_root.has("trial") &&
            !_root.has("shaft"))
            _table.fail("influence", "missing, expected a table of influence coefficients, trial "
                                     "weights ([[trial]]), or a rotor with a section [shaft]");
        std::optional<CsvTable> influence =
            table_of("influence", {{"speed", Quantity::speed},
                                   {"probe", {}},
                                   {"plane", {}},
                                   {"amplitude", Quantity::influence},
                                   {"phase", Quantity::angle}});
        if (influence && readings &&
            influence->says_reading("amplitude") != readings->says_reading("amplitude"))
            (influence->says_reading("amplitude") ? readings : influence)
                ->fail("amplitude",
                       "expected a unit that says how the vibration was read, as the heading of "
                       "the other table does, for example \"um pk-pk\" of readings and \"um "
                       "pk-pk/(g mm)\" of coefficients, got one that does not say");
        if (influence)
            read_influence(*influence);
    }

    void check_without_readings() {
        if (_table.has("influence"))
            _table.fail("readings", "missing, expected the table with the readings of the initial "
                                    "run");
        else if (!_root.has("shaft"))
            _table.fail("readings", "missing, expected a table of readings, or a rotor with a "
                                    "section [shaft]");
    }

    std::optional<double> speed_of(const CsvTable &csv, const CsvRow &row) const {
        if (csv.has("speed"))
            return row.number("speed", Quantity::speed, Range::not_negative());
        return _settings.speeds.size() == 1 ? std::optional(_settings.speeds.front())
                                            : std::nullopt;
    }

    /// Places of a probe by their speeds; one without a speed has -1.
    std::map<std::string, std::map<double, std::size_t>> _places;

    std::optional<std::size_t> place_at(const std::string &probe,
                                        const std::optional<double> &speed) const {
        const auto of_probe = _places.find(probe);
        if (of_probe == _places.end())
            return std::nullopt;
        const double wanted = speed.value_or(-1);
        const auto found = of_probe->second.lower_bound(wanted - same_speed * std::abs(wanted));
        const bool there = found != of_probe->second.end() &&
                           found->first <= wanted + same_speed * std::abs(wanted);
        return there ? std::optional(found->second) : std::nullopt;
    }

    /// ", the nearest is 314.159 rad/s (3000 rpm)": nothing where the probe was not read at any
    /// speed.
    std::string nearest_speed(const std::string &probe, const std::optional<double> &speed) const {
        const auto of_probe = _places.find(probe);
        if (of_probe == _places.end() || !speed)
            return "";
        const auto nearest = std::ranges::min_element(of_probe->second, {}, [&](const auto &place) {
            return std::abs(place.first - *speed);
        });
        return nearest->first < 0 ? ""
                                  : fmt::format(", the nearest is {}", speed_text(nearest->first));
    }

    void read_readings(const CsvTable &csv) {
        std::vector<ReadRow> rows;
        std::set<std::string> told;
        bool sound = true;
        for (const CsvRow &row : csv.rows()) {
            ReadRow read{
                row, name_in_row(row, "probe"), name_in_row(row, "run"), speed_of(csv, row), {}};
            read.value =
                polar_or_nan(row.number("amplitude", Quantity::amplitude, Range::not_negative()),
                             row.number("phase", Quantity::angle));
            check_run(read, told);
            check_probe(read.row, read.probe);
            sound = sound && !read.probe.empty() && !read.run.empty() &&
                    !std::isnan(read.value.real()) && !(read.speed && std::isnan(*read.speed));
            rows.push_back(std::move(read));
        }
        if (!sound)
            return; // what is missing could be what is wrong
        add_places(rows);
        if (_settings.places.empty()) {
            csv.fail("run", "expected readings of the run \"initial\", got none: without them the "
                            "others have nothing to be compared with");
            return;
        }
        add_readings(rows);
        check_complete(csv);
    }

    void check_run(const ReadRow &read, std::set<std::string> &told) const {
        if (read.run.empty() || read.run == initial_run || read.run == runout_run ||
            place_in(_settings.runs, read.run) || !told.insert(read.run).second)
            return;
        std::vector<std::string> known = _settings.runs;
        known.insert(known.end(), {initial_run, runout_run});
        read.row.fail("run", unknown_name("\"initial\", \"runout\" or the run of a [[trial]]",
                                          read.run, known));
    }

    void check_probe(const CsvRow &row, const std::string &probe) const {
        if (!_probes.empty() && !probe.empty() && !place_in(_probes, probe))
            row.fail("probe", unknown_name("the name of a [[probe]]", probe, _probes));
    }

    void add_places(const std::vector<ReadRow> &rows) {
        for (const ReadRow &read : rows)
            if (read.run == initial_run && !place_at(read.probe, read.speed)) {
                _places[read.probe][read.speed.value_or(-1)] = _settings.places.size();
                _settings.places.push_back({read.probe, read.speed, 1});
            }
        std::stable_sort(
            _settings.places.begin(), _settings.places.end(), [](const auto &a, const auto &b) {
                return a.speed.value_or(0) < b.speed.value_or(0) && !same(a.speed, b.speed);
            });
        for (std::size_t i = 0; i < _settings.places.size(); ++i)
            _places[_settings.places[i].probe][_settings.places[i].speed.value_or(-1)] = i;
    }

    /// The mean runout of a probe: at that speed, or at the only speed at which it was read, which
    /// is that of slow roll. None where it was not read.
    static std::optional<std::complex<double>> runout_at(const std::vector<const ReadRow *> &rows,
                                                         const std::optional<double> &speed,
                                                         bool &several) {
        std::complex<double> here, all;
        double here_count = 0, all_count = 0;
        std::optional<double> other;
        several = false;
        for (const ReadRow *read : rows) {
            if (same(read->speed, speed)) {
                here += read->value;
                here_count += 1;
            }
            several = several || (all_count > 0 && !same(other, read->speed));
            other = read->speed;
            all += read->value;
            all_count += 1;
        }
        if (here_count > 0) {
            several = false;
            return here / here_count;
        }
        if (all_count == 0 || several)
            return std::nullopt;
        return all / all_count;
    }

    void add_readings(const std::vector<ReadRow> &rows) {
        std::map<std::string, std::vector<const ReadRow *>> of_runout;
        for (const ReadRow &read : rows)
            if (read.run == runout_run)
                of_runout[read.probe].push_back(&read);
        std::vector<std::optional<std::complex<double>>> runout;
        std::set<std::string> without;
        for (const model::ReadingPlace &place : _settings.places) {
            bool several = false;
            const std::vector<const ReadRow *> &own = of_runout[place.probe];
            runout.push_back(runout_at(own, place.speed, several));
            if (own.empty() && !of_runout.empty())
                without.insert(place.probe);
            if (several)
                own.front()->row.fail(
                    "run", fmt::format("expected runout of probe {} at one speed, that of "
                                       "slow roll, or at all of them, got none{}",
                                       in_quotes(place.probe), at_speed(place.speed)));
        }
        if (without.size() < _places.size()) // else the probes of runout are others, which is told
            for (const std::string &probe : without)
                _table.context().remarks.emplace_back(
                    "weights.readings: no runout of probe {}: its readings are taken as vibration "
                    "alone, those of others without their runout",
                    probe);
        for (const ReadRow &read : rows) {
            if (read.run == runout_run) {
                if (!_places.contains(read.probe))
                    read.row.fail("probe", fmt::format("expected a probe with readings of the run "
                                                       "\"initial\", got {}",
                                                       in_quotes(read.probe)));
                continue;
            }
            const auto place = place_at(read.probe, read.speed);
            if (!place) {
                read.row.fail("speed",
                              fmt::format("expected a speed at which probe {} has a reading of the "
                                          "run \"initial\", got one without{}{}",
                                          in_quotes(read.probe), at_speed(read.speed),
                                          nearest_speed(read.probe, read.speed)));
                continue;
            }
            const std::size_t run =
                read.run == initial_run ? 0 : place_in(_settings.runs, read.run).value_or(0) + 1;
            _settings.readings.push_back(
                {*place, run, read.value - runout[*place].value_or(0.0), read.row.line()});
        }
    }

    /// Every probe needs every run at every speed.
    void check_complete(const CsvTable &csv) const {
        std::set<std::pair<std::size_t, std::size_t>> there;
        for (const model::RunReading &reading : _settings.readings)
            there.emplace(reading.place, reading.run);
        std::size_t missing = 0;
        for (std::size_t place = 0; place < _settings.places.size(); ++place)
            for (std::size_t run = 1; run <= _settings.runs.size(); ++run)
                if (!there.contains({place, run}) && ++missing <= told_one_by_one)
                    csv.fail("run", fmt::format("expected a reading of every run, got none of {} "
                                                "for probe {}{}",
                                                in_quotes(_settings.runs[run - 1]),
                                                in_quotes(_settings.places[place].probe),
                                                at_speed(_settings.places[place].speed)));
        if (missing > told_one_by_one)
            csv.fail("run", fmt::format("{} more readings of trial runs are missing",
                                        missing - told_one_by_one));
        if (_settings.runs.empty() || !_trials_sound)
            return;
        for (std::size_t i = 0; i < _planes.size(); ++i)
            if (!_planes[i].empty() && place_in(_planes, _planes[i]) == i &&
                std::ranges::none_of(_settings.trials, [i](const model::TrialWeight &trial) {
                    return trial.plane == i;
                })) {
                const std::string path = fmt::format("plane[{}]", i);
                _table.context().problems.add(
                    origin_of(_table.context().tree, path), path,
                    fmt::format("expected a [[trial]] with a weight in the plane \"{}\", got none: "
                                "its influence is not known",
                                _planes[i]));
            }
    }

    void read_influence(const CsvTable &csv) {
        note_unit(csv, "influence", "phase");
        std::set<std::pair<std::size_t, std::size_t>> there;
        std::vector<std::string> measured;
        for (const model::ReadingPlace &place : _settings.places)
            if (!place_in(measured, place.probe))
                measured.push_back(place.probe);
        for (const CsvRow &row : csv.rows()) {
            const std::string probe = name_in_row(row, "probe");
            const std::string plane = name_in_row(row, "plane");
            const std::optional<double> speed = speed_of(csv, row);
            const std::complex<double> value =
                polar_or_nan(row.number("amplitude", Quantity::influence, Range::not_negative()),
                             row.number("phase", Quantity::angle));
            const auto known = place_in(_planes, plane);
            if (!plane.empty() && !known)
                row.fail("plane", unknown_name("the name of a [[plane]]", plane, _planes));
            if (!measured.empty() && !probe.empty() && !place_in(measured, probe))
                row.fail("probe", unknown_name("a probe of the readings", probe, measured));
            const auto place = place_at(probe, speed);
            if (!known || !place || std::isnan(value.real()))
                continue; // of a speed that was not measured: no harm
            if (!there.emplace(*place, *known).second)
                row.fail("plane", fmt::format("expected each coefficient once, got that of probe "
                                              "{} and plane {}{} twice",
                                              in_quotes(probe), in_quotes(plane), at_speed(speed)));
            _settings.influence.push_back({*place, *known, value});
        }
        std::size_t missing = 0;
        for (std::size_t place = 0; place < _settings.places.size(); ++place)
            for (std::size_t plane = 0; plane < _planes.size(); ++plane)
                if (!there.contains({place, plane}) && ++missing <= told_one_by_one)
                    csv.fail("plane", fmt::format("expected a coefficient of every plane, got none "
                                                  "of plane {} for probe {}{}",
                                                  in_quotes(_planes[plane]),
                                                  in_quotes(_settings.places[place].probe),
                                                  at_speed(_settings.places[place].speed)));
        if (missing > told_one_by_one)
            csv.fail("plane",
                     fmt::format("{} more coefficients are missing", missing - told_one_by_one));
    }

    /// [weights.probe] name = factor
    void read_factors() {
        auto table = _table.table("probe");
        if (!table)
            return;
        std::vector<std::string> known = _probes;
        for (const model::ReadingPlace &place : _settings.places)
            if (!place_in(known, place.probe))
                known.push_back(place.probe);
        for (const Node &own : table->node().items) {
            const double factor = table->number(own.key, Quantity::number, Range::not_negative());
            if (!known.empty() && !place_in(known, own.key))
                table->fail(own.key, unknown_name("the name of a probe", own.key, known));
            _settings.factors.emplace_back(own.key, factor);
            for (model::ReadingPlace &place : _settings.places)
                if (place.probe == own.key)
                    place.factor = factor;
        }
        if (!_settings.places.empty() &&
            std::ranges::all_of(_settings.places,
                                [](const model::ReadingPlace &place) { return place.factor == 0; }))
            table->fail("expected a factor greater than 0 of some probe, got none");
    }
};

} // namespace

bool measured_alone(CheckedTable &root) { return !root.has("shaft") && root.has("weights"); }

std::complex<double> read_weight(CheckedTable &table, const std::optional<double> &radius) {
    const bool has_mr = table.has("mr"), has_mass = table.has("mass");
    double mr = 0;
    if (has_mr && has_mass)
        table.fail("mass", "expected either mr or mass (at the radius of the plane), got both");
    if (has_mass) {
        const double mass = table.number("mass", Quantity::mass, Range::not_negative());
        if (!radius)
            table.fail("mass", "expected mr, as the plane has no radius at which a mass could be, "
                               "got a mass");
        mr = mass * radius.value_or(0);
        if (!radius)
            mr = std::numeric_limits<double>::quiet_NaN(); // told
    } else {
        mr = table.number("mr", Quantity::imbalance, Range::not_negative());
    }
    return polar_or_nan(mr, table.number_or("phase", 0, Quantity::angle));
}

void read_weights(CheckedTable &root, model::Case &scene) {
    auto table = root.table("weights");
    if (!table) {
        if (!root.tables("trial").empty())
            root.fail("trial", "expected a section [weights] beside [[trial]], got none");
        return;
    }
    scene.weights = WeightsReader(*table, root, scene).read();
    table->refuse_unknown();
}

} // namespace whirl::input
