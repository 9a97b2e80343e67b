#pragma once

#include "report/report.h"
#include "sample_results.h"

#include <nlohmann/json.hpp>
#include <pugixml.hpp>

#include <algorithm>

namespace whirl::report {

/// Picture (where it is drawn), data, table and page of a command are in the folder, and each can
/// be read. @returns the data.
inline nlohmann::json expect_whole_report(const Files &files, const std::filesystem::path &folder,
                                          const std::string &command) {
    for (const std::string &name :
         {command + ".json", command + ".csv", std::string("report.html")})
        EXPECT_EQ(std::count(files.paths.begin(), files.paths.end(), folder / name), 1) << name;
    const std::string page = content_of(folder / "report.html");
    EXPECT_EQ(page.rfind("<!DOCTYPE html>", 0), 0U) << command;
    EXPECT_NE(page.find("</html>"), std::string::npos) << command;
    if (files.notes.empty()) {
        pugi::xml_document svg;
        EXPECT_TRUE(svg.load_file((folder / (command + ".svg")).c_str())) << command;
        EXPECT_TRUE(svg.child("svg")) << command;
        EXPECT_EQ(content_of(folder / (command + ".png")).substr(1, 3), "PNG") << command;
    }
    nlohmann::json json =
        nlohmann::json::parse(content_of(folder / (command + ".json")), nullptr, false);
    EXPECT_FALSE(json.is_discarded()) << command;
    EXPECT_EQ(json.value("command", ""), command);
    return json;
}

} // namespace whirl::report
