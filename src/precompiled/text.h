#pragma once

// What most reports use of JSON: see case.h.

#include "precompiled/case.h"
#include "report/common/table.h"

#include <string>

namespace whirl::precompiled {

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
