#include "cases/program_run.h"
#include "support/own_folder.h"

#include <httplib.h>
#include <nlohmann/json.hpp>

#include <gtest/gtest.h>

#include <array>
#include <chrono>
#include <csignal>
#include <fstream>
#include <iterator>
#include <memory>
#include <sstream>
#include <thread>

#include <arpa/inet.h>
#include <fcntl.h>
#include <spawn.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

extern char **environ;

namespace studio_test {

namespace fs = std::filesystem;
using json = nlohmann::json;

std::string text_of(const fs::path &file) {
    std::ostringstream text;
    text << std::ifstream(file).rdbuf();
    return text.str();
}

constexpr const char *rotor = R"(# A rotor of the tests.
format = 1
title = "one disc"   # its name

[material.steel]
E = "211 GPa"        # Young's modulus
nu = 0.3
rho = 7_810

[shaft]
segments = [{length = 1.2, outer = "50 mm", material = "steel"}] # one

[[disc]]
z = 0.4
outer = "300 mm"
inner = "50 mm"
width = "60 mm"
material = "steel"

[[bearing]]
name = 'ä'  ; z = 0
)";

/// The case with what TOML wants in place of the line with a semicolon.
std::string rotor_text() {
    std::string text = rotor;
    text.replace(text.find("  ; z = 0"), 9, "\nz = 0   # left");
    return text + R"(k = 1e7              # N/m
c = 500

[[bearing]]
z = 1.2
k = 1e7
c = 500

[speeds]
from = 0
to = "6000 rpm"
count = 7
)";
}

/// A studio at work in a folder of its own.
class Studio : public whirl::tests::InOwnFolder {
  protected:
    pid_t process = 0;
    int output = -1;
    int port = 0;
    std::string token;

    void SetUp() override {
        InOwnFolder::SetUp();
        std::ofstream("rotor.toml") << rotor_text();
        std::ofstream("secret.toml") << "hidden = true\n";
        start({"rotor.toml"});
    }
    void TearDown() override {
        if (process != 0)
            EXPECT_EQ(end(), SIGINT);
        InOwnFolder::TearDown();
    }

    void start(std::vector<std::string> words) {
        std::array<int, 2> ends{};
        ASSERT_EQ(pipe2(ends.data(), O_CLOEXEC), 0);
        words.insert(words.begin(), {WHIRL_PROGRAM, "studio"});
        std::vector<char *> argv;
        for (std::string &word : words)
            argv.push_back(word.data());
        argv.push_back(nullptr);
        posix_spawn_file_actions_t actions{};
        posix_spawn_file_actions_init(&actions);
        posix_spawn_file_actions_adddup2(&actions, ends[1], STDOUT_FILENO);
        posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, "errors",
                                         O_WRONLY | O_CREAT | O_TRUNC, 0644);
        ASSERT_EQ(posix_spawn(&process, WHIRL_PROGRAM, &actions, nullptr, argv.data(), environ), 0);
        posix_spawn_file_actions_destroy(&actions);
        close(ends[1]);
        output = ends[0];
        std::string said;
        for (char letter = 0; read(output, &letter, 1) == 1 && letter != '\n';)
            said += letter;
        const std::string begin = "http://127.0.0.1:";
        ASSERT_TRUE(said.starts_with(begin)) << said << text_of("errors");
        port = std::stoi(said.substr(begin.size()));
        token = said.substr(said.find("token=") + 6);
    }
    /// Ctrl-C. @returns the signal that ended it
    int end() {
        kill(process, SIGINT);
        int status = 0;
        waitpid(process, &status, 0);
        process = 0;
        close(output);
        return WIFSIGNALED(status) ? WTERMSIG(status) : 0;
    }

    [[nodiscard]] std::string with_token(const std::string &path) const {
        return path + (path.find('?') == std::string::npos ? "?" : "&") + "token=" + token;
    }
    [[nodiscard]] int status_of_get(const std::string &path,
                                    const httplib::Headers &headers = {}) const {
        httplib::Client client("127.0.0.1", port);
        const httplib::Result answer = client.Get(path, headers);
        return answer ? answer->status : -1;
    }
    struct Answer {
        int status = -1;
        json body;
    };
    [[nodiscard]] Answer post(const std::string &path, const json &question) const {
        httplib::Client client("127.0.0.1", port);
        client.set_read_timeout(100);
        const httplib::Result answer =
            client.Post(with_token(path), question.dump(), "application/json");
        return answer ? Answer{answer->status, json::parse(answer->body, nullptr, false)}
                      : Answer{};
    }
    [[nodiscard]] json problems_of(const json &values) const {
        return post("/check", {{"values", values}}).body.at("problems");
    }
};

