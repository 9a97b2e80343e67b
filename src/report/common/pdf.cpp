#include "report/common/pdf.h"

#include "model/errors.h"
#include "process/child.h"
#include "process/signals.h"

#include <fmt/format.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <optional>
#include <string_view>
#include <system_error>
#include <vector>

namespace whirl::report {

namespace {

using Words = std::vector<std::string>;

/// Pages of twenty pictures print in some seconds.
constexpr double patience = 120;

/// No sandbox: it does not start for root or in containers, and the page is our own, without
/// scripts.
Words by_chromium(const std::string &name, const std::string &page) {
    return {name,
            "--headless",
            "--no-sandbox",
            "--disable-gpu",
            "--disable-quic",
            "--no-first-run",
            "--disable-background-networking",
            "--no-pdf-header-footer",
            "--print-to-pdf=/dev/stdout",
            "file://" + page};
}

/// The programs that may be here, the best first. @param page  a file that holds it
std::vector<Words> printers(const std::string &page) {
    return {by_chromium("chromium", page),
            by_chromium("chromium-browser", page),
            by_chromium("google-chrome", page),
            by_chromium("google-chrome-stable", page),
            {"weasyprint", "--quiet", "--encoding", "utf8", page, "-"}};
}

/// The page in a folder of its own as long as it is printed: Chromium takes what has no name with
/// .html for text. Signals wait meanwhile, so that nothing stays behind.
class PageFile {
  public:
    explicit PageFile(const std::string &html) {
        std::error_code error;
        std::string folder =
            (std::filesystem::temp_directory_path(error) / "whirl-XXXXXX").string();
        if (error || mkdtemp(folder.data()) == nullptr)
            throw model::AnalysisFailure("no PDF: there is no folder for temporary files");
        _folder = folder;
        std::ofstream file(path(), std::ios::binary);
        file.write(html.data(), static_cast<std::streamsize>(html.size()));
        if (!file.flush()) {
            remove();
            throw model::AnalysisFailure("no PDF: the page does not fit into the folder for "
                                         "temporary files");
        }
    }
    ~PageFile() { remove(); }
    PageFile(const PageFile &) = delete;
    PageFile &operator=(const PageFile &) = delete;
    PageFile(PageFile &&) = delete;
    PageFile &operator=(PageFile &&) = delete;

    [[nodiscard]] std::string path() const { return (_folder / "report.html").string(); }

  private:
    process::SignalsHeld _held;
    std::filesystem::path _folder;

    void remove() noexcept {
        std::error_code ignored;
        std::filesystem::remove_all(_folder, ignored);
    }
};

/// PDF 32000-1, 7.5: it begins with its version and ends with %%EOF.
bool whole(std::string_view pdf) {
    constexpr std::size_t tail = 32;
    return pdf.starts_with("%PDF-") &&
           pdf.substr(pdf.size() > tail ? pdf.size() - tail : 0).find("%%EOF") !=
               std::string_view::npos;
}

/// The PDF as the program writes it: messages may stand around it on standard output.
std::string cut_out(const std::string &output) {
    const std::size_t from = output.find("%PDF-");
    const std::size_t to = output.rfind("%%EOF");
    return from == std::string::npos || to == std::string::npos || to < from
               ? output
               : output.substr(from, to + 5 - from) + "\n";
}

std::string last_words(const std::string &errors) {
    constexpr std::size_t enough = 1000;
    return errors.empty()
               ? ""
               : ":\n" + errors.substr(errors.size() > enough ? errors.size() - enough : 0);
}

/// @param why  takes what went wrong; nothing where there is no such program
std::optional<std::string> printed(const Words &words, std::string &why) {
    std::optional<process::Child> child = process::Child::start(words, "");
    if (!child)
        return std::nullopt;
    if (!child->ended_within(patience)) {
        why = fmt::format("{} has not printed the page within two minutes", words.front());
        return std::nullopt;
    }
    std::string pdf = cut_out(child->output());
    if (const std::string failure = child->failure(); !failure.empty() || !whole(pdf)) {
        why = fmt::format("{} has not printed the page{}{}", words.front(),
                          failure.empty() ? "" : ", " + failure, last_words(child->errors()));
        return std::nullopt;
    }
    return pdf;
}

} // namespace

std::string pdf_of(const std::string &html) {
    const PageFile page(html);
    std::string why;
    for (const Words &words : printers(page.path())) { // a browser may be there and not start
        std::string of_this;
        if (std::optional<std::string> pdf = printed(words, of_this))
            return *std::move(pdf);
        why += (why.empty() || of_this.empty() ? "" : "; ") + of_this;
    }
    if (why.empty())
        throw model::AnalysisFailure(
            "no PDF: neither Chromium nor WeasyPrint is installed; install one of the packages "
            "chromium and weasyprint (apt install weasyprint), or leave out --pdf and print the "
            "page from a browser");
    throw model::AnalysisFailure("no PDF: " + why);
}

} // namespace whirl::report
