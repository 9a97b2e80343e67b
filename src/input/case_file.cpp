#include "input/case_file.h"

#include "balancers/held.h"
#include "input/file_text.h"
#include "input/overrides.h"
#include "input/sections.h"
#include "input/toml_text.h"
#include "input/validate.h"
#include "model/errors.h"

#include <fmt/core.h>

namespace whirl::input {
namespace {

namespace fs = std::filesystem;

fs::path find_file(const fs::path &folder_or_file) {
    std::error_code ignored;
    const bool folder = fs::is_directory(folder_or_file, ignored);
    return (folder ? folder_or_file / "case.toml" : folder_or_file).lexically_normal();
}

std::string read_text(const fs::path &file, FileTexts &texts) {
    const auto &[text, mistake] = texts.of(file, largest_case);
    if (!mistake.empty())
        throw model::BadInput(fmt::format("{}: expected a case (a folder with a case.toml, or a "
                                          ".toml file), {}",
                                          file.generic_string(), mistake));
    return text;
}

/// The folder's name for a case.toml, else the file's without its ending.
std::string case_name(const fs::path &file) {
    const fs::path absolute = fs::absolute(file).lexically_normal();
    const bool in_folder = file.filename() == "case.toml" && absolute.has_parent_path();
    return in_folder ? absolute.parent_path().filename().string() : file.stem().string();
}

void read_format(CheckedTable &root) {
    const Node *format = root.find("format");
    if (!format)
        root.fail("format", "missing, expected format = 1");
    else if (format->kind != Node::Kind::integer || format->number != 1)
        root.fail("format", "expected 1, got " + shown(*format));
}

/// Reads [key] where the case has it.
void read_section(CheckedTable &root, const std::string &key,
                  void (*read)(CheckedTable &table, model::Case &scene), model::Case &scene) {
    auto table = root.table(key);
    if (!table)
        return;
    read(*table, scene);
    table->refuse_unknown();
}

} // namespace

model::Case read_case(CheckedTable &root) {
    model::Case scene;
    read_format(root);
    scene.title = root.text("title").value_or("");
    scene.formulation = static_cast<model::FormChoice>(root.choice(
        "formulation", {"auto", "planar", "hyperbolic", "general", "rotating", "hill"}, 0));
    scene.reduction = root.choice("reduction", {"auto", "off"}, 0) == 0;
    const Materials materials = read_materials(root);
    scene.rotor.shaft = read_shaft(root, materials);
    read_discs(root, materials, scene.rotor);
    read_bearings(root, scene.rotor);
    read_seals(root, scene.rotor);
    read_anisotropies(root, scene.rotor);
    read_balancers(root, scene.rotor);
    read_planes(root, scene.rotor);
    read_probes(root, scene.rotor);
    read_section(root, "speeds", read_speeds, scene);
    read_section(root, "operation", read_operation, scene);
    read_section(root, "limits", read_limits, scene);
    read_section(root, "level1", read_level1, scene);
    read_section(root, "standard", read_standard, scene);
    read_imbalances(root, scene);
    read_forces(root, scene.rotor);
    read_section(root, "campbell", read_campbell, scene);
    read_section(root, "modes", read_modes, scene);
    read_section(root, "critical_map", read_critical_map, scene);
    read_section(root, "units", read_units, scene);
    read_section(root, "response", read_response, scene);
    read_section(root, "simulate", read_simulate, scene);
    read_section(root, "balance", read_balance, scene);
    read_weights(root, scene);
    read_section(root, "states", read_states, scene);
    read_section(root, "map", read_map, scene);
    read_section(root, "samples", read_samples, scene);
    read_section(root, "sweep", read_sweep, scene);
    root.refuse_unknown();
    return scene;
}

CaseFile::CaseFile(const fs::path &folder_or_file)
    : _file(find_file(folder_or_file)), _tables(std::make_shared<FileTexts>()) {
    _text = read_text(_file, *_tables);
    _tree = std::make_shared<const Node>(parse_toml(_text, _file.generic_string()));
}

Node CaseFile::overridden(const std::vector<std::string> &overrides, Problems &problems) const {
    Node tree = *_tree;
    apply_overrides(tree, overrides, problems);
    return tree;
}

model::Case CaseFile::read(const Node &tree, ReadContext &context) const {
    context.folder = _file.parent_path();
    CheckedTable root({tree, "", context});
    model::Case scene = read_case(root);
    scene.file = _file;
    scene.name = case_name(_file);
    validate(scene, {tree, context.problems});
    return scene;
}

model::Case CaseFile::load(const std::vector<std::string> &overrides) const {
    Problems problems;
    const Node tree = overridden(overrides, problems);
    ReadContext context(tree, *_tables);
    context.problems = std::move(problems);
    model::Case scene = read(tree, context);
    context.problems.throw_if_any();
    scene.remarks = std::move(context.remarks);
    add_remarks(scene, tree);
    balancers::hold(scene);
    return scene;
}

std::string CaseFile::text(const std::vector<std::string> &overrides) const {
    if (overrides.empty())
        return _text;
    return to_toml(tree(overrides));
}

Node CaseFile::tree(const std::vector<std::string> &overrides) const {
    Problems problems;
    Node tree = overridden(overrides, problems);
    problems.throw_if_any();
    return tree;
}

std::string CaseFile::all_texts() const { return _tables->all(); }

std::vector<std::pair<std::string, std::string>> CaseFile::files() const {
    std::vector<std::pair<std::string, std::string>> all{{_file.filename().string(), _text}};
    for (const auto &[path, read] : _tables->texts())
        if (path != _file.string())
            all.emplace_back(
                fs::path(path).lexically_relative(_file.parent_path()).generic_string(), read.text);
    return all;
}

std::string CaseFile::with_place(const std::string &problem,
                                 const std::vector<std::string> &overrides) const {
    const std::string name = _file.generic_string();
    if (problem.starts_with(name + ":") && !problem.starts_with(name + ": "))
        return problem; // it has a line
    const std::string said =
        problem.starts_with(name + ": ") ? problem.substr(name.size() + 2) : problem;
    const std::string key = said.substr(0, said.find(": "));
    const bool is_key = key.find(' ') == key.npos && !parse_path(key).empty();
    return (is_key ? origin_of(tree(overrides), key) : Origin{name, 0}).text() + ": " + said;
}

model::OutputUnits output_units(const std::vector<std::string> &overrides) {
    Node tree = parse_toml("", "");
    FileTexts none;
    Problems problems;
    apply_overrides(tree, overrides, problems);
    ReadContext context(tree, none);
    context.problems = std::move(problems);
    CheckedTable root({tree, "", context});
    model::Case scene;
    read_section(root, "units", read_units, scene);
    context.problems.throw_if_any();
    return scene.units;
}

} // namespace whirl::input
