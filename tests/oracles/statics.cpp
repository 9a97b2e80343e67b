#include "oracles/statics.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace whirl::oracles {

namespace {

/// Linear equations, solved by elimination with row pivots.
class Equations {
  public:
    explicit Equations(std::size_t size) : _rows(size, std::vector<Real>(size + 1)) {}
    Real &operator()(std::size_t i, std::size_t j) { return _rows[i][j]; }
    Real &right(std::size_t i) { return _rows[i].back(); }

    std::vector<Real> solve() {
        const std::size_t n = _rows.size();
        for (std::size_t k = 0; k < n; ++k) {
            std::size_t pivot = k;
            for (std::size_t i = k + 1; i < n; ++i)
                if (std::abs(_rows[i][k]) > std::abs(_rows[pivot][k]))
                    pivot = i;
            std::swap(_rows[k], _rows[pivot]);
            for (std::size_t i = k + 1; i < n; ++i) {
                const Real factor = _rows[i][k] / _rows[k][k];
                for (std::size_t j = k; factor != 0 && j <= n; ++j)
                    _rows[i][j] -= factor * _rows[k][j];
            }
        }
        std::vector<Real> x(n);
        for (std::size_t k = n; k-- > 0;) {
            Real sum = _rows[k].back();
            for (std::size_t j = k + 1; j < n; ++j)
                sum -= _rows[k][j] * x[j];
            x[k] = sum / _rows[k][k];
        }
        return x;
    }

  private:
    std::vector<std::vector<Real>> _rows;
};

/// Bending and shear stiffness of a cylinder.
std::pair<Real, Real> stiffness(const Cylinder &c) {
    const Real ro = static_cast<Real>(c.outer) / 2;
    const Real m = static_cast<Real>(c.inner) / static_cast<Real>(c.outer);
    const Real A = std::numbers::pi_v<Real> * ro * ro * (1 - m * m);
    const Real nu = static_cast<Real>(c.E) / (2 * static_cast<Real>(c.G)) - 1;
    const Real s = (1 + m * m) * (1 + m * m);
    const Real cowper = 6 * (1 + nu) * s / ((7 + 6 * nu) * s + (20 + 12 * nu) * m * m);
    const Real kappa = c.kappa > 0 ? static_cast<Real>(c.kappa) : cowper;
    return {c.E * A * ro * ro * (1 + m * m) / 4, kappa * c.G * A};
}

/// Two-node beam in one plane, unknowns w, phi of both ends (Przemieniecki 1968), statically exact.
void add_beam(Equations &e, const std::array<std::size_t, 4> &at, Real EI, Real S, Real h) {
    const Real Phi = 12 * EI / (S * h * h);
    const Real f = EI / (h * h * h * (1 + Phi));
    const Real K[4][4] = {{12 * f, 6 * h * f, -12 * f, 6 * h * f},
                          {6 * h * f, (4 + Phi) * h * h * f, -6 * h * f, (2 - Phi) * h * h * f},
                          {-12 * f, -6 * h * f, 12 * f, -6 * h * f},
                          {6 * h * f, (2 - Phi) * h * h * f, -6 * h * f, (4 + Phi) * h * h * f}};
    for (std::size_t i = 0; i < 4; ++i)
        for (std::size_t j = 0; j < 4; ++j)
            e(at[i], at[j]) += K[i][j];
}

/// k, with the pedestal's spring in series.
std::array<std::array<Real, 2>, 2> support_stiffness(const Support &s) {
    std::array<std::array<Real, 2>, 2> out{};
    for (std::size_t i = 0; i < 2; ++i)
        for (std::size_t j = 0; j < 2; ++j)
            out[i][j] = s.k[i][j];
    if (!s.pedestal)
        return out;
    const Real p = s.pedestal_k;
    const Real a = out[0][0] + p, b = out[0][1], c = out[1][0], d = out[1][1] + p;
    const Real det = a * d - b * c;
    const auto k = out;
    // p (k + p)^-1 k
    out[0][0] = p * (d * k[0][0] - b * k[1][0]) / det;
    out[0][1] = p * (d * k[0][1] - b * k[1][1]) / det;
    out[1][0] = p * (a * k[1][0] - c * k[0][0]) / det;
    out[1][1] = p * (a * k[1][1] - c * k[0][1]) / det;
    return out;
}

/// Ends of the cylinders, from the left.
std::vector<Real> ends_of(const SteppedRotor &rotor) {
    std::vector<Real> ends;
    for (const Cylinder &c : rotor.shaft)
        ends.push_back((ends.empty() ? 0 : ends.back()) + c.length);
    return ends;
}

/// Places where something stands or is asked for, ascending.
std::vector<Real> nodes_of(const SteppedRotor &rotor, const std::vector<Real> &ends, double z_force,
                           double z) {
    std::vector<Real> nodes{0, static_cast<Real>(z_force), static_cast<Real>(z)};
    nodes.insert(nodes.end(), ends.begin(), ends.end());
    for (const Support &s : rotor.supports)
        nodes.push_back(s.z);
    std::sort(nodes.begin(), nodes.end());
    const Real near = 1e-9L * ends.back(); // stations of the program closer than that are one
    nodes.erase(
        std::unique(nodes.begin(), nodes.end(), [near](Real a, Real b) { return b - a < near; }),
        nodes.end());
    return nodes;
}

} // namespace

StaticDeflection static_deflection(const SteppedRotor &rotor, double z_force, Real force_x,
                                   Real force_y, double z) {
    const std::vector<Real> ends = ends_of(rotor);
    const std::vector<Real> nodes = nodes_of(rotor, ends, z_force, z);
    const auto node_at = [&nodes](double place) {
        return static_cast<std::size_t>(std::min_element(nodes.begin(), nodes.end(),
                                                         [place](Real a, Real b) {
                                                             return std::abs(a - place) <
                                                                    std::abs(b - place);
                                                         }) -
                                        nodes.begin());
    };
    Equations e(4 * nodes.size()); // x, phi_x, y, phi_y
    for (std::size_t i = 0; i + 1 < nodes.size(); ++i) {
        const Real middle = (nodes[i] + nodes[i + 1]) / 2;
        const auto segment = static_cast<std::size_t>(
            std::upper_bound(ends.begin(), ends.end() - 1, middle) - ends.begin());
        const auto [EI, S] = stiffness(rotor.shaft[segment]);
        for (std::size_t plane = 0; plane < 2; ++plane) {
            const std::size_t a = 4 * i + 2 * plane;
            add_beam(e, {a, a + 1, a + 4, a + 5}, EI, S, nodes[i + 1] - nodes[i]);
        }
    }
    for (const Support &s : rotor.supports) {
        const std::size_t n = 4 * node_at(s.z);
        const auto k = support_stiffness(s);
        for (std::size_t i = 0; i < 2; ++i)
            for (std::size_t j = 0; j < 2; ++j) {
                e(n + 2 * i, n + 2 * j) += k[i][j];
                e(n + 1 + 2 * i, n + 1 + 2 * j) += s.kt[i][j];
            }
    }
    e.right(4 * node_at(z_force)) = force_x;
    e.right(4 * node_at(z_force) + 2) = force_y;
    const std::vector<Real> u = e.solve();
    return {u[4 * node_at(z)], u[4 * node_at(z) + 2]};
}

} // namespace whirl::oracles
