#include "properties/long_checks.h"

#include "analyses/balance.h"
#include "analyses/response.h"
#include "analyses/stability.h"
#include "oracles/statics.h"
#include "properties/random_rotors.h"
#include "properties/transforms.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <complex>

namespace whirl::properties {

namespace {

using Answer = std::optional<std::string>;

/// Band ends are roots found to 1e-9 or so of the speed.
constexpr double of_roots = 1e-7;

template <class Band>
std::string band_difference(const std::vector<Band> &a, const std::vector<Band> &b,
                            const std::string &what, double tolerance = of_roots) {
    const auto text = [](const std::vector<Band> &bands) {
        std::string out;
        for (const auto &[from, to] : bands)
            out += fmt::format("[{:.9g}, {:.9g}] ", from, to);
        return out.empty() ? std::string("none ") : out;
    };
    bool same = a.size() == b.size();
    for (std::size_t i = 0; same && i < a.size(); ++i) {
        const auto &[from_a, to_a] = a[i];
        const auto &[from_b, to_b] = b[i];
        same = std::abs(from_a - from_b) <= tolerance * std::abs(to_a) &&
               std::abs(to_a - to_b) <= tolerance * std::abs(to_a);
    }
    return same ? "" : fmt::format("{}: {}become {}", what, text(a), text(b));
}

analyses::UnstableBands unstable_bands(const model::Case &scene, bool with_errors) {
    return analyses::unstable_bands_of(scene, balancers::arrangement_at_balance(scene.rotor),
                                       with_errors);
}

/// Every end of both lists within the sum of the errors.
bool within_errors(const analyses::UnstableBands &a, const analyses::UnstableBands &b) {
    if (a.bands.size() != b.bands.size())
        return false;
    for (std::size_t i = 0; i < a.bands.size(); ++i) {
        const auto &[from, to] = a.bands[i];
        const auto &[from_b, to_b] = b.bands[i];
        if (std::abs(from - from_b) > a.errors[i].first + b.errors[i].first + of_roots * to ||
            std::abs(to - to_b) > a.errors[i].second + b.errors[i].second + of_roots * to)
            return false;
    }
    return true;
}

/// A range in which something happens: up to beyond the lowest critical speeds.
model::Case with_grid(const model::Case &scene, int count) {
    model::Case out = scene;
    out.speeds = model::SpeedRange{20, 1500, count};
    return out;
}

Answer stability_difference(const model::Case &a, const model::Case &b) {
    const std::string difference =
        band_difference(unstable_bands(a, false).bands, unstable_bands(b, false).bands, "unstable");
    if (!difference.empty() && within_errors(unstable_bands(a, true), unstable_bands(b, true)))
        return "";
    return difference;
}

Answer balance_difference(const model::Case &a, const model::Case &b) {
    model::Case first = a;
    model::Case second = b;
    first.balance.balanced_position = second.balance.balanced_position = false;
    const results::BalanceResult x = analyses::balance(first);
    const results::BalanceResult y = analyses::balance(second);
    std::string out = band_difference(x.joint.bands.bands, y.joint.bands.bands, "joint");
    for (std::size_t i = 0; out.empty() && i < x.planes.size(); ++i)
        out = band_difference(x.planes[i].bands.bands, y.planes[i].bands.bands,
                              fmt::format("plane {}", i));
    return out;
}

bool has_response(InvarianceScene &s) { return !s.turning_parts(); }

/// Semi-axes at places with the same z; `length` - z where mirrored.
std::string orbit_difference(const results::ResponseResult &a, const results::ResponseResult &b,
                             std::optional<double> length) {
    for (const results::ResponseNode &node : a.nodes) {
        const double z = length ? *length - node.z : node.z;
        const auto other =
            std::min_element(b.nodes.begin(), b.nodes.end(), [z](const auto &p, const auto &q) {
                return std::abs(p.z - z) < std::abs(q.z - z);
            });
        for (std::size_t k = 0; k < a.speeds.size(); ++k) {
            const double size = node.major[k];
            const double off = std::max(std::abs(node.major[k] - other->major[k]),
                                        std::abs(node.minor[k] - other->minor[k]));
            if (!(off <= 1e-7 * size))
                return fmt::format("at {:.6g} rad/s, z = {:.6g}: semi-axes {:.9g}, {:.9g} become "
                                   "{:.9g}, {:.9g}",
                                   a.speeds[k], node.z, node.major[k], node.minor[k],
                                   other->major[k], other->minor[k]);
        }
    }
    return {};
}

} // namespace

Answer static_response(InvarianceScene &s) {
    if (!has_response(s))
        return std::nullopt;
    model::Case scene = s.scene();
    // The first mode is at tens of rad/s or more: inertia and damping weigh 1e-5 at most.
    const double speed = 1e-5;
    scene.speeds = model::SpeedRange{speed, speed, 1};
    model::Rotor still = scene.rotor; // tables at rest
    for (model::Bearing &b : still.bearings)
        b.rows = {b.at(speed)};
    const oracles::SteppedRotor rotor = continuum_of(still);
    for (const results::ResponseNode &node : analyses::unbalance_response(scene).nodes) {
        std::complex<double> forward = 0; // of x + i y = forward e^{i t} + backward e^{-i t}
        std::complex<double> backward = 0;
        for (const model::Imbalance &i : scene.rotor.imbalances) {
            const auto ax = static_deflection(rotor, i.z, 1, 0, node.z);
            const auto ay = static_deflection(rotor, i.z, 0, 1, node.z);
            const double size = i.mr * speed * speed;
            const std::complex<double> to_x(static_cast<double>(ax.x), static_cast<double>(ax.y));
            const std::complex<double> to_y(static_cast<double>(ay.x), static_cast<double>(ay.y));
            const std::complex<double> j(0, 1);
            forward += size * std::polar(1.0, i.phase) * (to_x - j * to_y) / 2.0;
            backward += size * std::polar(1.0, -i.phase) * (to_x + j * to_y) / 2.0;
        }
        const double major = std::abs(forward) + std::abs(backward);
        const double minor = std::abs(forward) - std::abs(backward);
        const double off =
            std::max(std::abs(major - node.major[0]), std::abs(minor - node.minor[0]));
        if (!(off <= 1e-6 * major))
            return fmt::format("z = {:.6g}: semi-axes {:.9g}, {:.9g}, of the beam at rest {:.9g}, "
                               "{:.9g}",
                               node.z, node.major[0], node.minor[0], major, minor);
    }
    return "";
}

Answer turned_response(InvarianceScene &s) {
    if (!has_response(s))
        return std::nullopt;
    model::Case changed = turned(s.scene(), 0.7);
    for (model::Imbalance &i : changed.rotor.imbalances)
        i.phase += 0.2; // all of them: another beginning of time
    return orbit_difference(analyses::unbalance_response(s.scene()),
                            analyses::unbalance_response(changed), std::nullopt);
}

Answer mirrored_response(InvarianceScene &s) {
    if (!has_response(s))
        return std::nullopt;
    return orbit_difference(analyses::unbalance_response(s.scene()),
                            analyses::unbalance_response(mirrored(s.scene())),
                            s.scene().rotor.shaft.length());
}

Answer turned_stability(InvarianceScene &s) {
    const model::Case scene = with_grid(s.scene(), 41);
    return stability_difference(scene, turned(scene, 0.7));
}

Answer mirrored_stability(InvarianceScene &s) {
    const model::Case scene = with_grid(s.scene(), 41);
    return stability_difference(scene, mirrored(scene));
}

Answer finer_stability(InvarianceScene &s) {
    return stability_difference(with_grid(s.scene(), 41), with_grid(s.scene(), 201));
}

Answer turned_balance(InvarianceScene &s) {
    const model::Case scene = with_grid(s.scene(), 41);
    return balance_difference(scene, turned(scene, 0.7));
}

Answer mirrored_balance(InvarianceScene &s) {
    const model::Case scene = with_grid(s.scene(), 41);
    return balance_difference(scene, mirrored(scene));
}

} // namespace whirl::properties
