#include "modes/rotating/rotating_pencil.h"

#include <algorithm>
#include <cmath>

namespace whirl::modes {

void RotatingPencil::set_speed(double speed) {
    _speed = speed;
    _pencil.set(_matrices.at(speed), 0.31 * std::max(std::abs(speed), _slow));
}

std::optional<linalg::ComplexPair> RotatingPencil::refined(const linalg::ComplexPair &guess,
                                                           double farthest) {
    // Small eigenvalues are blurred beside large ones: parts of the speed or of the motions on the
    // supports.
    constexpr double blurred = 1e-6;
    const bool real = guess.value.imag() == 0;
    const std::optional<WholeRoot> found =
        _pencil.refined({guess.value, guess.vector, in_mirror<double>(guess.vector)});
    if (!found)
        return std::nullopt;
    const double size = std::abs(found->value);
    const double reach = std::max(farthest * size, blurred * std::max(std::abs(_speed), _slow));
    const bool became_real = !real && found->value.imag() <= 1e-8 * size;
    if (became_real || !(std::abs(found->value - guess.value) <= reach))
        return std::nullopt;
    linalg::ComplexPair out{found->value, found->right, found->residual, found->rounding,
                            found->left.conjugate()};
    Eigen::Index largest = 0;
    out.vector.cwiseAbs2().maxCoeff(&largest);
    out.vector /= out.vector(largest);
    return out;
}

} // namespace whirl::modes
