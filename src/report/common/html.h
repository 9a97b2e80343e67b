#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace pugi {
class xml_document;
} // namespace pugi

namespace whirl::report {

/// The document as HTML or SVG: no declaration, an end tag for every element.
[[nodiscard]] std::string markup(const pugi::xml_document &document);

/// Text with markup characters escaped.
[[nodiscard]] std::string escaped(const std::string &text);

/// `<name>text</name>` and a line end; the text is escaped here.
[[nodiscard]] std::string element(const char *name, const std::string &text,
                                  const char *of_class = nullptr);

/// The text with each `@name@` that the map knows replaced, once.
[[nodiscard]] std::string filled(const std::string &text,
                                 const std::map<std::string, std::string> &values);

/// A picture of a page: the `<svg` element of an SVG file (what stands before it is left out) in a
/// figure that says what it is to those who do not see it. Empty without such an element.
[[nodiscard]] std::string picture_element(const std::string &svg, const std::string &label);

/// The page with its headings `<h2>` listed where it has `<ul id="contents"></ul>`, each with a
/// link. Headings are looked for in front of the data of the page.
[[nodiscard]] std::string with_contents(std::string page);

/// Links to files beside the page.
[[nodiscard]] std::string file_links(const std::vector<std::string> &names);

/// JSON for a script element: no markup can end the element early.
[[nodiscard]] std::string json_for_script(const std::string &json);

/// A file of src/report/web, such as "chart.js"; empty where there is none.
[[nodiscard]] std::string embedded(const std::string &name);
/// Plotly's JavaScript, embedded at build time from its npm package; empty where the build had
/// none.
[[nodiscard]] std::string_view plotly_bundle();

} // namespace whirl::report
