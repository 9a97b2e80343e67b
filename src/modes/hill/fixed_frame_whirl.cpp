#include "modes/hill/fixed_frame_whirl.h"

#include "assembly/hill_system.h"
#include "assembly/planes.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace whirl::modes {

namespace {

using assembly::i_unit;
using Complex = std::complex<double>;

/// x(t) + i y(t) = with exp(l t) + against exp(conj(l) t) for (x, y)(t) = Re(term exp(l t)).
struct Whirls {
    Eigen::VectorXcd with, against;

    explicit Whirls(const Eigen::VectorXcd &term) {
        const assembly::Planes planes(term);
        with = planes.towards() / 2;
        against = planes.against().conjugate() / 2;
    }
};

} // namespace

Eigen::VectorXcd FixedFrameWhirl::shape() const {
    // x = Re(w exp(i turn t)), y = Im: for a turn against the positive sense
    // x = Re(conj(w) exp(i |turn| t)), y = Re(i conj(w) exp(...)).
    const bool positive = turn >= 0;
    const auto half = [](const Eigen::VectorXcd &w, bool with) -> Eigen::VectorXcd {
        const Eigen::VectorXcd x = with ? w : Eigen::VectorXcd(w.conjugate());
        return assembly::in_pairs(x, with ? Eigen::VectorXcd(-i_unit * x)
                                          : Eigen::VectorXcd(i_unit * x));
    };
    Eigen::VectorXcd out = half(circle, positive);
    if (straight)
        out += half(opposite, !positive);
    return out;
}

FixedFrameWhirl fixed_frame_whirl(const Stations &stations, const Eigen::MatrixXcd &terms,
                                  Eigen::Index place, double frequency, double speed) {
    const Whirls whirls(terms.col(place));
    const double with = stations.deflection_energy(whirls.with);
    const double against = stations.deflection_energy(whirls.against);
    const bool first = with >= equal_share * against;
    FixedFrameWhirl out;
    out.turn = speed + (first ? frequency : -frequency);
    out.other = speed - (first ? frequency : -frequency);
    out.size = first ? with : against;
    out.other_size = first ? against : with;
    out.circle = first ? whirls.with : whirls.against;
    const Eigen::Index neighbour = first ? place + 1 : place - 1;
    if (neighbour < 0 || neighbour >= terms.cols())
        return out;
    const Whirls of_neighbour(terms.col(neighbour));
    out.opposite = first ? of_neighbour.against : of_neighbour.with;
    const double size = stations.deflection_energy(out.opposite);
    out.straight = std::min(size, out.size) >= equal_share * std::max(size, out.size);
    return out;
}

FixedFrameWhirl fixed_frame_whirl(const Stations &stations, const linalg::ComplexPair &pair,
                                  Eigen::Index size, double speed) {
    const Eigen::Index near = std::min(3 * size, pair.vector.size());
    const Eigen::MatrixXcd terms = assembly::hill_terms(pair.vector.head(near), size);
    return fixed_frame_whirl(stations, terms, terms.cols() / 2, pair.value.imag(), speed);
}

void drop_alias_of_straight(const Stations &stations, Eigen::Index size, double speed,
                            std::vector<linalg::ComplexPair> &all) {
    using Complex = std::complex<double>; // real part, frequency in the fixed frame
    std::vector<Complex> kept;
    std::vector<std::optional<Complex>> other;
    for (const linalg::ComplexPair &pair : all) {
        const FixedFrameWhirl whirl = fixed_frame_whirl(stations, pair, size, speed);
        const Complex value(pair.value.real(), std::abs(whirl.turn));
        const bool against_spin = whirl.turn * speed < 0;
        other.push_back(whirl.straight && !against_spin ? std::optional(value) : std::nullopt);
        if (whirl.straight && against_spin)
            kept.push_back(value);
    }
    const auto near = [&](Complex a, Complex b) {
        return std::abs(a - b) <= 1e-7 * (std::abs(a) + std::abs(speed));
    };
    std::size_t next = 0;
    std::erase_if(all, [&](const linalg::ComplexPair &) {
        const std::optional<Complex> &value = other[next++];
        return value && std::ranges::any_of(kept, [&](Complex one) { return near(*value, one); });
    });
}

} // namespace whirl::modes
