#include "report/restart_file.h"

#include "model/errors.h"
#include "report/common/files.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <fstream>

namespace whirl::model {
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(Restart, signature, time, step, displacements, velocities,
                                   angles, rates, spin, books, energy, momentum, largest, last,
                                   series, peaks, peak_times, ends)
} // namespace whirl::model

namespace whirl::report {

using nlohmann::json;

namespace {

constexpr const char *kind = "restart of simulate";

} // namespace

void write_restart(const std::filesystem::path &file, const model::Restart &restart) {
    json content = restart;
    content.update(
        {{"program", "whirl"}, {"format", 1}, {"kind", kind}, {"case", restart.case_name}});
    write_file_atomically(file, content.dump(-1, ' ', false, json::error_handler_t::replace));
}

model::Restart read_restart(const std::filesystem::path &file) {
    const std::string expected =
        fmt::format("simulate.restart: expected the restart file of an interrupted run, got \"{}\"",
                    file.string());
    std::ifstream stream(file);
    std::error_code ignored;
    if (!stream || std::filesystem::is_directory(file, ignored))
        throw model::BadInput(expected + ", which cannot be opened");
    try {
        const json j = json::parse(stream);
        if (j.at("kind") != kind || j.at("format") != 1)
            throw model::BadInput(expected + ", which is another file");
        auto r = j.get<model::Restart>();
        j.at("case").get_to(r.case_name);
        return r;
    } catch (const json::exception &) {
        throw model::BadInput(expected + ", which is another file or was cut short");
    }
}

} // namespace whirl::report
