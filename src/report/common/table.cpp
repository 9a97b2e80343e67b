#include "report/common/table.h"

#include "report/common/html.h"
#include "report/common/text_width.h"

#include <fmt/format.h>
#include <pugixml.hpp>

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace whirl::report {

std::string uncapitalized(std::string text) {
    if (!text.empty() && text.front() >= 'A' && text.front() <= 'Z')
        text.front() = static_cast<char>(text.front() - 'A' + 'a');
    return text;
}

std::string shown(const Json &value, const Shown &as, const std::string &missing) {
    if (value.is_string())
        return value.get<std::string>();
    if (value.is_number_float()) {
        const double number = value.get<double>();
        if (std::isfinite(number)) {
            std::string text = as.digits > 0 ? model::readable(number, as.digits)
                                             : fmt::format(fmt::runtime(as.format), number);
            if (text.starts_with('-') && text.find_first_of("123456789") == std::string::npos)
                text.erase(0, 1); // rounded to nothing
            return text;
        }
        return std::isinf(number) ? as.infinite.value_or(missing) : missing;
    }
    return value.is_null() ? missing : value.dump();
}

namespace {

/// Significant digits of a format without a fixed number of decimals; 0 of others.
int digits_of(const std::string &format) {
    const std::size_t dot = format.find('.');
    const bool significant = format.size() > 1 && format[format.size() - 2] == 'g';
    return dot != std::string::npos && significant ? std::atoi(format.c_str() + dot + 1) : 0;
}

} // namespace

Shown for_terminal(Shown as, const TextStyle &style) {
    if (style.digits == 0)
        return as;
    // Numbers of fewer digits are rough by nature: percents and factors of four, errors.
    constexpr int usual = TextStyle{}.digits;
    constexpr int factors = 4;
    const int digits = digits_of(as.format);
    if (digits >= usual || (digits >= factors && style.digits > usual))
        as.digits = style.digits;
    else
        as.digits = std::min(digits, style.digits);
    return as;
}

bool above_digits(double error, double value, const TextStyle &style) {
    return std::abs(error) > 0.5 * std::pow(10, -style.digits) * std::abs(value);
}

void add_column(Texts &table, const std::string &heading, const std::vector<Json> &values,
                const Shown &as, const std::string &missing) {
    table.front().push_back(heading);
    for (std::size_t i = 0; i < values.size(); ++i)
        table[1 + i].push_back(shown(values[i], as, missing));
}

std::string heading_of(const Shown &column, const model::Unit &unit, bool on_page) {
    std::string text = *column.heading;
    if (unit.peak_to_peak)
        text += text.empty() ? "pk-pk" : " pk-pk";
    if (text.empty() || unit.name.empty())
        return text + unit.name;
    return on_page ? text + " (" + unit.name + ")" : text + " " + unit.name;
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

bool says_something(const Json &value) {
    if (value.is_number_float())
        return !std::isnan(value.get<double>());
    return value.is_string() ? !value.get_ref<const std::string &>().empty() : !value.is_null();
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
        for (const std::string &text : row) {
            pugi::xml_node cell = line.append_child(first ? "th" : "td");
            if (!first && (breaks_at_its_exponent(text) || is_one_range(text)))
                cell.append_attribute("class") = "number";
            cell.text().set(printable(text).c_str());
        }
    }
    return markup(document);
}

std::string rows_left_out(std::size_t shown, std::size_t all) {
    return element("p", fmt::format("The first {} of {} rows.", shown, all), "more");
}

std::string text_table(const Texts &table) {
    const auto letters = [](const std::string &text) { // the first bytes of each
        return static_cast<std::size_t>(std::count_if(text.begin(), text.end(), [](char byte) {
            return (static_cast<unsigned char>(byte) & 0xC0) != 0x80;
        }));
    };
    std::vector<std::size_t> widths;
    for (const auto &row : table) {
        widths.resize(std::max(widths.size(), row.size()));
        for (std::size_t i = 0; i < row.size(); ++i)
            widths[i] = std::max(widths[i], letters(printable(row[i])));
    }
    std::string out;
    for (const auto &row : table) {
        for (std::size_t i = 0; i < row.size(); ++i) {
            const std::string cell = printable(row[i]);
            const std::string blanks(widths[i] - letters(cell), ' ');
            out += i == 0 ? "  " + cell + blanks : "   " + blanks + cell;
        }
        out.erase(out.find_last_not_of(' ') + 1);
        out += '\n';
    }
    return out;
}

} // namespace whirl::report
