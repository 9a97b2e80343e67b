// A report of several analyses on one page that can be printed and signed.

#include "report/document.h"

#include "model/errors.h"
#include "report/common/files.h"
#include "report/common/html.h"
#include "report/common/pdf.h"
#include "report/common/plot_jobs.h"
#include "report/common/sha256.h"
#include "report/common/table.h"
#include "report/common/text_width.h"
#include "report/common/words.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <sstream>

namespace whirl::report {

namespace fs = std::filesystem;

namespace {

/// Lines of an input table that are printed; the hash is of all of them.
constexpr std::size_t printed_lines = 400;

std::string without_end(std::string text) {
    while (text.ends_with('.') || text.ends_with(' ') || text.ends_with('\n'))
        text.pop_back();
    return text;
}

std::string sentence_of(const model::Sentence &sentence, const Units &units) {
    const std::string text = capitalized(without_end(units.text(sentence)));
    return text.empty() ? "" : text + ".";
}

/// "2026-03-01 12:00 UTC" of "2026-03-01T12:00:00Z".
std::string day_and_time(const std::string &date) {
    constexpr std::size_t day = 10, time = 5;
    return date.size() < day + 1 + time
               ? date
               : date.substr(0, day) + " " + date.substr(day + 1, time) + " UTC";
}

/// A string of CSS in a style element: what could end either stands there by its number.
std::string css_string(const std::string &text) {
    std::string out = "\"";
    for (const char letter : printable(text))
        if (letter == '"' || letter == '\\' || letter == '<' || letter == '&')
            out += fmt::format("\\{:06x}", static_cast<unsigned char>(letter));
        else
            out += letter;
    return out + "\"";
}

/// At the foot of each printed page.
std::string page_foot(const std::string &title, const std::string &hash) {
    constexpr const char *look = "font:8pt 'DejaVu Sans',Arial,sans-serif;color:#5a6775";
    return fmt::format("@page{{size:A4;margin:13mm 12mm 15mm;"
                       "@bottom-left{{content:{};{}}}"
                       "@bottom-right{{content:{} counter(page) \" of \" counter(pages);{}}}}}\n",
                       css_string(title), look, css_string("case " + hash + " · page "), look);
}

/// The text of a file, in full or its first lines.
std::string pre_element(const std::string &text) {
    std::istringstream lines(text);
    std::string html;
    std::size_t count = 0;
    for (std::string line; std::getline(lines, line); ++count) {
        if (line.ends_with('\r'))
            line.pop_back();
        if (count < printed_lines)
            html += escaped(line) + "\n";
    }
    html = "<pre>" + html + "</pre>\n";
    if (count > printed_lines)
        html += element("p",
                        fmt::format("The first {} of {} lines; the hash is of all of them.",
                                    printed_lines, count),
                        "more");
    return html;
}

std::vector<std::string> hashed(const Provenance &provenance) {
    std::vector<std::string> texts;
    for (const InputFile &file : provenance.files)
        texts.push_back(file.text);
    for (const std::string &entry : provenance.set)
        texts.push_back(entry + "\n");
    return texts;
}

/// What it was computed from, for whoever wants to do it again.
std::string inputs_section(const Report &report, const std::string &hash) {
    const Provenance &from = report.provenance;
    std::string html = "<section class=\"inputs\"><h2>What it was computed from</h2>\n";
    html += element(
        "p", fmt::format("Whirl {}, {}. SHA-256 of the case, which is {}:", program_version(),
                         day_and_time(from.date),
                         from.set.empty() ? "its files one after another"
                                          : "its files and the entries of the command line, each "
                                            "with a line end, one after another"));
    html += element("p", hash, "hash");
    Texts table{{"File", "Bytes", "SHA-256"}};
    for (const InputFile &file : from.files)
        table.push_back({file.name, std::to_string(file.text.size()), sha256({file.text})});
    html += page_table(table);
    if (!from.set.empty())
        html += element("h3", "Entries of the command line, in place of those of the case") +
                pre_element(joined(from.set, "\n"));
    for (const InputFile &file : from.files)
        html += element("h3", file.name) + pre_element(file.text);
    return html + "</section>\n";
}

/// Draws all pictures of a document side by side.
class Pictures {
  public:
    Pictures(const Document &document, const model::Case &scene, const Units &units) {
        for (std::size_t i = 0; i < document.chapters.size(); ++i)
            for (std::size_t k = 0; k < document.chapters[i].pictures.size(); ++k)
                if (!_missing)
                    _missing = !_jobs.start(
                        chart_figure(document.chapters[i].pictures[k].chart, scene, units),
                        PictureFormat::svg, name(i, k));
        _drawn = _jobs.finish();
    }
    [[nodiscard]] bool missing() const { return _missing; }
    /// SVG; none without gnuplot.
    [[nodiscard]] std::string of(std::size_t chapter, std::size_t picture) const {
        const auto found = _drawn.find(name(chapter, picture));
        return found == _drawn.end() ? "" : found->second;
    }

