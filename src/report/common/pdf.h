#pragma once

#include <string>

namespace whirl::report {

/// What prints pages: Chromium under one of its names, which draws the page as browsers show it,
/// else WeasyPrint, which is smaller. Both write to standard output, so no half PDF lies about.
/// @throws model::AnalysisFailure where there is none: says what to install
void require_printer();

/// The page as PDF, by its style sheet for print.
/// @param html  loads nothing from elsewhere
/// @throws model::AnalysisFailure where no program prints it, or not within two minutes
[[nodiscard]] std::string pdf_of(const std::string &html);

} // namespace whirl::report
