#include "ends/finer_ends.h"

#include "mesh_error/safety.h"

#include <cmath>

namespace whirl::ends {

namespace {

/// Part of the kinetic energy that both have in common, of that of both.
double likeness(const Eigen::VectorXcd &a, const Eigen::VectorXcd &b,
                const Eigen::SparseMatrix<double> &mass) {
    const auto product = [&mass](const Eigen::VectorXcd &x, const Eigen::VectorXcd &y) {
        return x.dot(mass.cast<std::complex<double>>() * y);
    };
    return std::norm(product(a, b)) / std::abs(product(a, a) * product(b, b));
}

} // namespace

FinerEnds::FinerEnds(
    const assembly::Discretization &discretization,
    const std::function<modes::FormMatrices(const assembly::Discretization &)> &matrices)
    : _discretization(discretization),
      _finer(discretization.rotor(), mesh_error::finer_order(discretization.order())),
      _matrices(matrices(_finer)), _places(discretization.places_in(_finer)) {}

FinerEnds::FinerEnds(const assembly::Discretization &discretization, results::Form form,
                     const balancers::Arrangement &arrangement)
    : FinerEnds(discretization, [&](const assembly::Discretization &finer) {
          return modes::FormMatrices(
              finer, form, balancers::balancer_elements(discretization.rotor(), arrangement));
      }) {}

Eigen::VectorXcd FinerEnds::embedded(const Eigen::VectorXcd &vector) const {
    const Eigen::Index own = 2 * _discretization.planar_size();
    const Eigen::Index all = 2 * _finer.planar_size();
    const Eigen::Index attached = vector.size() - own; // balls
    Eigen::VectorXcd out = Eigen::VectorXcd::Zero(all + attached);
    out.tail(attached) = vector.tail(attached);
    for (std::size_t i = 0; i < _places.size(); ++i)
        out.segment<2>(2 * _places[i]) = vector.segment<2>(2 * static_cast<Eigen::Index>(i));
    return out;
}

std::optional<double> FinerEnds::error(const EndOfGrowth &own, double inward, double reach) const {
    constexpr double alike = 0.5; // of 1: above a half no other motion can be as much alike
    WholeMotion guess = own;
    guess.right = embedded(own.right);
    guess.left = embedded(own.left);
    const auto other = own.kind == results::EndKind::collision
                           ? collision(_matrices, guess, reach)
                           : on_the_axis(_matrices, guess, own.kind == results::EndKind::zero);
    const bool same_way = own.kind == results::EndKind::zero || // the rate can be rounding
                          (other && other->inward == own.inward);
    if (!other || !(std::abs(other->speed - own.speed) <= reach) || !(own.inward * inward > 0) ||
        !same_way || !(likeness(guess.right, other->right, _matrices.mass()) > alike))
        return std::nullopt;
    const double error = own.blur + other->blur + 1e-12 * std::abs(own.speed) +
                         mesh_error::estimate_safety * std::abs(other->speed - own.speed);
    return std::isfinite(error) ? std::optional(error) : std::nullopt;
}

} // namespace whirl::ends
