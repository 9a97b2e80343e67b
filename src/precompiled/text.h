#pragma once

// What most reports and commands include, and what they use of JSON: see case.h.

#include "precompiled/case.h"
#include "report/common/csv.h"
#include "report/common/table.h"
#include "report/pictures/figures.h"
#include "report/pictures/style.h"
#include "report/report.h"
#include "results/critical.h"
#include "results/response.h"
#include "results/stability.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace whirl::precompiled {

inline std::optional<std::filesystem::path> perhaps(const std::filesystem::path &file,
                                                    const std::optional<std::string> &text) {
    std::optional<std::filesystem::path> out(file);
    if (text)
        out = *text;
    return out;
}

inline report::Json json(const std::string &text, double number, int count) {
    report::Json out = {{"text", text}, {"number", number}, {"count", count}, {"none", nullptr}};
    out["list"] = report::Json::array({number, number});
    out["list"].push_back(text);
    out["yes"] = number > 0;
    const report::Json copy = out;
    out["copy"] = copy.at("text");
    out["numbers"] = std::vector<double>{number};
    out["names"] = std::vector<std::string>{text};
    out["perhaps"] = std::optional<double>(number);
    return copy.contains("text") ? out : copy;
}

} // namespace whirl::precompiled
