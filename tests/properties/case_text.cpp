#include "properties/case_text.h"
#include "support/balancer_parts.h"

#include <fmt/format.h>

namespace whirl::properties {

namespace {

/// kxx = .., kxy = .. of a matrix that is not zero.
std::string block(const char *name, const Eigen::Matrix2d &m) {
    std::string out;
    const char *axes[2] = {"x", "y"};
    if (m.isZero(0))
        return out;
    for (int i = 0; i < 2; ++i)
        for (int j = 0; j < 2; ++j)
            if (m(i, j) != 0 || i == j)
                out += fmt::format("{}{}{} = {}\n", name, axes[i], axes[j], m(i, j));
    return out;
}

std::string shaft(const model::Shaft &s) {
    std::string out =
        fmt::format("[shaft]\norder = {}\n", s.order_auto ? "\"auto\"" : std::to_string(s.order));
    if (s.order_auto)
        out += fmt::format("tolerance = {}\n", s.tolerance);
    if (s.internal_damping != 0)
        out += fmt::format("internal_damping = {}\n", s.internal_damping);
    out += "segments = [\n";
    for (const model::Segment &p : s.segments)
        out += fmt::format("  {{length = {}, outer = {}, outer_end = {}, inner = {}, inner_end = "
                           "{}, elements = {}, asymmetry = {}, asymmetry_angle = {}}},\n",
                           p.length, p.outer_start, p.outer_end, p.inner_start, p.inner_end,
                           p.elements, p.asymmetry, p.asymmetry_angle);
    return out + "]\n\n";
}

std::string bearing(const model::Bearing &b) {
    const model::BearingCoefficients &at = b.rows.front();
    std::string out = fmt::format("[[bearing]]\nz = {}\n", b.z);
    out += block("k", at.k) + block("c", at.c);
    out += fmt::format("kt = {}\nct = {}\n", at.kt(0, 0), at.ct(0, 0)); // a case has them round
    if (b.pedestal)
        out += fmt::format("pedestal_mass = {}\npedestal_k = {}\npedestal_c = {}\n",
                           b.pedestal->mass(0), b.pedestal->k(0), b.pedestal->c(0)); // alike
    return out + "\n";
}

} // namespace

std::string case_text(const model::Case &scene) {
    const model::Rotor &r = scene.rotor;
    const model::Material &m = r.shaft.segments.front().material;
    std::string out = fmt::format("format = 1\n\n[material.metal]\nE = {}\nG = {}\nrho = {}\n\n",
                                  m.E, m.G, m.rho);
    out += shaft(r.shaft);
    for (const model::Disc &d : r.discs)
        out += fmt::format("[[disc]]\nz = {}\nmass = {}\nId = {}\nIp = {}\n\n", d.z, d.mass, d.Id,
                           d.Ip);
    for (const model::Bearing &b : r.bearings)
        out += bearing(b);
    for (const model::Anisotropy &a : r.anisotropies)
        out += fmt::format("[[anisotropy]]\nz = {}\ndI = {}\nangle = {}\n\n", a.z, a.dI, a.angle);
    for (const model::Balancer &b : r.balancers)
        out += fmt::format("[[balancer]]\nz = {}\nn = {}\nmass = {}\nradius = {}\ndamping = "
                           "{}\nimbalance = {}\nimbalance_phase = {}\n\n",
                           b.z, tests::row(b).n, tests::row(b).mass, tests::row(b).radius,
                           tests::row(b).damping, b.imbalance, b.imbalance_phase);
    if (scene.speeds)
        out += fmt::format("[speeds]\nfrom = {}\nto = {}\ncount = {}\n\n", scene.speeds->from,
                           scene.speeds->to, scene.speeds->count);
    return out + fmt::format("[campbell]\nmodes = {}\n", scene.campbell.modes);
}

} // namespace whirl::properties
