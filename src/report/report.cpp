#include "report/report.h"

#include "report/common/files.h"
#include "report/common/html.h"
#include "report/common/units.h"
#include "report/common/words.h"

namespace whirl::report {

namespace fs = std::filesystem;

namespace {

/// The files of a report while they come into being. The pictures are drawn by their own processes
/// while this one writes the other files.
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
        if (_report.vtp)
            add(_report.command + ".vtp", _report.vtp());
        write_page();
        _jobs.finish();
        _written.paths = _files.commit();
        return _written;
    }

  private:
    /// A file that the page links to.
    void add(const std::string &name, const std::string &content) {
        _files.add(name, content);
        _linked.push_back(name);
    }

    /// Forgets the file where gnuplot is missing. @returns whether the picture is on its way.
    bool start_png(const Figure &figure, const std::string &name) {
        const bool started = _jobs.start(figure, PictureFormat::png, _files.reserve(name + ".png"));
        if (started)
            _linked.push_back(name + ".png");
        else
            _files.drop(name + ".png");
        return started;
    }

    /// Both files of a picture, in the units that were asked for. The PNG takes longest, so it
    /// starts first; the SVG is announced first. @returns the latter, or nothing without gnuplot
    fs::path start_both(Figure figure, const std::string &name) {
        if (!figure.in_units)
            figure.script = script_in_written_units(figure.script);
        const fs::path svg = _files.reserve(name + ".svg");
        if (!start_png(figure, name)) {
            _files.drop(name + ".svg");
            return {};
        }
        _jobs.start(figure, PictureFormat::svg, svg);
        _linked.push_back(name + ".svg");
        return svg;
    }

    void start_main() {
        const std::string name = _report.command;
        if (_report.drawing) {
            const Drawing drawing = _report.drawing(_readers);
            _still = to_svg(drawing);
            add(name + ".svg", _still);
            _still = picture_element(_still, _report.heading + ": " + title_of(*_report.scene));
            if (!start_png(to_figure(drawing), name))
                _written.notes.emplace_back("gnuplot is not installed: no PNG picture");
            return;
        }
        _svg = start_both(_report.figure(_readers), name);
        if (_svg.empty())
            _written.notes.emplace_back("gnuplot is not installed: no SVG and PNG pictures");
    }

    void start_further(const Picture &picture) {
        if (const fs::path svg = start_both(picture.figure, picture.name); !svg.empty())
            _further.push_back(svg);
        if (picture.csv)
            add(picture.name + ".csv", picture.csv(_in_files));
    }

    void write_page() {
        const bool moves = !plotly_bundle().empty() && !embedded(_report.command + ".js").empty();
        const bool wants_svg = !moves && !_svg.empty();
        if (wants_svg || !_further.empty()) // still pictures in the page: wait for them
            _jobs.finish();
        if (wants_svg)
            _still = picture_element(content_of(_svg),
                                     _report.heading + ": " + title_of(*_report.scene));
        std::string pictures;
        for (const fs::path &picture : _further)
            pictures += picture_element(content_of(picture), _report.pictures_heading);
        _files.add("report.html", to_html(_report, _still, pictures, _linked));
    }

    const Report &_report;
    Units _readers, _in_files;
    OutputFiles _files;
    PlotJobs _jobs;
    Files _written;
    fs::path _svg;      ///< where gnuplot draws the main picture
    std::string _still; ///< the main picture as an element
    std::vector<fs::path> _further;
    std::vector<std::string> _linked; ///< names of the files beside the page
};

} // namespace

Files write_report(const Report &report, const fs::path &folder) {
    return Writer(report, folder).write();
}

} // namespace whirl::report
