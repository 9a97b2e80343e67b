#include "analyses/samples/draws.h"

#include <boost/math/special_functions/erf.hpp>

#include <cstdint>
#include <numbers>
#include <random>

namespace whirl::analyses {

namespace {

/// Inside (0, 1), 2^52 places equally likely: with one bit more the last would round to 1. Own
/// transforms, here and below: those of the standard library differ between compilers.
double share_of(std::uint64_t bits) { return (static_cast<double>(bits >> 12U) + 0.5) * 0x1p-52; }

double value_of(const model::UncertainInput &input, double share) {
    switch (input.distribution) {
    case model::Distribution::normal:
        return input.mean -
               input.deviation * std::numbers::sqrt2 * boost::math::erfc_inv(2 * share);
    case model::Distribution::uniform:
        return input.from + (input.to - input.from) * share;
    case model::Distribution::values:
        break;
    }
    const auto place = static_cast<std::size_t>(share * static_cast<double>(input.values.size()));
    return input.values.at(place);
}

} // namespace

std::vector<double> draw(const model::SamplesSettings &settings, int sample) {
    std::seed_seq key{settings.seed, sample};
    std::mt19937_64 bits(key);
    std::vector<double> values;
    for (const model::UncertainInput &input : settings.vary)
        values.push_back(value_of(input, share_of(bits())));
    return values;
}

} // namespace whirl::analyses
