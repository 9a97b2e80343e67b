#include "oracles/case_attached.h"

#include "oracles/case_values.h"

#include <algorithm>
#include <stdexcept>

namespace whirl::oracles {

namespace {

constexpr std::array<const char *, 4> ends{"xx", "xy", "yx", "yy"};

Row row_of(const toml::table &table) {
    return {static_cast<int>(number(table, "n", 2)), number(table, "mass"), number(table, "radius"),
            number(table, "damping")};
}

Block between(const Block &a, const Block &b, double share) {
    Block out = a;
    for (std::size_t i = 0; i < 4; ++i)
        out[i / 2][i % 2] += share * (b[i / 2][i % 2] - a[i / 2][i % 2]);
    return out;
}

} // namespace

Support support_of(const toml::table &table) {
    Support out;
    out.z = number(table, "z");
    for (std::size_t i = 0; i < 4; ++i) {
        const bool diagonal = i == 0 || i == 3;
        out.k[i / 2][i % 2] =
            number(table, std::string("k") + ends[i], diagonal ? number(table, "k") : 0);
        out.c[i / 2][i % 2] =
            number(table, std::string("c") + ends[i], diagonal ? number(table, "c") : 0);
    }
    out.kt[0][0] = out.kt[1][1] = number(table, "kt");
    for (const char *key : {"ct", "ktxx"})
        if (table.contains(key))
            throw std::runtime_error("the oracles read of tilt coefficients kt alone");
    return out;
}

Mount mount_of(const toml::table &table) {
    Mount out;
    for (std::size_t i = 0; i < 4; ++i)
        out.m[i / 2][i % 2] =
            number(table, std::string("m") + ends[i], i == 0 || i == 3 ? number(table, "m") : 0);
    const std::array<std::string, 2> axes{"x", "y"};
    for (std::size_t axis = 0; axis < 2; ++axis) {
        const auto of = [&](const std::string &key) {
            return number(table, key + (key.size() > 10 ? "_" : "") + axes[axis],
                          number(table, key));
        };
        out.pedestal_mass[axis] = of("pedestal_mass");
        out.pedestal_k[axis] = of("pedestal_k");
        out.pedestal_c[axis] = of("pedestal_c");
    }
    return out;
}

SpeedTable speed_table_of(const std::string &file, double z) {
    SpeedTable out;
    for (const CsvColumn &column : read_csv(file)) {
        out.rows.resize(column.numbers.size());
        if (column.name == "speed") {
            out.speeds = column.numbers;
            continue;
        }
        const auto end = static_cast<std::size_t>(
            std::find(ends.begin(), ends.end(), column.name.substr(1)) - ends.begin());
        for (std::size_t row = 0; row < out.rows.size(); ++row) {
            Support &s = out.rows[row];
            s.z = z;
            (column.name[0] == 'k' ? s.k : s.c).at(end / 2)[end % 2] = column.numbers[row];
        }
    }
    return out;
}

Balancer balancer_of(const toml::table &table) {
    Balancer out;
    out.z = number(table, "z");
    out.pendulums = word(table, "kind") == "pendulum4";
    out.ring = word(table, "kind") == "ring";
    out.n = out.pendulums ? 4 : static_cast<int>(number(table, "n", 2));
    out.mass = number(table, "mass");
    out.radius = number(table, "radius");
    out.arm = number(table, "arm");
    out.pivot = number(table, "pivot");
    out.damping = number(table, "damping");
    out.imbalance = number(table, "imbalance");
    out.imbalance_radius = number(table, "imbalance_radius");
    out.diameter = number(table, "ball_diameter");
    out.ellipticity = number(table, "ellipticity");
    out.ellipticity_angle = number(table, "ellipticity_angle");
    if (const toml::array *walls = table["walls"].as_array())
        for (const toml::node &angle : *walls)
            out.walls.push_back(number(angle));
    out.held = table["held"].value_or(false);
    if (const toml::array *position = table["position"].as_array())
        for (const toml::node &angle : *position)
            out.position.push_back(number(angle));
    if (!out.pendulums)
        out.rows.push_back(row_of(table));
    if (table.contains("rows")) {
        out.rows.clear();
        for (const toml::table *row : tables_of(table, "rows"))
            out.rows.push_back(row_of(*row));
    }
    if (const toml::array *radii = table["radii"].as_array()) {
        out.rows.clear();
        for (const toml::node &radius : *radii) {
            out.rows.push_back(row_of(table));
            out.rows.back().n = 1;
            out.rows.back().radius = number(radius);
        }
    }
    if (out.ring) {
        const double clearance = number(table, "clearance");
        const double outer = number(table, "outer_radius");
        out.rows.front().radius = clearance;
        out.bore = number(table, "journal_radius") + clearance;
        out.inertia = outer > 0 ? out.mass * (out.bore * out.bore + outer * outer) / 2
                                : number(table, "inertia");
        out.drag = number(table, "drag");
    }
    return out;
}

CaseRotor CaseRotor::at_speed(double spin) const {
    CaseRotor out = *this;
    for (std::size_t i = 0; i < tables.size(); ++i) {
        const SpeedTable &table = tables[i];
        if (table.speeds.empty())
            continue;
        const double s = std::clamp(spin, table.speeds.front(), table.speeds.back());
        std::size_t row = 0;
        while (row + 2 < table.speeds.size() && s > table.speeds[row + 1])
            ++row;
        const double share = (s - table.speeds[row]) / (table.speeds[row + 1] - table.speeds[row]);
        out.supports[i].k = between(table.rows[row].k, table.rows[row + 1].k, share);
        out.supports[i].c = between(table.rows[row].c, table.rows[row + 1].c, share);
    }
    return out;
}

} // namespace whirl::oracles
