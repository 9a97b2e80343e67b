#include "modes/dissipation/dissipation.h"

#include "assembly/assemble.h"
#include "assembly/planes.h"
#include "balancers/arrangement.h"
#include "linalg/dense/products.h"
#include "results/formulation.h"

#include <cmath>
#include <limits>

namespace whirl::modes {

namespace {

using assembly::Term;
using Complex = std::complex<double>;
using assembly::i_unit;

/// Power of blocks of one part. Of the product of a complex amplitude with a real matrix the real
/// part is that of its symmetric, the imaginary one that of its skew part.
class Power {
  public:
    /// @param turning  rad/s: of the axes; 0: they are fixed
    Power(Complex eigenvalue, const Eigen::VectorXcd &x, const Eigen::VectorXcd &y, double turning)
        : _l(eigenvalue), _x(x), _y(y), _turning(turning) {}

    /// 0 where the terms cancel each other but for rounding of the motion.
    [[nodiscard]] double value() const {
        constexpr double rounding = 1e-10; // of the terms: vectors are known no better
        return std::abs(_sum) > rounding * _size ? _sum : 0;
    }

    /// What acts from the fixed frame, on (x, y) between two planar unknowns.
    void add_coupling(Term term, int row, int column, const Eigen::Matrix2d &block) {
        const Eigen::Vector2cd left(_x(row), _y(row));
        const Eigen::Vector2cd right(_x(column), _y(column));
        const Eigen::Matrix2d effective = _turning == 0 ? block : round_part(block);
        if (term == Term::stiffness)
            add_stiffness(left.dot(skew_part(effective) * right));
        else if (term == Term::mass)
            add_stiffness(-std::norm(_l) * left.dot(skew_part(effective) * right));
        else if (term == Term::damping) {
            add_damping(left.dot(effective * right));
            // c (u' + i speed u) in axes that turn
            Eigen::Matrix2d quarter_turn;
            quarter_turn << 0, -1, 1, 0;
            add_stiffness(_turning * left.dot(skew_part(effective * quarter_turn) * right));
        }
    }
    /// Internal damping, in both planes.
    void add_internal(Term term, std::span<const int> unknowns, const Eigen::MatrixXd &block,
                      double speed) {
        const std::vector<int> at(unknowns.begin(), unknowns.end());
        const Eigen::VectorXcd x = _x(at);
        const Eigen::VectorXcd y = _y(at);
        if (term == Term::damping)
            add_damping(x.dot(block * x) + y.dot(block * y));
        else if (term == Term::circulatory && _turning == 0)
            add_stiffness(speed * (x.dot(block * y) - y.dot(block * x)));
    }
    /// Internal damping of what is not axisymmetric: factor times the block on conj(u').
    void add_conjugate(std::span<const int> unknowns, const Eigen::MatrixXd &block,
                       Complex factor) {
        const std::vector<int> at(unknowns.begin(), unknowns.end());
        const Eigen::VectorXcd x = _x(at);
        const Eigen::VectorXcd y = _y(at);
        add_damping(factor.real() * (x.dot(block * x) - y.dot(block * y)) +
                    factor.imag() * (x.dot(block * y) + y.dot(block * x)));
    }
    void add_damping(Complex product) { add(std::norm(_l) / 2, product.real(), product); }

  private:
    Complex _l;
    const Eigen::VectorXcd &_x, &_y;
    double _turning;
    double _sum = 0;
    double _size = 0; ///< of all terms

    void add(double factor, double part, Complex product) {
        _sum += factor * part;
        _size += std::abs(factor) * std::abs(product);
    }
    void add_stiffness(Complex product) { add(_l.imag() / 2, product.imag(), product); }
    /// What a symmetric block leaves is rounding.
    static Eigen::Matrix2d skew_part(const Eigen::Matrix2d &block) {
        return (block - block.transpose()) / 2;
    }
    /// The part that is the same from every direction: all there is in axes that turn.
    static Eigen::Matrix2d round_part(const Eigen::Matrix2d &block) {
        Eigen::Matrix2d out;
        const double along = (block(0, 0) + block(1, 1)) / 2;
        const double across = (block(0, 1) - block(1, 0)) / 2;
        out << along, across, -across, along;
        return out;
    }
};

/// The parts of a rotor under one motion.
class Parts {
  public:
    Parts(const assembly::Discretization &d, Power none, double speed)
        : _discretization(d), _none(none), _speed(speed) {}

    std::vector<PartPower> take() { return std::move(_parts); }

    void add_supports() {
        const auto &bearings = _discretization.rotor().bearings;
        for (int i = 0; i < static_cast<int>(bearings.size()); ++i) {
            const model::Bearing &bearing = bearings[static_cast<std::size_t>(i)];
            add_outside(bearing.seal ? "seal" : "bearing", bearing.z, bearing.name,
                        [&](const assembly::AddCoupling &add) {
                            assembly::assemble_film(_discretization, i, _speed, add);
                        });
            add_outside("pedestal", bearing.z, bearing.name, [&](const assembly::AddCoupling &add) {
                assembly::assemble_pedestal(_discretization, i, add);
            });
        }
    }
    void add_shaft(bool turning) {
        Power power = _none;
        assembly::assemble_rotating_parts(
            _discretization,
            [&](Term term, std::span<const int> unknowns, const Eigen::MatrixXd &block) {
                power.add_internal(term, unknowns, block, _speed);
            });
        if (turning)
            assembly::assemble_asymmetry(_discretization,
                                         [&](Term term, std::span<const int> unknowns,
                                             const Eigen::MatrixXd &block, Complex factor) {
                                             if (term == Term::damping)
                                                 power.add_conjugate(unknowns, block, factor);
                                         });
        add("internal damping", {}, "", power.value());
        add_outside("shaft damping", {}, "", [&](const assembly::AddCoupling &add_block) {
            assembly::assemble_outside_damping(_discretization, add_block);
        });
        add_outside("axial torque", {}, "", [&](const assembly::AddCoupling &add_block) {
            assembly::assemble_torque(_discretization, add_block);
        });
    }
    /// Parts that neither take nor feed anything are left out.
    void add(const char *of, std::optional<double> z, const std::string &name, double power) {
        if (power != 0)
            _parts.push_back({of, z, name, power});
    }

