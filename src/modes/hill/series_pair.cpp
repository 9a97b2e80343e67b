#include "modes/hill/series_pair.h"

#include "modes/hill/fixed_frame_whirl.h"

#include <algorithm>
#include <cmath>

namespace whirl::modes {

namespace {

/// With the largest entry of its first `size` real: of a motion that is its own conjugate all are.
void make_real(Eigen::VectorXcd &vector, Eigen::Index size) {
    Eigen::Index largest = 0;
    vector.head(size).cwiseAbs().maxCoeff(&largest);
    if (vector(largest) != 0.0)
        vector /= vector(largest);
    vector = vector.real().eval();
}

} // namespace

linalg::ComplexPair series_pair(const RotatingSpectrum &rotor, double speed,
                                std::complex<double> value, const Eigen::MatrixXcd &terms,
                                Eigen::Index place) {
    const Eigen::Index n = terms.rows();
    const Eigen::Index middle = terms.cols() / 2;
    const bool real = value.imag() == 0 && place == middle;
    value += std::complex<double>(0, 1) * (2 * speed * static_cast<double>(place - middle));
    const bool conjugate = value.imag() < 0;
    const auto term = [&](Eigen::Index k) -> Eigen::VectorXcd {
        const Eigen::Index at = place + (conjugate ? -k : k);
        if (at < 0 || at >= terms.cols())
            return Eigen::VectorXcd::Zero(n);
        return conjugate ? Eigen::VectorXcd(terms.col(at).conjugate())
                         : Eigen::VectorXcd(terms.col(at));
    };
    // Of the largest term: the eigenvalue is off by the square, below rounding.
    constexpr double hardly = 1e-9;
    const Eigen::VectorXd sizes = terms.colwise().norm();
    Eigen::Index harmonics = rotor.harmonics();
    for (Eigen::Index k = 0; k < terms.cols(); ++k)
        if (sizes(k) > hardly * sizes.maxCoeff())
            harmonics = std::max(harmonics, std::abs(k - place));
    linalg::ComplexPair pair;
    pair.value = conjugate ? std::conj(value) : value;
    pair.vector.resize(n * (2 * harmonics + 1));
    pair.vector.head(n) = term(0);
    for (Eigen::Index k = 1; k <= harmonics; ++k) {
        pair.vector.segment((2 * k - 1) * n, n) = term(k) + term(-k);
        pair.vector.segment(2 * k * n, n) = std::complex<double>(0, 1) * (term(k) - term(-k));
    }
    if (real)
        make_real(pair.vector, n);
    return pair;
}

std::vector<Eigen::Index> shown_places(const RotatingSpectrum &rotor, std::complex<double> value,
                                       const Eigen::MatrixXcd &terms, double speed) {
    const Eigen::Index middle = terms.cols() / 2;
    if (value.imag() == 0)
        return {middle};
    Eigen::VectorXd sizes(terms.cols());
    for (Eigen::Index k = 0; k < terms.cols(); ++k)
        sizes(k) = rotor.motion_energy(terms.col(k));
    const auto frequency = [&](Eigen::Index place) {
        return value.imag() + 2 * speed * static_cast<double>(place - middle);
    };
    std::vector<Eigen::Index> largest;
    for (Eigen::Index k = 0; k < terms.cols(); ++k)
        if (sizes(k) >= equal_share * sizes.maxCoeff())
            largest.push_back(k);
    if (largest.size() == 1)
        return largest;
    std::vector<double> turns;
    for (const Eigen::Index k : largest)
        turns.push_back(fixed_frame_whirl(rotor.stations(), terms, k, frequency(k), speed).turn);
    const auto alike = [&](double a, double b) {
        return std::abs(a - b) <= 1e-9 * std::abs(speed);
    };
    // Conjugate terms turn alike; of two that turn against each other one stands for both, the one
    // that never comes to stand in the rotor.
    std::vector<Eigen::Index> out;
    std::vector<double> taken;
    for (const double sense : {-1.0, 1.0})
        for (std::size_t i = 0; i < largest.size(); ++i)
            if (sense * turns[i] * speed >= 0 && std::ranges::none_of(taken, [&](double other) {
                    return alike(other, std::abs(turns[i]));
                })) {
                out.push_back(largest[i]);
                taken.push_back(std::abs(turns[i]));
            }
    return out;
}

} // namespace whirl::modes
