// Times of analyses in units of a dense eigendecomposition measured beside them, and against dense
// routes to the same numbers: ./run benchmark_ratios

#include "benchmarks/stopwatch.h"
#include "benchmarks/workloads.h"
#include "linalg/session.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <chrono>
#include <exception>
#include <fstream>
#include <limits>
#include <optional>
#include <stdexcept>

namespace whirl::benchmarks {

namespace {

constexpr double never = std::numeric_limits<double>::infinity();

struct Options {
    int rounds = 3;
    double once = 5;   ///< s; what takes longer runs once
    double limit = 80; ///< s of wall time after which no further round is begun
    std::string csv, json;
    std::vector<std::string> names; ///< empty: all
};

/// Least times of a workload and of what it is compared with, measured before and after each run.
struct Row {
    Workload workload;
    double run = never, unit = never, dense = never;

    [[nodiscard]] double seconds() const { return run / workload.parts; }
    [[nodiscard]] double units() const { return seconds() / unit; }
    [[nodiscard]] std::optional<double> ratio() const {
        if (workload.dense.solves == 0)
            return std::nullopt;
        return workload.dense.solves * dense / run;
    }
};

void keep_least(double &least, const std::function<void()> &call) {
    least = std::min(least, processor_seconds_of(call));
}

void measure(Row &row, const std::function<void()> &unit) {
    const auto beside = [&] {
        for (int i = 0; i < 3; ++i)
            keep_least(row.unit, unit);
        if (row.workload.dense.solves > 0)
            keep_least(row.dense, row.workload.dense.solve);
    };
    beside();
    keep_least(row.run, row.workload.run);
    beside();
}

std::vector<Row> rows_asked_for(const std::string &folder, const Options &options) {
    std::vector<Row> rows;
    for (const Workload &workload : all_workloads(folder))
        if (options.names.empty() || std::ranges::count(options.names, workload.name) > 0)
            rows.push_back({workload});
    if (!options.names.empty() && rows.size() < options.names.size())
        throw std::runtime_error("there is no workload of one of these names");
    return rows;
}

std::vector<Row> measured(const std::string &folder, const Options &options) {
    std::vector<Row> rows = rows_asked_for(folder, options);
    const std::function<void()> unit = unit_of_time(folder);
    const auto start = std::chrono::steady_clock::now();
    for (int round = 0; round < options.rounds; ++round)
        for (Row &row : rows) {
            const std::chrono::duration<double> passed = std::chrono::steady_clock::now() - start;
            if (round == 0 || (row.run < options.once && passed.count() < options.limit))
                measure(row, unit);
        }
    return rows;
}

std::string text_of(const std::vector<Row> &rows) {
    std::string text =
        fmt::format("{:<22}{:>12}{:>12}{:>14}\n", "workload", "seconds", "units", "dense route");
    for (const Row &row : rows) {
        const std::optional<double> ratio = row.ratio();
        text += fmt::format("{:<22}{:>12.4f}{:>12.4g}{:>14}\n", row.workload.name, row.seconds(),
                            row.units(), ratio ? fmt::format("{:.3g} x", *ratio) : "-");
    }
    return text;
}

std::string csv_of(const std::vector<Row> &rows) {
    std::string text = "workload,seconds,units,dense_ratio,what\n";
    for (const Row &row : rows) {
        const std::optional<double> ratio = row.ratio();
        text +=
            fmt::format("{},{:.4g},{:.4g},{},{}\n", row.workload.name, row.seconds(), row.units(),
                        ratio ? fmt::format("{:.4g}", *ratio) : "", row.workload.what);
    }
    return text;
}

std::string json_of(const std::vector<Row> &rows) {
    nlohmann::ordered_json list = nlohmann::ordered_json::array();
    for (const Row &row : rows) {
        const std::optional<double> ratio = row.ratio();
        list.push_back({{"workload", row.workload.name},
                        {"what", row.workload.what},
                        {"seconds", row.seconds()},
                        {"unit_seconds", row.unit},
                        {"units", row.units()},
                        {"dense_ratio", nullptr}});
        if (ratio)
            list.back()["dense_ratio"] = *ratio;
    }
    return list.dump(2) + "\n";
}

void write(const std::string &path, const std::string &text) {
    if (path.empty())
        return;
    std::ofstream file(path);
    file << text;
    file.close();
    if (!file)
        throw std::runtime_error("cannot write " + path);
}

int main_of(int argc, char **argv) {
    Options options;
    CLI::App app("Times of analyses as ratios");
    app.add_option("--rounds", options.rounds, "runs of each workload")->check(CLI::PositiveNumber);
    app.add_option("--once", options.once, "seconds; what takes longer runs once");
    app.add_option("--limit", options.limit, "seconds after which no further round is begun");
    app.add_option("--csv", options.csv, "table for tests/benchmarks/check_ratios.sh");
    app.add_option("--json", options.json, "the same as JSON");
    app.add_option("workload", options.names, "these alone");
    CLI11_PARSE(app, argc, argv);
    try {
        const linalg::Session session;
        const std::vector<Row> rows = measured(WHIRL_ROOT "/cases", options);
        fmt::print("{}", text_of(rows));
        write(options.csv, csv_of(rows));
        write(options.json, json_of(rows));
        return 0;
    } catch (const std::exception &problem) {
        fmt::print(stderr, "whirl_ratios: {}\n", problem.what());
        return 1;
    }
}

} // namespace

} // namespace whirl::benchmarks

int main(int argc, char **argv) { return whirl::benchmarks::main_of(argc, argv); }
