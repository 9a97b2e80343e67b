#include "report/report.h"

#include "report/common/files.h"
#include "report/common/html.h"
#include "report/common/plot_jobs.h"
#include "report/common/units.h"
#include "report/common/words.h"
#include "report/document.h"

namespace whirl::report {

namespace fs = std::filesystem;

namespace {

/// The files of a report while they come into being. The pictures are drawn by their own processes
/// while this one composes the other files.
class Writer {
  public:
    Writer(const Report &report, const fs::path &folder)
        : _report(report), _readers(Units::of_readers(report.scene->units)),
          _in_files(Units::of_files(report.scene->units)), _files(folder) {}

    Files write() {
        start_main();
        if (_report.pictures)
            for (const Picture &picture : _report.pictures(_readers))
                start_further(picture);
        add(_report.command + ".json", to_json(_report));
        add(_report.command + ".csv", _report.csv(_in_files));
        if (_report.tables)
            for (const TableFile &table : _report.tables())
                add(table.name + ".csv", table.csv(_in_files));
        if (_report.vtp)
            add(_report.command + ".vtp", _report.vtp());
        write_page();
        take_pictures();
        _written.paths = _files.commit();
        return _written;
    }

  private:
    /// A file that the page links to.
    void add(const std::string &name, std::string content) {
        _files.add(name, std::move(content));
        _linked.push_back(name);
    }

    /// @returns whether the picture is on its way: not where gnuplot is missing
    bool start(const Figure &figure, PictureFormat format, const std::string &name) {
        _files.announce(name);
        const bool started = _jobs.start(figure, format, name);
        if (started)
            _linked.push_back(name);
        return started;
    }

    /// Both files of a picture, in the units that were asked for. The PNG takes longest, so it
    /// starts first; the SVG is announced first. @returns the name of the latter, or nothing
    /// without gnuplot
    std::string start_both(const Chart &chart, const std::string &name) {
        const Figure figure = chart_figure(chart, *_report.scene, _readers);
        const std::string svg = name + ".svg";
        _files.announce(svg);
        return start(figure, PictureFormat::png, name + ".png") &&
                       start(figure, PictureFormat::svg, svg)
                   ? svg
                   : "";
    }

    /// Waits for those that were started.
    void take_pictures() {
        for (auto &[name, picture] : _jobs.finish()) {
            _pictures[name] = picture;
            _files.add(name, std::move(picture));
        }
    }

    void start_main() {
        const std::string name = _report.command;
        if (_report.drawing) {
            const Drawing drawing = _report.drawing(_readers);
            _still = to_svg(drawing);
            add(name + ".svg", _still);
            _still = picture_element(_still, _report.heading + ": " + title_of(*_report.scene));
            if (!start(to_figure(drawing), PictureFormat::png, name + ".png"))
                _written.notes.emplace_back("gnuplot is not installed: no PNG picture");
            return;
        }
        _svg = start_both(_report.chart(_readers), name);
        if (_svg.empty())
            _written.notes.emplace_back("gnuplot is not installed: no SVG and PNG pictures");
    }

    void start_further(const Picture &picture) {
        if (const std::string svg = start_both(picture.chart, picture.name); !svg.empty())
            _further.push_back(svg);
        if (picture.csv)
            add(picture.name + ".csv", picture.csv(_in_files));
    }

    void write_page() {
        const bool wants_svg = !moves(_report) && !_svg.empty();
        if (wants_svg || !_further.empty()) // still pictures in the page: wait for them
            take_pictures();
        if (wants_svg)
            _still = picture_element(_pictures.at(_svg),
                                     _report.heading + ": " + title_of(*_report.scene));
        std::string pictures;
        for (const std::string &picture : _further)
            pictures += picture_element(_pictures.at(picture), _report.pictures_heading);
        _files.add("report.html", to_html(_report, _still, pictures, _linked));
    }

    const Report &_report;
    Units _readers, _in_files;
    OutputFiles _files;
    PlotJobs _jobs;
    Files _written;
    std::string _svg;   ///< the main picture, where gnuplot draws it
    std::string _still; ///< the main picture as an element
    std::vector<std::string> _further;
    std::map<std::string, std::string> _pictures; ///< those that are drawn, by their names
    std::vector<std::string> _linked;             ///< names of the files beside the page
};

} // namespace

Files write_report(const Report &report, const fs::path &folder) {
    if (report.document)
        return write_document(report, folder);
    return Writer(report, folder).write();
}

} // namespace whirl::report
