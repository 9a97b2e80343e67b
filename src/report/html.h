#pragma once

#include "model/case.h"
#include "results/formulation.h"
#include "results/model_summary.h"

#include <string>
#include <utility>
#include <vector>

namespace whirl::report {

/// What a page shows between its common head and foot.
struct PageContent {
    std::string command; ///< "campbell", ...
    std::string heading; ///< "Campbell diagram", ...
    std::string script;  ///< JavaScript that fills the element with id "plot"; may be empty
    std::string picture; ///< SVG shown where no script can draw
    std::string json;    ///< the result, for the script and for readers of the page
    std::vector<std::pair<std::string, std::string>> sections; ///< heading and HTML, after the plot
};

/// One self-contained page: nothing is loaded from elsewhere.
[[nodiscard]] std::string page(const model::Case &scene, const results::ModelSummary &model,
                               const PageContent &content);

/// HTML table; cells are escaped here.
[[nodiscard]] std::string html_table(const std::vector<std::string> &head,
                                     const std::vector<std::vector<std::string>> &rows);

/// The equations of the form, as HTML.
[[nodiscard]] std::string form_formula(results::Form form);

} // namespace whirl::report
