#include "report/common/table.h"

#include "report/common/html.h"

#include <fmt/format.h>
#include <pugixml.hpp>

#include <algorithm>
#include <cmath>

namespace whirl::report {

std::string shown(const Json &value, const Shown &as, const std::string &missing) {
    if (value.is_string())
        return value.get<std::string>();
    if (value.is_number_float()) {
        const double number = value.get<double>();
        if (std::isfinite(number))
            return fmt::format(fmt::runtime(as.format), number);
        return std::isinf(number) ? as.infinite.value_or(missing) : missing;
    }
    return value.is_null() ? missing : value.dump();
}

std::string page_table(const Texts &table) {
    pugi::xml_document document;
    pugi::xml_node box = document.append_child("div");
    box.append_attribute("class") = "scroll";
    pugi::xml_node parent = box.append_child("table");
    pugi::xml_node head = parent.append_child("thead");
    pugi::xml_node body = parent.append_child("tbody");
    for (const auto &row : table) {
        const bool first = &row == &table.front();
        pugi::xml_node line = (first ? head : body).append_child("tr");
        for (const std::string &text : row)
            line.append_child(first ? "th" : "td").text().set(printable(text).c_str());
    }
    return markup(document);
}

std::string text_table(const Texts &table) {
    std::vector<std::size_t> widths;
    for (const auto &row : table) {
        widths.resize(std::max(widths.size(), row.size()));
        for (std::size_t i = 0; i < row.size(); ++i)
            widths[i] = std::max(widths[i], row[i].size());
    }
    std::string out;
    for (const auto &row : table) {
        for (std::size_t i = 0; i < row.size(); ++i)
            out += i == 0 ? fmt::format("  {:<{}}", row[i], widths[i])
                          : fmt::format("   {:>{}}", row[i], widths[i]);
        out.erase(out.find_last_not_of(' ') + 1);
        out += '\n';
    }
    return out;
}

} // namespace whirl::report
