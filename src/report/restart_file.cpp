#include "report/restart_file.h"

#include "model/errors.h"
#include "report/common/files.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <fstream>

namespace whirl::report {

using nlohmann::json;

namespace {

constexpr const char *kind = "restart of simulate";

json content(const model::Restart &r) {
    return {{"program", "whirl"},
            {"format", 1},
            {"kind", kind},
            {"case", r.case_name},
            {"signature", r.signature},
            {"time", r.time},
            {"step", r.step},
            {"displacements", r.displacements},
            {"velocities", r.velocities},
            {"angles", r.angles},
            {"rates", r.rates},
            {"spin", r.spin},
            {"books", r.books},
            {"energy", r.energy},
            {"momentum", r.momentum},
            {"largest", r.largest},
            {"last", r.last},
            {"series", r.series}};
}

} // namespace

void write_restart(const std::filesystem::path &file, const model::Restart &restart) {
    write_file_atomically(file,
                          content(restart).dump(-1, ' ', false, json::error_handler_t::replace));
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
        model::Restart r;
        j.at("case").get_to(r.case_name);
        j.at("signature").get_to(r.signature);
        j.at("time").get_to(r.time);
        j.at("step").get_to(r.step);
        j.at("displacements").get_to(r.displacements);
        j.at("velocities").get_to(r.velocities);
        j.at("angles").get_to(r.angles);
        j.at("rates").get_to(r.rates);
        j.at("spin").get_to(r.spin);
        j.at("books").get_to(r.books);
        j.at("energy").get_to(r.energy);
        j.at("momentum").get_to(r.momentum);
        j.at("largest").get_to(r.largest);
        j.at("last").get_to(r.last);
        j.at("series").get_to(r.series);
        return r;
    } catch (const json::exception &) {
        throw model::BadInput(expected + ", which is another file or was cut short");
    }
}

} // namespace whirl::report
