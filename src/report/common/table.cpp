#include "report/common/table.h"

#include "report/common/html.h"
#include "report/common/text_width.h"
#include "report/common/units.h"

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
        if (std::isfinite(number)) {
            std::string text = fmt::format(fmt::runtime(as.format), number);
            if (text.starts_with('-') && text.find_first_of("123456789") == std::string::npos)
                text.erase(0, 1); // rounded to nothing
            return text;
        }
        return std::isinf(number) ? as.infinite.value_or(missing) : missing;
    }
    return value.is_null() ? missing : value.dump();
}

namespace {

/// A column in the units that were asked for.
struct ConvertedColumn {
    UnitHeading heading;
    std::string format; ///< of its numbers
    std::vector<Json> values;
};

bool same_numbers(const std::vector<Json> &a, const std::vector<Json> &b) {
    constexpr double rounding = 1e-12; // of the factors
    for (std::size_t i = 0; i < a.size(); ++i) {
        const bool numbers = a[i].is_number() && b[i].is_number();
        if (numbers ? std::abs(a[i].get<double>() - b[i].get<double>()) >
                          rounding * std::abs(b[i].get<double>())
                    : a[i] != b[i])
            return false;
    }
    return true;
}

/// Numbers in words, such as both ends of a band, keep the unit of their heading.
bool in_words(const Json &value) {
    return value.is_string() &&
           value.get<std::string>().find_first_of("0123456789") != std::string::npos;
}

ConvertedColumn converted(const ShownColumn &column) {
    ConvertedColumn out{heading_in_written_units(*column.as.heading, column.context),
                        column.as.format, column.values};
    if (out.heading.factor != 1 && std::any_of(out.values.begin(), out.values.end(), in_words))
        return {{*column.as.heading, 1, false}, column.as.format, column.values};
    // Some have their unit in the cells.
    const UnitHeading cell =
        heading_in_written_units(column.as.format, *column.as.heading + column.context);
    if (cell.factor != 1) {
        out.format = cell.text;
        out.heading.factor = cell.factor;
    }
    for (Json &value : out.values)
        if (value.is_number_float())
            value = value.get<double>() * out.heading.factor;
    return out;
}

} // namespace

Texts texts_of(const std::vector<ShownColumn> &columns, const std::string &missing) {
    std::vector<ConvertedColumn> kept;
    Texts table(1 + (columns.empty() ? 0 : columns.front().values.size()));
    for (const ShownColumn &column : columns) {
        ConvertedColumn next = converted(column);
        const auto same = std::find_if(kept.begin(), kept.end(), [&](const ConvertedColumn &other) {
            return next.heading.given && other.heading.text == next.heading.text &&
                   same_numbers(other.values, next.values);
        });
        const auto place = static_cast<std::size_t>(same - kept.begin());
        for (auto &row : table)
            row.resize(std::max(row.size(), place + 1));
        table[0][place] = next.heading.text;
        // Of two the one in SI has the digits that the other leaves out.
        if (same == kept.end() || next.heading.factor != 1)
            for (std::size_t i = 0; i < next.values.size(); ++i)
                table[1 + i][place] =
                    shown(next.values[i], {"", next.format, column.as.infinite}, missing);
        if (same == kept.end())
            kept.push_back(std::move(next));
    }
    return table;
}

namespace {

/// A number that a browser would break behind the hyphen of "1.2e-05".
bool breaks_at_its_exponent(const std::string &text) {
    return text.find("e-") != std::string::npos &&
           text.find_first_not_of("0123456789.e+-") == std::string::npos;
}

/// "5254.54 … 6225.15": one number would stand below the other.
bool is_one_range(const std::string &text) {
    const std::size_t dots = text.find(" … ");
    return dots != std::string::npos && text.find(" … ", dots + 1) == std::string::npos &&
           text.find_first_not_of("0123456789.-+e… ") == std::string::npos;
}

} // namespace

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
        for (const std::string &text : row) {
            pugi::xml_node cell = line.append_child(first ? "th" : "td");
            if (!first && (breaks_at_its_exponent(text) || is_one_range(text)))
                cell.append_attribute("class") = "number";
            cell.text().set(printable(text).c_str());
        }
    }
    return markup(document);
}

std::string text_table(const Texts &in_si) {
    std::vector<std::size_t> widths;
    Texts table = in_si;
    for (auto &row : table) {
        widths.resize(std::max(widths.size(), row.size()));
        for (std::size_t i = 0; i < row.size(); ++i) {
            row[i] = cell_in_written_units(printable(row[i]));
            widths[i] = std::max(widths[i], shown_size(row[i]));
        }
    }
    std::string out;
    for (const auto &row : table) {
        for (std::size_t i = 0; i < row.size(); ++i) {
            const std::string blanks(widths[i] - shown_size(row[i]), ' ');
            out += i == 0 ? "  " + row[i] + blanks : "   " + blanks + row[i];
        }
        out.erase(out.find_last_not_of(' ') + 1);
        out += '\n';
    }
    return out;
}

} // namespace whirl::report
