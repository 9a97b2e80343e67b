#include "assembly/rotating_system.h"
#include "assembly/planes.h"

#include <complex>

namespace whirl::assembly {

namespace {

using Complex = std::complex<double>;

/// Entries of a real matrix that stands for complex rows: row of u takes a u + b conj(u).
class ComplexEntries {
  public:
    void add(int row, int column, Complex a, Complex b = 0) {
        put(2 * row, 2 * column, a.real() + b.real());
        put(2 * row, 2 * column + 1, b.imag() - a.imag());
        put(2 * row + 1, 2 * column, a.imag() + b.imag());
        put(2 * row + 1, 2 * column + 1, a.real() - b.real());
    }
    [[nodiscard]] linalg::Matrix matrix(int n) const {
        return linalg::Matrix::from_entries(n, _entries);
    }

  private:
    std::vector<Eigen::Triplet<double>> _entries;

    void put(int row, int column, double value) {
        if (value != 0)
            _entries.emplace_back(row, column, value);
    }
};

/// The six matrices of a rotating system while they are filled.
struct RotatingEntries {
    ComplexEntries M, C, Cs, K, Ks, Kss;

    /// The acceleration seen from the fixed frame, a = v'' + 2 i speed v' - speed^2 v, of a motion
    /// v = m u + d conj(u).
    void inertia(int i, int j, double m, Complex d = 0) {
        M.add(i, j, m, d);
        Cs.add(i, j, 2.0 * i_unit * m, 2.0 * i_unit * d);
        Kss.add(i, j, -m, -d);
    }
    /// -i speed g (u' + i speed u).
    void gyroscopic(int i, int j, double g) {
        Cs.add(i, j, -i_unit * g);
        Kss.add(i, j, g);
    }
    /// a conj(u'' + speed^2 u).
    void anisotropy(int i, int j, Complex a) {
        M.add(i, j, 0, a);
        Kss.add(i, j, 0, a);
    }
    /// d times the conjugate of the acceleration seen from the fixed frame.
    void conjugate_inertia(int i, int j, Complex d) {
        M.add(i, j, 0, d);
        Cs.add(i, j, 0, -2.0 * i_unit * d);
        Kss.add(i, j, 0, -d);
    }
    /// c (u' + i speed u).
    void external_damping(int i, int j, Complex c) {
        C.add(i, j, c);
        Ks.add(i, j, i_unit * c);
    }
};

void add_rotating_parts(const Discretization &d, RotatingEntries &out) {
    assemble_rotating_parts(d, [&](Term term, std::span<const int> unknowns,
                                   const Eigen::MatrixXd &block) {
        for_each_entry(unknowns, block, [&](int i, int j, double v) {
            if (term == Term::mass)
                out.inertia(i, j, v);
            else if (term == Term::gyroscopic)
                out.gyroscopic(i, j, v);
            else if (term == Term::stiffness)
                out.K.add(i, j, v);
            else if (term == Term::damping) // of the shaft: acts on what it sees turning with it
                out.C.add(i, j, v);
        });
    });
    assemble_asymmetry(d, [&](Term term, std::span<const int> unknowns,
                              const Eigen::MatrixXd &block, Complex factor) {
        for_each_entry(unknowns, block, [&](int i, int j, double v) {
            if (term == Term::mass)
                out.anisotropy(i, j, v * factor);
            else if (term == Term::stiffness)
                out.K.add(i, j, 0, v * factor);
            else if (term == Term::damping)
                out.C.add(i, j, 0, v * factor);
        });
    });
}

/// A 2 x 2 block on (x, y) as r w + t conj(w): r is the same from every direction.
struct Directions {
    Complex round, turning;
};
Directions directions(const Eigen::Matrix2d &k) {
    return {{(k(0, 0) + k(1, 1)) / 2, (k(1, 0) - k(0, 1)) / 2},
            {(k(0, 0) - k(1, 1)) / 2, (k(1, 0) + k(0, 1)) / 2}};
}

/// Entry of a column of small motions: M l^2 + C l, or, where its rate alone matters,
/// (M l + C)(l/drift + 1); of a motion v = share u + across conj(u).
struct Column {
    int row, column;
    double share;
    Complex across;

