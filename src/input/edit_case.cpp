// What a program with fields for the numbers of a case needs of its file: the numbers as they were
// written, and the file with other values in their places.

#include "input/case_file.h"
#include "input/checked_table.h"
#include "input/overrides.h"
#include "input/toml_text.h"
#include "model/errors.h"

#include <fmt/core.h>

#include <algorithm>

namespace whirl::input {
namespace {

/// "drive end" of bearing[0], where it has a name.
std::string name_at(const Node &tree, const std::string &path) {
    const Node *item = find_path(tree, path);
    const Node *name = item == nullptr ? nullptr : item->find("name");
    return name != nullptr && name->kind == Node::Kind::text ? name->text : "";
}

/// "bearing 1, drive end" of "bearing[0].k"; "the case" of what stands in no section.
std::string group_of(const Node &tree, const std::string &path) {
    std::vector<PathStep> steps = parse_path(path);
    while (!steps.empty() && steps.back().key.empty()) // an item of a list of numbers
        steps.pop_back();
    if (steps.size() < 2)
        return "the case";
    steps.pop_back();
    std::string text, walked;
    for (const PathStep &step : steps) {
        if (step.key.empty()) {
            const std::size_t index = step.index.value_or(0);
            walked += fmt::format("[{}]", index);
            const std::string name = name_at(tree, walked);
            text += fmt::format(" {}{}", index + 1, name.empty() ? "" : ", " + name);
        } else {
            walked += (walked.empty() ? "" : ".") + step.key;
            text += (text.empty() ? "" : " ") + step.key;
        }
    }
    return text;
}

/// Equal but for where they stand, and whether 1 or 1.0 was written.
bool same(const Node &a, const Node &b) {
    if ((a.kind != b.kind && !(a.is_number() && b.is_number())) || a.text != b.text ||
        a.number != b.number || a.flag != b.flag || a.items.size() != b.items.size())
        return false;
    return std::ranges::all_of(a.items, [&](const Node &item) {
        const auto place = static_cast<std::size_t>(&item - a.items.data());
        const Node *other = a.kind == Node::Kind::table ? b.find(item.key) : &b.items[place];
        return other != nullptr && item.key == other->key && same(item, *other);
    });
}

/// An override apart.
struct EditedEntry {
    std::string path;
    std::string value;
};

EditedEntry entry_of(const std::string &text) {
    const std::size_t equals = std::min(text.find('='), text.size());
    return {std::string(trimmed(std::string_view(text).substr(0, equals))),
            std::string(trimmed(std::string_view(text).substr(std::min(equals + 1, text.size()))))};
}

/// The value as the user gave it where that is TOML, in quotation marks where it is a text.
std::string toml_of(const std::string &value) {
    const Node node = parse_value(value, {});
    const bool plain = node.kind == Node::Kind::text && node.text == value;
    const bool needs_no_escape = std::ranges::none_of(value, [](char letter) {
        return letter == '"' || letter == '\\' || static_cast<unsigned char>(letter) < ' ';
    });
    if (plain && needs_no_escape) // as cases are written; the library prefers '...'
        return "\"" + value + "\"";
    const bool in_one_line = value.find_first_of("#\n\r") == std::string::npos;
    return plain || !in_one_line ? value_text(node) : value;
}

/// A document that is edited entry by entry.
class EditedText {
  public:
    explicit EditedText(std::string text) : _text(std::move(text)) {}

    /// @returns false where there is no place for it
    bool set(const std::string &path, const std::string &value) {
        const auto places = text_places(_text);
        if (const auto at = places.find(path); at != places.end()) {
            if (at->second.kind == TextPlace::Kind::header)
                return false;
            _text.replace(at->second.begin, at->second.end - at->second.begin, value);
            return true;
        }
        return add(places, path, value);
    }
    [[nodiscard]] const std::string &text() const { return _text; }

  private:
    std::string _text;