  private:
    const assembly::Discretization &_discretization;
    Power _none;
    double _speed;
    std::vector<PartPower> _parts;

    template <class Assemble>
    void add_outside(const char *of, std::optional<double> z, const std::string &name,
                     const Assemble &assemble) {
        Power power = _none;
        assemble([&](Term term, int row, int column, const Eigen::Matrix2d &block) {
            power.add_coupling(term, row, column, block);
        });
        add(of, z, name, power.value());
    }
};

/// y of a balancer's parts, that is of their groups; columns x and y.
Eigen::MatrixXcd group_motions(const balancers::SmallMotions &parts, const Eigen::VectorXcd &vector,
                               Eigen::Index first, Complex eigenvalue) {
    Eigen::MatrixXcd y(parts.pull.size(), 2);
    for (Eigen::Index j = 0; j < y.rows(); ++j) {
        // The unknown may be Y, y' = Y + Y'/drift.
        const Complex of_rate =
            parts.drift(j) > 0 ? (eigenvalue / parts.drift(j) + 1.0) / eigenvalue : Complex(1);
        y.row(j) = of_rate * vector.segment(2 * (first + j), 2).transpose();
    }
    if (parts.groups.size() > 0)
        return linalg::times(parts.groups.cast<Complex>(), y);
    return y;
}

/// Pseudo-inverse of v -> 1/2 (v - D conj v) over (Re v, Im v): along sqrt(D) v shrinks to
/// (1 - |D|) / 2 of it, across to (1 + |D|) / 2.
Eigen::Matrix2d drive_inverse(Complex D) {
    // Of a difference of two numbers of order 1.
    constexpr double rounding = 2 * std::numeric_limits<double>::epsilon();
    const double size = std::abs(D);
    const double c = std::cos(std::arg(D) / 2);
    const double s = std::sin(std::arg(D) / 2);
    const double across = 2 / (1 + size);
    const double along = std::abs(1 - size) <= rounding * (1 + size) ? 0 : 2 / (1 - size);
    Eigen::Matrix2d out;
    out << c * c * along + s * s * across, c * s * (along - across), c * s * (along - across),
        s * s * along + c * c * across;
    return out;
}

/// Product of the drag in a balancer with the motion of its parts. Groups of parts move along
/// y = 1/2 (v - D conj v) for some v, since that is all that the node drives; the powers of their
/// forces are those along v (docs/theory.md).
Complex drag_product(const balancers::SmallMotions &parts, const Eigen::MatrixXcd &y) {
    const Eigen::Index n = y.rows();
    const Eigen::MatrixXd to_groups = parts.groups.size() > 0
                                          ? Eigen::MatrixXd(parts.groups.inverse())
                                          : Eigen::MatrixXd(Eigen::MatrixXd::Identity(n, n));
    const Eigen::MatrixXd drag =
        linalg::transposed_times(to_groups, linalg::times(parts.damping, to_groups));
    const Eigen::VectorXd pull = to_groups.transpose() * parts.pull;
    const Eigen::VectorXcd conjugate = to_groups.transpose().cast<Complex>() * parts.conjugate;
    Complex sum = 0;
    for (Eigen::Index g = 0; g < n; ++g) {
        const Eigen::Index of = pull(g) != 0 ? g : 0; // turning about themselves: as they move
        const Complex D = conjugate(of) / pull(of);
        const Eigen::Vector2cd v = drive_inverse(D) * y.row(g).transpose();
        for (Eigen::Index h = 0; h < n; ++h)
            sum += drag(g, h) * v.dot(y.row(h).transpose());
    }
    return sum;
}

void add_balancers(Parts &parts, const Power &none, const assembly::Discretization &d,
                   const WhirlMode &mode) {
    const std::vector<balancers::BalancerElement> elements =
        balancers::balancer_elements(d.rotor(), balancers::arrangement_at_balance(d.rotor()));
    Eigen::Index first = d.planar_size();
    for (std::size_t i = 0; i < elements.size(); ++i) {
        Power power = none;
        power.add_damping(
            drag_product(elements[i].parts, group_motions(elements[i].parts, mode.rotating_vector,
                                                          first, mode.rotating_value)));
        parts.add("balancer", elements[i].z, d.rotor().balancers[i].name, power.value());
        first += elements[i].unknowns();
    }
}

} // namespace

std::vector<PartPower> part_powers(const SpectrumSolver &solver, const WhirlMode &mode,
                                   double speed) {
    const results::Form form = solver.form();
    if (form == results::Form::hill || mode.eigenvalue == 0.0)
        return {};
    const assembly::Discretization &d = solver.discretization();
    const bool turning = form == results::Form::rotating;
    auto [x, y] = solver.planes(mode);
    if (turning) {
        const assembly::Planes of_rotor(mode.rotating_vector);
        x = of_rotor.x;
        y = of_rotor.y;
    }
    const Power none(turning ? mode.rotating_value : mode.eigenvalue, x, y, turning ? speed : 0);
    Parts parts(d, none, speed);
    parts.add_supports();
    parts.add_shaft(turning);
    if (turning)
        add_balancers(parts, none, d, mode);
    return parts.take();
}

} // namespace whirl::modes
