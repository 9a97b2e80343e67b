#include "input/sections.h"

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <set>

namespace whirl::input {

namespace {

const std::vector<std::string> distribution_words{"normal", "uniform", "values"};
const std::vector<std::string> answer_words{"critical", "peaks",   "ends",     "residual",
                                            "damping",  "margins", "operating"};

void read_normal(CheckedTable &table, const NumericEntries &entries, model::UncertainInput &input) {
    const Quantity quantity = entries.quantity;
    const bool relative = table.flag_or("relative", false);
    if (const auto usual = value_in_case(entries, table.context().tree);
        usual && !table.has("mean"))
        input.mean = *usual;
    else
        input.mean = table.number("mean", quantity);
    input.deviation =
        table.number("deviation", relative ? Quantity::number : quantity, Range::positive());
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
/// @param varied  paths of the entries that others of `vary` change; gets those of this one
model::UncertainInput read_input(CheckedTable &table, std::set<std::string> &varied) {
    model::UncertainInput input;
    const auto path = table.text("path");
    if (!table.has("path"))
        table.fail("path", "missing, expected a numeric entry of the case");
    const auto entries = path ? numeric_entries(table, *path, "") : std::nullopt;
    const std::size_t none = distribution_words.size();
    const std::size_t kind = table.choice("distribution", distribution_words, none);
    if (!table.has("distribution"))
        table.fail("distribution", fmt::format("missing, expected \"{}\"",
                                               fmt::join(distribution_words, "\" or \"")));
    if (!entries || kind == none)
        return input;
    std::string twice;
    for (const std::string &own : entries->paths)
        if (!varied.insert(own).second)
            twice = own;
    if (!twice.empty())
        table.fail("path", "expected each entry once, got " + in_quotes(twice) + " twice");
    input.path = *path;
    input.quantity = entries->quantity;
    input.distribution = static_cast<model::Distribution>(kind);
    if (input.distribution == model::Distribution::normal)
        read_normal(table, *entries, input);
    else if (input.distribution == model::Distribution::uniform)
        read_uniform(table, entries->quantity, input);
    else
        read_values(table, entries->quantity, input);
    table.refuse_unknown();
    return input;
}

void read_inputs(CheckedTable &table, model::SamplesSettings &samples) {
    const Node *list = table.find("vary");
    if (!list || (list->is_list() && list->items.empty()))
        table.fail("vary", list ? "expected at least one entry of the case, got none"
                                : "missing, expected a list of tables {path, distribution, ...}");
    std::set<std::string> varied;
    for (CheckedTable &item : table.tables("vary"))
        samples.vary.push_back(read_input(item, varied));
}

void read_quantiles(CheckedTable &table, model::SamplesSettings &samples) {
    if (!table.has("quantiles"))
        return;
    std::vector<double> shares = table.numbers("quantiles", Quantity::number, Range::inside(0, 1));
    const Node *list = table.find("quantiles");
    if (list->is_list() && list->items.empty())
        table.fail("quantiles", "expected at least one number in (0, 1), got none");
    std::ranges::sort(shares);
    shares.erase(std::unique(shares.begin(), shares.end()), shares.end());
    samples.quantiles = std::move(shares);
}

} // namespace

std::optional<double> value_in_case(const NumericEntries &entries, const Node &tree) {
    std::optional<double> value;
    for (const std::string &path : entries.paths) {
        const Node *own = find_path(tree, path);
        if (!own)
            return std::nullopt;
        constexpr double wrong = std::numeric_limits<double>::quiet_NaN();
        const double given = number_of(*own, entries.quantity).value_or(wrong);
        if (value && given != *value)
            return std::nullopt;
        value = given;
    }
    return value;
}

void read_wanted(CheckedTable &table, const model::Case &scene, model::WantedAnswers &wanted) {
    if (const auto list = table.entry("of")) {
        if (list->items().empty())
            list->fail(fmt::format("expected a list of \"{}\", got {}",
                                   fmt::join(answer_words, "\" or \""), shown(list->node)));
        const std::array flags{&wanted.critical, &wanted.peaks,   &wanted.ends,
                               &wanted.residual, &wanted.damping, &wanted.margins,
                               &wanted.operating};
        wanted.critical = false;
        for (const CheckedEntry &item : list->items()) {
            const auto found = std::ranges::find(answer_words, item.node.text);
            if (found != answer_words.end())
                *flags.at(static_cast<std::size_t>(found - answer_words.begin())) = true;
            else
                item.fail(one_of(answer_words, item.node));
        }
    }
    for (const auto &[asked, word] :
         {std::pair(wanted.margins, "margins"), std::pair(wanted.operating, "operating")})
        if (asked && !scene.operation)
            table.fail("of", fmt::format("expected operating speeds in [operation] for \"{}\", got "
                                         "none",
                                         word));
    if (table.has("at")) // of the damping alone
        wanted.at = table.numbers("at", Quantity::speed);
    else if (scene.operation) {
        wanted.at = {scene.operation->from, scene.operation->to};
    } else if (scene.speeds) {
        wanted.at = {scene.speeds->to};
    } else if (wanted.damping) {
        table.fail("at", "missing, expected spin speeds at which the damping is wanted");
    }
}

void read_samples(CheckedTable &table, model::Case &scene) {
    model::SamplesSettings samples;
    samples.count = table.whole("count", 1, largest_count);
    samples.seed = table.whole_or("seed", 1, 0, std::numeric_limits<int>::max());
    read_wanted(table, scene, samples.of);
    read_quantiles(table, samples);
    read_inputs(table, samples);
    scene.samples = std::move(samples);
}

} // namespace whirl::input
