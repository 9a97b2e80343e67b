// Report of the command modes.

#include "results/modes.h"

#include "report/common/csv.h"
#include "report/common/table.h"
#include "report/common/words.h"
#include "report/pictures/figures.h"
#include "report/pictures/mode_curves.h"
#include "report/reports.h"
#include "report/vtk.h"
#include "results/whirl.h"

#include <fmt/format.h>

#include <cmath>

namespace whirl::report {

using results::ModeShape;
using results::ModesResult;

namespace {

double frequency(const ModeShape &mode) { return mode.eigenvalue.imag(); }
double real_part(const ModeShape &mode) { return mode.eigenvalue.real(); }

double damping_ratio(const ModeShape &mode) {
    const double modulus = std::abs(mode.eigenvalue);
    return modulus > 0 ? 0.0 - real_part(mode) / modulus : 0.0;
}

/// Real or imaginary parts of the deflections.
auto part(std::vector<std::complex<double>> ModeShape::*of, bool real) {
    return [of, real](const ModeShape &mode) {
        return json_list(mode.*of, [real](std::complex<double> value) {
            return real ? value.real() : value.imag();
        });
    };
}

const Columns<ModeShape> shape_columns{
    {"label", "", {"Mode"}, {"mode"}, &ModeShape::label},
    {"frequency", "", {"Frequency (rad/s)", "{:.10g}"}, {"rad/s", precise}, frequency},
    {"",
     "",
     {"Frequency (Hz)", "{:.10g}"},
     {"Hz"},
     [](const ModeShape &mode) { return frequency(mode) * hertz; }},
    {"real", "", {"Real part (1/s)"}, {}, real_part},
    {"", "", {}, {"damping ratio"}, damping_ratio},
    {"whirl", "", {"Whirl"}, {"whirl"}, &ModeShape::whirl},
    {"forward_share", "", {"Forward share", "{:.4g}"}, {}, &ModeShape::forward_fraction},
    {"forward_fraction", "", {}, {}, &ModeShape::forward_fraction}, // its older name
    {"x_real", "", {}, {}, part(&ModeShape::x, true)},
    {"x_imag", "", {}, {}, part(&ModeShape::x, false)},
    {"y_real", "", {}, {}, part(&ModeShape::y, true)},
    {"y_imag", "", {}, {}, part(&ModeShape::y, false)}};

/// A mode at a station.
struct Deflection {
    double speed;
    const ModeShape &mode;
    double z;
    std::complex<double> x, y;
};

const Columns<Deflection> deflection_columns{
    {"", "speed [rad/s]", {}, {}, &Deflection::speed},
    {"", "mode", {}, {}, [](const auto &at) { return at.mode.label; }},
    {"", "frequency [rad/s]", {}, {}, [](const auto &at) { return frequency(at.mode); }},
    {"", "real [1/s]", {}, {}, [](const auto &at) { return real_part(at.mode); }},
    {"", "whirl", {}, {}, [](const auto &at) { return at.mode.whirl; }},
    {"", "z [m]", {}, {}, &Deflection::z},
    {"", "x_real", {}, {}, [](const auto &at) { return at.x.real(); }},
    {"", "x_imag", {}, {}, [](const auto &at) { return at.x.imag(); }},
    {"", "y_real", {}, {}, [](const auto &at) { return at.y.real(); }},
    {"", "y_imag", {}, {}, [](const auto &at) { return at.y.imag(); }}};

std::string csv_of(const ModesResult &result) {
    std::vector<Deflection> rows;
    for (const ModeShape &mode : result.modes)
        for (std::size_t i = 0; i < result.z.size() && i < mode.x.size() && i < mode.y.size(); ++i)
            rows.push_back({result.speed, mode, result.z[i], mode.x[i], mode.y[i]});
    return csv_table(deflection_columns, rows);
}

std::string text_of(const model::Case &scene, const ModesResult &result) {
    return heading(scene, fmt::format("Mode shapes at {:.6g} rpm", result.speed * rpm)) +
           text_table(shape_columns, result.modes) + model_text(result.model);
}

/// A JavaScript array; five digits are more than a screen shows.
std::string script_array(const std::vector<double> &values) {
    std::string text = "[";
    for (const double value : values)
        text += (text.size() > 1 ? "," : "") +
                (std::isfinite(value) ? fmt::format("{:.5g}", value) : "null");
    return text + "]";
}

/// The curves of the still picture for the script of the page.
std::string drawn_modes(const ModesResult &result) {
    std::string text = "const drawnModes = [";
    for (const ModeShape &mode : result.modes) {
        const ModeCurves curves = mode_curves(mode);
        text += fmt::format("\n{{x: {}, y: {}, atOneInstant: {}}},", script_array(curves.x),
                            script_array(curves.y), curves.at_one_instant);
    }
    return text + "];\n";
}

} // namespace

Report describe(const model::Case &scene, const ModesResult &result) {
    return {.command = "modes",
            .heading = "Mode shapes",
            .scene = &scene,
            .model = &result.model,
            .json =
                [&] {
                    return Json{{"speed", result.speed},
                                {"z", result.z},
                                {"modes", json_rows(shape_columns, result.modes)}};
                },
            .csv = [&] { return csv_of(result); },
            .sections =
                [&] {
                    return std::vector{
                        Section{fmt::format("Modes at {:.6g} rpm", result.speed * rpm),
                                page_table(shape_columns, result.modes)}};
                },
            .text = [&] { return text_of(scene, result); },
            .figure = [&] { return modes_figure(scene, result); },
            .script_data = [&] { return drawn_modes(result); },
            .vtp = [&] { return to_vtp(scene, result); }};
}

} // namespace whirl::report