    void add(double m, double c, double drift, RotatingEntries &out) const {
        if (drift == 0) {
            put(m, out.M);
            put(c, out.C);
            return;
        }
        put(m / drift, out.M);
        put(m + c / drift, out.C);
        put(c, out.K);
    }
    void put(double value, ComplexEntries &out) const {
        out.add(row, column, value * share, value * across);
    }
};

/// What is no motion of the parts, 1/2 (y + D conj(y)): m (l + far)(l + 2 far).
void add_held(const Column &along, double m, double far, RotatingEntries &out) {
    along.put(m, out.M);
    along.put(3 * far * m, out.C);
    along.put(2 * far * far * m, out.K);
}

/// @param first  unknown of the first of its small motions
void add_small_motions(const Combination &w, const balancers::SmallMotions &parts, int first,
                       RotatingEntries &out) {
    const auto n = static_cast<int>(parts.pull.size());
    const double share = parts.diameter ? 0.5 : 1;
    const Complex across = parts.diameter ? -0.5 * *parts.diameter : 0;
    for (int j = 0; j < n; ++j) {
        for (const auto &[i, v] : w) {
            out.inertia(i, first + j, parts.pull(j) * v * share, parts.pull(j) * v * across);
            out.inertia(first + j, i, parts.pull(j) * v / 2);
            out.conjugate_inertia(first + j, i, -v / 2 * parts.conjugate(j));
        }
        for (int k = 0; k < n; ++k)
            Column{first + j, first + k, share, across}.add(
                parts.inertia(j, k), parts.damping(j, k), parts.drift(k), out);
        if (parts.diameter)
            add_held({first + j, first + j, share, -across}, parts.inertia(j, j), parts.far, out);
        out.Kss.add(first + j, first + j, parts.restoring(j));
    }
}

/// @param first  unknown of the first of its small motions; -1: held
void add_balancer(const Discretization &d, const balancers::BalancerElement &b, int first,
                  RotatingEntries &out) {
    const Combination w = d.deflection_at(b.z);
    const Combination phi = d.slope_at(b.z);
    for (const auto &[i, vi] : w)
        for (const auto &[j, vj] : w)
            out.inertia(i, j, b.mass * vi * vj);
    for (const auto &[i, vi] : phi)
        for (const auto &[j, vj] : phi) {
            out.inertia(i, j, b.polar_inertia / 2 * vi * vj);
            out.gyroscopic(i, j, b.polar_inertia * vi * vj);
            out.anisotropy(i, j, b.anisotropy * vi * vj);
        }
    if (first >= 0)
        add_small_motions(w, b.parts, first, out);
}

} // namespace

linalg::Matrix RotatingSystem::damping(double speed) const {
    return linalg::Matrix::sum(1, C, speed, Cs);
}

linalg::Matrix RotatingSystem::stiffness(double speed) const {
    return linalg::Matrix::sum(1, linalg::Matrix::sum(1, K, speed, Ks), speed * speed, Kss);
}

RotatingSystem assemble_rotating(const Discretization &discretization, double bearing_speed,
                                 const std::vector<balancers::BalancerElement> &balancers,
                                 bool frozen) {
    RotatingEntries out;
    add_rotating_parts(discretization, out);
    assemble_supports(discretization, bearing_speed,
                      [&](Term term, int i, int j, const Eigen::Matrix2d &block) {
                          const Complex round = directions(block).round;
                          if (term == Term::mass)
                              out.inertia(i, j, round.real());
                          else if (term == Term::stiffness)
                              out.K.add(i, j, round);
                          else if (term == Term::damping)
                              out.external_damping(i, j, round);
                      });
    int unknowns = discretization.planar_size();
    for (const balancers::BalancerElement &balancer : balancers) {
        add_balancer(discretization, balancer, frozen ? -1 : unknowns, out);
        unknowns += frozen ? 0 : balancer.unknowns();
    }
    const int n = 2 * unknowns;
    return {out.M.matrix(n), out.C.matrix(n),  out.Cs.matrix(n),
            out.K.matrix(n), out.Ks.matrix(n), out.Kss.matrix(n)};
}

PeriodicSupports periodic_supports(const Discretization &discretization, double bearing_speed,
                                   int unknowns) {
    // t conj(u) exp(-2 i speed t) = t conj(u) cos - i t conj(u) sin.
    ComplexEntries K_cos, K_sin, C_cos, C_sin, Ks_cos, Ks_sin;
    assemble_supports(discretization, bearing_speed,
                      [&](Term term, int i, int j, const Eigen::Matrix2d &block) {
                          const Complex t = directions(block).turning;
                          if (term == Term::stiffness) {
                              K_cos.add(i, j, 0, t);
                              K_sin.add(i, j, 0, -i_unit * t);
                          } else if (term == Term::damping) { // t conj(u' + i speed u)
                              C_cos.add(i, j, 0, t);
                              C_sin.add(i, j, 0, -i_unit * t);
                              Ks_cos.add(i, j, 0, -i_unit * t);
                              Ks_sin.add(i, j, 0, -t);
                          }
                      });
    return {{C_cos.matrix(unknowns), C_sin.matrix(unknowns)},
            {K_cos.matrix(unknowns), K_sin.matrix(unknowns)},
            {Ks_cos.matrix(unknowns), Ks_sin.matrix(unknowns)}};
}

} // namespace whirl::assembly
