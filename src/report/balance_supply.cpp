#include "report/balance_supply.h"

#include "report/common/csv.h"
#include "report/common/html.h"
#include "report/common/words.h"
#include "report/sections.h"

#include <fmt/format.h>

#include <algorithm>
#include <complex>

namespace whirl::report {

using results::BalanceResult;
using results::BalanceSupply;
using results::LeftAt;
using results::LeftMotion;
using results::PlaneSupply;

namespace {

std::vector<std::optional<double>> sizes(const PlaneSupply::Moments &moments) {
    std::vector<std::optional<double>> out;
    for (const auto &moment : moments)
        out.push_back(moment ? std::optional(std::abs(*moment)) : std::nullopt);
    return out;
}

std::optional<double> direction(const std::optional<std::complex<double>> &moment) {
    return moment ? phase_of(*moment) : std::nullopt;
}

std::vector<std::optional<double>> directions(const PlaneSupply::Moments &moments) {
    std::vector<std::optional<double>> out;
    for (const auto &moment : moments)
        out.push_back(direction(moment));
    return out;
}

std::optional<double> share_of(const PlaneSupply &plane,
                               const std::optional<std::complex<double>> &moment) {
    return moment && plane.capacity && *plane.capacity > 0
               ? std::optional(std::abs(*moment) / *plane.capacity)
               : std::nullopt;
}

Json moments_json(const PlaneSupply &plane, const PlaneSupply::Moments &moments,
                  const Units &units) {
    std::vector<std::optional<double>> shares;
    for (const auto &moment : moments)
        shares.push_back(share_of(plane, moment));
    return {{"mr", written(units, Quantity::imbalance, sizes(moments))},
            {"phase", written(units, Quantity::angle, directions(moments))},
            {"share", shares}};
}

/// What one plane needs at one speed.
struct Need {
    std::string plane;
    double z = 0, speed = 0;
    std::optional<std::complex<double>> needed, beside;
    std::optional<double> capacity, share;
    bool works = false;
};

/// Where balls that resist rolling rest at one speed.
struct Rest {
    std::string plane;
    double speed = 0;
    std::optional<double> residual, from, to;
};

const Columns<Rest> rest_columns{
    {ForReaders("Plane"), &Rest::plane},
    {ForReaders("Speed"), Quantity::speed, &Rest::speed},
    {ForReaders("Left at most", "{:.4g}"), Quantity::amplitude, &Rest::residual},
    {ForReaders("Balls rest from", "{:.5g}"), Quantity::angle, &Rest::from},
    {ForReaders("to", "{:.5g}"), Quantity::angle, &Rest::to}};

/// What a place does at one speed.
struct Left {
    std::string of, name;
    double z = 0, speed = 0;
    std::optional<double> nothing, weights, balancers, both;
    std::string supply; ///< how far the balancers get
    bool works = false;
    /// Of a bearing the forces, N.
    std::optional<double> force_nothing{}, force_weights{}, force_balancers{}, force_both{};
};

std::optional<double> size_of(const std::optional<std::complex<double>> &moment) {
    return moment ? std::optional(std::abs(*moment)) : std::nullopt;
}

const Columns<Need> need_columns{
    {InCsv("plane"), ForReaders("Plane"), &Need::plane},
    {InCsv("speed"), ForReaders("Speed"), Quantity::speed, &Need::speed},
    {InCsv("needed"), ForReaders("Needed", "{:.5g}"), Quantity::imbalance,
     [](const Need &need) { return size_of(need.needed); }},
    {InCsv("phase"), ForReaders("Phase", "{:.2f}"), Quantity::angle,
     [](const Need &need) { return direction(need.needed); }},
    {InCsv("capacity"), Quantity::imbalance, &Need::capacity},
    {InCsv("share"), Quantity::number, &Need::share},
    {ForReaders("Of what there is (%)", "{:.4g}"), Quantity::number, in(100, &Need::share)},
    {InCsv("needed_beside_weights"), ForReaders("Beside the weights", "{:.5g}"),
     Quantity::imbalance, [](const Need &need) { return size_of(need.beside); }},
    {InCsv("phase_beside_weights"), Quantity::angle,
     [](const Need &need) { return direction(need.beside); }},
    {InCsv("works"), &Need::works},
    {ForReaders("Criterion"), [](const Need &need) { return need.works ? "holds" : "does not"; }}};

const Columns<Left> left_columns{
    {ForReaders("Place"), &Left::name},
    {ForReaders("Speed"), Quantity::speed, &Left::speed},
    {ForReaders("Nothing", "{:.4g}"), Quantity::amplitude, &Left::nothing},
    {ForReaders("Weights", "{:.4g}"), Quantity::amplitude, &Left::weights},
    {ForReaders("Balancers", "{:.4g}"), Quantity::amplitude, &Left::balancers},
    {ForReaders("Both", "{:.4g}"), Quantity::amplitude, &Left::both},
    {ForReaders("Balancers get"), &Left::supply}};

const Columns<Left> left_file_columns{
    {InCsv("of"), &Left::of},
    {InCsv("name"), &Left::name},
    {InCsv("z"), Quantity::length, &Left::z},
    {InCsv("speed"), Quantity::speed, &Left::speed},
    {InCsv("nothing"), Quantity::amplitude, &Left::nothing},
    {InCsv("weights"), Quantity::amplitude, &Left::weights},
    {InCsv("balancers"), Quantity::amplitude, &Left::balancers},
    {InCsv("both"), Quantity::amplitude, &Left::both},
    {InCsv("force_nothing"), Quantity::force, &Left::force_nothing},
    {InCsv("force_weights"), Quantity::force, &Left::force_weights},
    {InCsv("force_balancers"), Quantity::force, &Left::force_balancers},
    {InCsv("force_both"), Quantity::force, &Left::force_both},
    {InCsv("supply"), &Left::supply},
    {InCsv("works"), &Left::works}};

std::vector<Need> needs_of(const BalanceResult &result, const std::vector<std::size_t> &speeds) {
    std::vector<Need> out;
    for (std::size_t p = 0; p < result.planes.size(); ++p) {
        const PlaneSupply &plane = result.supply->planes[p];
        for (const std::size_t k : speeds)
            out.push_back({model::name_or_number(result.planes[p].name, "plane", p),
                           result.planes[p].z, result.speeds[k], plane.needed[k],
                           plane.beside_weights[k], plane.capacity,
                           share_of(plane, plane.needed[k]), result.supply->works[k]});
    }
    return out;
}

std::vector<Rest> rests_of(const BalanceResult &result, const std::vector<std::size_t> &speeds) {
    std::vector<Rest> out;
    for (std::size_t p = 0; p < result.planes.size(); ++p)
        for (const std::size_t k : speeds)
            if (const auto &friction = result.supply->planes[p].friction; !friction.empty()) {
                out.push_back({model::name_or_number(result.planes[p].name, "plane", p),
                               result.speeds[k],
                               {},
                               {},
                               {}});
                if (friction[k]) {
                    out.back().residual = friction[k]->residual;
                    out.back().from = friction[k]->from;
                    out.back().to = friction[k]->to;
                }
            }
    return out;
}

void add_left(const BalanceResult &result, const LeftAt &at, const std::vector<std::size_t> &speeds,
              std::vector<Left> &out) {
    for (const std::size_t k : speeds) {
        out.push_back({at.of, at.name, at.z, result.speeds[k], at.amplitude.nothing[k],
                       at.amplitude.weights[k], at.amplitude.balancers[k], at.amplitude.both[k],
                       results::supply_name(result.supply->with_balancers[k]),
                       static_cast<bool>(result.supply->works[k])});
        if (!at.force)
            continue;
        Left &last = out.back();
        last.force_nothing = at.force->nothing[k];
        last.force_weights = at.force->weights[k];
        last.force_balancers = at.force->balancers[k];
        last.force_both = at.force->both[k];
    }
}

/// For readers: the places that count.
std::vector<Left> left_for_readers(const BalanceResult &result, std::size_t most_places,
                                   std::size_t most_speeds) {
    std::vector<Left> out;
    for (const LeftAt *at : places_for_readers(*result.supply, most_places))
        add_left(result, *at, spread_over(result.speeds.size(), most_speeds), out);
    return out;
}

Json motion_json(const LeftMotion &motion, Quantity quantity, const Units &units) {
    return {{"nothing", written(units, quantity, motion.nothing)},
            {"weights", written(units, quantity, motion.weights)},
            {"balancers", written(units, quantity, motion.balancers)},
            {"both", written(units, quantity, motion.both)}};
}

Json names_json(const std::vector<results::Supply> &supplies) {
    return json_list(supplies, [](results::Supply of) { return results::supply_name(of); });
}

const char *rest_heading = "Rest positions by friction: what is left in any of them; of two balls, "
                           "one from the imbalance, while the other mirrors it";
const char *needs_heading = "What the balancers must supply, and what there is of it";
const char *left_heading = "What stays: with nothing, the best weights, the balancers, and both";

/// Rows that somebody reads.
constexpr std::size_t most_speeds = 9;
constexpr std::size_t most_places = 4;

} // namespace

std::vector<const LeftAt *> places_for_readers(const BalanceSupply &supply, std::size_t most) {
    std::vector<const LeftAt *> out;
    for (const char *of : {"probe", "bearing", "plane"}) {
        if (std::string(of) == "bearing" && !out.empty())
            break;
        for (const LeftAt &left : supply.left)
            if (left.of == of && out.size() < most)
                out.push_back(&left);
    }
    return out;
}

Json plane_supply_json(const BalanceResult &result, std::size_t plane, const Units &units) {
    Json out{{"needed", nullptr},   {"needed_beside_weights", nullptr},
             {"capacity", nullptr}, {"least", nullptr},
             {"weight", nullptr},   {"friction", nullptr}};
    if (!result.supply)
        return out;
    const PlaneSupply &of = result.supply->planes[plane];
    out["needed"] = moments_json(of, of.needed, units);
    out["needed_beside_weights"] = moments_json(of, of.beside_weights, units);
    out["capacity"] = written(units, Quantity::imbalance, of.capacity);
    if (of.capacity)
        out["least"] = written(units, Quantity::imbalance, of.least);
    if (!of.friction.empty()) {
        const auto list = [&](Quantity quantity, auto results::RestWithFriction::*value) {
            std::vector<std::optional<double>> values;
            for (const auto &rest : of.friction) {
                values.emplace_back();
                if (rest)
                    values.back() = (*rest).*value;
            }
            return written(units, quantity, values);
        };
        using results::RestWithFriction;
        out["friction"] = {{"residual", list(Quantity::amplitude, &RestWithFriction::residual)},
                           {"from", list(Quantity::angle, &RestWithFriction::from)},
                           {"to", list(Quantity::angle, &RestWithFriction::to)}};
    }
    if (of.weight)
        out["weight"] = {{"mr", written(units, Quantity::imbalance, std::abs(*of.weight))},
                         {"phase", written(units, Quantity::angle, direction(of.weight))}};
    return out;
}

Json supply_json(const BalanceResult &result, const Units &units) {
    if (!result.supply)
        return {{"phase", nullptr},  {"residual", nullptr},
                {"supply", nullptr}, {"supply_beside_weights", nullptr},
                {"works", nullptr},  {"residual_weight_speeds", nullptr}};
    const BalanceSupply &supply = *result.supply;
    return {{"phase", phase_word(supply.lag)},
            {"residual",
             json_list(supply.left,
                       [&units](const LeftAt &at) {
                           Json row{{"of", at.of},
                                    {"name", at.name},
                                    {"z", written(units, Quantity::length, at.z)}};
                           take_entries(row, motion_json(at.amplitude, Quantity::amplitude, units));
                           row["force"] =
                               at.force ? motion_json(*at.force, Quantity::force, units) : Json();
                           return row;
                       })},
            {"supply", names_json(supply.with_balancers)},
            {"supply_beside_weights", names_json(supply.with_both)},
            {"works", supply.works},
            {"residual_weight_speeds", written(units, Quantity::speed, supply.weight_speeds)}};
}

std::string supply_text(const BalanceResult &result, const Units &units) {
    if (!result.supply)
        return "";
    return text_table(fmt::format("\n{}:\n", needs_heading), need_columns,
                      needs_of(result, spread_over(result.speeds.size(), most_speeds)), units) +
           phase_convention(result.supply->lag) + "\n" +
           text_table(fmt::format("\n{}:\n", rest_heading), rest_columns,
                      rests_of(result, spread_over(result.speeds.size(), most_speeds)), units) +
           text_table(fmt::format("\n{}:\n", left_heading), left_columns,
                      left_for_readers(result, most_places, most_speeds), units);
}

std::vector<Section> supply_sections(const BalanceResult &result, const Units &units) {
    if (!result.supply)
        return {};
    constexpr std::size_t on_page = 21; // speeds
    std::vector<Section> out{
        {needs_heading,
         page_table(need_columns, needs_of(result, spread_over(result.speeds.size(), on_page)),
                    units) +
             element("p", phase_convention(result.supply->lag))}};
    add_table(out, rest_heading, rest_columns,
              rests_of(result, spread_over(result.speeds.size(), on_page)), units);
    out.push_back(
        {left_heading,
         page_table(left_columns, left_for_readers(result, most_places, on_page), units)});
    return out;
}

std::vector<TableFile> supply_tables(const BalanceResult &result) {
    if (!result.supply)
        return {};
    const std::vector<std::size_t> all = spread_over(result.speeds.size(), result.speeds.size());
    return {{"balance_needed",
             [&result, all](const Units &units) {
                 return csv_table(need_columns, needs_of(result, all), units);
             }},
            {"balance_residual", [&result, all](const Units &units) {
                 std::vector<Left> rows;
                 for (const LeftAt &at : result.supply->left)
                     add_left(result, at, all, rows);
                 return csv_table(left_file_columns, rows, units);
             }}};
}

} // namespace whirl::report
