#include "oracles/continuum.h"

#include "oracles/continuum_walk.h"

namespace whirl::oracles {

namespace {

Real cowper(const Cylinder &c) {
    const Real nu = static_cast<Real>(c.E) / (2 * static_cast<Real>(c.G)) - 1;
    const Real m2 = static_cast<Real>(c.inner) * c.inner / (static_cast<Real>(c.outer) * c.outer);
    const Real s = (1 + m2) * (1 + m2);
    return 6 * (1 + nu) * s / ((7 + 6 * nu) * s + (20 + 12 * nu) * m2);
}

/// Bending stiffness etc. of a cylinder, SI.
Continuum::Piece properties(const Cylinder &c) {
    const Real ro = static_cast<Real>(c.outer) / 2;
    const Real ri = static_cast<Real>(c.inner) / 2;
    const Real A = std::numbers::pi_v<Real> * (ro - ri) * (ro + ri);
    const Real I = A * (ro * ro + ri * ri) / 4;
    const Real kappa = c.kappa > 0 ? static_cast<Real>(c.kappa) : cowper(c);
    return {static_cast<Real>(c.length), c.E * I, kappa * c.G * A, c.rho * A, c.rho * I};
}

bool zero(const Block &b) { return b[0][0] == 0 && b[0][1] == 0 && b[1][0] == 0 && b[1][1] == 0; }
bool round(const Block &b) { return b[0][0] == b[1][1] && b[0][1] == -b[1][0]; }
bool straight(const Block &b) { return b[0][1] == 0 && b[1][0] == 0; }
bool symmetric(const Block &b) { return b[0][1] == b[1][0]; }

/// A position along the shaft and what is attached there.
struct Station {
    Real z = 0;
    Continuum::Point point;
};

std::vector<Station> stations_of(const SteppedRotor &rotor, const Continuum::Units &units,
                                 const std::vector<Real> &ends) {
    std::vector<Station> stations;
    const auto at = [&stations](Real z) -> Continuum::Point & {
        for (Station &s : stations)
            if (s.z == z)
                return s.point;
        stations.push_back({z, {}});
        return stations.back().point;
    };
    at(0);
    for (const Real end : ends)
        at(end);
    // A position given in double need not equal the sum of lengths it means.
    const auto place = [&ends](double z) {
        for (const Real end : ends)
            if (std::abs(z - end) <= 1e-14L * ends.back())
                return end;
        return static_cast<Real>(z);
    };
    for (const RigidDisc &disc : rotor.discs) {
        Continuum::Point &p = at(place(disc.z));
        p.mass += disc.mass * units.force;
        p.Id += disc.Id * units.moment;
        p.Ip += disc.Ip * units.moment;
    }
    for (const Support &support : rotor.supports)
        at(place(support.z)).supports.push_back(support);
    std::sort(stations.begin(), stations.end(),
              [](const Station &a, const Station &b) { return a.z < b.z; });
    return stations;
}

} // namespace

double SteppedRotor::length() const {
    double sum = 0;
    for (const Cylinder &c : shaft)
        sum += c.length;
    return sum;
}

Continuum::Continuum(const SteppedRotor &rotor) : _internal_damping(rotor.internal_damping) {
    std::vector<Real> ends;
    Real length = 0;
    for (const Cylinder &c : rotor.shaft)
        ends.push_back(length += c.length);
    const Real L2 = length * length;
    const Real EI = properties(rotor.shaft.front()).EI;
    _units = {L2 * length / EI, length / EI};
    const std::vector<Station> stations = stations_of(rotor, _units, ends);
    for (std::size_t i = 0; i < stations.size(); ++i) {
        _points.push_back(stations[i].point);
        if (i + 1 == stations.size())
            break;
        const Real middle = (stations[i].z + stations[i + 1].z) / 2;
        const auto segment = static_cast<std::size_t>(
            std::upper_bound(ends.begin(), ends.end(), middle) - ends.begin());
        const Piece p = properties(rotor.shaft[segment]);
        _pieces.push_back({(stations[i + 1].z - stations[i].z) / length, p.EI / EI, p.GA * L2 / EI,
                           p.mass * L2 * L2 / EI, p.inertia * L2 / EI});
    }
    for (const Support &s : rotor.supports) {
        const bool undamped = zero(s.c) && zero(s.ct) && s.pedestal_c == 0;
        _coupled = _coupled || !(round(s.k) && round(s.c) && round(s.kt) && round(s.ct));
        _real = _real && undamped && straight(s.k) && straight(s.kt);
        _conservative = _conservative && undamped && symmetric(s.k) && symmetric(s.kt);
    }
    _real = _real && _internal_damping == 0;
    _conservative = _conservative && _internal_damping == 0;
}

Real Continuum::reference_frequency() const { return std::sqrt(1 / _pieces.front().mass); }

template <class Number, int planes>
Scaled Continuum::walk(const Dynamics<Number> &d, Motion motion, int *below) const {
    Subspace<Number, planes> y;
    for (std::size_t i = 0; i < _points.size(); ++i) {
        pass<Number, planes>(y, _points[i], d, motion, _units, below);
        if (i == _pieces.size())
            break;
        const Piece &piece = _pieces[i];
        std::array<Wave<Number>, 2> waves;
        Real longest = piece.length;
        for (int plane = 0; plane < planes; ++plane) {
            const Real s = sense(motion, plane);
            Wave<Number> &wave = waves[static_cast<std::size_t>(plane)];
            const Number damped =
                narrowed<Number>(Real(1) + _internal_damping * (d.lambda - Complex(0, s) * d.spin));
            wave = {piece.GA * damped, piece.EI * damped, piece.mass * d.lambda2,
                    piece.inertia * (d.lambda2 + 2 * s * d.gyroscopic)};
            longest = std::min(longest, wave.longest());
        }
        const int parts = static_cast<int>(std::ceil(piece.length / longest));
        std::array<Small<Number, 4>, 2> transfers;
        for (std::size_t plane = 0; plane < planes; ++plane)
            transfers[plane] = waves[plane].transfer(piece.length / parts);
        for (int part = 0; part < parts; ++part)
            cross<Number, planes>(y, transfers, below);
    }
    if (below)
        *below += negative_eigenvalues(product(y.U, y.F, true));
    return {Complex(oracles::determinant(y.F) * y.product), y.exponent};
}

Scaled Continuum::dispatch(bool real, Complex lambda, const Question &question, int *below) const {
    const Complex spin =
        question.synchronous ? Complex(0, -1) * lambda : Complex(question.speed, 0);
    const Complex gyroscopic = Complex(0, -1) * spin * lambda;
    const bool both = question.motion == Motion::both;
    if (real) {
        const Dynamics<Real> d{(lambda * lambda).real(), gyroscopic.real(), lambda, spin};
        return both ? walk<Real, 2>(d, question.motion, below)
                    : walk<Real, 1>(d, question.motion, below);
    }
    const Dynamics<Complex> d{lambda * lambda, gyroscopic, lambda, spin};
    return both ? walk<Complex, 2>(d, question.motion, below)
                : walk<Complex, 1>(d, question.motion, below);
}

Scaled Continuum::determinant(Complex lambda, const Question &question) const {
    return dispatch(false, lambda, question, nullptr);
}

Scaled Continuum::determinant_at(Real omega, const Question &question, int *below) const {
    if (below)
        *below = 0;
    return dispatch(_real, Complex(0, omega), question, below);
}

} // namespace whirl::oracles