    bool add(const std::map<std::string, TextPlace> &places, const std::string &path,
             const std::string &value) {
        const std::size_t dot = path.rfind('.');
        const std::string key = dot == std::string::npos ? path : path.substr(dot + 1);
        if (key.find('[') != std::string::npos)
            return false;
        const std::string entry = key_text(key) + " = " + value;
        if (dot == std::string::npos) {
            _text.insert(0, entry + "\n");
            return true;
        }
        const std::string table = path.substr(0, dot);
        const auto at = places.find(table);
        if (at == places.end())
            return add_section(table, entry);
        if (at->second.kind == TextPlace::Kind::value)
            return false;
        if (at->second.kind == TextPlace::Kind::inline_table) {
            const std::size_t last = _text.find_last_not_of(" \t\n\r", at->second.end - 2);
            const bool empty = last <= at->second.begin;
            _text.insert(last + 1, (empty ? "" : ", ") + entry);
            return true;
        }
        const std::size_t end = _text.find('\n', at->second.end);
        if (end == std::string::npos)
            _text += "\n" + entry + "\n";
        else
            _text.insert(end + 1, entry + "\n");
        return true;
    }

    /// Sections may stand in any order, items of lists not.
    bool add_section(const std::string &table, const std::string &entry) {
        if (table.find('[') != std::string::npos)
            return false;
        std::string header;
        for (const PathStep &step : parse_path(table))
            header += (header.empty() ? "" : ".") + key_text(step.key);
        _text += (_text.ends_with('\n') || _text.empty() ? "" : "\n") +
                 fmt::format("\n[{}]\n{}\n", header, entry);
        return true;
    }
};

} // namespace

std::optional<NumberParts> number_parts(const std::string &value) {
    const Node node = parse_value(value, {});
    if (node.is_number())
        return NumberParts{node.number, ""};
    const std::optional<LeadingNumber> number = leading_number(node.text);
    return number ? std::optional(NumberParts{number->value, number->rest}) : std::nullopt;
}

std::vector<Problem> CaseFile::problems(const std::vector<std::string> &overrides) const {
    Problems problems;
    const Node tree = overridden(overrides, problems);
    ReadContext context(tree, *_tables);
    context.problems = std::move(problems);
    (void)read(tree, context);
    return context.problems.sorted();
}

std::vector<WrittenNumber> CaseFile::numbers(const std::vector<std::string> &overrides) const {
    Problems problems;
    const Node tree = overridden(overrides, problems);
    ReadContext context(tree, *_tables);
    context.problems = std::move(problems);
    (void)read(tree, context);
    context.problems.throw_if_any();
    const auto places = text_places(_text);
    std::vector<std::pair<std::size_t, WrittenNumber>> found;
    for (const auto &[path, quantity] : context.numeric) {
        const Node *node = find_path(tree, path);
        // Of some entries a word or a flag is as good as a number: order = "auto".
        if (node == nullptr || !(node->is_number() || leading_number(node->text)))
            continue;
        WrittenNumber number{path,     group_of(tree, path),         node->text,
                             quantity, context.whole.contains(path), node->origin.line};
        const auto at = places.find(path);
        const bool stands = at != places.end() && node->origin.line > 0;
        if (node->is_number())
            number.text = stands ? _text.substr(at->second.begin, at->second.end - at->second.begin)
                                 : value_text(*node);
        found.emplace_back(at != places.end() ? at->second.begin : _text.size(), number);
    }
    std::ranges::stable_sort(found, {}, [](const auto &entry) { return entry.first; });
    std::vector<WrittenNumber> numbers;
    for (auto &[place, number] : found)
        numbers.push_back(std::move(number));
    return numbers;
}

std::string CaseFile::edited(const std::vector<std::string> &overrides) const {
    (void)load(overrides); // what is written can be read
    const std::string name = _file.generic_string();
    EditedText edited(_text);
    for (const std::string &text : overrides) {
        const EditedEntry entry = entry_of(text);
        Node tree = parse_toml(edited.text(), name);
        Problems problems;
        bool done = !entry.value.empty(); // an empty one takes entries out
        if (done)
            for (const std::string &path :
                 set_entries(tree, entry.path, entry.value, {"--set " + text, 0}, problems))
                done = edited.set(path, toml_of(entry.value)) && done;
        if (!done)
            throw model::BadInput(
                fmt::format("--set {}: expected an entry that the case file has, or one in a "
                            "section: it cannot "
                            "be written into the file with all else left as it is",
                            text));
    }
    Problems problems;
    if (!same(parse_toml(edited.text(), name), overridden(overrides, problems)))
        throw model::BadInput(fmt::format("{}: its text does not take these values with all else "
                                          "left as it is: {} has to be edited by hand",
                                          name, _file.filename().string()));
    return edited.text();
}

} // namespace whirl::input
