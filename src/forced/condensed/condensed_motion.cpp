#include "forced/condensed/condensed_motion.h"

#include "elements/beam.h"
#include "forced/condensed/equal_chain.h"
#include "forced/forced_motion.h"
#include "forced/response_places.h"
#include "linalg/dense/products.h"
#include "results/formulation.h"

#include <Eigen/LU>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

namespace whirl::forced {

namespace {

using Complex = std::complex<double>;
constexpr int at_nodes = 4; ///< unknowns of a beam element at its nodes

/// A with all but its first `kept` unknowns eliminated.
template <class Dense> Dense condensed(const Dense &A, Eigen::Index kept = at_nodes) {
    const Eigen::Index inner = A.rows() - kept;
    if (inner == 0)
        return A;
    const Dense inside = A.bottomRightCorner(inner, inner);
    const Dense across = A.topRightCorner(kept, inner);
    const Dense right = A.bottomLeftCorner(inner, kept);
    const Dense moved = linalg::solved(inside.partialPivLu(), right);
    Dense out = A.topLeftCorner(kept, kept);
    out.noalias() -= across * moved;
    return out;
}

/// Equal but for their place and rounding.
bool equal(const mesh::Span &a, const mesh::Span &b) {
    const bool uniform = a.outer_start == a.outer_end && a.inner_start == a.inner_end;
    return uniform && a.segment == b.segment && b.outer_start == b.outer_end &&
           a.outer_start == b.outer_start && b.inner_start == b.inner_end &&
           a.inner_start == b.inner_start && std::abs(a.length - b.length) <= 1e-13 * a.length;
}

int part_count(results::Form form) { return form == results::Form::planar ? 1 : 2; }

/// From (a, d) to (x, y) of the fixed frame.
Eigen::Matrix2cd to_directions() {
    Eigen::Matrix2cd T;
    T << 1, 1, -imaginary_unit, imaginary_unit;
    return T;
}

/// So many equal ones in a row in place of one, over the rows and columns listed.
void chain(const std::vector<Eigen::Index> &rows, int count, Eigen::MatrixXcd &values,
           Eigen::MatrixXd &sizes) {
    Chain one;
    one.half = static_cast<int>(rows.size()) / 2;
    for (std::size_t i = 0; i < rows.size(); ++i)
        for (std::size_t j = 0; j < rows.size(); ++j) {
            one.values[i][j] = values(rows[i], rows[j]);
            one.sizes[i][j] = sizes(rows[i], rows[j]);
        }
    const Chain all = equal_chain(one, count);
    for (std::size_t i = 0; i < rows.size(); ++i)
        for (std::size_t j = 0; j < rows.size(); ++j) {
            values(rows[i], rows[j]) = all.values[i][j];
            sizes(rows[i], rows[j]) = all.sizes[i][j];
        }
}

} // namespace

bool CondensedMotion::describes(const assembly::Discretization &discretization) {
    const model::Shaft &shaft = discretization.rotor().shaft;
    return !discretization.rigid() && shaft.modal_damping.empty() && shaft.axial_torque == 0;
}

CondensedMotion::CondensedMotion(const assembly::Discretization &discretization, results::Form form)
    : _discretization(discretization), _rotating(form == results::Form::rotating),
      _parts(part_count(form)), _matrix(0, 0) {
    for (const auto &[node, name] : attached_nodes(discretization))
        _places.emplace(node, 0);
    find_stretches();
    int place = 0;
    for (auto &[node, at] : _places)
        at = place++;
    const int size = 2 * _parts * static_cast<int>(_places.size());
    _matrix = linalg::BandMatrix(size, 4 * _parts - 1);
    _sizes.resize(size, 2 * (4 * _parts - 1) + 1);
}

void CondensedMotion::find_stretches() {
    const auto &spans = _discretization.shaft_mesh().spans;
    for (int span = 0; span < static_cast<int>(spans.size()); ++span) {
        const bool like_last =
            span > 0 && equal(spans[static_cast<std::size_t>(_stretches.back().first)],
                              spans[static_cast<std::size_t>(span)]);
        if (like_last && !_places.contains(span)) {
            ++_stretches.back().count;
            continue;
        }
        _places.emplace(span, 0);
        _stretches.push_back({span, 1, like_last});
        // Over deflections and slopes of its own ends, short ones too.
        if (!like_last)
            _beams.emplace(span, elements::beam_matrices(
                                     elements::beam_of(_discretization.rotor().shaft,
                                                       spans[static_cast<std::size_t>(span)]),
                                     _discretization.order()));
    }
    _places.emplace(static_cast<int>(spans.size()), 0);
}

int CondensedMotion::unknown(int node, int part, bool slope) const {
    return 2 * _parts * _places.at(node) + 2 * part + (slope ? 1 : 0);
}

void CondensedMotion::add(int row, int column, Complex value, double size) {
    _matrix(row, column) += value;
    _sizes(row, column - row + 4 * _parts - 1) += size;
}

/// So many equal elements in a row, their inner nodes eliminated.
CondensedMotion::Block CondensedMotion::in_a_row(const Block &element, int count) const {
    if (count == 1)
        return element;
    Block out{element.values, element.sizes};
    if (_rotating) { // the unknowns of each end together
        chain({0, 1, 4, 5, 2, 3, 6, 7}, count, out.values, out.sizes);
        return out;
    }
    for (int part = 0; part < _parts; ++part) { // they do not meet in the shaft
        const int first = at_nodes * part;
        chain({first, first + 1, first + 2, first + 3}, count, out.values, out.sizes);
    }
    return out;
}

/// Values and sizes over (w0, L phi0, w1, L phi1) of the first part, of the second.
CondensedMotion::Block CondensedMotion::element(int span) const {
    const double length = _discretization.rotor().shaft.length();
    const elements::PlanarMatrices &beam = _beams.at(span);
    const model::Shaft &shaft = _discretization.rotor().shaft;
    const double turn = std::abs(_speed);
    const Eigen::MatrixXd size =
        ((1 + turn * (shaft.beta + 2 * shaft.internal_damping)) * beam.K.cwiseAbs() +
         beam.K_axial.cwiseAbs() + turn * (turn + shaft.alpha) * beam.M.cwiseAbs() +
         turn * turn * beam.G.cwiseAbs())
            .topLeftCorner(at_nodes, at_nodes);
    Block out{values_of(span), size.replicate(_parts, _parts)};
    if (!_rotating && _parts == 2) {
        out.sizes.topRightCorner(at_nodes, at_nodes).setZero();
        out.sizes.bottomLeftCorner(at_nodes, at_nodes).setZero();
    }
    for (Eigen::Index i = 1; i < out.values.rows(); i += 2) {
        out.values.row(i) /= length;
        out.values.col(i) /= length;
        out.sizes.row(i) /= length;
        out.sizes.col(i) /= length;
    }
    return out;
}

/// Dynamic stiffness of an element over (w0, phi0, w1, phi1) of the first part, of the second.
Eigen::MatrixXcd CondensedMotion::values_of(int span) const {
    const elements::PlanarMatrices &beam = _beams.at(span);
    const model::Shaft &shaft = _discretization.rotor().shaft;
    const double square = _speed * _speed;
    const Eigen::MatrixXd K = beam.K + beam.K_axial;
    const Eigen::MatrixXd forward = K - square * (beam.M - beam.G);
    const Eigen::MatrixXd outside = _speed * (shaft.alpha * beam.M + shaft.beta * beam.K);
    const bool damped = shaft.alpha != 0 || shaft.beta != 0;
    if (_rotating)
        return rotating_values(span, forward, outside);
    Eigen::MatrixXcd out = Eigen::MatrixXcd::Zero(at_nodes * _parts, at_nodes * _parts);
    out.topLeftCorner(at_nodes, at_nodes) =
        damped ? condensed(Eigen::MatrixXcd(forward + imaginary_unit * outside))
               : condensed(forward).cast<Complex>();
    if (_parts == 1)
        return out;
    const Eigen::MatrixXd backward = K - square * (beam.M + beam.G);
    const Eigen::MatrixXd all = outside + 2.0 * _speed * shaft.internal_damping * beam.K;
    out.bottomRightCorner(at_nodes, at_nodes) =
        damped || shaft.internal_damping != 0
            ? condensed(Eigen::MatrixXcd(backward + imaginary_unit * all))
            : condensed(backward).cast<Complex>();
    return out;
}

/// (forward + i outside) u + difference conj(u), and its conjugate.
Eigen::MatrixXcd CondensedMotion::rotating_values(int span, const Eigen::MatrixXd &forward,
                                                  const Eigen::MatrixXd &outside) const {
    const elements::PlanarMatrices &beam = _beams.at(span);
    const int segment = _discretization.shaft_mesh().spans[static_cast<std::size_t>(span)].segment;
    const model::Segment &of =
        _discretization.rotor().shaft.segments[static_cast<std::size_t>(segment)];
    const Eigen::MatrixXd difference =
        of.asymmetry * (beam.K_bending + _speed * _speed / 2 * beam.G);
    Eigen::MatrixXcd out(2 * at_nodes, 2 * at_nodes);
    if (outside.isZero(0)) {
        const Eigen::MatrixXd along = condensed(Eigen::MatrixXd(forward + difference));
        const Eigen::MatrixXd across = condensed(Eigen::MatrixXd(forward - difference));
        out << along + across, along - across, along - across, along + across;
        out /= 2;
    } else { // over the unknowns at the nodes of both parts, then those inside of both
        const Eigen::Index n = forward.rows();
        const Eigen::Index inner = n - at_nodes;
        const auto row = [inner](Eigen::Index k, Eigen::Index part) {
            return k < at_nodes ? at_nodes * part + k : at_nodes + inner * part + k;
        };
        Eigen::MatrixXcd whole(2 * n, 2 * n);
        for (Eigen::Index j = 0; j < n; ++j)
            for (Eigen::Index i = 0; i < n; ++i) {
                const Complex Z(forward(i, j), outside(i, j));
                whole(row(i, 0), row(j, 0)) = Z;
                whole(row(i, 1), row(j, 1)) = std::conj(Z);
                whole(row(i, 0), row(j, 1)) = whole(row(i, 1), row(j, 0)) = difference(i, j);
            }
        out = condensed(whole, 2 * at_nodes);
    }
    const Complex turn = std::polar(1.0, 2 * of.asymmetry_angle);
    out.topRightCorner(at_nodes, at_nodes) *= turn;
    out.bottomLeftCorner(at_nodes, at_nodes) *= std::conj(turn);
    return out;
}

/// Slopes count in lengths of the shaft: all unknowns of one kind, so that the choice of pivots
/// does not depend on the unit of length.
void CondensedMotion::add_shaft() {
    Block one;
    for (const Stretch &stretch : _stretches) {
        if (!stretch.like_last)
            one = element(stretch.first);
        const Block all = in_a_row(one, stretch.count);
        const auto place = [&](Eigen::Index i) {
            const auto index = static_cast<int>(i) % at_nodes;
            return unknown(stretch.first + (index / 2) * stretch.count,
                           static_cast<int>(i) / at_nodes, index % 2 == 1);
        };
        for (Eigen::Index i = 0; i < all.values.rows(); ++i)
            for (Eigen::Index j = 0; j < all.values.rows(); ++j)
                add(place(i), place(j), all.values(i, j), all.sizes(i, j));
    }
}

void CondensedMotion::add_block(int node, bool slope, const Eigen::Matrix2cd &block) {
    const double length = _discretization.rotor().shaft.length();
    const double scale = slope ? length * length : 1;
    for (int i = 0; i < _parts; ++i)
        for (int j = 0; j < _parts; ++j)
            add(unknown(node, i, slope), unknown(node, j, slope), block(i, j) / scale,
                std::abs(block(i, j)) / scale);
}

void CondensedMotion::add_discs() {
    const double square = _speed * _speed;
    for (const model::Disc &disc : _discretization.rotor().discs) {
        const int node = _discretization.shaft_mesh().node_at(disc.z);
        const double other = _rotating ? disc.Id - disc.Ip : disc.Id + disc.Ip;
        add_block(node, false, -square * disc.mass * Eigen::Matrix2cd::Identity());
        Eigen::Matrix2cd tilt = Eigen::Matrix2cd::Zero();
        tilt(0, 0) = -square * (disc.Id - disc.Ip);
        tilt(1, 1) = -square * other;
        add_block(node, true, tilt);
    }
}

/// a Omega^2 conj(u) in the rotating frame, a = dI exp(2 i angle).
void CondensedMotion::add_anisotropies() {
    for (const model::Anisotropy &anisotropy : _discretization.rotor().anisotropies) {
        Eigen::Matrix2cd tilt = Eigen::Matrix2cd::Zero();
        tilt(0, 1) = _speed * _speed * anisotropy.dI * std::polar(1.0, 2 * anisotropy.angle);
        tilt(1, 0) = std::conj(tilt(0, 1));
        add_block(_discretization.shaft_mesh().node_at(anisotropy.z), true, tilt);
    }
}

Eigen::Matrix2cd CondensedMotion::on_parts(const Eigen::Matrix2d &k,
                                           const Eigen::Matrix2d &c) const {
    const Eigen::Matrix2cd Z = k + imaginary_unit * _speed * c;
    const Eigen::Matrix2cd T = to_directions();
    Eigen::Matrix2cd out = T.inverse() * Z * T;
    if (_rotating) { // the same from every direction; the second part is the conjugate
        out(0, 1) = out(1, 0) = 0;
        out(1, 1) = std::conj(out(0, 0));
    }
    return out;
}

void CondensedMotion::add_bearings() {
    for (const model::Bearing &bearing : _discretization.rotor().bearings) {
        const int node = _discretization.shaft_mesh().node_at(bearing.z);
        const model::BearingCoefficients at = bearing.at(_speed);
        add_block(node, true, on_parts(at.kt, at.ct));
        const double square = _speed * _speed;
        const Eigen::Matrix2cd film = on_parts(at.k - square * at.m, at.c);
        if (!bearing.pedestal) {
            add_block(node, false, film);
            continue;
        }
        const model::Pedestal &pedestal = *bearing.pedestal;
        const Eigen::Matrix2cd below =
            on_parts(Eigen::Matrix2d((pedestal.k - square * pedestal.mass).asDiagonal()),
                     Eigen::Matrix2d(pedestal.c.asDiagonal()));
        add_block(node, false, film - film * (film + below).inverse() * film); // in series
    }
}

Eigen::VectorXcd CondensedMotion::forces() const {
    Eigen::VectorXcd f = Eigen::VectorXcd::Zero(_sizes.rows());
    for (const model::Imbalance &imbalance : _discretization.rotor().imbalances) {
        const Complex force = imbalance.mr * _speed * _speed * std::polar(1.0, imbalance.phase);
        const int node = _discretization.shaft_mesh().node_at(imbalance.z);
        f(unknown(node, 0, false)) += force;
        if (_rotating)
            f(unknown(node, 1, false)) += std::conj(force);
    }
    return f;
}

void CondensedMotion::solve(double speed) {
    _speed = speed;
    if (speed == 0) { // no force; a free rotor's matrix would be singular
        _motion = forces();
        return;
    }
    _matrix.clear();
    _sizes.setZero();
    add_shaft();
    add_discs();
    add_anisotropies();
    add_bearings();
    _forces = forces();
    _matrix.eliminate();
    _motion = _matrix.solve(_forces);
}

double CondensedMotion::rounding() const {
    if (_speed == 0)
        return 0;
    const Eigen::Index reach = 4 * _parts - 1;
    Eigen::VectorXcd change(_motion.size());
    for (Eigen::Index i = 0; i < change.size(); ++i) {
        double size = std::abs(_forces(i));
        for (Eigen::Index j = std::max<Eigen::Index>(0, i - reach);
             j <= std::min(i + reach, change.size() - 1); ++j)
            size += _sizes(i, j - i + reach) * std::abs(_motion(j));
        change(i) = i % 2 == 0 || i % 3 == 0 ? size : -size;
    }
    return std::numeric_limits<double>::epsilon() * _matrix.solve(std::move(change)).norm() /
           std::max(_motion.norm(), std::numeric_limits<double>::min());
}

Phasor CondensedMotion::at_node(int node) const {
    const Complex a = _motion(unknown(node, 0, false));
    const Complex d = _rotating || _parts == 1 ? 0.0 : _motion(unknown(node, 1, false));
    return {a + d, -imaginary_unit * (a - d)};
}

Eigen::Matrix2cd CondensedMotion::film(const model::Bearing &bearing) const {
    const model::BearingCoefficients at = bearing.at(_speed);
    return at.k - _speed * _speed * at.m + imaginary_unit * _speed * at.c;
}

Phasor CondensedMotion::stretch(int index) const {
    const model::Bearing &bearing =
        _discretization.rotor().bearings[static_cast<std::size_t>(index)];
    const Phasor u = at_node(_discretization.shaft_mesh().node_at(bearing.z));
    if (!bearing.pedestal)
        return u;
    const model::Pedestal &pedestal = *bearing.pedestal;
    const Eigen::Vector2cd below =
        pedestal.k - _speed * _speed * pedestal.mass + imaginary_unit * _speed * pedestal.c;
    const Eigen::Matrix2cd above = film(bearing);
    const Eigen::Vector2cd shaft(u.x, u.y); // what the film takes of it, in series with the ground
    const Eigen::Vector2cd moved =
        (above + Eigen::Matrix2cd(below.asDiagonal())).inverse() * (above * shaft);
    return {u.x - moved(0), u.y - moved(1)};
}

Phasor CondensedMotion::bearing_force(int index) const {
    const Phasor u = stretch(index);
    const Eigen::Vector2cd force =
        film(_discretization.rotor().bearings[static_cast<std::size_t>(index)]) *
        Eigen::Vector2cd(u.x, u.y);
    return {force(0), force(1)};
}

} // namespace whirl::forced