TEST_F(Studio, WithoutItsTokenAllIsRefused) {
    const std::string wrong(token.size(), '0');
    for (const std::string path : {"/", "/panel?command=campbell", "/plotly.js", "/report?name=1",
                                   "/nothing", "/rotor.toml", "/check"}) {
        EXPECT_EQ(status_of_get(path), 403) << path;
        EXPECT_EQ(status_of_get(path + (path.find('?') == std::string::npos ? "?" : "&") +
                                "token=" + wrong),
                  403)
            << path;
    }
    httplib::Client client("127.0.0.1", port);
    for (const char *path : {"/check", "/compute", "/save", "/make_report", "/leave"}) {
        const httplib::Result answer = client.Post(path, R"({"values":{}})", "application/json");
        ASSERT_TRUE(answer) << path;
        EXPECT_EQ(answer->status, 403) << path;
    }
    EXPECT_EQ(status_of_get("/?token=" + token.substr(1)), 403);
    EXPECT_EQ(status_of_get("/?token=" + token + "&token=" + wrong), 403);
    EXPECT_EQ(status_of_get(with_token("/")), 200);
}

/// The page of another site whose name leads here, or that asks from within a browser.
TEST_F(Studio, OtherNamesAndOriginsAreRefused) {
    const std::string own = "127.0.0.1:" + std::to_string(port);
    EXPECT_EQ(status_of_get(with_token("/"), {{"Host", "evil.example"}}), 403);
    EXPECT_EQ(status_of_get(with_token("/"), {{"Origin", "http://evil.example"}}), 403);
    EXPECT_EQ(status_of_get(with_token("/"), {{"Origin", "null"}}), 403);
    EXPECT_EQ(status_of_get(with_token("/"), {{"Origin", "http://" + own}}), 200);
}

TEST_F(Studio, NoFilesAreBehindIt) {
    for (const char *path :
         {"/rotor.toml", "/secret.toml", "/../secret.toml", "/%2e%2e/secret.toml", "/etc/passwd",
          "//etc/passwd", "/panel/../../etc/passwd", "/report/secret.toml", "/."})
        EXPECT_EQ(status_of_get(with_token(path)), 404) << path;
    EXPECT_EQ(status_of_get(with_token("/report?name=../secret.toml")), 404);
    EXPECT_EQ(status_of_get(with_token("/panel?command=../secret")), 404);
    EXPECT_EQ(status_of_get(with_token("/panel?command=studio")), 404);
}

TEST_F(Studio, MethodsAreThoseOfTheRoutes) {
    for (const char *path : {"/check", "/compute", "/save", "/make_report", "/leave"})
        EXPECT_EQ(status_of_get(with_token(path)), 405) << path;
    httplib::Client client("127.0.0.1", port);
    EXPECT_EQ(client.Post(with_token("/"), "", "text/plain")->status, 405);
    EXPECT_EQ(client.Put(with_token("/save"), "", "text/plain")->status, 405);
    EXPECT_EQ(client.Delete(with_token("/"))->status, 405);
}

/// A field that the case has not could name another file, or take anything else for the case.
TEST_F(Studio, OnlyNumbersOfTheCaseCanBeSet) {
    for (const char *path : {"shaft.table", "bearing[0].table", "title", "bearing[*].k", "nothing"})
        EXPECT_EQ(post("/check", {{"values", {{path, "secret.toml"}}}}).status, 400) << path;
    for (const json &question :
         {json::object(), json{{"values", 1}}, json{{"values", {{"speeds.count", 3}}}}})
        for (const char *path : {"/check", "/compute", "/save", "/make_report"})
            EXPECT_EQ(post(path, question).status, 400) << path << question;
    httplib::Client client("127.0.0.1", port);
    EXPECT_EQ(client.Post(with_token("/check"), "{", "application/json")->status, 400);
}

