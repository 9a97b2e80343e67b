#include "ends/growth.h"

#include "stability/band_finder.h"

#include <cmath>
#include <limits>
#include <utility>

namespace whirl::ends {

namespace {

/// Hill's form finds its shapes as it goes.
std::shared_ptr<const Eigen::MatrixXd> shapes_for(const stability::StabilityModel &model,
                                                  const balancers::Arrangement &arrangement,
                                                  const std::vector<double> &speeds) {
    if (model.conservative || model.form == results::Form::hill)
        return nullptr;
    return stability::BandFinder(model, arrangement).good_shapes(speeds);
}

} // namespace

Growth::Growth(const stability::StabilityModel &model, const balancers::Arrangement &arrangement,
               const std::vector<double> &speeds)
    : Growth(model, arrangement, shapes_for(model, arrangement, speeds),
             {speeds.front(), speeds.back()}) {}

Growth::Growth(const stability::StabilityModel &model, const balancers::Arrangement &arrangement,
               std::shared_ptr<const Eigen::MatrixXd> shapes, const results::Interval &range)
    : _from(model.from), _discretization(model.rotor, model.order) {
    if (model.form == results::Form::hill)
        _hill.emplace(model, arrangement, std::move(shapes));
    else if (!model.conservative)
        _motions.emplace(_discretization, model.form, arrangement, std::move(shapes), range.from,
                         range.to);
}

double Growth::at(double speed) const {
    if (std::abs(speed) < _from)
        return std::numeric_limits<double>::quiet_NaN();
    if (_hill)
        return stability::growth_of(_hill->at(speed));
    return _motions ? _motions->fastest_growing(speed).value.real() : 0;
}

} // namespace whirl::ends
