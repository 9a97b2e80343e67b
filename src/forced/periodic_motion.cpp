#include "forced/periodic_motion.h"

#include "assembly/planes.h"
#include "linalg/roots.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstddef>
#include <limits>
#include <numbers>

namespace whirl::forced {

Eigen::Vector2d TurnParts::at(double angle) const {
    Eigen::Vector2d out(0, 0);
    std::complex<double> turn = std::polar(1.0, first * angle);
    const std::complex<double> twice = std::polar(1.0, 2 * angle);
    for (const Phasor &part : parts) {
        out += Eigen::Vector2d((part.x * turn).real(), (part.y * turn).real());
        turn *= twice;
    }
    return out;
}

double TurnParts::largest() const { return at(farthest()).norm(); }

double TurnParts::change_of_largest(const TurnParts &changes) const {
    const double angle = farthest();
    const Eigen::Vector2d there = at(angle);
    const double size = there.norm();
    return size > 0 ? there.dot(changes.at(angle)) / size : changes.largest();
}

double TurnParts::farthest() const {
    const auto size = [](const Phasor &part) { return std::abs(part.x) + std::abs(part.y); };
    double sum = 0;
    for (const Phasor &part : parts)
        sum += size(part);
    std::size_t count = parts.size(); // without those that the last digits do not show
    double left_out = 0;
    while (count > 0 &&
           (left_out += size(parts[count - 1])) <= std::numeric_limits<double>::epsilon() * sum)
        --count;
    if (count == 0)
        return 0;
    // A polynomial of so many harmonics has no more bumps than twice their number: this many points
    // leave one a place next to which it falls off on both sides.
    const auto points = static_cast<int>(8 * (first + 2 * count));
    const TurnParts main{first,
                         {parts.begin(), parts.begin() + static_cast<std::ptrdiff_t>(count)}};
    const double step = 2 * std::numbers::pi / points;
    int best = 0;
    double most = -1;
    for (int i = 0; i < points; ++i)
        if (const double here = main.at(i * step).norm(); here > most) {
            most = here;
            best = i;
        }
    const double angle = linalg::least_place([&main](double a) { return -main.at(a).norm(); },
                                             (best - 1) * step, (best + 1) * step);
    return main.at(angle).norm() >= most ? angle : best * step;
}

TurnParts TurnParts::read(double angle) const {
    TurnParts out{first, {}};
    for (const Phasor &part : parts)
        out.parts.push_back({reading(part, angle), 0});
    return out;
}

TurnParts TurnParts::moving() const {
    TurnParts out = *this;
    if (first == 0) {
        out.first = 2;
        out.parts.erase(out.parts.begin());
    }
    return out;
}

Phasor TurnParts::part(int multiple) const {
    const int place = (multiple - first) / 2;
    return place >= 0 && place < static_cast<int>(parts.size())
               ? parts[static_cast<std::size_t>(place)]
               : Phasor{0, 0};
}

PeriodicMotion::PeriodicMotion(const assembly::Discretization &discretization, double gravity)
    : _discretization(discretization), _gravity(gravity), _rotor(discretization, {}) {}

bool PeriodicMotion::solve(double speed) {
    using Complex = std::complex<double>;
    _speed = speed;
    Complex exponent = 0;
    Eigen::VectorXcd load;
    if (_gravity != 0) { // -i m g exp(-i Omega t) on x + i y: the real part of this exp(i Omega t)
        const Eigen::VectorXcd w = imaginary_unit * _gravity * weight_loads(_discretization);
        exponent = Complex(0, speed);
        load = assembly::in_pairs(w, imaginary_unit * w);
    } else {
        const Eigen::VectorXcd w = (speed * speed) * imbalance_loads(_discretization);
        load = assembly::in_pairs(w.real().cast<Complex>(), w.imag().cast<Complex>());
    }
    auto solution = _rotor.driven(speed, exponent, load);
    if (!solution)
        return false;
    _solution = std::move(*solution);
    return true;
}

TurnParts PeriodicMotion::motion(const assembly::Combination &combination) const {
    using Complex = std::complex<double>;
    const Eigen::Index columns = _solution.terms.cols();
    const int N = static_cast<int>((columns - 1) / 2);
    Eigen::RowVectorXcd u = Eigen::RowVectorXcd::Zero(columns);
    Eigen::RowVectorXcd v = u;
    for (const auto &[unknown, value] : combination) {
        u += value * _solution.terms.row(2 * unknown);
        v += value * _solution.terms.row(2 * unknown + 1);
    }
    // Of (u + i v) exp(i Omega t) the terms exp(i m Omega t).
    const auto at = [&](const Eigen::RowVectorXcd &row, int k) {
        return std::abs(k) <= N ? row(k + N) : Complex(0);
    };
    const auto term = [&](int m) {
        if (_gravity == 0) // u, v: sum of terms exp(2 i k Omega t), real together
            return at(u, (m - 1) / 2) + imaginary_unit * at(v, (m - 1) / 2);
        // u, v: real part of the sum of terms exp((2k + 1) i Omega t)
        return 0.5 * (at(u, m / 2 - 1) + imaginary_unit * at(v, m / 2 - 1) +
                      std::conj(at(u, -m / 2) - imaginary_unit * at(v, -m / 2)));
    };
    TurnParts out;
    out.first = _gravity == 0 ? 1 : 0;
    for (int m = out.first; m <= 2 * N + 1; m += 2) {
        if (m == 0) {
            out.parts.push_back({term(0).real(), term(0).imag()});
            continue;
        }
        const Complex a = term(m);
        const Complex d = std::conj(term(-m));
        out.parts.push_back({a + d, -imaginary_unit * (a - d)});
    }
    return out;
}

TurnParts PeriodicMotion::bearing_force(int bearing) const {
    TurnParts out = motion(stretch_of_bearing(_discretization, bearing));
    const model::BearingCoefficients at =
        _discretization.rotor().bearings[static_cast<std::size_t>(bearing)].at(_speed);
    int multiple = out.first;
    for (Phasor &part : out.parts) {
        const double frequency = multiple * _speed;
        const Eigen::Vector2cd force =
            (at.k - frequency * frequency * at.m + imaginary_unit * frequency * at.c) *
            Eigen::Vector2cd(part.x, part.y);
        part = {force(0), force(1)};
        multiple += 2;
    }
    return out;
}

} // namespace whirl::forced
