#include "oracles/case_rotor.h"

#include "oracles/case_attached.h"
#include "oracles/case_values.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <numbers>
#include <stdexcept>

namespace whirl::oracles {

namespace {

using Materials = std::map<std::string, Cylinder>;

Materials materials_of(const toml::table &root) {
    Materials out;
    for (const auto &[name, node] : part(root, "material")) {
        const toml::table &table = *node.as_table();
        Cylinder material;
        material.E = number(table, "E");
        material.G =
            table.contains("G") ? number(table, "G") : material.E / (2 * (1 + number(table, "nu")));
        material.rho = number(table, "rho");
        out[std::string(name.str())] = material;
    }
    return out;
}

Segment segment_of(const toml::table &table, const Materials &materials, double kappa,
                   int elements) {
    Segment out;
    out.left = materials.at(word(table, "material"));
    out.left.kappa = kappa;
    out.left.length = number(table, "length");
    out.left.outer = number(table, "outer");
    out.left.inner = number(table, "inner");
    out.outer_end = number(table, "outer_end", out.left.outer);
    out.inner_end = number(table, "inner_end", out.left.inner);
    out.elements = static_cast<int>(number(table, "elements", elements));
    out.asymmetry = number(table, "asymmetry");
    out.asymmetry_angle = number(table, "asymmetry_angle");
    return out;
}

/// Rows of the station table as the tables of `segments`.
std::vector<toml::table> stations(const std::string &file) {
    std::vector<toml::table> out;
    for (const CsvColumn &column : read_csv(file)) {
        out.resize(column.numbers.size());
        for (std::size_t i = 0; i < out.size(); ++i)
            if (column.name == "material")
                out[i].insert("material", column.names[i]);
            else
                out[i].insert(column.name, column.numbers[i]);
    }
    return out;
}

void read_shaft(const toml::table &root, const std::filesystem::path &folder, CaseRotor &rotor) {
    const toml::table &shaft = part(root, "shaft");
    const Materials materials = materials_of(root);
    const toml::node *shear = shaft.get("shear");
    const double kappa = shear && shear->is_number() ? number(*shear) : 0;
    const int elements = static_cast<int>(number(shaft, "elements", 1));
    for (const char *key : {"alpha", "beta", "modal_damping"})
        if (shaft.contains(key))
            throw std::runtime_error(std::string("the oracles know of no ") + key);
    rotor.rigid = yes(shaft, "rigid");
    rotor.classical = shaft.contains("order") && number(shaft, "order", 0) == 1;
    rotor.axial_force = number(shaft, "axial_force");
    rotor.axial_torque = number(shaft, "axial_torque");
    rotor.torque_kind = word(shaft, "torque_kind");
    rotor.rotary_inertia = !shaft.contains("rotary_inertia") || yes(shaft, "rotary_inertia");
    rotor.internal_damping = number(shaft, "internal_damping");
    if (shaft.contains("table")) {
        for (const toml::table &row : stations((folder / word(shaft, "table")).string()))
            rotor.shaft.push_back(segment_of(row, materials, kappa, elements));
        return;
    }
    for (const toml::table *row : tables_of(shaft, "segments"))
        rotor.shaft.push_back(segment_of(*row, materials, kappa, elements));
}

/// A disc by its mass and inertias, or a hollow cylinder of a material.
RigidDisc disc_of(const toml::table &table, const Materials &materials) {
    const double z = number(table, "z");
    if (table.contains("mass"))
        return {z, number(table, "mass"), number(table, "Id"), number(table, "Ip")};
    const double ro = number(table, "outer") / 2;
    const double ri = number(table, "inner") / 2;
    const double width = number(table, "width");
    const double mass =
        materials.at(word(table, "material")).rho * std::numbers::pi * (ro * ro - ri * ri) * width;
    const double square = ro * ro + ri * ri;
    return {z, mass, mass * (3 * square + width * width) / 12, mass * square / 2};
}

/// With the support that it names by name or place, else the nearest; on its pedestal where it says
/// so.
Probe probe_of(const toml::table &table, const toml::table &root, const CaseRotor &rotor) {
    Probe out;
    out.on_pedestal = word(table, "on") == "pedestal";
    out.relative = yes(table, "relative");
    out.angle = number(table, "angle");
    const toml::node *named = table.get("bearing");
    if (named && named->is_integer())
        out.support = static_cast<std::size_t>(number(*named));
    if (named && named->is_string())
        for (std::size_t i = 0; const toml::table *bearing : tables_of(root, "bearing")) {
            if (word(*bearing, "name") == word(table, "bearing"))
                out.support = i;
            ++i;
        }
    out.z = table.contains("z") ? number(table, "z") : rotor.supports.at(out.support).z;
    if (!named)
        for (std::size_t i = 1; i < rotor.supports.size(); ++i)
            if (std::abs(rotor.supports[i].z - out.z) <
                std::abs(rotor.supports[out.support].z - out.z))
                out.support = i;
    return out;
}

void read_attached(const toml::table &root, const std::filesystem::path &folder, CaseRotor &rotor) {
    const Materials materials = materials_of(root);
    for (const toml::table *t : tables_of(root, "disc"))
        rotor.discs.push_back(disc_of(*t, materials));
    for (const toml::table *t : tables_of(root, "bearing")) {
        SpeedTable table;
        if (t->contains("table"))
            table = speed_table_of((folder / word(*t, "table")).string(), number(*t, "z"));
        rotor.supports.push_back(table.rows.empty() ? support_of(*t) : table.rows.front());
        rotor.tables.push_back(table);
        rotor.mounts.push_back(mount_of(*t));
    }
    if (const toml::array *clearances = part(root, "standard")["clearances"].as_array())
        for (const toml::node &clearance : *clearances) {
            std::vector<SpeedTable> &tables = rotor.tables_of_clearances.emplace_back();
            for (const toml::table *t : tables_of(root, "bearing"))
                tables.push_back(speed_table_of(
                    (folder / word(*t, "table_" + clearance.value_or<std::string>(""))).string(),
                    number(*t, "z")));
        }
    for (const toml::table *t : tables_of(root, "seal")) {
        if (t->contains("table"))
            throw std::runtime_error("the oracles read seals without tables");
        Support seal = support_of(*t);
        if (!t->contains("kyx"))
            seal.k[1][0] = -seal.k[0][1];
        if (!t->contains("cyx"))
            seal.c[1][0] = -seal.c[0][1];
        rotor.supports.push_back(seal);
        rotor.tables.emplace_back();
        rotor.mounts.emplace_back(); // the fluid as a disc without inertia: the same in x and y
        if (mount_of(*t).m[0][1] != 0 || mount_of(*t).m[0][0] != mount_of(*t).m[1][1])
            throw std::runtime_error("the oracles read the fluid of seals as a mass alone");
        rotor.discs.push_back({number(*t, "z"), number(*t, "m"), 0, 0});
    }
    for (const toml::table *t : tables_of(root, "probe"))
        rotor.probes.push_back(probe_of(*t, root, rotor));
    for (const toml::table *t : tables_of(root, "anisotropy"))
        rotor.anisotropies.push_back({number(*t, "z"), number(*t, "dI"), number(*t, "angle")});
    for (const toml::table *t : tables_of(root, "balancer"))
        rotor.balancers.push_back(balancer_of(*t));
    for (const toml::table *t : tables_of(root, "plane"))
        rotor.planes.push_back(number(*t, "z"));
    if (rotor.planes.empty())
        for (const Balancer &b : rotor.balancers)
            rotor.planes.push_back(b.z);
    for (const toml::table *t : tables_of(root, "imbalance"))
        rotor.imbalances.push_back({number(*t, "z"), number(*t, "mr"), number(*t, "phase")});
    for (const toml::table *t : tables_of(root, "force")) {
        const std::string direction = word(*t, "direction");
        const bool turns = direction.empty() ? t->contains("multiple") : direction == "forward";
        if (!turns && !direction.empty() && direction != "x")
            throw std::runtime_error("the oracles know forces forward and along x");
        rotor.forces.push_back({number(*t, "z"), number(*t, "amplitude"), number(*t, "phase"),
                                number(*t, "multiple"), number(*t, "frequency"), turns});
    }
}

/// Lists of numbers, one in the other.
std::vector<std::vector<double>> lists(const toml::node &node) {
    std::vector<std::vector<double>> out;
    for (const toml::node &row : *node.as_array()) {
        out.emplace_back();
        for (const toml::node &item : *row.as_array())
            out.back().push_back(number(item));
    }
    return out;
}

void read_analyses(const toml::table &root, CaseRotor &rotor) {
    const toml::table &speeds = part(root, "speeds");
    rotor.speed_from = number(speeds, "from");
    rotor.speed_to = number(speeds, "to", rotor.speed_from);
    rotor.speed_count = static_cast<int>(number(speeds, "count", 1));
    rotor.gravity = number(part(root, "response"), "gravity");
    const toml::table &frequencies = part(part(root, "response"), "frequencies");
    const double first = number(frequencies, "from");
    const int count = static_cast<int>(number(frequencies, "count"));
    for (int i = 0; i < count; ++i)
        rotor.frequencies.push_back(first + (number(frequencies, "to") - first) * i / (count - 1));
    const toml::table &operation = part(root, "operation");
    const toml::table &level1 = part(root, "level1");
    rotor.operation = {number(operation, "from"),   number(operation, "to"),
                       number(level1, "z"),         number(level1, "anticipated"),
                       number(operation, "normal"), number(operation, "trip")};
    const toml::table &balance = part(root, "balance");
    for (const toml::table *t : tables_of(balance, "designs"))
        rotor.designs.push_back({number(*t, "arm"), number(*t, "pivot")});
    if (const toml::node *dampings = balance.get("external_damping"))
        for (const toml::node &item : *dampings->as_array())
            rotor.external_dampings.push_back(number(item));
    const toml::table &simulate = part(root, "simulate");
    rotor.time = number(simulate, "time");
    const toml::table &ramp = part(simulate, "run_up");
    rotor.run_up.from = number(ramp, "from", rotor.speed_from);
    rotor.run_up.to = number(ramp, "to", rotor.speed_from);
    rotor.run_up.duration = number(ramp, "duration");
    rotor.run_up.steady_start = simulate["start"].value_or(std::string("rest")) == "steady";
    for (const toml::table *t : tables_of(simulate, "imbalance"))
        rotor.run_up.sudden.push_back(
            {{number(*t, "z"), number(*t, "mr"), number(*t, "phase")}, number(*t, "time")});
    if (const toml::node *angles = simulate.get("ball_angles"))
        rotor.ball_angles = lists(*angles);
    if (const toml::node *starts = simulate.get("other_starts"))
        for (const toml::node &item : *starts->as_array())
            rotor.other_starts.push_back(lists(item));
    const toml::table &sweep = part(simulate, "sweep");
    const int held = static_cast<int>(number(sweep, "count"));
    for (int k = 0; k < 2 * held - 1; ++k) {
        const int place = k < held ? k : 2 * held - 2 - k;
        rotor.held.push_back(number(sweep, "from") +
                             (number(sweep, "to") - number(sweep, "from")) * place / (held - 1));
    }
}

std::vector<double> numbers(const toml::node *list) {
    std::vector<double> out;
    if (list)
        for (const toml::node &item : *list->as_array())
            out.push_back(number(item));
    return out;
}

void read_samples(const toml::table &root, CaseRotor &rotor) {
    const toml::table &table = part(root, "samples");
    rotor.samples.count = static_cast<int>(number(table, "count"));
    rotor.samples.seed = static_cast<int>(number(table, "seed", 1));
    rotor.samples.quantiles = numbers(table.get("quantiles"));
    for (const toml::table *t : tables_of(table, "vary")) {
        UncertainEntry entry;
        entry.path = word(*t, "path");
        entry.distribution = word(*t, "distribution");
        entry.mean = number(*t, "mean", std::nan(""));
        entry.deviation = number(*t, "deviation");
        entry.relative = (*t)["relative"].value_or(false);
        entry.from = number(*t, "from");
        entry.to = number(*t, "to");
        entry.values = numbers(t->get("values"));
        rotor.samples.vary.push_back(entry);
    }
}

void read_sweep(const toml::table &root, CaseRotor &rotor) {
    const toml::table &table = part(root, "sweep");
    for (const char *key : {"x", "y"}) {
        const toml::table *of = table[key].as_table();
        if (!of)
            continue;
        SweptAxis axis{word(*of, "path"), (*of)["change"].value_or(std::string("value")),
                       numbers(of->get("values"))};
        const auto count = static_cast<int>(number(*of, "count"));
        const bool logarithmic = (*of)["spacing"].value_or(std::string()) == "log";
        const double from = number(*of, "from");
        const double to = number(*of, "to");
        for (int i = 0; i < count; ++i)
            axis.values.push_back(
                logarithmic ? std::exp2(std::log2(from) + std::log2(to / from) * i / (count - 1))
                            : from + (to - from) * i / (count - 1));
        rotor.sweep.push_back(axis);
    }
}

} // namespace

double CaseRotor::length() const {
    double sum = 0;
    for (const Segment &segment : shaft)
        sum += segment.left.length;
    return sum;
}

bool CaseRotor::damped() const {
    return internal_damping != 0 ||
           std::any_of(supports.begin(), supports.end(),
                       [](const Support &s) { return s.c != Block{} || s.ct != Block{}; });
}

bool CaseRotor::mounted() const {
    return !std::all_of(mounts.begin(), mounts.end(), [](const Mount &m) { return m.empty(); });
}

bool CaseRotor::rings_or_rows() const {
    return std::any_of(balancers.begin(), balancers.end(),
                       [](const Balancer &b) { return b.ring || b.rows.size() > 1; });
}

double CaseRotor::speed(int i) const {
    return speed_count == 1 ? speed_from
                            : speed_from + (speed_to - speed_from) * i / (speed_count - 1);
}

CaseRotor read_case(const std::string &file, const std::vector<std::string> &settings) {
    toml::table root = toml::parse_file(file);
    for (const std::string &setting : settings)
        apply_setting(root, setting);
    const std::filesystem::path folder = std::filesystem::path(file).parent_path();
    CaseRotor rotor;
    read_shaft(root, folder, rotor);
    read_attached(root, folder, rotor);
    read_analyses(root, rotor);
    read_samples(root, rotor);
    read_sweep(root, rotor);
    return rotor;
}

SteppedRotor stepped(const CaseRotor &rotor, int slices) {
    SteppedRotor out;
    for (const Segment &s : rotor.shaft) {
        const bool cone = s.outer_end != s.left.outer || s.inner_end != s.left.inner;
        const int parts = cone ? slices : 1;
        for (int i = 0; i < parts; ++i) {
            const double middle = (i + 0.5) / parts;
            Cylinder slice = s.left;
            slice.length /= parts;
            slice.outer += cone ? middle * (s.outer_end - s.left.outer) : 0;
            slice.inner += cone ? middle * (s.inner_end - s.left.inner) : 0;
            out.shaft.push_back(slice);
        }
    }
    out.discs = rotor.discs;
    out.supports = rotor.supports;
    out.internal_damping = rotor.internal_damping;
    return out;
}

} // namespace whirl::oracles
