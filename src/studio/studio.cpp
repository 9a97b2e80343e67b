#include "studio/studio.h"

#include "input/case_file.h"
#include "input/toml_text.h"
#include "model/errors.h"
#include "report/common/files.h"
#include "report/common/html.h"
#include "report/common/json.h"
#include "studio/computations.h"
#include "studio/server.h"

#include <fmt/format.h>

#include <algorithm>
#include <deque>
#include <mutex>
#include <optional>

namespace whirl::studio {

namespace fs = std::filesystem;
using report::Json;

namespace {

/// Of a value: longer than any number with its unit, and what the reader of numbers takes.
constexpr std::size_t longest_value = 200;

/// Reports that a browser may still ask for.
constexpr std::size_t kept_reports = 8;

Reply json_reply(const Json &json, int status = 200) {
    return {.status = status, .content = report::json_text(json)};
}
Reply bad_question(const std::string &why) { return json_reply({{"failed", why}}, 400); }

/// What follows the name of the section in the path: "k", "length", "2" of a list.
std::string label_of(const std::string &path) {
    const std::size_t dot = path.rfind('.');
    return dot == std::string::npos ? path : path.substr(dot + 1);
}

Json number_json(const std::string &text) {
    const std::optional<input::NumberParts> parts = input::number_parts(text);
    if (!parts)
        return nullptr;
    return {{"value", parts->value}, {"unit", parts->unit}};
}

/// A plain file name for a case beside the one that is open; empty: it is none.
std::string case_file_name(std::string name) {
    constexpr std::size_t longest = 120; // bytes
    if (!name.ends_with(".toml"))
        name += ".toml";
    const bool plain =
        name.size() > 5 && name.size() <= longest && name.front() != '.' && name.front() != '-' &&
        std::all_of(name.begin(), name.end(), [](char letter) {
            const auto code = static_cast<unsigned char>(letter);
            return code >= ' ' && code != 127 &&
                   std::string_view("/\\:*?\"<>|").find(letter) == std::string_view::npos;
        });
    return plain ? name : "";
}

/// The case that is open, and what the page asks of it.
class Studio {
  public:
    explicit Studio(const Setup &setup)
        : _setup(setup), _file(setup.scene), _scene(_file.load(setup.overrides)),
          _numbers(_file.numbers(setup.overrides)) {
        for (const auto &[name, text] : _file.files()) {
            const fs::path file = _file.path().parent_path() / name;
            _as_read.emplace_back(file, report::content_of(file));
        }
    }

    [[nodiscard]] std::vector<Route> routes() {
        const auto of = [this](auto answer) {
            return [this, answer](const Question &question) {
                const Json asked = Json::parse(question.body, nullptr, false);
                if (!asked.is_object())
                    return bad_question("expected an object of JSON");
                if constexpr (std::is_invocable_v<decltype(answer), Studio, const Json &>)
                    return (this->*answer)(asked);
                else
                    return (this->*answer)(asked, question.gone);
            };
        };
        return {{"GET", "/", [this](const Question &) { return page(); }},
                {"GET", "/panel", [this](const Question &question) { return panel(question); }},
                {"GET", "/plotly.js", [](const Question &) { return plotly(); }},
                {"GET", "/report", [this](const Question &question) { return made(question); }},
                {"POST", "/check", of(&Studio::check)},
                {"POST", "/compute", of(&Studio::compute)},
                {"POST", "/save", of(&Studio::save)},
                {"POST", "/make_report", of(&Studio::make_report)},
                {"POST", "/leave", of(&Studio::leave)}};
    }

    /// Of the addresses on the page. Before the first question.
    void set_token(const std::string &token) { _token = token; }

  private:
    const Setup &_setup;
    input::CaseFile _file;
    model::Case _scene;
    std::vector<input::WrittenNumber> _numbers;
    std::string _token;
    Computations _computations;
    /// The case and its tables, byte by byte.
    std::vector<std::pair<fs::path, std::string>> _as_read;
    std::mutex _reading; ///< a case file keeps the tables it has read
    std::mutex _reporting;
    std::deque<std::pair<std::string, std::string>> _reports; ///< by name

