#include "report/csv.h"

#include "results/balance.h"
#include <fmt/format.h>

#include <cmath>
#include <optional>

namespace whirl::report {

namespace {

std::string cell(std::optional<double> value) {
    return value && std::isfinite(*value) ? fmt::format("{}", *value) : "";
}

std::string band_rows(const std::string &which, const std::string &z,
                      const results::BalanceBands &of) {
    std::string csv;
    for (const auto &band : of.bands)
        csv += fmt::format("band,{},{},,{},{},,\n", which, z, cell(band.from), cell(band.to));
    for (const auto &[at_from, at_to] : of.errors)
        csv += fmt::format("band_error,{},{},,{},{},,\n", which, z, cell(at_from), cell(at_to));
    if (of.rigid_bands)
        for (const auto &band : *of.rigid_bands)
            csv += fmt::format("rigid_band,{},{},,{},{},,\n", which, z, cell(band.from),
                               cell(band.to));
    return csv;
}

} // namespace

std::string to_csv(const results::BalanceResult &result) {
    std::string csv = "kind,which,z [m],speed [rad/s],from [rad/s],to [rad/s],value [1/kg],ratio\n";
    for (std::size_t i = 0; i < result.planes.size(); ++i)
        csv += band_rows(std::to_string(i + 1), cell(result.planes[i].z), result.planes[i].bands);
    csv += band_rows("joint", "", result.joint.bands);
    for (const auto &point : result.joint.signature)
        for (std::size_t k = 0; k < point.eigenvalues.size(); ++k)
            csv += fmt::format("eigenvalue,{},,{},,,{},\n", k + 1, cell(point.speed),
                               cell(point.eigenvalues[k]));
    for (std::size_t i = 0; i < result.planes.size(); ++i)
        for (std::size_t k = 0; k < result.planes[i].criterion.size(); ++k)
            csv += fmt::format("criterion,{},{},{},,,{},\n", i + 1, cell(result.planes[i].z),
                               cell(result.speeds[k]), cell(result.planes[i].criterion[k]));
    for (std::size_t i = 0; i < result.pendulum.size(); ++i)
        for (std::size_t k = 0; k < result.pendulum[i].speeds.size(); ++k)
            for (const auto &state : result.pendulum[i].states[k])
                csv += fmt::format("pendulum_{},{},{},{},,,,{}\n",
                                   state.stable ? "stable" : "unstable", i + 1,
                                   cell(result.pendulum[i].z), cell(result.pendulum[i].speeds[k]),
                                   cell(state.ratio));
    if (result.balanced_position)
        for (const auto &band : result.balanced_position->bands)
            csv += fmt::format("balanced_position,,,,{},{},,\n", cell(band.from), cell(band.to));
    for (const auto &run : result.simulated)
        csv += fmt::format("simulated_{},,,{},,,,{}\n", run.outcome, cell(run.speed),
                           cell(run.residual_ratio));
    return csv;
}

} // namespace whirl::report
