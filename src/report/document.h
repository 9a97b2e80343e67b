#pragma once

#include "report/report.h"

#include <filesystem>

namespace whirl::report {

/// report.html, its result as .json and its checks as .csv, and .pdf where it is asked for.
/// @param report  a document
/// @throws model::AnalysisFailure where a file cannot be written, a picture not drawn, or the PDF
///         not made; nothing is written then
Files write_document(const Report &report, const std::filesystem::path &folder);

} // namespace whirl::report