    [[nodiscard]] std::string addressed(const std::string &path, const std::string &more = "") {
        return path + "?token=" + _token + more;
    }

    /// Overrides of the command line and those of the fields; none where the page asks for what is
    /// no field of it. So no other file can be named than those that the case names.
    [[nodiscard]] std::optional<std::vector<std::string>> overrides_of(const Json &asked) const {
        const auto values = asked.find("values");
        if (values == asked.end() || !values->is_object())
            return std::nullopt;
        std::vector<std::string> overrides = _setup.overrides;
        std::size_t known = 0;
        for (const input::WrittenNumber &number : _numbers)
            if (const auto value = values->find(number.path); value != values->end()) {
                if (!value->is_string())
                    return std::nullopt;
                overrides.push_back(number.path + "=" + value->get<std::string>());
                ++known;
            }
        return known == values->size() ? std::optional(overrides) : std::nullopt;
    }

    [[nodiscard]] Json problems_json(const Json &asked, const std::vector<std::string> &overrides) {
        Json problems = Json::array();
        const auto add = [&](const std::string &key, const std::string &text) {
            const auto field = std::ranges::find(_numbers, key, &input::WrittenNumber::path);
            problems.push_back({{"key", key},
                                {"text", text},
                                {"file", _file.path().filename().string()},
                                {"line", field == _numbers.end() ? 0 : field->line}});
        };
        for (const auto &[key, value] : asked.at("values").items()) {
            const std::string text = value.get<std::string>();
            // Without a value an override takes the entry out of the case.
            if (text.find_first_not_of(" \t\n\r") == std::string::npos)
                add(key, "expected a number, got nothing");
            else if (text.size() > longest_value)
                add(key, fmt::format("expected a number, got a text of {} letters", text.size()));
        }
        if (!problems.empty())
            return problems;
        const std::lock_guard guard(_reading);
        try {
            for (const input::Problem &problem : _file.problems(overrides))
                add(problem.key, problem.text);
        } catch (const model::Failure &failure) {
            add("", failure.what());
        }
        return problems;
    }

    /// Whether the files have changed since the fields were made of them.
    [[nodiscard]] bool changed() {
        const std::lock_guard guard(_reading);
        return std::ranges::any_of(_as_read, [](const auto &file) {
            return report::content_of(file.first) != file.second;
        });
    }

    Reply page() {
        Json fields = Json::array();
        for (const input::WrittenNumber &number : _numbers)
            fields.push_back({{"path", number.path},
                              {"label", label_of(number.path)},
                              {"group", number.group},
                              {"text", number.text},
                              {"number", number_json(number.text)},
                              {"si", model::names_of(number.quantity).si},
                              {"whole", number.whole},
                              {"line", number.line}});
        Json offers = Json::array();
        for (const Offer &offer : _setup.offers)
            offers.push_back({{"command", offer.command},
                              {"heading", offer.heading},
                              {"why_not", offer.why_not},
                              {"panel", addressed("panel", "&command=" + offer.command)}});
        const std::string title = _scene.title.empty() ? _scene.name : _scene.title;
        const Json data{
            {"case", _scene.name},     {"title", title},  {"file", _setup.scene.generic_string()},
            {"set", _setup.overrides}, {"token", _token}, {"fields", fields},
            {"offers", offers}};
        return {.type = "text/html; charset=utf-8",
                .content =
                    report::filled(report::embedded("studio.html"),
                                   {{"title", report::escaped(title)},
                                    {"style", report::embedded("studio.css")},
                                    {"data", report::json_for_script(report::json_text(data))},
                                    {"script", report::embedded("studio.js")}})};
    }

    Reply panel(const Question &question) {
        const auto command = question.of.find("command");
        if (command == question.of.end() || !offered(command->second))
            return {.status = 404, .type = "text/plain", .content = "there is no such analysis\n"};
        return {.type = "text/html; charset=utf-8",
                .content = report::filled(
                    report::embedded("studio_panel.html"),
                    {{"style", report::embedded("page.css")},
                     {"plotly", addressed("plotly.js")},
                     {"tables", report::embedded("tables.js")},
                     {"drawing", report::embedded("common.js") + report::embedded("chart.js")},
                     {"script", report::embedded("studio_panel.js")}})};
    }

