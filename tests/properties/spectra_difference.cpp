#include "properties/spectra_difference.h"
#include "results/campbell.h"
#include "results/critical.h"
#include "results/whirl.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>

namespace whirl::properties {

namespace {

using Complex = std::complex<double>;

struct Item {
    Complex value;
    double error = 0; ///< absolute
    results::Whirl whirl = results::Whirl::mixed;
    bool used = false;
};

void sort_by_frequency(std::vector<Item> &items) {
    std::sort(items.begin(), items.end(),
              [](const Item &a, const Item &b) { return a.value.imag() < b.value.imag(); });
}

std::vector<Item> items_at(const results::CampbellResult &result, std::size_t k) {
    std::vector<Item> items;
    for (const results::CampbellMode &mode : result.modes)
        if (mode.frequency[k]) {
            const Complex value(mode.real[k].value_or(0), *mode.frequency[k]);
            items.push_back(
                {value, mode.error[k].value_or(0) * std::abs(value), mode.whirl[k], false});
        }
    sort_by_frequency(items);
    return items;
}

/// Something else lies so close that the sense of whirl of either is not defined, or within the
/// error bars, so that it is not known which is which.
bool crowded(const std::vector<Item> &items, const Item &item, double bar) {
    const double close = std::max(1e-4 * std::abs(item.value), 2 * bar);
    return std::count_if(items.begin(), items.end(), [&](const Item &other) {
               return std::abs(other.value - item.value) < close;
           }) > 1;
}

/// The nearest one left, of the same sense of whirl if there is such a one within the error bars.
Item *partner(const Item &item, std::vector<Item> &others, double rounding) {
    const auto distance = [&](const Item &other) { return std::abs(other.value - item.value); };
    Item *nearest = nullptr;
    Item *alike = nullptr;
    for (Item &other : others) {
        if (other.used)
            continue;
        if (nearest == nullptr || distance(other) < distance(*nearest))
            nearest = &other;
        const bool same =
            other.whirl == item.whirl && distance(other) <= item.error + other.error + rounding;
        if (same && (alike == nullptr || distance(other) < distance(*alike)))
            alike = &other;
    }
    return alike != nullptr ? alike : nearest;
}

/// The `count` lowest of a against all of b; `near_end` of them may have left b's list.
std::string unmatched(const std::vector<Item> &a, std::vector<Item> b, std::size_t count,
                      const Allowance &allowance) {
    for (std::size_t i = 0; i < std::min(count, a.size()); ++i) {
        const Item &item = a[i];
        const double size = std::abs(item.value);
        Item *nearest = partner(item, b, allowance.relative * size);
        if (!nearest)
            return fmt::format("{:.10g}{:+.10g}i has no partner", item.value.real(),
                               item.value.imag());
        nearest->used = true;
        const double difference = std::abs(nearest->value - item.value);
        const double bar = item.error + nearest->error + allowance.relative * size;
        if (!(difference <= bar))
            return fmt::format("{:.10g}{:+.10g}i becomes {:.10g}{:+.10g}i, by {:.1e} of its size "
                               "with bars of {:.1e}",
                               item.value.real(), item.value.imag(), nearest->value.real(),
                               nearest->value.imag(), difference / size, bar / size);
        if (allowance.whirl && item.whirl != nearest->whirl && !crowded(a, item, bar))
            return fmt::format("{:.10g}{:+.10g}i is {} and becomes {}", item.value.real(),
                               item.value.imag(), results::whirl_name(item.whirl),
                               results::whirl_name(nearest->whirl));
    }
    return {};
}

std::string both_ways(const std::vector<Item> &a, const std::vector<Item> &b, std::size_t count,
                      const Allowance &allowance) {
    std::string difference = unmatched(a, b, count, allowance);
    if (difference.empty() && !allowance.more_in_second)
        difference = unmatched(b, a, count, allowance);
    return difference;
}

} // namespace

std::string spectra_difference(const results::CampbellResult &a,
                               const std::vector<std::size_t> &places_a,
                               const results::CampbellResult &b,
                               const std::vector<std::size_t> &places_b, int modes,
                               const Allowance &allowance) {
    for (std::size_t i = 0; i < places_a.size(); ++i) {
        const std::string difference = both_ways(items_at(a, places_a[i]), items_at(b, places_b[i]),
                                                 static_cast<std::size_t>(modes), allowance);
        if (!difference.empty())
            return fmt::format("at {:.6g} rad/s {}", a.speeds[places_a[i]], difference);
    }
    return {};
}

std::string critical_difference(const results::CriticalResult &a, const results::CriticalResult &b,
                                int modes, const Allowance &allowance) {
    const auto items = [](const results::CriticalResult &result) {
        std::vector<Item> out;
        for (const results::CriticalSpeed &c : result.critical_speeds) {
            const Complex value(c.real, c.speed);
            out.push_back({value, c.error * std::abs(value), c.whirl, false});
        }
        sort_by_frequency(out);
        return out;
    };
    return both_ways(items(a), items(b), static_cast<std::size_t>(modes), allowance);
}

std::string crossing_difference(const results::CampbellResult &a, const results::CampbellResult &b,
                                double relative) {
    const auto items = [relative](const results::CampbellResult &result) {
        std::vector<Item> out;
        for (const results::Crossing &c : result.crossings)
            out.push_back({Complex(0, c.speed), relative * c.speed, results::Whirl::mixed, false});
        sort_by_frequency(out);
        return out;
    };
    const std::vector<Item> first = items(a);
    return both_ways(first, items(b), std::numeric_limits<std::size_t>::max(), {});
}

} // namespace whirl::properties
