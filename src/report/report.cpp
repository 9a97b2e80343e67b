#include "report/report.h"

#include "report/csv.h"
#include "report/files.h"
#include "report/gnuplot.h"
#include "report/html_pages.h"
#include "report/json.h"
#include "report/plot_accuracy.h"
#include "report/plot_campbell.h"
#include "report/plot_critical.h"
#include "report/plot_modes.h"
#include "report/plot_response.h"
#include "report/plot_scene.h"
#include "report/plotly.h"
#include "report/vtk.h"

#include <fstream>
#include <sstream>

namespace whirl::report {

namespace fs = std::filesystem;

namespace {

std::string read_file(const fs::path &path) {
    std::ifstream file(path, std::ios::binary);
    std::ostringstream text;
    text << file.rdbuf();
    return text.str();
}

/// An SVG file as an element of a page: without the XML declaration before it.
std::string svg_element(const fs::path &path) {
    const std::string text = read_file(path);
    const std::size_t start = text.find("<svg");
    return start == std::string::npos ? "" : text.substr(start);
}

/// Starts a picture; forgets its file where gnuplot is missing. @returns whether it was started.
bool start(PlotJobs &jobs, OutputFiles &files, const Figure &figure, PictureFormat format,
           const std::string &name) {
    const bool started = jobs.start(figure, format, files.reserve(name));
    if (!started)
        files.drop(name);
    return started;
}

const char *no_gnuplot = "gnuplot is not installed: no SVG and PNG pictures";

/// The pictures are drawn by their own processes while this one writes the other files.
template <class Result>
Files write(const std::string &command, const model::Case &scene, const Result &result,
            const Figure &figure, const fs::path &folder, const std::string &vtp = "") {
    OutputFiles files(folder);
    PlotJobs jobs;
    Files written;
    // The PNG takes longest, so it starts first; the SVG is announced first as the main picture.
    const fs::path svg = files.reserve(command + ".svg");
    const bool drawn = start(jobs, files, figure, PictureFormat::png, command + ".png") &&
                       jobs.start(figure, PictureFormat::svg, svg);
    if (!drawn) {
        files.drop(command + ".svg");
        written.notes.emplace_back(no_gnuplot);
    }
    files.add(command + ".json", to_json(scene, result));
    files.add(command + ".csv", to_csv(result));
    if (!vtp.empty())
        files.add(command + ".vtp", vtp);
    std::string picture;
    if (drawn && plotly_bundle().empty()) { // a still picture in the page: wait for it
        jobs.finish();
        picture = svg_element(svg);
    }
    files.add("report.html", to_html(scene, result, picture));
    jobs.finish();
    written.paths = files.commit();
    return written;
}

} // namespace

Files write_report(const model::Case &scene, const analyses::CampbellResult &result,
                   const fs::path &folder) {
    return write("campbell", scene, result, campbell_figure(scene, result), folder);
}

Files write_report(const model::Case &scene, const analyses::CriticalResult &result,
                   const fs::path &folder) {
    return write("critical", scene, result, critical_figure(scene, result), folder);
}

Files write_report(const model::Case &scene, const analyses::ResponseResult &result,
                   const fs::path &folder) {
    return write("response", scene, result, response_figure(scene, result), folder);
}

Files write_report(const model::Case &scene, const analyses::ModesResult &result,
                   const fs::path &folder) {
    return write("modes", scene, result, modes_figure(scene, result), folder,
                 to_vtp(scene, result));
}

Files write_report(const model::Case &scene, const analyses::ShowResult &result,
                   const fs::path &folder) {
    OutputFiles files(folder);
    PlotJobs jobs;
    Files written;
    const Drawing drawing = show_drawing(scene, result);
    const std::string svg = to_svg(drawing);
    files.add("show.svg", svg);
    if (!start(jobs, files, to_figure(drawing), PictureFormat::png, "show.png"))
        written.notes.emplace_back("gnuplot is not installed: no PNG picture");
    files.add("show.json", to_json(scene, result));
    files.add("show.csv", to_csv(result));
    files.add("report.html", to_html(scene, result, svg));
    jobs.finish();
    written.paths = files.commit();
    return written;
}

Files write_report(const model::Case &scene, const analyses::AccuracyResult &result,
                   const fs::path &folder) {
    return write("accuracy", scene, result, accuracy_figure(scene, result), folder);
}

} // namespace whirl::report
