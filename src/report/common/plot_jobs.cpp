#include "report/common/plot_jobs.h"

#include "model/errors.h"

#include <fmt/format.h>
#include <pugixml.hpp>

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <string_view>
#include <utility>

namespace whirl::report {

namespace {

[[noreturn]] void fail(const std::string &what) {
    throw model::AnalysisFailure("picture: " + what);
}

/// The words of gnuplot that a message has room for.
std::string words_of(const process::Child &gnuplot) {
    constexpr std::size_t enough = 4096;
    const std::string words = gnuplot.errors().substr(0, enough);
    return words.empty() ? "" : ":\n" + words;
}

/// A number of four bytes, the highest first.
std::uint32_t four_bytes(std::string_view text, std::size_t at) {
    std::uint32_t number = 0;
    for (const char byte : text.substr(at, 4))
        number = number << 8U | static_cast<unsigned char>(byte);
    return number;
}

/// Of the PNG specification (third edition, section 5): a signature, then chunks of a length, a
/// name, so many bytes and a checksum, the first of them IHDR with width and height, the last IEND.
std::string png_fault(std::string_view content, int width, int height) {
    constexpr std::string_view signature = "\x89PNG\r\n\x1a\n";
    constexpr std::size_t frame = 12; // of a chunk, around its bytes
    if (!content.starts_with(signature))
        return "it is no PNG";
    std::size_t at = signature.size();
    for (bool first = true; content.size() - at >= frame; first = false) {
        const std::size_t length = four_bytes(content, at);
        const std::string_view name = content.substr(at + 4, 4);
        if (length > content.size() - at - frame)
            break;
        if (first && (name != "IHDR" || length < 8 ||
                      four_bytes(content, at + 8) != static_cast<std::uint32_t>(width) ||
                      four_bytes(content, at + 12) != static_cast<std::uint32_t>(height)))
            return fmt::format("it has not {} x {} pixels", width, height);
        at += frame + length;
        if (name == "IEND")
            return at == content.size() ? "" : "something follows its end";
    }
    return "its end is missing";
}

std::string svg_fault(const std::string &content) {
    pugi::xml_document document;
    const pugi::xml_parse_result parsed =
        document.load_buffer(content.data(), content.size(), pugi::parse_minimal);
    if (!parsed)
        return fmt::format("it is no whole SVG: {}", parsed.description());
    return std::string_view(document.document_element().name()) == "svg" ? "" : "it is no SVG";
}

} // namespace

std::string picture_fault(const std::string &content, PictureFormat format, int width, int height) {
    if (content.empty())
        return "it is empty";
    return format == PictureFormat::png ? png_fault(content, width, height) : svg_fault(content);
}

PlotJobs::PlotJobs(double patience) : _patience(patience) {}

double PlotJobs::patience_asked_for() {
    constexpr double usual = 30; // a picture takes some tenths of a second
    const char *asked = std::getenv("WHIRL_GNUPLOT_SECONDS");
    const double seconds = asked == nullptr ? 0 : std::strtod(asked, nullptr);
    return seconds > 0 ? seconds : usual;
}

bool PlotJobs::start(const Figure &figure, PictureFormat format, const std::string &name) {
    // The user's own gnuplotrc must not change a report.
    std::optional<process::Child> gnuplot =
        process::Child::start({"gnuplot", "--default-settings"}, gnuplot_input(figure, format));
    if (!gnuplot)
        return false;
    _jobs.push_back({*std::move(gnuplot), name, format, figure.width, figure.height});
    return true;
}

std::map<std::string, std::string> PlotJobs::finish() {
    std::map<std::string, std::string> pictures;
    while (!_jobs.empty()) {
        Job job = std::move(_jobs.back());
        _jobs.pop_back();
        if (!job.gnuplot.ended_within(_patience))
            fail(fmt::format("gnuplot has not drawn {} within {} s (the environment variable "
                             "WHIRL_GNUPLOT_SECONDS sets the limit)",
                             job.name, _patience));
        if (const std::string failure = job.gnuplot.failure(); !failure.empty())
            fail(fmt::format("gnuplot could not draw {}, {}{}", job.name, failure,
                             words_of(job.gnuplot)));
        std::string content = job.gnuplot.output();
        if (const std::string fault = picture_fault(content, job.format, job.width, job.height);
            !fault.empty())
            fail(fmt::format("gnuplot has not drawn {}, though it says so: {}{}", job.name, fault,
                             words_of(job.gnuplot)));
        pictures.insert_or_assign(job.name, std::move(content));
    }
    return pictures;
}

} // namespace whirl::report
