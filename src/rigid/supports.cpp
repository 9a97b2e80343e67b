#include "rigid/supports.h"

#include <algorithm>

namespace whirl::rigid {

namespace {

std::string reason_against(const model::Rotor &rotor) {
    if (!rotor.bearings_isotropic())
        return "a bearing is not isotropic";
    if (rotor.bearings_depend_on_speed())
        return "a bearing depends on the spin speed";
    if (std::ranges::any_of(rotor.bearings, [](const model::Bearing &bearing) {
            return bearing.pedestal.has_value();
        }))
        return "a bearing stands on a pedestal";
    if (std::ranges::any_of(rotor.bearings, &model::Bearing::has_mass))
        return "a bearing or seal has mass coefficients";
    if (rotor.shaft.damped_outside())
        return "the shaft has damping of its own";
    return "";
}

} // namespace

std::optional<closed_form::ReducedSupports> reduced_supports(const model::Rotor &rotor,
                                                             double center, std::string &why) {
    why = reason_against(rotor);
    if (!why.empty())
        return std::nullopt;
    closed_form::ReducedSupports sum;
    for (const model::Bearing &bearing : rotor.bearings) {
        const model::BearingCoefficients &row = bearing.rows.front();
        const double z = bearing.z - center;
        sum.c_x += row.k(0, 0);
        sum.c_y += row.k(0, 0) * z;
        sum.c_beta += row.k(0, 0) * z * z + row.kt(0, 0);
        sum.h_x += row.c(0, 0);
        sum.h_y += row.c(0, 0) * z;
        sum.h_beta += row.c(0, 0) * z * z + row.ct(0, 0);
    }
    if (sum.c_x > 0)
        return sum;
    why = "no bearing carries the rotor";
    return std::nullopt;
}

} // namespace whirl::rigid
