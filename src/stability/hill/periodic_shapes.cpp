// The planar shapes that an elastic periodic rotor is reduced to.

#include "reduction/projection.h"
#include "stability/hill/periodic_motions.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace whirl::stability {

/// The whole rotor's own motion on the strip. Far from its largest term it is found by the alias
/// around that, which takes few terms.
std::optional<periodic::WholeRotor::Root> PeriodicMotions::whole_root(double speed,
                                                                      const Listed &one) const {
    constexpr double far = 3; // terms
    if (one.frequency > far * 2 * std::abs(speed)) {
        periodic::FloquetMotion motion;
        motion.value = one.motion.value;
        motion.shape = one.shape;
        const auto series = periodic::centred_series(
            system(speed), speed, steps(speed, reach(speed), _experience->density), motion);
        if (series) {
            const reduction::Projection basis(*_shapes);
            Eigen::MatrixXcd terms(2 * _discretization.planar_size() +
                                       2 * balancers::unknowns_of(_balancers),
                                   series->terms.cols());
            for (Eigen::Index k = 0; k < terms.cols(); ++k)
                terms.col(k) = basis.lifted(series->terms.col(k));
            auto root = _whole->next_to(speed, series->value, 0, terms);
            if (root) {
                root->value += motion.value - series->value;
                return root;
            }
        }
    }
    return _whole->next_to(speed, one.motion.value, one.frequency);
}

/// The reduced rotor has the motions of the whole one that were looked at.
bool PeriodicMotions::has_wanted() const {
    constexpr double closely = 1e-8; // over the spin speed
    return std::ranges::all_of(_good_at, [this](const auto &at) {
        const double speed = at.first;
        const List &list = known(speed);
        return std::ranges::all_of(at.second, [&](const Wanted &one) {
            const double allowed =
                closely * std::max(std::abs(speed), std::abs(one.value)) + 10 * one.noise;
            return std::ranges::any_of(list, [&](const Listed &other) {
                return alias_distance(one.value, other.motion.value, 2 * speed) <= allowed;
            });
        });
    });
}

/// Shapes good for one speed were added to those for another, and static deflections to both: of
/// what they span as few as have all motions at these speeds.
void PeriodicMotions::keep_principal() const {
    constexpr std::array least_parts{1e-3, 3e-4, 1e-4, 3e-5};
    // Of the shapes: a tenth less is not worth a check at all speeds.
    constexpr double hardly_fewer = 0.9;
    const auto all = static_cast<double>(_planar->matrix().cols());
    std::vector<const Eigen::MatrixXd *> parts;
    for (const auto &[speed, wanted] : _good_at)
        for (const Wanted &one : wanted)
            parts.push_back(&one.parts);
    const auto principal = _planar->principal(parts);
    Eigen::Index tried = 0;
    for (const double part : least_parts) {
        const Eigen::Index few = (principal.eigenvalues().array() > part * part).count();
        if (static_cast<double>(few) > hardly_fewer * all)
            return;
        if (few == tried || few == 0)
            continue;
        tried = few;
        reduction::PlanarShapes fewer = *_planar;
        fewer.keep(principal.eigenvectors().rightCols(few));
        std::swap(*_planar, fewer);
        use_planar();
        if (has_wanted())
            return;
        std::swap(*_planar, fewer);
        use_planar();
    }
}

std::shared_ptr<const Eigen::MatrixXd>
PeriodicMotions::good_shapes(const std::vector<double> &speeds) const {
    const std::size_t last = speeds.size() - 1;
    set_top(std::max(std::abs(speeds.front()), std::abs(speeds.back())));
    constexpr int tries = 6; // rounds in which motions that the shapes lack are added
    bool more = false;
    for (const std::size_t place : {last, std::size_t{0}, last / 2, last / 4, 3 * last / 4})
        for (int k = 0; _reduced && speeds[place] != 0 && k < tries; ++k) {
            std::vector<Wanted> wanted;
            if (_good_at.count(speeds[place]) > 0)
                break;
            if (corrected(speeds[place], true, &wanted)) {
                _good_at[speeds[place]] = std::move(wanted);
                more = true;
                break;
            }
        }
    if (more && _reduced)
        keep_principal();
    return _shapes;
}

} // namespace whirl::stability