  private:
    PlotJobs _jobs;
    std::map<std::string, std::string> _drawn;
    bool _missing = false;

    static std::string name(std::size_t chapter, std::size_t picture) {
        return fmt::format("picture {} of chapter {}", picture + 1, chapter + 1);
    }
};

std::string chapter_section(const Chapter &chapter, std::size_t index, const Pictures &pictures,
                            const Units &units) {
    std::string html = std::string("<section class=\"chapter") + (index == 0 ? " first" : "") +
                       "\">" + element("h2", chapter.heading) +
                       element("p", sentence_of(chapter.answer, units),
                               chapter.answered ? "answer" : "answer failed");
    if (chapter.drawing)
        html += picture_element(to_svg(*chapter.drawing), chapter.heading);
    for (std::size_t k = 0; k < chapter.pictures.size(); ++k)
        html += picture_element(pictures.of(index, k),
                                chapter.heading + ": " + chapter.pictures[k].name);
    for (const Section &table : chapter.tables)
        html += element("h3", table.heading) + table.html;
    for (const model::Sentence &note : chapter.notes)
        html += element("p", sentence_of(note, units), "note");
    if (chapter.answered)
        html += element(
            "p", fmt::format("All rows, more pictures and files: whirl {}.", chapter.command),
            "more");
    return html + "</section>\n";
}

std::string left_out_section(const std::vector<model::Sentence> &left_out, const Units &units) {
    if (left_out.empty())
        return "";
    std::string html = "<section class=\"chapter left_out\"><h2>Not part of this report</h2>\n";
    for (const model::Sentence &sentence : left_out)
        html += element("p", sentence_of(sentence, units));
    return html + "</section>\n";
}

std::string document_page(const Report &report, const Document &document, const Pictures &pictures,
                          const Units &units) {
    const std::string title = title_of(*report.scene);
    const std::string hash = sha256(hashed(report.provenance));
    const std::string short_hash = hash.substr(0, 12);
    std::string chapters;
    for (std::size_t i = 0; i < document.chapters.size(); ++i)
        chapters += chapter_section(document.chapters[i], i, pictures, units);
    if (pictures.missing())
        chapters = element("p", "gnuplot is not installed: the report has no diagrams.", "note") +
                   chapters;
    return with_contents(
        filled(embedded("document.html"),
               {{"title", escaped(title)},
                {"style", embedded("document.css")},
                {"page_foot", page_foot(title, short_hash)},
                {"case", escaped(report.scene->name)},
                {"date", day_and_time(report.provenance.date)},
                {"version", program_version()},
                {"short_hash", short_hash},
                {"drawing", picture_element(to_svg(document.drawing), "Side view: " + title)},
                {"verdict_class", document.verdict},
                {"verdict", escaped(capitalized(document.verdict) + ".")},
                {"sentence", escaped(sentence_of(document.sentence, units))},
                {"running", document.running.empty()
                                ? ""
                                : element("p", sentence_of(document.running, units), "running")},
                {"checks", document.checks},
                {"chapters", chapters + left_out_section(document.left_out, units)},
                {"inputs", inputs_section(report, hash)}}));
}

} // namespace

Files write_document(const Report &report, const fs::path &folder) {
    const Units units = Units::of_readers(report.scene->units);
    const Document document = report.document(units);
    const Pictures pictures(document, *report.scene, units);
    const std::string page = document_page(report, document, pictures, units);
    OutputFiles files(folder);
    Files written;
    files.add(report.command + ".html", page);
    files.announce(report.command + ".pdf"); // one of another run would be beside this page
    if (report.pdf) {
        try {
            files.add(report.command + ".pdf", pdf_of(page));
        } catch (const model::AnalysisFailure &failure) {
            written.failure = failure.what();
        }
    }
    files.add(report.command + ".json", to_json(report));
    files.add(report.command + ".csv", report.csv(Units::of_files(report.scene->units)));
    if (pictures.missing())
        written.notes.emplace_back("gnuplot is not installed: no diagrams");
    written.paths = files.commit();
    if (!written.failure.empty())
        written.failure += "; the page is there: " + written.paths.front().string();
    return written;
}

} // namespace whirl::report
