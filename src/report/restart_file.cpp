#include "report/restart_file.h"

#include "model/errors.h"
#include "report/common/files.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <cstdint>
#include <fstream>

namespace whirl::model {
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(Restart, signature, time, step, displacements, velocities,
                                   angles, rates, spin, books, energy, momentum, largest, last,
                                   series, peaks, peak_times)
} // namespace whirl::model

namespace whirl::report {

using nlohmann::json;

namespace {

constexpr const char *restart_kind = "restart of simulate";

std::string text_of(const json &content) {
    return content.dump(-1, ' ', false, json::error_handler_t::replace);
}

/// FNV-1a of 64 bits (G. Fowler, L. C. Noll, K.-P. Vo) of all that the file holds beside it: digits
/// that were changed, lost or mixed up are noticed.
std::string checksum(json content) {
    content.erase("checksum");
    std::uint64_t hash = 0xcbf29ce484222325;
    for (const char c : text_of(content)) {
        hash ^= static_cast<unsigned char>(c);
        hash *= 0x100000001b3;
    }
    return fmt::format("{:016x}", hash);
}

/// What is wrong with the time and the step from which the motion would go on; empty: nothing.
std::string misfit(const model::Restart &restart) {
    if (!(restart.time >= 0))
        return fmt::format("time = {}, expected 0 s or more", restart.time);
    // Before its first step the integrator has none to try.
    if (!(restart.step > 0) && !(restart.step == 0 && restart.time == 0))
        return fmt::format("step = {}, expected more than 0 s", restart.step);
    return "";
}

} // namespace

void write_restart(const std::filesystem::path &file, const model::Restart &restart) {
    json content = restart;
    content.update(
        {{"program", "whirl"}, {"format", 1}, {"kind", restart_kind}, {"case", restart.case_name}});
    content["checksum"] = checksum(content);
    write_file_atomically(file, text_of(content));
}

model::Restart read_restart(const std::filesystem::path &file) {
    const std::string expected =
        fmt::format("simulate.restart: expected the restart file of an interrupted run, got \"{}\"",
                    file.string());
    std::ifstream stream(file);
    std::error_code ignored;
    if (!stream || !std::filesystem::is_regular_file(file, ignored))
        throw model::BadInput(expected + ", which cannot be opened");
    try {
        const json j = json::parse(stream, [](int depth, json::parse_event_t, json &) {
            constexpr int deepest = 10; // a restart has three
            if (depth > deepest)
                throw json::other_error::create(0, "deep", static_cast<const json *>(nullptr));
            return true;
        });
        if (j.at("kind") != restart_kind || j.at("format") != 1)
            throw model::BadInput(expected + ", which is another file");
        auto r = j.get<model::Restart>();
        j.at("case").get_to(r.case_name);
        if (const std::string wrong = misfit(r); !wrong.empty())
            throw model::BadInput(fmt::format("{} with {}", expected, wrong));
        if (!j.contains("checksum"))
            throw model::BadInput(expected + ", which has no checksum: it is of an earlier version "
                                             "of the program, or was written by hand");
        if (j.at("checksum") != checksum(j))
            throw model::BadInput(expected + ", which was changed or damaged since it was written "
                                             "(its checksum is that of other numbers)");
        return r;
    } catch (const json::exception &) {
        throw model::BadInput(expected + ", which is another file or was cut short");
    }
}

} // namespace whirl::report
