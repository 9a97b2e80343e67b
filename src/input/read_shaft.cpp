#include "input/csv_table.h"
#include "input/sections.h"
#include "input/validate.h"

#include <fmt/core.h>

#include <algorithm>

namespace whirl::input {
namespace {

model::Material read_material(CheckedTable table, const std::string &name) {
    model::Material material;
    material.name = name;
    material.E = table.number("E", Quantity::pressure, Range::positive());
    material.rho = table.number("rho", Quantity::density, Range::positive());
    const auto nu = table.optional_number("nu", Quantity::dimensionless, {0, 0.5, false, true});
    const auto shear = table.optional_number("G", Quantity::pressure, Range::positive());
    if (!table.has("nu") && !table.has("G"))
        table.fail("G", "missing, expected a pressure in Pa greater than 0, or nu");
    material.G = shear.value_or(material.E / (2 * (1 + nu.value_or(0))));
    if (shear)
        check_shear_modulus(material, nu, origin_of(table.node(), "G"), table.path_of("G"),
                            table.context().problems);
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
std::vector<model::Layer> read_layers(CheckedTable &table_of_segment, const model::Segment &segment,
                                      const Materials &materials) {
    std::vector<model::Layer> layers;
    std::vector<Ring> taken{{std::min(segment.inner_start, segment.inner_end),
                             std::max(segment.outer_start, segment.outer_end)}};
    double inside = taken.front().outer;
    for (CheckedTable &table : table_of_segment.tables("layers")) {
        model::Layer layer;
        table.text("name");
        layer.outer = table.number("outer", Quantity::length, Range::positive());
        layer.inner = table.number_or("inner", inside, Quantity::length, Range::not_negative());
        if (layer.inner >= layer.outer)
            table.fail("outer",
                       fmt::format("expected a diameter above the inner one, {:.6g} m, got "
                                   "{:.6g} m",
                                   layer.inner, layer.outer));
        else
            check_free(layer, taken, table);
        layer.material = material_of(table, materials).value_or(model::Material{});
        table.refuse_unknown();
        inside = layer.outer;
        taken.push_back({layer.inner, layer.outer});
        layers.push_back(layer);
    }
    return layers;
}

/// What a segment has mass for, where that is not what carries load, and its shear coefficient.
/// @param number  (name, range), empty for what is not given
template <class Number> void read_departures(const Number &number, model::Segment &segment) {
    segment.shear_coefficient = number("shear", Range::positive()).value_or(0);
    const std::optional<double> inner = number("mass_inner", Range::not_negative());
    const bool cylinder = segment.outer_start == segment.outer_end; // a cone has no one diameter
    segment.mass_inner = inner.value_or(0);
    segment.mass_outer = number("mass_outer", Range::positive())
                             .value_or(inner && cylinder ? segment.outer_start : 0);
}

std::vector<model::Segment> read_segments(CheckedTable &shaft, const Materials &materials,
                                          int elements) {
    std::vector<model::Segment> segments;
    ReadContext &context = shaft.context();
    for (CheckedTable &table : shaft.tables("segments")) {
        model::Segment segment;
        table.text("name");
        segment.length = table.number("length", Quantity::length, Range::positive());
        segment.outer_start = table.number("outer", Quantity::length, Range::positive());
        segment.inner_start = table.number_or("inner", 0, Quantity::length, Range::not_negative());
        segment.outer_end =
            table.number_or("outer_end", segment.outer_start, Quantity::length, Range::positive());
        segment.inner_end = table.number_or("inner_end", segment.inner_start, Quantity::length,
                                            Range::not_negative());
        segment.elements = table.whole_or("elements", elements, 1, largest_count);
        segment.asymmetry =
            table.number_or("asymmetry", 0, Quantity::dimensionless, Range::inside(-1, 1));
        segment.asymmetry_angle = table.number_or("asymmetry_angle", 0, Quantity::angle);
        segment.material = material_of(table, materials).value_or(model::Material{});
        read_departures(
            [&table](const std::string &name, Range range) {
                return table.optional_number(
                    name, name == "shear" ? Quantity::dimensionless : Quantity::length, range);
            },
            segment);
        segment.layers = read_layers(table, segment, materials);
        table.refuse_unknown();
        check_mass_diameters(segment, origin_of(table.node(), "mass_inner"),
                             table.path_of("mass_inner"), context.problems);
        check_segment(segment, origin_of(table.node(), "inner"), table.path_of("inner"),
                      context.problems);
        segments.push_back(segment);
    }
    return segments;
}

const std::vector<CsvRule> station_columns{
    {"length", Quantity::length},          {"outer", Quantity::length},
    {"inner", Quantity::length},           {"outer_end", Quantity::length},
    {"inner_end", Quantity::length},       {"material", {}},
    {"elements", Quantity::dimensionless}, {"asymmetry", Quantity::dimensionless},
    {"asymmetry_angle", Quantity::angle},  {"shear", Quantity::dimensionless},
    {"mass_outer", Quantity::length},      {"mass_inner", Quantity::length}};

model::Segment read_station(CsvTable &table, std::size_t row, const Materials &materials,
                            int elements, ReadContext &context) {
    model::Segment segment;
    segment.length = table.number(row, "length", Range::positive());
    segment.outer_start = table.number(row, "outer", Range::positive());
    segment.inner_start = table.optional_number(row, "inner", Range::not_negative()).value_or(0);
    segment.outer_end =
        table.optional_number(row, "outer_end", Range::positive()).value_or(segment.outer_start);
    segment.inner_end = table.optional_number(row, "inner_end", Range::not_negative())
                            .value_or(segment.inner_start);
    segment.asymmetry = table.optional_number(row, "asymmetry", Range::inside(-1, 1)).value_or(0);
    segment.asymmetry_angle =
        table.optional_number(row, "asymmetry_angle", Range::any()).value_or(0);
    const std::string name = table.text(row, "material");
    segment.material = pick_material(materials, name.empty() ? std::nullopt : std::optional(name),
                                     table.origin(row), "material", context.problems)
                           .value_or(model::Material{});
    read_departures([&](const std::string &column,
                        Range range) { return table.optional_number(row, column, range); },
                    segment);
    segment.elements = elements;
    if (const auto count = table.optional_number(row, "elements", {1, largest_count})) {
        segment.elements = static_cast<int>(std::max(1.0, *count));
        if (segment.elements < *count)
            context.problems.add(table.origin(row), "elements",
                                 fmt::format("expected a whole number, got {}", *count));
    }
    check_segment(segment, table.origin(row), "inner", context.problems);
    check_mass_diameters(segment, table.origin(row), "mass_inner", context.problems);
    return segment;
}

std::vector<model::Segment> read_stations(const std::string &path, const Materials &materials,
                                          int elements, ReadContext &context) {
    const auto file = (context.folder / path).lexically_normal();
    CsvTable table(file, station_columns, context.problems);
    std::vector<model::Segment> segments;
    bool complete = table.usable();
    for (const std::string column : {"length", "outer"})
        if (complete && !table.has(column)) {
            context.problems.add(table.header_origin(), column,
                                 "missing, expected a column of lengths");
            complete = false;
        }
    for (std::size_t row = 0; complete && row < table.rows(); ++row)
        segments.push_back(read_station(table, row, materials, elements, context));
    return segments;
}

void read_shear(CheckedTable &table, model::Shaft &shaft) {
    const Node *entry = table.find("shear");
    if (!entry || (entry->kind == Node::Kind::text && entry->text == "cowper"))
        return;
    if (entry->kind == Node::Kind::text && entry->text == "hutchinson") {
        shaft.shear = model::ShearFormula::hutchinson;
    } else if (entry->is_number()) {
        shaft.shear = model::ShearFormula::given;
        shaft.shear_coefficient = table.number("shear", Quantity::dimensionless, Range::positive());
    } else {
        table.fail("shear", "expected \"cowper\", \"hutchinson\" or a shear coefficient greater "
                            "than 0, got " +
                                shown(*entry));
    }
}

void read_order(CheckedTable &table, model::Shaft &shaft) {
    const Node *entry = table.find("order");
    shaft.order_auto = entry && entry->kind == Node::Kind::text && entry->text == "auto";
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

std::optional<model::Material> pick_material(const Materials &materials,
                                             const std::optional<std::string> &name,
                                             const Origin &origin, const std::string &key,
                                             Problems &problems) {
    if (!name && materials.size() == 1)
        return materials.begin()->second;
    std::vector<std::string> names;
    for (const auto &entry : materials)
        names.push_back(entry.first);
    if (!name) {
        problems.add(origin, key,
                     materials.empty()
                         ? "missing, expected a section [material.NAME]"
                         : "missing, expected the name of a material" + suggestion("", names));
        return std::nullopt;
    }
    const auto found = materials.find(*name);
    if (found != materials.end())
        return found->second;
    problems.add(origin, key,
                 "expected the name of a material, got " + in_quotes(*name) +
                     suggestion(*name, names));
    return std::nullopt;
}

std::optional<model::Material> material_of(CheckedTable &table, const Materials &materials) {
    return pick_material(materials, table.text("material"), origin_of(table.node(), "material"),
                         table.path_of("material"), table.context().problems);
}

model::Shaft read_shaft(CheckedTable &root, const Materials &materials) {
    model::Shaft shaft;
    auto table = root.table("shaft");
    if (!table) {
        if (!root.has("shaft"))
            root.fail("shaft", "missing, expected a section [shaft]");
        return shaft;
    }
    table->text("name");
    read_order(*table, shaft);
    read_shear(*table, shaft);
    shaft.tolerance = table->number_or("tolerance", shaft.tolerance, Quantity::dimensionless,
                                       Range::inside(0, 1));
    shaft.rigid = table->flag_or("rigid", false);
    shaft.rotary_inertia = table->flag_or("rotary_inertia", true);
    shaft.internal_damping =
        table->number_or("internal_damping", 0, Quantity::time, Range::not_negative());
    shaft.alpha = table->number_or("alpha", 0, Quantity::rate, Range::not_negative());
    shaft.beta = table->number_or("beta", 0, Quantity::time, Range::not_negative());
    shaft.modal_damping =
        table->numbers("modal_damping", Quantity::dimensionless, {0, 1, false, true});
    shaft.axial_force = table->number_or("axial_force", 0, Quantity::force);
    shaft.axial_torque = table->number_or("axial_torque", 0, Quantity::torque);
    shaft.torque_kind = static_cast<model::TorqueKind>(
        table->choice("torque_kind", {"axial", "semitangential", "tangential"}, 0));
    const int elements = table->whole_or("elements", 1, 1, largest_count);
    const auto path = table->text("table");
    if (table->has("table") == table->has("segments"))
        table->fail("segments", table->has("table")
                                    ? "expected either table or segments, got both"
                                    : "missing, expected a list of segments, or table");
    else if (path)
        shaft.segments = read_stations(*path, materials, elements, table->context());
    else
        shaft.segments = read_segments(*table, materials, elements);
    const Node *list = table->find("segments");
    if (list && list->kind == Node::Kind::list && list->items.empty())
        table->fail("segments", "expected at least one segment, got none");
    table->refuse_unknown();
    return shaft;
}

} // namespace whirl::input