TEST_F(Studio, MistakesStandAtTheirFields) {
    EXPECT_TRUE(problems_of(json::object()).empty());
    EXPECT_TRUE(problems_of({{"bearing[0].k", "2 MN/m"}}).empty());
    const json two = problems_of({{"bearing[0].k", "5 kg"}, {"disc[0].z", "3"}});
    ASSERT_EQ(two.size(), 2);
    for (const json &problem : two) {
        const std::string line_begin =
            problem.at("key") == "bearing[0].k" ? "k = 1e7              # N/m" : "z = 0.4";
        EXPECT_TRUE(problem.at("key") == "bearing[0].k" || problem.at("key") == "disc[0].z");
        // Its line is that of the text.
        std::istringstream lines(rotor_text());
        std::string line;
        for (int i = 0; i < problem.at("line").get<int>(); ++i)
            std::getline(lines, line);
        EXPECT_EQ(line, line_begin);
    }
    for (const char *text : {"", "  ", "nan", "inf", "1,5", "{a = 1}", "[1]", "1\nc = 3", "true"})
        EXPECT_EQ(problems_of({{"bearing[0].k", text}}).size(), 1) << text;
    EXPECT_EQ(problems_of({{"bearing[0].k", std::string(5000, '1')}}).size(), 1);
    EXPECT_EQ(post("/compute", {{"command", "campbell"},
                                {"page", "p"},
                                {"number", 1},
                                {"values", {{"bearing[0].k", "5 kg"}}}})
                  .status,
              400);
}

/// What a panel shows is what the command says with --set.
TEST_F(Studio, ComputesAsTheCommandLineDoes) {
    const Answer answer = post("/compute", {{"command", "critical"},
                                            {"page", "p"},
                                            {"number", 1},
                                            {"values", {{"bearing[1].k", "3e6"}}}});
    ASSERT_EQ(answer.status, 200);
    const json shown = json::parse(answer.body.at("result").get<std::string>());
    const auto run =
        whirl::tests::run_program(WHIRL_PROGRAM,
                                  {"critical", "rotor.toml", "--json", "--units", "speed=rpm",
                                   "--json-units", "--set", "bearing[1].k=3e6"},
                                  "own_errors");
    const json own = json::parse(run.output);
    ASSERT_FALSE(own.at("critical_speeds").empty());
    ASSERT_EQ(shown.at("critical_speeds").size(), own.at("critical_speeds").size());
    for (std::size_t i = 0; i < own.at("critical_speeds").size(); ++i)
        EXPECT_EQ(shown.at("critical_speeds")[i].at("speed"),
                  own.at("critical_speeds")[i].at("speed"));
    EXPECT_NE(answer.body.at("main").get<std::string>().find("id=\"plot\""), std::string::npos);
}

/// The coarse picture has the same form, and few speeds.
TEST_F(Studio, PreviewsAreCoarse) {
    const auto speeds = [this](int number, bool preview) {
        const Answer answer = post("/compute", {{"command", "campbell"},
                                                {"page", "p"},
                                                {"number", number},
                                                {"values", {{"speeds.count", "40"}}},
                                                {"preview", preview}});
        EXPECT_EQ(answer.status, 200);
        return json::parse(answer.body.at("result").get<std::string>()).at("speeds").size();
    };
    EXPECT_EQ(speeds(1, false), 40U);
    EXPECT_LT(speeds(2, true), 40U);
}

