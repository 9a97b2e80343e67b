#include "report/report.h"

#include "report/csv.h"
#include "report/files.h"
#include "report/gnuplot.h"
#include "report/html_pages.h"
#include "report/html_scripts.h"
#include "report/html_simulate.h"
#include "report/json.h"
#include "report/json_simulate.h"
#include "report/plot_accuracy.h"
#include "report/plot_anisotropy.h"
#include "report/plot_balance.h"
#include "report/plot_campbell.h"
#include "report/plot_composite.h"
#include "report/plot_critical.h"
#include "report/plot_modes.h"
#include "report/plot_response.h"
#include "report/plot_rigid_limit.h"
#include "report/plot_scene.h"
#include "report/plot_simulate.h"
#include "report/plot_stability.h"
#include "report/plotly.h"
#include "report/vtk.h"
#include "results/accuracy.h"
#include "results/campbell.h"
#include "results/critical.h"
#include "results/modes.h"
#include "results/show.h"

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

/// A picture beside the main one, and its curves as a table.
struct Extra {
    std::string name; ///< of its files, without ending
    Figure figure;
    std::string csv;
};

std::vector<Extra> extras_of(const model::Case &scene, const results::ShowResult &result) {
    std::vector<Extra> extras;
    for (std::size_t i = 0; i < result.balancers.size(); ++i)
        if (result.balancers[i].curves)
            extras.push_back({i == 0 ? "composite" : "composite_" + std::to_string(i + 1),
                              composite_figure(scene, result, i),
                              composite_csv(*result.balancers[i].curves)});
    if (result.anisotropy)
        extras.push_back({"anisotropy", anisotropy_figure(scene, *result.anisotropy),
                          anisotropy_csv(*result.anisotropy)});
    return extras;
}

const char *no_gnuplot = "gnuplot is not installed: no SVG and PNG pictures";

/// More pictures of a result, by their file names without ending.
using NamedFigures = std::vector<std::pair<std::string, Figure>>;

/// The pictures are drawn by their own processes while this one writes the other files.
template <class Result>
Files write(const std::string &command, const model::Case &scene, const Result &result,
            const Figure &figure, const fs::path &folder, const std::string &vtp = "",
            const NamedFigures &more = {}) {
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
    std::vector<fs::path> further;
    for (const auto &[name, other] : drawn ? more : NamedFigures{}) {
        further.push_back(files.reserve(name + ".svg"));
        jobs.start(other, PictureFormat::svg, further.back());
        jobs.start(other, PictureFormat::png, files.reserve(name + ".png"));
    }
    files.add(command + ".json", to_json(scene, result));
    files.add(command + ".csv", to_csv(result));
    if (!vtp.empty())
        files.add(command + ".vtp", vtp);
    std::string picture;
    const bool still = plotly_bundle().empty() || plot_script(command).empty();
    if (drawn && (still || !further.empty())) { // still pictures in the page: wait for them
        jobs.finish();
        if (still)
            picture = svg_element(svg);
        for (const fs::path &other : further)
            picture += svg_element(other);
    }
    files.add("report.html", to_html(scene, result, picture));
    jobs.finish();
    written.paths = files.commit();
    return written;
}

} // namespace

Files write_report(const model::Case &scene, const results::CampbellResult &result,
                   const fs::path &folder) {
    return write("campbell", scene, result, campbell_figure(scene, result), folder);
}

Files write_report(const model::Case &scene, const results::CriticalResult &result,
                   const fs::path &folder) {
    return write("critical", scene, result, critical_figure(scene, result), folder);
}

Files write_report(const model::Case &scene, const results::ResponseResult &result,
                   const fs::path &folder) {
    return write("response", scene, result, response_figure(scene, result), folder);
}

Files write_report(const model::Case &scene, const results::ModesResult &result,
                   const fs::path &folder) {
    return write("modes", scene, result, modes_figure(scene, result), folder,
                 to_vtp(scene, result));
}

Files write_report(const model::Case &scene, const results::ShowResult &result,
                   const fs::path &folder) {
    OutputFiles files(folder);
    PlotJobs jobs;
    Files written;
    const Drawing drawing = show_drawing(scene, result);
    const std::string svg = to_svg(drawing);
    files.add("show.svg", svg);
    if (!start(jobs, files, to_figure(drawing), PictureFormat::png, "show.png"))
        written.notes.emplace_back("gnuplot is not installed: no PNG picture");
    std::vector<fs::path> curves; // pictures for the page
    for (const Extra &extra : extras_of(scene, result)) {
        if (start(jobs, files, extra.figure, PictureFormat::png, extra.name + ".png")) {
            curves.push_back(files.reserve(extra.name + ".svg"));
            jobs.start(extra.figure, PictureFormat::svg, curves.back());
        }
        files.add(extra.name + ".csv", extra.csv);
    }
    files.add("show.json", to_json(scene, result));
    files.add("show.csv", to_csv(result));
    jobs.finish(); // the page holds the finished pictures
    std::string more;
    for (const fs::path &picture : curves)
        more += svg_element(picture);
    files.add("report.html", to_html(scene, result, svg, more));
    written.paths = files.commit();
    return written;
}

Files write_report(const model::Case &scene, const results::AccuracyResult &result,
                   const fs::path &folder) {
    return write("accuracy", scene, result, accuracy_figure(scene, result), folder);
}

Files write_report(const model::Case &scene, const results::StabilityResult &result,
                   const fs::path &folder) {
    return write("stability", scene, result, stability_figure(scene, result), folder);
}

Files write_report(const model::Case &scene, const results::RigidLimitResult &result,
                   const fs::path &folder) {
    return write("rigid-limit", scene, result, rigid_limit_figure(scene, result), folder);
}

Files write_report(const model::Case &scene, const results::BalanceResult &result,
                   const fs::path &folder) {
    NamedFigures more;
    if (result.placement)
        more.emplace_back("placement", placement_figure(scene, *result.placement));
    for (std::size_t i = 0; i < result.pendulum.size(); ++i)
        more.emplace_back("pendulum" + (i == 0 ? "" : "_" + std::to_string(i + 1)),
                          pendulum_figure(scene, result.pendulum[i]));
    for (std::size_t i = 0; i < result.pendulum.size(); ++i)
        if (!result.pendulum[i].dampings.empty())
            more.emplace_back("pendulum_designs" + (i == 0 ? "" : "_" + std::to_string(i + 1)),
                              pendulum_designs_figure(scene, result.pendulum[i]));
    return write("balance", scene, result, balance_figure(scene, result), folder, "", more);
}

Files write_report(const model::Case &scene, const results::SimulateResult &result,
                   const fs::path &folder) {
    return write("simulate", scene, result, simulate_figure(scene, result), folder);
}

} // namespace whirl::report
