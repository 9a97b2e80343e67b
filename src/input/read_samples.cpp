#include "input/sections.h"

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace whirl::input {

namespace {

const std::vector<std::string> distribution_words{"normal", "uniform", "values"};
const std::vector<std::string> answer_words{"critical", "peaks", "ends", "residual"};

/// The value that the entry has in the case; nan where it is wrong, which is told elsewhere.
double value_in_case(const CheckedTable &root, const std::string &path, Quantity quantity) {
    const Node *node = find_path(root.node(), path);
    if (node && node->is_number())
        return node->number;
    if (node && node->kind == Node::Kind::text)
        if (const auto value = parse_quantity(node->text, quantity))
            return *value;
    return std::numeric_limits<double>::quiet_NaN();
}

/// "N/m" of "a stiffness in N/m".
std::string unit_of(Quantity quantity) {
    const std::string words = describe(quantity);
    const std::size_t in = words.find(" in ");
    return in == std::string::npos ? "" : words.substr(in + 4);
}

void read_normal(CheckedTable &table, double in_case, Quantity quantity,
                 model::UncertainInput &input) {
    const bool relative = table.flag_or("relative", false);
    input.mean = table.number_or("mean", in_case, quantity);
    input.deviation =
        table.number("deviation", relative ? Quantity::dimensionless : quantity, Range::positive());
    if (!relative)
        return;
    input.deviation *= std::abs(input.mean);
    if (input.mean == 0)
        table.fail("relative", "expected a mean other than 0 for a deviation that is a share of "
                               "it, got 0");
}

void read_uniform(CheckedTable &table, Quantity quantity, model::UncertainInput &input) {
    input.from = table.number("from", quantity);
    input.to = table.number("to", quantity);
    if (input.to <= input.from)
        table.fail("to", fmt::format("expected more than from = {}, got {}", input.from, input.to));
}

void read_values(CheckedTable &table, Quantity quantity, model::UncertainInput &input) {
    input.values = table.numbers("values", quantity);
    const Node *list = table.find("values");
    if (!list || (list->kind == Node::Kind::list && list->items.empty()))
        table.fail("values", list ? "expected at least one value, got none"
                                  : "missing, expected a list of values");
}

/// One entry of `vary`. Its numbers are read where its path and distribution are known.
model::UncertainInput read_input(CheckedTable &table, const CheckedTable &root,
                                 const std::map<std::string, Quantity> &entries) {
    constexpr std::array known{model::Distribution::normal, model::Distribution::uniform,
                               model::Distribution::values};
    model::UncertainInput input;
    const auto path = table.text("path");
    if (!table.has("path"))
        table.fail("path", "missing, expected a numeric entry of the case");
    const auto quantity = path ? quantity_of_entry(table, *path, entries, "") : std::nullopt;
    const std::size_t kind = table.choice("distribution", distribution_words, known.size());
    if (!table.has("distribution"))
        table.fail("distribution", fmt::format("missing, expected \"{}\"",
                                               fmt::join(distribution_words, "\" or \"")));
    if (!quantity || kind == known.size())
        return input;
    input.path = *path;
    input.unit = unit_of(*quantity);
    input.distribution = known[kind];
    if (input.distribution == model::Distribution::normal)
        read_normal(table, value_in_case(root, *path, *quantity), *quantity, input);
    else if (input.distribution == model::Distribution::uniform)
        read_uniform(table, *quantity, input);
    else
        read_values(table, *quantity, input);
    table.refuse_unknown();
    return input;
}

void read_inputs(CheckedTable &table, const CheckedTable &root,
                 const std::map<std::string, Quantity> &entries, model::SamplesSettings &samples) {
    const Node *list = table.find("vary");
    if (!list || (list->kind == Node::Kind::list && list->items.empty()))
        table.fail("vary", list ? "expected at least one entry of the case, got none"
                                : "missing, expected a list of tables {path, distribution, ...}");
    for (CheckedTable &item : table.tables("vary")) {
        model::UncertainInput input = read_input(item, root, entries);
        const bool twice = std::ranges::any_of(samples.vary, [&input](const auto &before) {
            return !input.path.empty() && before.path == input.path;
        });
        if (twice)
            item.fail("path", "expected each entry once, got " + in_quotes(input.path) + " twice");
        samples.vary.push_back(std::move(input));
    }
}

/// Which answers are wanted.
void read_wanted(CheckedTable &table, model::SamplesSettings &samples) {
    const Node *list = table.find("of");
    if (!list)
        return;
    if (list->kind != Node::Kind::list || list->items.empty()) {
        table.fail("of", fmt::format("expected a list of \"{}\", got {}",
                                     fmt::join(answer_words, "\" or \""), shown(*list)));
        return;
    }
    const std::array wanted{&samples.critical, &samples.peaks, &samples.ends, &samples.residual};
    samples.critical = false;
    for (std::size_t i = 0; i < list->items.size(); ++i) {
        const Node &item = list->items[i];
        const auto found = std::ranges::find(answer_words, item.text);
        if (item.kind == Node::Kind::text && found != answer_words.end())
            *wanted[static_cast<std::size_t>(found - answer_words.begin())] = true;
        else
            table.context().problems.add(item.origin, fmt::format("{}[{}]", table.path_of("of"), i),
                                         one_of(answer_words, item));
    }
}

void read_quantiles(CheckedTable &table, model::SamplesSettings &samples) {
    if (!table.has("quantiles"))
        return;
    std::vector<double> shares =
        table.numbers("quantiles", Quantity::dimensionless, Range::inside(0, 1));
    const Node *list = table.find("quantiles");
    if (list->kind == Node::Kind::list && list->items.empty())
        table.fail("quantiles", "expected at least one number in (0, 1), got none");
    std::ranges::sort(shares);
    shares.erase(std::unique(shares.begin(), shares.end()), shares.end());
    samples.quantiles = std::move(shares);
}

} // namespace

void read_samples(CheckedTable &root, model::Case &scene) {
    auto table = root.table("samples");
    if (!table)
        return;
    // Taken before its own numbers are read. Those of the map are not used with samples.
    std::map<std::string, Quantity> entries = root.context().numeric;
    std::erase_if(entries, [](const auto &entry) { return entry.first.starts_with("map."); });
    model::SamplesSettings samples;
    samples.count = table->whole("count", 1, largest_count);
    samples.seed = table->whole_or("seed", 1, 0, std::numeric_limits<int>::max());
    read_wanted(*table, samples);
    read_quantiles(*table, samples);
    read_inputs(*table, root, entries, samples);
    table->refuse_unknown();
    scene.samples = std::move(samples);
}

} // namespace whirl::input
