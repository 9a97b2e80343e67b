#include "input/csv_table.h"
#include "input/sections.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

namespace whirl::input {
namespace {

/// The shear modulus belongs to 0 <= nu < 0.5, nu = E/(2G) - 1, and to `nu` within 1e-3 if given.
void check_shear_modulus(const model::Material &material, std::optional<double> nu,
                         const CheckedTable &table) {
    const double derived = material.poisson_ratio();
    constexpr double round_off = 1e-12; // G = E/2 as printed by a program
    if (derived < -round_off || derived >= 0.5 - round_off)
        table.fail("G", fmt::format("expected a shear modulus above E/3 = {:.6g} Pa and up to E/2 "
                                    "= {:.6g} Pa (0 <= nu < 0.5), got {:.6g} Pa (nu = {:.6g})",
                                    material.E / 3, material.E / 2, material.G, derived));
    else if (nu && std::abs(*nu - derived) > 1e-3)
        table.fail("G", fmt::format("expected a shear modulus that agrees with nu within 1e-3, "
                                    "E/(2 (1 + nu)) = {:.6g} Pa, got {:.6g} Pa (nu = {:.6g})",
                                    material.E / (2 * (1 + *nu)), material.G, derived));
}

model::Material read_material(CheckedTable table, const std::string &name) {
    model::Material material;
    material.name = name;
    material.E = table.number("E", Quantity::pressure, Range::positive());
    material.rho = table.number("rho", Quantity::density, Range::positive());
    const auto nu = table.optional_number("nu", Quantity::number, {0, 0.5, false, true});
    const auto shear = table.optional_number("G", Quantity::pressure, Range::positive());
    if (!table.has("nu") && !table.has("G"))
        table.fail("G", "missing, expected a pressure in Pa greater than 0, or nu");
    material.G = shear.value_or(material.E / (2 * (1 + nu.value_or(0))));
    if (shear)
        check_shear_modulus(material, nu, table);
    table.refuse_unknown();
    return material;
}

/// What a tube takes of the section, m; of a cone all that it takes somewhere.
struct Ring {
    double inner = 0, outer = 0;
};

/// Collects a problem where a layer takes what one before it, or the segment, has taken: where two
/// materials would be counted at one place.
void check_free(const model::Layer &layer, const std::vector<Ring> &taken, CheckedTable &table) {
    constexpr double rounding = 1e-9; // of lengths in other units
    for (const Ring &ring : taken)
        if (layer.inner < (1 - rounding) * ring.outer && (1 + rounding) * ring.inner < layer.outer)
            table.fail(
                table.find("inner") ? "inner" : "outer",
                fmt::format("expected a tube beside what lies from {:.6g} m to {:.6g} m already, "
                            "got one from {:.6g} m to {:.6g} m",
                            ring.inner, ring.outer, layer.inner, layer.outer));
}

/// Tubes given without an inner diameter sit on what lies inside of them.
void read_layers(CheckedTable &table_of_segment, const Materials &materials,
                 model::Segment &segment) {
    std::vector<Ring> taken{{std::min(segment.inner_start, segment.inner_end),
                             std::max(segment.outer_start, segment.outer_end)}};
    read_each(table_of_segment, "layers", segment.layers,
              [&](CheckedTable &table, model::Layer &layer) {
                  table.text("name");
                  layer.outer = table.number("outer", Quantity::length, Range::positive());
                  layer.inner = table.number_or("inner", taken.back().outer, Quantity::length,
                                                Range::not_negative());
                  if (layer.inner >= layer.outer)
                      table.fail("outer", fmt::format("expected a diameter above the inner one, "
                                                      "{:.6g} m, got {:.6g} m",
                                                      layer.inner, layer.outer));
                  else
                      check_free(layer, taken, table);
                  layer.material = material_of(table, materials);
                  taken.push_back({layer.inner, layer.outer});
              });
}

/// @param table  with an entry `material`
template <class Table> model::Material pick_material(Table &table, const Materials &materials) {
    const std::optional<std::string> name = table.text("material");
    if (!name && materials.size() == 1)
        return materials.begin()->second;
    std::vector<std::string> names;
    for (const auto &entry : materials)
        names.push_back(entry.first);
    const auto found = materials.find(name.value_or(""));
    if (name && found != materials.end())
        return found->second;
    table.fail(
        "material",
        name ? "expected the name of a material, got " + in_quotes(*name) + suggestion(*name, names)
        : materials.empty() ? "missing, expected a section [material.NAME]"
                            : "missing, expected the name of a material" + suggestion("", names));
    return {};
}

/// The bore is smaller than the outer diameter at both ends, and what has mass is not empty.
template <class Table> void check_diameters(const model::Segment &segment, Table &table) {
    const bool start = segment.inner_start >= segment.outer_start;
    const double outer = start ? segment.outer_start : segment.outer_end;
    const double inner = start ? segment.inner_start : segment.inner_end;
    if (inner >= outer)
        table.fail("inner",
                   fmt::format("expected an inner diameter below the outer one, {} m, got {} m{}",
                               digits_apart(outer, inner), digits_apart(inner, outer),
                               start ? "" : " (at the end of the segment)"));
    if (segment.mass_inner > 0 && segment.mass_inner >= segment.mass_outer)
        table.fail("mass_inner", fmt::format("expected mass_inner below mass_outer, {:.6g} m "
                                             "(which a cone must be given), got {:.6g} m",
                                             segment.mass_outer, segment.mass_inner));
}

/// A segment, from a table of the case or a row of a station table.
template <class Table>
model::Segment read_segment(Table &table, const Materials &materials, int elements) {
    model::Segment segment;
    segment.length = table.number("length", Quantity::length, Range::positive());
    segment.outer_start = table.number("outer", Quantity::length, Range::positive());
    segment.inner_start = table.number_or("inner", 0, Quantity::length, Range::not_negative());
    segment.outer_end =
        table.number_or("outer_end", segment.outer_start, Quantity::length, Range::positive());
    segment.inner_end =
        table.number_or("inner_end", segment.inner_start, Quantity::length, Range::not_negative());
    segment.elements = table.whole_or("elements", elements, 1, largest_count);
    segment.asymmetry = table.number_or("asymmetry", 0, Quantity::number, Range::inside(-1, 1));
    segment.asymmetry_angle = table.number_or("asymmetry_angle", 0, Quantity::angle);
    segment.material = pick_material(table, materials);
    segment.shear_coefficient = table.number_or("shear", 0, Quantity::number, Range::positive());
    const auto inner = table.optional_number("mass_inner", Quantity::length, Range::not_negative());
    const bool cylinder = segment.outer_start == segment.outer_end; // a cone has no one diameter
    segment.mass_inner = inner.value_or(0);
    segment.mass_outer = table.number_or("mass_outer", inner && cylinder ? segment.outer_start : 0,
                                         Quantity::length, Range::positive());
    check_diameters(segment, table);
    return segment;
}

const std::vector<CsvRule> station_columns{
    {"length", Quantity::length},         {"outer", Quantity::length},
    {"inner", Quantity::length},          {"outer_end", Quantity::length},
    {"inner_end", Quantity::length},      {"material", {}},
    {"elements", Quantity::number},       {"asymmetry", Quantity::number},
    {"asymmetry_angle", Quantity::angle}, {"shear", Quantity::number},
    {"mass_outer", Quantity::length},     {"mass_inner", Quantity::length}};

std::vector<model::Segment> read_stations(const CheckedEntry &asked, const Materials &materials,
                                          int elements) {
    CsvTable table(asked, station_columns);
    std::vector<model::Segment> segments;
    bool complete = table.usable();
    for (const std::string column : {"length", "outer"})
        if (complete && !table.has(column)) {
            table.fail(column, "missing, expected a column of lengths");
            complete = false;
        }
    if (complete)
        for (const CsvRow &row : table.rows())
            segments.push_back(read_segment(row, materials, elements));
    return segments;
}

void read_shear(CheckedTable &table, model::Shaft &shaft) {
    const Node *entry = table.find("shear");
    if (!entry || entry->text == "cowper")
        return;
    if (entry->text == "hutchinson") {
        shaft.shear = model::ShearFormula::hutchinson;
    } else if (entry->is_number()) {
        shaft.shear = model::ShearFormula::given;
        shaft.shear_coefficient = table.number("shear", Quantity::number, Range::positive());
    } else {
        table.fail("shear", "expected \"cowper\", \"hutchinson\" or a shear coefficient greater "
                            "than 0, got " +
                                shown(*entry));
    }
}

void read_order(CheckedTable &table, model::Shaft &shaft) {
    const Node *entry = table.find("order");
    shaft.order_auto = entry && entry->text == "auto";
    if (entry && entry->kind == Node::Kind::text && !shaft.order_auto)
        table.fail("order",
                   "expected a whole number from 1 to 30 or \"auto\", got " + shown(*entry));
    else if (entry && !shaft.order_auto)
        shaft.order = table.whole_or("order", shaft.order, 1, 30);
}

} // namespace

Materials read_materials(CheckedTable &root) {
    Materials materials;
    auto section = root.table("material");
    if (!section)
        return materials;
    for (const Node &entry : section->node().items)
        if (auto table = section->table(entry.key))
            materials.emplace(entry.key, read_material(*table, entry.key));
    return materials;
}

model::Material material_of(CheckedTable &table, const Materials &materials) {
    return pick_material(table, materials);
}

model::Shaft read_shaft(CheckedTable &root, const Materials &materials) {
    model::Shaft shaft;
    auto table = root.table("shaft");
    if (!table) {
        if (!root.has("shaft") && !measured_alone(root))
            root.fail("shaft", "missing, expected a section [shaft]");
        return shaft;
    }
    table->text("name");
    read_order(*table, shaft);
    read_shear(*table, shaft);
    shaft.tolerance =
        table->number_or("tolerance", shaft.tolerance, Quantity::number, Range::inside(0, 1));
    shaft.rigid = table->flag_or("rigid", false);
    shaft.rotary_inertia = table->flag_or("rotary_inertia", true);
    shaft.internal_damping =
        table->number_or("internal_damping", 0, Quantity::time, Range::not_negative());
    shaft.alpha = table->number_or("alpha", 0, Quantity::rate, Range::not_negative());
    shaft.beta = table->number_or("beta", 0, Quantity::time, Range::not_negative());
    shaft.modal_damping = table->numbers("modal_damping", Quantity::number, {0, 1, false, true});
    shaft.axial_force = table->number_or("axial_force", 0, Quantity::force);
    shaft.axial_torque = table->number_or("axial_torque", 0, Quantity::moment);
    shaft.torque_kind = static_cast<model::TorqueKind>(
        table->choice("torque_kind", {"axial", "semitangential", "tangential"}, 0));
    const int elements = table->whole_or("elements", 1, 1, largest_count);
    const auto stations = table->text_entry("table");
    if (table->has("table") == table->has("segments"))
        table->fail("segments", table->has("table")
                                    ? "expected either table or segments, got both"
                                    : "missing, expected a list of segments, or table");
    else if (stations)
        shaft.segments = read_stations(*stations, materials, elements);
    else
        read_each(*table, "segments", shaft.segments,
                  [&](CheckedTable &of, model::Segment &segment) {
                      of.text("name");
                      segment = read_segment(of, materials, elements);
                      read_layers(of, materials, segment);
                  });
    const Node *list = table->find("segments");
    if (list && list->is_list() && list->items.empty())
        table->fail("segments", "expected at least one segment, got none");
    table->refuse_unknown();
    return shaft;
}

} // namespace whirl::input