/// A connection whose bytes are written and read as they are.
class Raw {
  public:
    explicit Raw(int port) : _socket(socket(AF_INET, SOCK_STREAM, 0)) {
        sockaddr_in address{};
        address.sin_family = AF_INET;
        address.sin_port = htons(static_cast<std::uint16_t>(port));
        address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
        connected = connect(_socket, reinterpret_cast<sockaddr *>(&address), sizeof address) == 0;
    }
    ~Raw() { close(_socket); }
    Raw(const Raw &) = delete;
    Raw &operator=(const Raw &) = delete;
    void say(const std::string &text) const {
        (void)send(_socket, text.data(), text.size(), MSG_NOSIGNAL);
    }
    /// Until the other end has closed it.
    [[nodiscard]] std::string hear() const {
        std::string text;
        std::array<char, 4096> some{};
        for (ssize_t got = 0; (got = recv(_socket, some.data(), some.size(), 0)) > 0;)
            text.append(some.data(), static_cast<std::size_t>(got));
        return text;
    }
    bool connected = false;

  private:
    int _socket;
};

TEST_F(Studio, TwoNamesOfTheHostAreRefused) {
    const std::string host = "Host: 127.0.0.1:" + std::to_string(port) + "\r\n";
    for (const std::string &other : {host, std::string("Host: elsewhere\r\n")}) {
        const Raw client(port);
        ASSERT_TRUE(client.connected);
        client.say("GET " + with_token("/") + " HTTP/1.1\r\n" + host + other + "\r\n");
        EXPECT_TRUE(client.hear().starts_with("HTTP/1.1 403")) << other;
    }
}

/// Clients that never end their first question are cut off, and nobody waits for them.
TEST_F(Studio, SlowStrangersHoldNothing) {
    std::vector<std::unique_ptr<Raw>> strangers;
    for (int i = 0; i < 70; ++i) {
        strangers.push_back(std::make_unique<Raw>(port));
        ASSERT_TRUE(strangers.back()->connected);
        strangers.back()->say("GET / HTTP/1.1\r\nHo");
    }
    EXPECT_EQ(post("/check", {{"values", json::object()}}).status, 200);
    for (const auto &stranger : strangers) // to the end of the connection: it would never come
        EXPECT_FALSE(stranger->hear().starts_with("HTTP/1.1 200"));
}

/// What nobody waits for any more is ended: a run that would take minutes.
TEST_F(Studio, ARunEndsWithTheOneThatAsked) {
    const std::string question = json{{"command", "campbell"},
                                      {"page", "p"},
                                      {"number", 1},
                                      {"values", {{"speeds.count", "100000"}}}}
                                     .dump();
    const auto all_children = [this] {
        std::size_t count = 0;
        for (const auto &task :
             fs::directory_iterator(fs::path("/proc") / std::to_string(process) / "task")) {
            std::istringstream words(text_of(task.path() / "children"));
            count += static_cast<std::size_t>(std::distance(
                std::istream_iterator<std::string>(words), std::istream_iterator<std::string>()));
        }
        return count;
    };
    const auto until = [&](std::size_t wanted) {
        for (int i = 0; i < 1000 && all_children() != wanted; ++i)
            std::this_thread::sleep_for(std::chrono::milliseconds(10));
        return all_children();
    };
    {
        const Raw client(port);
        ASSERT_TRUE(client.connected);
        client.say("POST " + with_token("/compute") + " HTTP/1.1\r\nHost: 127.0.0.1:" +
                   std::to_string(port) + "\r\nContent-Length: " + std::to_string(question.size()) +
                   "\r\n\r\n" + question);
        ASSERT_EQ(until(1), 1U);
    }
    EXPECT_EQ(until(0), 0U);
}

/// Of one panel the newest counts.
TEST_F(Studio, OlderQuestionsAreSuperseded) {
    const json question{
        {"command", "critical"}, {"page", "p"}, {"number", 5}, {"values", json::object()}};
    EXPECT_TRUE(post("/compute", question).body.contains("main"));
    EXPECT_TRUE(post("/compute", question).body.contains("superseded"));
}

