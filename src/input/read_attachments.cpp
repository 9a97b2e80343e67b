#include "input/sections.h"

#include <fmt/core.h>

namespace whirl::input {
namespace {

/// The keys that the table has; all of them become known.
std::vector<std::string> given(CheckedTable &table, const std::vector<std::string> &keys) {
    std::vector<std::string> found;
    for (const std::string &key : keys)
        if (table.has(key))
            found.push_back(key);
    return found;
}

model::Disc read_disc_of_geometry(CheckedTable &table, const Materials &materials, double z) {
    const double outer = table.number("outer", Quantity::length, Range::positive());
    const double inner = table.number_or("inner", 0, Quantity::length, Range::not_negative());
    const double width = table.number("width", Quantity::length, Range::positive());
    const auto material =
        pick_material(materials, table.text("material"), origin_of(table.node(), "material"),
                      table.path_of("material"), table.context().problems);
    if (inner >= outer) {
        table.fail("inner", fmt::format("expected an inner diameter below the outer one, {} m, "
                                        "got {} m",
                                        outer, inner));
        return {};
    }
    return model::disc_from_geometry(z, outer, inner, width, material ? material->rho : 0);
}

model::Disc read_disc_of_inertias(CheckedTable &table) {
    model::Disc disc;
    disc.mass = table.number("mass", Quantity::mass, Range::not_negative());
    if (!table.has("Id") && !table.has("Ip"))
        return disc; // a point mass
    disc.Id = table.number("Id", Quantity::inertia, Range::not_negative());
    disc.Ip = table.number("Ip", Quantity::inertia, Range::not_negative());
    return disc;
}

} // namespace

void read_discs(CheckedTable &root, const Materials &materials, model::Rotor &rotor) {
    for (CheckedTable &table : root.tables("disc")) {
        const auto inertias = given(table, {"mass", "Id", "Ip"});
        const auto geometry = given(table, {"outer", "inner", "width", "material"});
        const std::string name = table.text("name").value_or("");
        const double z = table.number("z", Quantity::length);
        model::Disc disc;
        if (!inertias.empty() && !geometry.empty())
            table.fail(geometry.front(), "expected either mass, Id, Ip or outer, inner, width, "
                                         "material, got both");
        else if (!inertias.empty())
            disc = read_disc_of_inertias(table);
        else if (!geometry.empty())
            disc = read_disc_of_geometry(table, materials, z);
        else
            table.fail("mass", "missing, expected mass (with Id and Ip), or outer and width");
        disc.name = name;
        disc.z = z;
        table.refuse_unknown();
        rotor.discs.push_back(disc);
    }
}

void read_anisotropies(CheckedTable &root, model::Rotor &rotor) {
    for (CheckedTable &table : root.tables("anisotropy")) {
        model::Anisotropy anisotropy;
        anisotropy.name = table.text("name").value_or("");
        anisotropy.z = table.number("z", Quantity::length);
        anisotropy.dI = table.number("dI", Quantity::inertia);
        anisotropy.angle = table.number_or("angle", 0, Quantity::angle);
        table.refuse_unknown();
        rotor.anisotropies.push_back(anisotropy);
    }
}

void read_planes(CheckedTable &root, model::Rotor &rotor) {
    for (CheckedTable &table : root.tables("plane")) {
        model::CorrectionPlane plane;
        plane.name = table.text("name").value_or("");
        plane.z = table.number("z", Quantity::length);
        table.refuse_unknown();
        rotor.planes.push_back(plane);
    }
}

void read_imbalances(CheckedTable &root, model::Rotor &rotor) {
    for (CheckedTable &table : root.tables("imbalance")) {
        model::Imbalance imbalance;
        imbalance.name = table.text("name").value_or("");
        imbalance.z = table.number("z", Quantity::length);
        imbalance.mr = table.number("mr", Quantity::imbalance);
        imbalance.phase = table.number_or("phase", 0, Quantity::angle);
        table.refuse_unknown();
        rotor.imbalances.push_back(imbalance);
    }
}

void read_probes(CheckedTable &root, model::Rotor &rotor) {
    for (CheckedTable &table : root.tables("probe")) {
        model::Probe probe;
        probe.name = table.text("name").value_or("");
        probe.z = table.number("z", Quantity::length);
        probe.angle = table.number_or("angle", 0, Quantity::angle);
        table.refuse_unknown();
        rotor.probes.push_back(probe);
    }
}

} // namespace whirl::input
