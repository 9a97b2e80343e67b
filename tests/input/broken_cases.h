#pragma once

#include "broken_attachments.h"
#include "broken_bearings.h"
#include "broken_maps.h"
#include "broken_motion.h"
#include "broken_operation.h"
#include "broken_rotating.h"
#include "broken_samples.h"
#include "broken_shafts.h"
#include "broken_sweep.h"
#include "broken_weights.h"

#include <filesystem>
#include <fstream>

namespace whirl::tests {

/// Cases with one mistake each, for tests of the reader and of the program.
inline std::vector<BrokenCase> broken_cases() {
    std::vector<BrokenCase> all = broken_shafts();
    for (const auto &part : {broken_attachments(), broken_bearings(), broken_rotating_parts(),
                             broken_settings(), broken_samples(), broken_sweep(),
                             broken_operation(), broken_maps(), broken_motion(), broken_weights()})
        all.insert(all.end(), part.begin(), part.end());
    return all;
}

/// Writes case.toml and the further files into `folder`, which is made anew.
inline void write_case(const std::filesystem::path &folder, const BrokenCase &broken) {
    std::filesystem::remove_all(folder);
    std::filesystem::create_directories(folder);
    std::ofstream(folder / "case.toml") << broken.text;
    for (const auto &[name, text] : broken.files)
        std::ofstream(folder / name) << text;
}

/// Start of the message: "folder/case.toml:12: bearing[0].kxx: ".
inline std::string expected_start(const std::filesystem::path &folder, const BrokenCase &broken) {
    std::string start = (folder / broken.file).generic_string();
    if (broken.line > 0)
        start += ":" + std::to_string(broken.line);
    start += ": ";
    return broken.key.empty() ? start : start + broken.key + ": ";
}

} // namespace whirl::tests
