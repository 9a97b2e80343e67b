#include "report/csv.h"

#include "report/csv_cell.h"
#include "results/accuracy.h"
#include "results/campbell.h"
#include "results/critical.h"
#include "results/modes.h"
#include "results/show.h"
#include "results/whirl.h"

#include <fmt/format.h>

#include <optional>
#include <vector>

namespace whirl::report {

namespace {

template <class T> std::string cell(const T &value) { return csv_cell(value); }

template <class T> std::optional<double> at(const std::vector<T> &values, std::size_t i) {
    return i < values.size() ? std::optional<double>(values[i]) : std::nullopt;
}

template <class T>
std::optional<double> at(const std::vector<std::optional<T>> &values, std::size_t i) {
    return i < values.size() ? values[i] : std::nullopt;
}

} // namespace

std::string to_csv(const results::CampbellResult &result) {
    std::string csv = "speed [rad/s],mode,frequency [rad/s],real [1/s],damping_ratio,log_dec,whirl,"
                      "forward_fraction,error,residual\n";
    for (std::size_t i = 0; i < result.speeds.size(); ++i)
        for (const auto &mode : result.modes)
            csv +=
                fmt::format("{},{},{},{},{},{},{},{},{},{}\n", cell(result.speeds[i]),
                            cell(mode.label), cell(at(mode.frequency, i)), cell(at(mode.real, i)),
                            cell(at(mode.damping_ratio, i)), cell(at(mode.log_dec, i)),
                            i < mode.whirl.size() ? results::whirl_name(mode.whirl[i]) : "",
                            cell(at(mode.forward_fraction, i)), cell(at(mode.error, i)),
                            cell(at(mode.residual, i)));
    return csv;
}

std::string to_csv(const results::CriticalResult &result) {
    std::string csv = "speed [rad/s],whirl,real [1/s],error,residual\n";
    for (const auto &critical : result.critical_speeds)
        csv += fmt::format("{},{},{},{},{}\n", cell(critical.speed),
                           results::whirl_name(critical.whirl), cell(critical.real),
                           cell(critical.error), cell(critical.residual));
    return csv;
}

std::string to_csv(const results::ModesResult &result) {
    std::string csv = "speed [rad/s],mode,frequency [rad/s],real [1/s],whirl,z [m],x_real,x_imag,"
                      "y_real,y_imag\n";
    for (const auto &mode : result.modes)
        for (std::size_t i = 0; i < result.z.size() && i < mode.x.size() && i < mode.y.size(); ++i)
            csv += fmt::format("{},{},{},{},{},{},{},{},{},{}\n", cell(result.speed),
                               cell(mode.label), cell(mode.eigenvalue.imag()),
                               cell(mode.eigenvalue.real()), results::whirl_name(mode.whirl),
                               cell(result.z[i]), cell(mode.x[i].real()), cell(mode.x[i].imag()),
                               cell(mode.y[i].real()), cell(mode.y[i].imag()));
    return csv;
}

std::string to_csv(const results::ShowResult &result) {
    return fmt::format("mass [kg],center_of_mass [m],Id [kg m2],Ip [kg m2],type,shaft_mass [kg],"
                       "length [m]\n{},{},{},{},{},{},{}\n",
                       cell(result.mass), cell(result.center_of_mass), cell(result.Id),
                       cell(result.Ip), cell(result.type), cell(result.shaft_mass),
                       cell(result.length));
}

std::string to_csv(const results::AccuracyResult &result) {
    std::string csv = "family,order,elements,unknowns,seconds [s],error_estimate,true_error\n";
    for (const auto &row : result.rows)
        csv += fmt::format("{},{},{},{},{},{},{}\n", cell(row.family), row.order, row.elements,
                           row.unknowns, cell(row.seconds), cell(row.error_estimate),
                           cell(row.true_error));
    return csv;
}

} // namespace whirl::report
