#include "report/csv.h"

#include "report/csv_cell.h"
#include "results/response.h"

#include <fmt/format.h>

namespace whirl::report {

namespace {

/// The cells of the lists at one speed, in their order.
std::string cells(const std::vector<const std::vector<double> *> &lists, std::size_t i) {
    std::string text;
    for (const std::vector<double> *list : lists)
        text += "," + (list != nullptr ? csv_cell(*list, i) : "");
    return text;
}

std::string place(double speed, const char *kind, const std::string &name, double z) {
    return fmt::format("{},{},{},{}", csv_cell(speed), kind, csv_cell(name), csv_cell(z));
}

} // namespace

std::string to_csv(const results::ResponseResult &result) {
    constexpr const std::vector<double> *no = nullptr;
    std::string csv = "speed [rad/s],kind,name,z [m],amplitude [m],phase [rad],major [m],minor [m],"
                      "force [N],x [m],x_phase [rad],y [m],y_phase [rad],inclination [rad],error,"
                      "angle [rad]\n";
    for (std::size_t i = 0; i < result.speeds.size(); ++i) {
        const double speed = result.speeds[i];
        for (const auto &node : result.nodes)
            csv +=
                place(speed, "node", node.name, node.z) +
                cells({&node.amplitude, &node.phase, &node.major, &node.minor, no, &node.x,
                       &node.x_phase, &node.y, &node.y_phase, &node.inclination, &node.error, no},
                      i) +
                "\n";
        for (const auto &bearing : result.bearings)
            csv +=
                place(speed, "bearing", bearing.name, bearing.z) +
                cells({no, no, no, no, &bearing.force, no, no, no, no, no, &bearing.error, no}, i) +
                "\n";
        for (const auto &probe : result.probes)
            csv += place(speed, "probe", probe.name, probe.z) +
                   cells({&probe.amplitude, &probe.phase, no, no, no, no, no, no, no, no,
                          &probe.error},
                         i) +
                   "," + csv_cell(probe.angle) + "\n";
    }
    return csv;
}

} // namespace whirl::report
