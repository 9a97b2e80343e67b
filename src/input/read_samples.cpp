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

void read_normal(CheckedTable &table, Quantity quantity, model::UncertainInput &input) {
    const bool relative = table.flag_or("relative", false);
    const Node *in_case = find_path(table.context().tree, input.path);
    const auto usual = in_case ? number_of(*in_case, quantity) : std::nullopt;
    constexpr double wrong = std::numeric_limits<double>::quiet_NaN(); // told where it stands
    input.mean = table.number_or("mean", usual.value_or(wrong), quantity);
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
    if (!list || (list->is_list() && list->items.empty()))
        table.fail("values", list ? "expected at least one value, got none"
                                  : "missing, expected a list of values");
}

/// One entry of `vary`. Its numbers are read where its path and distribution are known.
model::UncertainInput read_input(CheckedTable &table,
                                 const std::map<std::string, Quantity> &entries) {
    model::UncertainInput input;
    const auto path = table.text("path");
    if (!table.has("path"))
        table.fail("path", "missing, expected a numeric entry of the case");
    const auto quantity = path ? quantity_of_entry(table, *path, entries, "") : std::nullopt;
    const std::size_t none = distribution_words.size();
    const std::size_t kind = table.choice("distribution", distribution_words, none);
    if (!table.has("distribution"))
        table.fail("distribution", fmt::format("missing, expected \"{}\"",
                                               fmt::join(distribution_words, "\" or \"")));
    if (!quantity || kind == none)
        return input;
    input.path = *path;
    input.quantity = in_results(*quantity);
    input.distribution = static_cast<model::Distribution>(kind);
    if (input.distribution == model::Distribution::normal)
        read_normal(table, *quantity, input);
    else if (input.distribution == model::Distribution::uniform)
        read_uniform(table, *quantity, input);
    else
        read_values(table, *quantity, input);
    table.refuse_unknown();
    return input;
}

void read_inputs(CheckedTable &table, const std::map<std::string, Quantity> &entries,
                 model::SamplesSettings &samples) {
    const Node *list = table.find("vary");
    if (!list || (list->is_list() && list->items.empty()))
        table.fail("vary", list ? "expected at least one entry of the case, got none"
                                : "missing, expected a list of tables {path, distribution, ...}");
    for (CheckedTable &item : table.tables("vary")) {
        model::UncertainInput input = read_input(item, entries);
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
    const auto list = table.entry("of");
    if (!list)
        return;
    if (list->items().empty())
        list->fail(fmt::format("expected a list of \"{}\", got {}",
                               fmt::join(answer_words, "\" or \""), shown(list->node)));
    const std::array wanted{&samples.critical, &samples.peaks, &samples.ends, &samples.residual};
    samples.critical = false;
    for (const CheckedEntry &item : list->items()) {
        const auto found = std::ranges::find(answer_words, item.node.text);
        if (found != answer_words.end())
            *wanted[static_cast<std::size_t>(found - answer_words.begin())] = true;
        else
            item.fail(one_of(answer_words, item.node));
    }
}

void read_quantiles(CheckedTable &table, model::SamplesSettings &samples) {
    if (!table.has("quantiles"))
        return;
    std::vector<double> shares =
        table.numbers("quantiles", Quantity::dimensionless, Range::inside(0, 1));
    const Node *list = table.find("quantiles");
    if (list->is_list() && list->items.empty())
        table.fail("quantiles", "expected at least one number in (0, 1), got none");
    std::ranges::sort(shares);
    shares.erase(std::unique(shares.begin(), shares.end()), shares.end());
    samples.quantiles = std::move(shares);
}

} // namespace

void read_samples(CheckedTable &table, model::Case &scene) {
    // Taken before its own numbers are read. Those of the map are not used with samples.
    std::map<std::string, Quantity> entries = table.context().numeric;
    std::erase_if(entries, [](const auto &entry) { return entry.first.starts_with("map."); });
    model::SamplesSettings samples;
    samples.count = table.whole("count", 1, largest_count);
    samples.seed = table.whole_or("seed", 1, 0, std::numeric_limits<int>::max());
    read_wanted(table, samples);
    read_quantiles(table, samples);
    read_inputs(table, entries, samples);
    scene.samples = std::move(samples);
}

} // namespace whirl::input
