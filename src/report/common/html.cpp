#include "report/common/html.h"

#include "report/common/text_width.h"
#include "report/common/words.h"

#include <fmt/format.h>
#include <pugixml.hpp>

#include <algorithm>
#include <sstream>

namespace whirl::report {

std::string markup(const pugi::xml_document &document) {
    std::ostringstream text;
    document.save(text, "",
                  pugi::format_no_declaration | pugi::format_indent |
                      pugi::format_no_empty_element_tags,
                  pugi::encoding_utf8);
    return text.str();
}

std::string escaped(const std::string &text) {
    pugi::xml_document document;
    document.append_child(pugi::node_pcdata).set_value(printable(text).c_str());
    const std::string result = markup(document);
    return result.substr(0, result.find_last_not_of('\n') + 1);
}

std::string element(const char *name, const std::string &text, const char *of_class) {
    pugi::xml_document document;
    pugi::xml_node node = document.append_child(name);
    if (of_class != nullptr)
        node.append_attribute("class") = of_class;
    node.text().set(printable(text).c_str());
    return markup(document);
}

std::string filled(const std::string &text, const std::map<std::string, std::string> &values) {
    std::string result;
    std::size_t done = 0;
    for (std::size_t open = text.find('@'); open != std::string::npos;
         open = text.find('@', done)) {
        const std::size_t close = text.find('@', open + 1);
        const auto value = close == std::string::npos
                               ? values.end()
                               : values.find(text.substr(open + 1, close - open - 1));
        result += text.substr(done, open - done) + (value == values.end() ? "@" : value->second);
        done = value == values.end() ? open + 1 : close + 1;
    }
    return result + text.substr(done);
}

std::string picture_element(const std::string &svg, const std::string &label) {
    const std::size_t start = svg.find("<svg");
    if (start == std::string::npos)
        return "";
    pugi::xml_document document;
    pugi::xml_node figure = document.append_child("figure");
    figure.append_attribute("role") = "img";
    figure.append_attribute("aria-label") = printable(label).c_str();
    std::string html = markup(document);
    return html.insert(html.find("</figure>"), "\n" + svg.substr(start) + "\n");
}

std::string with_contents(std::string page) {
    const std::string mark = "<ul id=\"contents\">";
    std::string items;
    std::size_t end = std::min(page.find("<script id=\"result\""), page.size());
    int number = 0;
    for (std::size_t at = page.find("<h2>"); at < end; at = page.find("<h2>", at)) {
        const std::size_t close = page.find("</h2>", at);
        if (close == std::string::npos)
            break;
        const std::string name = fmt::format("section-{}", ++number);
        items += fmt::format("<li><a href=\"#{}\">{}</a></li>", name,
                             page.substr(at + 4, close - at - 4));
        const std::string open = fmt::format("<h2 id=\"{}\">", name);
        page.replace(at, 4, open);
        end += open.size() - 4;
        at += open.size();
    }
    const std::size_t list = page.find(mark);
    return list == std::string::npos ? page : page.insert(list + mark.size(), items);
}

std::string file_links(const std::vector<std::string> &names) {
    return joined(names, " · ", [](const std::string &name) {
        return fmt::format("<a href=\"{0}\">{0}</a>", escaped(name));
    });
}

std::string json_for_script(const std::string &json) {
    std::string safe;
    std::size_t done = 0;
    for (std::size_t at = json.find('<'); at != std::string::npos; at = json.find('<', done)) {
        safe.append(json, done, at - done).append("\\u003c");
        done = at + 1;
    }
    return safe.append(json, done);
}

} // namespace whirl::report