    static Reply plotly() {
        return {.type = "text/javascript; charset=utf-8",
                .content = std::string(report::plotly_bundle()),
                .lasting = true};
    }

    [[nodiscard]] bool offered(const std::string &command) const {
        return std::ranges::find(_setup.offers, command, &Offer::command) != _setup.offers.end();
    }

    /// The mistakes of the case with the values of the fields, and what these are made of.
    Reply check(const Json &asked) {
        const auto overrides = overrides_of(asked);
        if (!overrides)
            return bad_question("expected values of the fields");
        Json numbers = Json::object();
        for (const auto &[path, value] : asked.at("values").items())
            numbers[path] = number_json(value.get<std::string>());
        return json_reply({{"problems", problems_json(asked, *overrides)},
                           {"numbers", numbers},
                           {"changed", changed()}});
    }

    /// A command on the case as the fields have it.
    [[nodiscard]] std::vector<std::string> line_of(const std::string &command,
                                                   const std::vector<std::string> &overrides) {
        std::vector<std::string> words{command};
        for (const std::string &text : overrides)
            words.push_back("--set=" + text);
        words.insert(words.end(), {"--", _setup.scene.string()});
        return words;
    }

    /// What the page asks for with a number, so that of several the newest counts.
    struct Asked {
        std::string panel;
        long long number = 0;
    };
    [[nodiscard]] static std::optional<Asked> panel_of(const Json &asked, const std::string &name) {
        constexpr std::size_t longest = 60;
        const std::string page = text_of(asked, "page");
        const auto number = asked.find("number");
        if (page.empty() || page.size() > longest || number == asked.end() ||
            !number->is_number_integer())
            return std::nullopt;
        return Asked{page + "/" + name, number->get<long long>()};
    }
    [[nodiscard]] static std::string text_of(const Json &asked, const char *key) {
        const auto found = asked.find(key);
        return found != asked.end() && found->is_string() ? found->get<std::string>() : "";
    }

    using Gone = std::function<bool()>;

    /// What makes a run faster: few speeds, the classical elements, few modes to look for and to
    /// name peaks by, neither stability of the balanced position (nine tenths of the time of
    /// `balance`) nor motions in time. Of a case that has them anyway nothing.
    [[nodiscard]] std::vector<std::string> coarse(const std::string &command,
                                                  const std::vector<std::string> &as_asked) {
        const model::Case scene = [&] {
            const std::lock_guard guard(_reading);
            return _file.load(as_asked);
        }();
        constexpr int speeds = 12;
        const int modes = command == "campbell" ? 4 : command == "critical" ? 2 : 1;
        std::vector<std::string> overrides;
        if (scene.speeds && scene.speeds->count > speeds)
            overrides.push_back(fmt::format("speeds.count={}", speeds));
        if (!scene.rotor.shaft.rigid &&
            (scene.rotor.shaft.order > 1 || scene.rotor.shaft.order_auto))
            overrides.emplace_back("shaft.order=1");
        if (command != "balance" && scene.campbell.modes > modes)
            overrides.push_back(fmt::format("campbell.modes={}", modes));
        if (command == "balance" && scene.balance.balanced_position)
            overrides.insert(overrides.end(),
                             {"balance.balanced_position=false", "balance.simulated=0"});
        return overrides;
    }

