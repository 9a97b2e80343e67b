// How far printed errors hold: over rotors drawn at random, the error printed with each whirl speed
// and critical speed against the true one, from the exact solution of the continuum.
//
//   error_bars [rotors [first]]        counts, worst points; exit status 1 where they are too many
//   error_bars --case NUMBER           the case file of one of them

#include "linalg/session.h"
#include "properties/case_text.h"
#include "properties/error_points.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <map>

namespace {

using whirl::properties::ErrorPoint;
using whirl::properties::ErrorPoints;

/// Below this a true error is rounding of the eigenvalue itself and only has to be bounded.
constexpr double rounding_level = 1e-11;

/// How many points of a group, and how its errors stand against the printed ones.
struct Counts {
    int points = 0;
    int above = 0; ///< true error above the estimate
    int twice = 0; ///< above twice the estimate
    int sized = 0; ///< true error above rounding level
    int near = 0;  ///< of those, estimate within 10 times of it

    void add(const ErrorPoint &p) {
        ++points;
        above += p.error <= p.estimate ? 0 : 1; // also where none is printed
        twice += p.error <= 2 * p.estimate ? 0 : 1;
        if (p.error <= rounding_level)
            return;
        ++sized;
        near += p.estimate <= 10 * p.error && p.estimate >= p.error / 10 ? 1 : 0;
    }
    [[nodiscard]] bool holds() const {
        return 100 * above <= points && twice == 0 && 10 * near >= 9 * sized;
    }
    [[nodiscard]] std::string row(const std::string &name) const {
        return fmt::format("{:<34}{:>8}{:>8}{:>8}{:>10}{:>10} {:>6.1f} %  {}\n", name, points,
                           above, twice, sized, near, sized > 0 ? 100.0 * near / sized : 100.0,
                           holds() ? "" : "too many");
    }
};

std::string kind_name(whirl::properties::Kind kind) {
    switch (kind) {
    case whirl::properties::Kind::isotropic:
        return "isotropic";
    case whirl::properties::Kind::orthotropic:
        return "orthotropic";
    default:
        return "damped";
    }
}

void print_counts(const std::vector<ErrorPoint> &points) {
    std::map<std::string, Counts> groups;
    for (const ErrorPoint &p : points) {
        groups["1 " + p.what].add(p);
        groups["2 " + kind_name(p.kind)].add(p);
        groups[fmt::format("3 order {:>2}", p.order)].add(p);
    }
    fmt::print("{:<34}{:>8}{:>8}{:>8}{:>10}{:>10}\n", "", "points", "above", "twice", "sized",
               "within 10");
    for (const auto &[name, counts] : groups)
        fmt::print("{}", counts.row(name.substr(2)));
}

void print_worst(std::vector<ErrorPoint> points, bool above) {
    const auto rank = [above](const ErrorPoint &p) {
        const double ratio = p.error / p.estimate;
        if (std::isnan(ratio))
            return p.error > 0 ? 1e300 : 0.0;
        if (!above)
            return p.error > rounding_level ? 1 / ratio : 0.0;
        return ratio;
    };
    std::sort(points.begin(), points.end(),
              [&](const ErrorPoint &a, const ErrorPoint &b) { return rank(a) > rank(b); });
    points.resize(std::min<std::size_t>(points.size(), 10));
    fmt::print("\nWorst, {}:\n{:>6} {:<12}{:>6} {:<20}{:>9} {:<10}{:>14}{:>18}{:>18}{:>10}{:>10}\n",
               above ? "error above the estimate" : "estimate above the error", "rotor", "bearings",
               "order", "where", "mode", "", "speed", "printed", "true", "estimate", "error");
    for (const ErrorPoint &p : points)
        fmt::print(
            "{:>6} {:<12}{:>6} {:<20}{:>9} {:<10}{:>14.6f}{:>18.9f}{:>18.9f}{:>10.1e}{:>10.1e}\n",
            p.rotor, kind_name(p.kind), p.order, p.what, p.mode, p.sense, p.speed, p.printed,
            p.truth, p.estimate, p.error);
}

/// Counts by class, worst points; whether the printed errors hold.
bool report(const char *title, const std::vector<ErrorPoint> &points) {
    fmt::print("\n{}\n", title);
    print_counts(points);
    Counts all;
    for (const ErrorPoint &p : points)
        all.add(p);
    fmt::print("{}", all.row("all"));
    print_worst(points, true);
    print_worst(points, false);
    return all.holds();
}

/// order = "auto": every error within the tolerance of its case.
bool report_automatic(const std::vector<ErrorPoint> &points) {
    const auto missed = std::count_if(points.begin(), points.end(),
                                      [](const ErrorPoint &p) { return !(p.error <= p.estimate); });
    fmt::print("\norder = \"auto\": {} points, {} with an error above the tolerance\n",
               points.size(), missed);
    if (missed > 0)
        print_worst(points, true);
    return missed == 0;
}

void print_refusals(const std::vector<std::string> &refusals) {
    fmt::print("\nNo answer: {}\n", refusals.size());
    for (std::size_t i = 0; i < std::min<std::size_t>(refusals.size(), 20); ++i)
        fmt::print("  {}\n", refusals[i]);
}

void append(ErrorPoints from, int rotor, std::vector<ErrorPoint> &points,
            std::vector<std::string> &refusals) {
    points.insert(points.end(), from.points.begin(), from.points.end());
    for (const std::string &text : from.refusals)
        refusals.push_back(fmt::format("rotor {}: {}", rotor, text));
}

} // namespace

int main(int argc, char **argv) {
    namespace properties = whirl::properties;
    if (argc == 3 && std::string(argv[1]) == "--case") {
        fmt::print("{}", properties::case_text(properties::random_case(std::atoi(argv[2]))));
        return 0;
    }
    const int rotors = argc > 1 ? std::atoi(argv[1]) : 320;
    const int first = argc > 2 ? std::atoi(argv[2]) : 0;
    const whirl::linalg::Session session;
    std::vector<ErrorPoint> whirl_speeds, critical, automatic, damped;
    std::vector<std::string> refusals;
    for (int number = first; number < first + rotors; ++number) {
        const whirl::model::Case scene = properties::random_case(number);
        if (properties::kind_of(number) == properties::Kind::damped) {
            append(properties::damped_points(scene, number), number, damped, refusals);
            continue;
        }
        std::vector<ErrorPoint> points;
        append(properties::undamped_points(scene, number), number, points, refusals);
        for (const ErrorPoint &p : points)
            (p.what == "critical" ? critical : whirl_speeds).push_back(p);
        if (number % 4 == 0)
            append(properties::automatic_points(scene, number), number, automatic, refusals);
    }
    bool holds = report("Whirl speeds of campbell, undamped", whirl_speeds);
    holds = report("Critical speeds", critical) && holds;
    holds = report("Eigenvalues of campbell, damped", damped) && holds;
    holds = report_automatic(automatic) && holds;
    print_refusals(refusals);
    return holds ? 0 : 1;
}
