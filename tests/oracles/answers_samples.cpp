// Random rotors by the closed form of a rigid disc on one spring: sorted, counted off.

#include "oracles/answers.h"

#include <algorithm>
#include <cmath>
#include <random>
#include <stdexcept>
#include <utility>

namespace whirl::oracles {

namespace {

/// Share of a normal distribution below so many standard deviations.
Real normal_share(Real deviations) { return std::erfc(-deviations / std::sqrt(Real(2))) / 2; }

/// The inverse of normal_share, by halving.
Real normal_deviations(Real share) {
    Real low = -10;
    Real high = 10;
    for (int i = 0; i < 200; ++i) {
        const Real middle = (low + high) / 2;
        (normal_share(middle) < share ? low : high) = middle;
    }
    return (low + high) / 2;
}

Real &entry_of(const std::string &path, Real &k, Real &kt, Real &mass) {
    if (path == "bearing[0].k" || path == "bearing.k")
        return k;
    if (path == "bearing[0].kt" || path == "bearing.kt")
        return kt;
    if (path == "disc[0].mass" || path == "disc.mass")
        return mass;
    throw std::runtime_error("samples: no oracle where " + path + " varies");
}

Real drawn(const UncertainEntry &entry, Real share, Real in_case) {
    if (entry.distribution == "uniform")
        return entry.from + (Real(entry.to) - entry.from) * share;
    if (entry.distribution == "values")
        return entry.values.at(static_cast<std::size_t>(share * entry.values.size()));
    const Real mean = std::isnan(entry.mean) ? in_case : Real(entry.mean);
    return mean + entry.deviation * (entry.relative ? mean : 1) * normal_deviations(share);
}

/// Speeds of one rotor: translation forward and backward, tilt backward and forward.
std::vector<Real> speeds_of(const CaseRotor &rotor, int sample) {
    Real k = rotor.supports[0].k[0][0];
    Real kt = rotor.supports[0].kt[0][0];
    Real mass = rotor.discs[0].mass;
    // As docs/case_format.md says: the upper 52 of 64 bits, halfway between two steps.
    std::seed_seq key{rotor.samples.seed, sample};
    std::mt19937_64 bits(key);
    for (const UncertainEntry &entry : rotor.samples.vary) {
        const Real share = (Real(bits() / 4096) + Real(0.5)) / Real(4503599627370496.0);
        Real &value = entry_of(entry.path, k, kt, mass);
        value = drawn(entry, share, value);
    }
    const Real translation = std::sqrt(k / mass);
    return {translation, translation, std::sqrt(kt / (rotor.discs[0].Id + rotor.discs[0].Ip)),
            std::sqrt(kt / (rotor.discs[0].Id - rotor.discs[0].Ip))};
}

} // namespace

Answer answer_samples(const Request &request) {
    const CaseRotor &rotor = request.rotor;
    if (!rotor.rigid || rotor.supports.size() != 1 || rotor.discs.size() != 1 ||
        rotor.supports[0].z != rotor.discs[0].z)
        no_answer("samples: no oracle for this rotor");
    unsigned answer = 0;
    unsigned quantile = 0;
    if (std::sscanf(request.path.c_str(), "/answers/%u/quantiles/%u/value", &answer, &quantile) !=
        2)
        no_answer("samples: no oracle for " + request.path);
    std::vector<Real> values;
    for (int i = 0; i < rotor.samples.count; ++i)
        values.push_back(speeds_of(rotor, i).at(answer));
    std::sort(values.begin(), values.end());
    // The least at or below which so many samples lie, in thousandths.
    const auto thousandths = std::lround(1000 * rotor.samples.quantiles.at(quantile));
    const auto rank = static_cast<std::size_t>((thousandths * rotor.samples.count + 999) / 1000);
    return {"closed form of a disc on a spring, sorted", {values.at(rank - 1)}, {}, {}};
}

Answer answer_sweep(const Request &request) {
    const CaseRotor &rotor = request.rotor;
    unsigned answer = 0;
    unsigned row = 0;
    if (!rotor.rigid || rotor.supports.size() != 1 || rotor.discs.size() != 1 ||
        rotor.supports[0].z != rotor.discs[0].z || rotor.sweep.size() != 2 ||
        std::sscanf(request.path.c_str(), "/answers/%u/values/%u", &answer, &row) != 2)
        no_answer("sweep: no oracle for " + request.path);
    std::vector<Real> values;
    for (const double x : rotor.sweep[0].values) {
        Real k = rotor.supports[0].k[0][0];
        Real kt = rotor.supports[0].kt[0][0];
        Real mass = rotor.discs[0].mass;
        for (const auto &[axis, value] :
             {std::pair(rotor.sweep[0], x),
              std::pair(rotor.sweep[1], rotor.sweep[1].values.at(row))}) {
            Real &entry = entry_of(axis.path, k, kt, mass);
            entry = axis.change == "factor"  ? entry * value
                    : axis.change == "shift" ? entry + value
                                             : value;
        }
        std::vector<Real> speeds{std::sqrt(k / mass), std::sqrt(k / mass),
                                 std::sqrt(kt / (rotor.discs[0].Id + rotor.discs[0].Ip)),
                                 std::sqrt(kt / (rotor.discs[0].Id - rotor.discs[0].Ip))};
        std::sort(speeds.begin(), speeds.end());
        values.push_back(speeds.at(answer));
    }
    return {"closed form of a disc on a spring, sorted", values, {}, {}};
}

} // namespace whirl::oracles