    /// With `preview` the same by a coarse model, for as long as the full one takes.
    Reply compute(const Json &asked, const Gone &gone) {
        const std::string command = text_of(asked, "command");
        auto overrides = overrides_of(asked);
        const auto place = panel_of(asked, command);
        if (!offered(command) || !overrides || !place)
            return bad_question("expected the command of a panel, values of the fields, page and "
                                "number");
        if (!problems_json(asked, *overrides).empty())
            return bad_question("the case has mistakes");
        if (const auto preview = asked.find("preview"); preview != asked.end() && *preview == true)
            for (std::string &override : coarse(command, *overrides))
                overrides->push_back(std::move(override));
        std::vector<std::string> line = line_of(command, *overrides);
        line.insert(line.begin() + 1, {"--parts", "--quiet"});
        const Computations::Answer answer =
            _computations.run(place->panel, place->number, line, gone);
        if (answer.superseded)
            return json_reply({{"superseded", true}});
        if (answer.failed)
            return json_reply({{"failed", answer.errors}});
        return {.content = answer.output};
    }

    Reply make_report(const Json &asked, const Gone &gone) {
        const auto overrides = overrides_of(asked);
        const auto place = panel_of(asked, "report");
        if (!overrides || !place)
            return bad_question("expected values of the fields, page and number");
        if (!problems_json(asked, *overrides).empty())
            return bad_question("the case has mistakes");
        std::vector<std::string> line = line_of("report", *overrides);
        const std::string name = next_report();
        const fs::path folder = _setup.reports / name; // of its own: several pages may ask at once
        line.insert(line.begin() + 1, {"--quiet", "--out=" + folder.string()});
        const Computations::Answer answer =
            _computations.run(place->panel, place->number, line, gone);
        if (answer.superseded)
            return json_reply({{"superseded", true}});
        if (answer.failed)
            return json_reply({{"failed", answer.errors}});
        const fs::path file = folder / "report.html";
        const std::lock_guard guard(_reporting);
        _reports.emplace_back(name, report::content_of(file));
        if (_reports.size() > kept_reports)
            _reports.pop_front();
        return json_reply(
            {{"report", addressed("report", "&name=" + name)}, {"file", file.generic_string()}});
    }
    std::size_t _made = 0;

    std::string next_report() {
        const std::lock_guard guard(_reporting);
        return std::to_string(++_made);
    }

    /// A report that was made, as it was then.
    Reply made(const Question &question) {
        const auto name = question.of.find("name");
        const std::lock_guard guard(_reporting);
        for (const auto &[own, content] : _reports)
            if (name != question.of.end() && own == name->second)
                return {.type = "text/html; charset=utf-8", .content = content};
        return {.status = 404, .type = "text/plain", .content = "there is no such report\n"};
    }

    /// The case with the values of the fields as a file beside it.
    Reply save(const Json &asked) {
        const auto overrides = overrides_of(asked);
        const std::string name = case_file_name(text_of(asked, "name"));
        if (!overrides)
            return bad_question("expected values of the fields");
        if (name.empty())
            return json_reply({{"failed", "expected the name of a file in the folder of the case, "
                                          "without / \\ : * ? \" < > |"}},
                              422);
        if (!problems_json(asked, *overrides).empty())
            return json_reply({{"failed", "the case has mistakes: they stand at their fields"}},
                              422);
        const fs::path file = fs::absolute(_file.path()).parent_path() / name;
        std::error_code none;
        if (const fs::file_status there = fs::symlink_status(file, none); fs::exists(there)) {
            if (!fs::is_regular_file(there))
                return json_reply({{"failed", name + " is there and is no plain file"}}, 422);
            if (const auto replace = asked.find("replace");
                replace == asked.end() || *replace != true)
                return json_reply({{"exists", name}}, 409);
        }
        try {
            const std::lock_guard guard(_reading);
            report::write_file_atomically(file, _file.edited(*overrides));
        } catch (const model::Failure &failure) {
            return json_reply({{"failed", failure.what()}}, 422);
        }
        return json_reply({{"saved", name}});
    }

    Reply leave(const Json &asked) {
        const std::string page = text_of(asked, "page");
        if (page.empty())
            return bad_question("expected page");
        _computations.leave(page + "/");
        return json_reply({{"left", true}});
    }
};

} // namespace

void run(const Setup &setup, const std::function<void(const std::string &address)> &ready) {
    Studio studio(setup);
    Server server(studio.routes(), setup.port);
    studio.set_token(server.token());
    ready(server.address());
    server.serve();
}

} // namespace whirl::studio
