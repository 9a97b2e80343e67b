// What is said of reduction and completeness: over damped rotors drawn at random, whirl speeds,
// growth and peaks against the whole rotor solved densely, and every count of eigenvalues against
// that of the dense ones.
//
//   certificate [scenes [first]]       counts, worst ratios; exit status 1 where one does not hold

#include "linalg/session.h"
#include "properties/certificate_checks.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <exception>
#include <functional>
#include <map>

namespace {

using whirl::properties::Certified;
using whirl::properties::Counted;
using whirl::properties::Findings;

/// Of the numbers of one kind.
bool report(const std::string &what, std::vector<Certified> numbers) {
    const auto over = [](const Certified &c) { return c.error / (2 * c.stated + c.rounding); };
    std::sort(numbers.begin(), numbers.end(),
              [&](const auto &a, const auto &b) { return over(a) > over(b); });
    double largest = 0; // of those that rounding does not explain
    for (const Certified &c : numbers)
        if (c.error > c.rounding)
            largest = std::max(largest, (c.error - c.rounding) / c.stated);
    const auto broken = std::count_if(numbers.begin(), numbers.end(),
                                      [](const Certified &c) { return !c.holds(); });
    fmt::print("{:<24}{:>8} numbers, {} not held; beyond rounding at most {:.2g} of what is "
               "stated\n",
               what, numbers.size(), broken, largest);
    numbers.resize(std::min<std::size_t>(numbers.size(), 4));
    for (const Certified &c : numbers)
        fmt::print("    scene {:>5} at {:>12.6f} rad/s: true {:.1e}, stated {:.1e}, rounding "
                   "{:.1e}\n",
                   c.scene, c.speed, c.error, c.stated, c.rounding);
    return broken == 0;
}

bool report(const std::string &what, const std::vector<Counted> &counts) {
    int broken = 0;
    for (const Counted &c : counts) {
        if (c.counted == c.dense)
            continue;
        if (++broken <= 10)
            fmt::print("    {}: scene {} at {:.6f} rad/s: {} counted, {} dense\n", what, c.scene,
                       c.speed, c.counted, c.dense);
    }
    fmt::print("{:<28}{:>8} counts, {} wrong\n", what, counts.size(), broken);
    return broken == 0;
}

template <class One> std::map<std::string, std::vector<One>> by_kind(const std::vector<One> &all) {
    std::map<std::string, std::vector<One>> out;
    for (const One &one : all)
        out[one.what].push_back(one);
    return out;
}

} // namespace

int main(int argc, char **argv) {
    namespace properties = whirl::properties;
    const int scenes = argc > 1 ? std::atoi(argv[1]) : 1000;
    const int first = argc > 2 ? std::atoi(argv[2]) : 0;
    const whirl::linalg::Session session;
    Findings found;
    int refused = 0;
    for (int number = first; number < first + scenes; ++number) {
        const whirl::model::Case scene = properties::damped_scene(number);
        for (const auto check :
             {&properties::check_eigenvalues, &properties::check_winding, &properties::check_peaks})
            try {
                (*check)(scene, number, found);
            } catch (const std::exception &failure) {
                if (++refused <= 10)
                    fmt::print("no answer: scene {}: {}\n", number, failure.what());
            }
    }
    bool holds = true;
    for (const auto &[what, numbers] : by_kind(found.numbers))
        holds = report(what, numbers) && holds;
    for (const auto &[what, counts] : by_kind(found.counts))
        holds = report(what, counts) && holds;
    fmt::print("{} scenes, {} without an answer to one of the questions\n", scenes, refused);
    return holds && refused * 50 <= scenes ? 0 : 1;
}