TEST_F(Studio, SaveKeepsAllButTheValues) {
    const json values{{"material.steel.E", "200 GPa"},
                      {"material.steel.rho", "7850"},
                      {"shaft.segments[0].outer", "60 mm"},
                      {"bearing[0].k", "2e7"}};
    const Answer answer = post("/save", {{"name", "other"}, {"values", values}});
    EXPECT_EQ(answer.status, 200) << answer.body;
    std::string wanted = rotor_text();
    const auto replace = [&wanted](const std::string &before, const std::string &after) {
        wanted.replace(wanted.find(before), before.size(), after);
    };
    replace("\"211 GPa\"", "\"200 GPa\"");
    replace("7_810", "7850");
    replace("\"50 mm\", material", "\"60 mm\", material");
    replace("k = 1e7 ", "k = 2e7 ");
    EXPECT_EQ(text_of("other.toml"), wanted);
    EXPECT_EQ(text_of("rotor.toml"), rotor_text());
}

TEST_F(Studio, SaveReplacesNothingUnasked) {
    const json question{{"name", "secret.toml"}, {"values", json::object()}};
    EXPECT_EQ(post("/save", question).status, 409);
    EXPECT_EQ(text_of("secret.toml"), "hidden = true\n");
    json asked = question;
    asked["replace"] = true;
    EXPECT_EQ(post("/save", asked).status, 200);
    EXPECT_EQ(text_of("secret.toml"), rotor_text());
}

TEST_F(Studio, SaveStaysInTheFolder) {
    fs::create_symlink(folder / "outside", "link.toml");
    fs::create_directory("folder.toml");
    for (const char *name :
         {"../out", "/tmp/out", "a/b", "..", ".hidden", "", "a\\b", "a\nb", "link", "folder", "-x"})
        EXPECT_EQ(
            post("/save", {{"name", name}, {"values", json::object()}, {"replace", true}}).status,
            422)
            << name;
    EXPECT_FALSE(fs::exists(folder / "out.toml"));
    EXPECT_FALSE(fs::exists(folder / "outside"));
    EXPECT_EQ(post("/save", {{"name", "bad"}, {"values", {{"bearing[0].k", "x"}}}}).status, 422);
    EXPECT_FALSE(fs::exists("bad.toml"));
}

TEST_F(Studio, ReportIsThatOfTheCommand) {
    const Answer answer =
        post("/make_report", {{"page", "p"}, {"number", 1}, {"values", {{"bearing[0].k", "2e7"}}}});
    ASSERT_EQ(answer.status, 200);
    ASSERT_TRUE(answer.body.contains("report")) << answer.body;
    httplib::Client client("127.0.0.1", port);
    const auto page = client.Get("/" + answer.body.at("report").get<std::string>());
    ASSERT_TRUE(page);
    EXPECT_EQ(page->body, text_of(answer.body.at("file").get<std::string>()));
    EXPECT_NE(page->body.find("bearing[0].k=2e7"), std::string::npos);
}

TEST_F(Studio, ATakenPortIsAMistakeOfTheArguments) {
    const auto second = whirl::tests::run_program(
        WHIRL_PROGRAM, {"studio", "rotor.toml", "--port", std::to_string(port)}, "own_errors");
    EXPECT_EQ(second.status, 2);
    EXPECT_NE(second.errors.find("--port"), std::string::npos) << second.errors;
    EXPECT_EQ(
        whirl::tests::run_program(WHIRL_PROGRAM, {"studio", "none.toml"}, "own_errors").status, 2);
    EXPECT_EQ(whirl::tests::run_program(WHIRL_PROGRAM, {"studio", "rotor.toml", "--port", "70000"},
                                        "own_errors")
                  .status,
              2);
}

TEST_F(Studio, TakesOverridesOfTheCommandLine) {
    end();
    start({"rotor.toml", "--set", "bearing[0].k=3e6", "--set", "campbell.modes=2"});
    EXPECT_EQ(post("/save", {{"name", "set"}, {"values", {{"bearing[1].k", "4e6"}}}}).status, 200);
    const std::string text = text_of("set.toml");
    EXPECT_NE(text.find("k = 3e6 "), std::string::npos) << text;
    EXPECT_NE(text.find("k = 4e6\n"), std::string::npos) << text;
    EXPECT_TRUE(text.ends_with("\n[campbell]\nmodes = 2\n")) << text;
}

} // namespace studio_test
