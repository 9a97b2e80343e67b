#pragma once

#include <string>

namespace whirl::report {

/// The page as PDF, by its style sheet for print, printed by Chromium under one of its names, which
/// draws the page as browsers show it, else by WeasyPrint, which is smaller. Both write to standard
/// output, so no half PDF lies about.
/// @param html  loads nothing from elsewhere
/// @throws model::AnalysisFailure where no program prints it, or not within two minutes, and says
///         what to install where there is none
[[nodiscard]] std::string pdf_of(const std::string &html);

} // namespace whirl::report
