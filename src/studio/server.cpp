#include "studio/server.h"

#include "model/errors.h"

// The only translation unit that sees it: it is slow to compile.
#include <httplib.h>

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <exception>
#include <random>

#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

namespace whirl::studio {

namespace {

constexpr const char *here = "127.0.0.1";

/// Of a request: far more than all numbers of a case.
constexpr std::size_t largest_body = 4'000'000; // bytes

/// A browser keeps up to six connections open to a page, and each takes a thread of the server.
constexpr std::size_t threads = 256;

using Clock = std::chrono::steady_clock;
/// From its beginning to the end of its headers: of a connection without a question so far with the
/// token, and of one with it, which a browser keeps for the next one.
constexpr std::chrono::seconds of_strangers{2};
constexpr std::chrono::seconds of_known{20};
/// Of an answer that nobody takes.
constexpr int write_timeout = 5000; // ms

/// 128 bits from the system, in hexadecimal.
std::string new_token() {
    std::random_device of_system;
    std::string token;
    for (int i = 0; i < 4; ++i)
        token += fmt::format("{:08x}", of_system());
    return token;
}

/// In a time that says nothing of how many letters are right.
bool same_secret(const std::string &a, const std::string &b) {
    unsigned char differs = a.size() == b.size() ? 0 : 1;
    for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i)
        differs |= static_cast<unsigned char>(a[i] ^ b[i]);
    return differs == 0;
}

void put(httplib::Response &response, const Reply &reply) {
    response.status = reply.status;
    response.set_header("Cache-Control", reply.lasting ? "private, max-age=86400" : "no-store");
    response.set_header("Referrer-Policy", "no-referrer"); // the token stands in the address
    response.set_header("X-Content-Type-Options", "nosniff");
    response.set_header("Cross-Origin-Resource-Policy", "same-origin");
    response.set_header("Content-Security-Policy",
                        "default-src 'none'; script-src 'self' 'unsafe-inline'; style-src "
                        "'unsafe-inline'; img-src 'self' data: blob:; connect-src 'self'; "
                        "frame-src 'self'; frame-ancestors 'self'; base-uri 'none'; "
                        "form-action 'none'");
    // By a provider: a body is compressed, which takes longer than the way within a machine.
    response.set_content_provider(
        reply.content.size(), reply.type,
        [content = reply.content](std::size_t from, std::size_t length, httplib::DataSink &sink) {
            sink.write(content.data() + from, length);
            return true;
        });
}

/// A connection. What it has to say up to a certain time is read; to a stranger it is closed then.
class Connection : public httplib::Stream {
  public:
    explicit Connection(socket_t of) : _socket(of) {}

    void allow(Clock::duration time) { _until = Clock::now() + time; }
    /// Whether there is something to read, before the time is over.
    [[nodiscard]] bool speaks() const {
        return _next < _read.size() || ready(POLLIN, milliseconds_left());
    }
    /// The other end has left, or has no more to say.
    [[nodiscard]] bool gone() const { return ready(POLLRDHUP, 0); }
    bool known = false; ///< it has asked with the token

    bool is_readable() const override { return speaks(); }
    bool is_writable() const override { return ready(POLLOUT, write_timeout); }
    ssize_t read(char *into, std::size_t size) override {
        if (_next == _read.size()) {
            if (!speaks())
                return -1;
            _read.resize(4096);
            const ssize_t got = recv(_socket, _read.data(), _read.size(), 0);
            _read.resize(got > 0 ? static_cast<std::size_t>(got) : 0);
            _next = 0;
            if (got <= 0)
                return got;
        }
        const std::size_t count = std::min(size, _read.size() - _next);
        std::copy_n(_read.data() + _next, count, into);
        _next += count;
        return static_cast<ssize_t>(count);
    }
    ssize_t write(const char *from, std::size_t size) override {
        return is_writable() ? send(_socket, from, size, MSG_NOSIGNAL) : -1;
    }
    void get_remote_ip_and_port(std::string &ip, int &port) const override {
        ip = here;
        port = 0;
    }
    void get_local_ip_and_port(std::string &ip, int &port) const override {
        get_remote_ip_and_port(ip, port);
    }
    socket_t socket() const override { return _socket; }

  private:
    socket_t _socket;
    Clock::time_point _until = Clock::now();
    std::string _read; ///< read and not yet taken, from _next on
    std::size_t _next = 0;

    [[nodiscard]] int milliseconds_left() const {
        const auto left =
            std::chrono::duration_cast<std::chrono::milliseconds>(_until - Clock::now());
        return static_cast<int>(std::max<std::int64_t>(left.count(), 0));
    }
    [[nodiscard]] bool ready(short event, int milliseconds) const {
        pollfd wanted{_socket, event, 0};
        int found = 0;
        while ((found = poll(&wanted, 1, milliseconds)) < 0 && errno == EINTR) {
        }
        return found > 0;
    }
};

/// That whose question this thread answers.
thread_local Connection *current = nullptr;

/// The server of the library, with connections as above.
class HttpServer : public httplib::Server {
    bool process_and_close_socket(socket_t socket) override {
        Connection connection(socket);
        current = &connection;
        bool answered = true;
        bool closed = false;
        while (answered && !closed) {
            connection.allow(connection.known ? of_known : of_strangers);
            if (!connection.speaks())
                break;
            answered = process_request(connection, false, closed, nullptr) && connection.known;
        }
        current = nullptr;
        shutdown(socket, SHUT_RDWR);
        close(socket);
        return answered;
    }
};

Reply plain(int status, const std::string &text) { return {status, "text/plain", text + "\n"}; }

} // namespace

struct Server::Http {
    HttpServer server;
    std::vector<Route> routes;
    std::string token = new_token();
    int port = 0;

    /// From the page of this address itself, and not of another one whose name leads here.
    [[nodiscard]] bool own(const httplib::Request &request) const {
        const std::string host = request.get_header_value("Host");
        const std::string origin = request.get_header_value("Origin");
        const auto is_here = [this](const std::string &name) {
            return name == fmt::format("{}:{}", here, port) ||
                   name == fmt::format("localhost:{}", port);
        };
        return request.get_header_value_count("Host") == 1 &&
               request.get_header_value_count("Origin") <= 1 && is_here(host) &&
               (origin.empty() || origin == "http://" + host) &&
               request.get_param_value_count("token") == 1 &&
               same_secret(request.get_param_value("token"), token);
    }

    /// What no route is asked for; status 0: one is.
    [[nodiscard]] Reply refusal(const httplib::Request &request) const {
        if (!own(request))
            return plain(403, "refused: the address is that which whirl studio has printed, with "
                              "its token");
        const auto of_path = [&](const Route &route) { return route.path == request.path; };
        const auto found = std::find_if(routes.begin(), routes.end(), of_path);
        if (found == routes.end())
            return plain(404, "there is no such page");
        return found->method == request.method
                   ? Reply{.status = 0}
                   : plain(405, "this page is asked by " + found->method);
    }

    void answer(const Route &route, const httplib::Request &request,
                httplib::Response &response) const {
        Question question{request.body, {}, [asking = current] { return asking->gone(); }};
        for (const auto &[name, value] : request.params)
            if (name != "token")
                question.of[name] = value;
        try {
            put(response, route.answer(question));
        } catch (const std::exception &failure) {
            put(response, plain(500, failure.what()));
        }
    }
};

Server::Server(std::vector<Route> routes, int port) : _http(std::make_unique<Http>()) {
    Http &http = *_http;
    http.routes = std::move(routes);
    http.server.new_task_queue = [] { return new httplib::ThreadPool(threads); };
    http.server.set_payload_max_length(largest_body);
    http.server.set_tcp_nodelay(true);
    // Not that of the library, with which a second program could listen at the same port.
    http.server.set_socket_options([](socket_t socket) {
        const int yes = 1;
        (void)setsockopt(socket, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes);
    });
    http.server.set_pre_routing_handler([&http](const auto &request, auto &response) {
        const Reply refused = http.refusal(request);
        current->known = refused.status == 0;
        current->allow(of_known); // for the rest of the question
        if (refused.status == 0)
            return httplib::Server::HandlerResponse::Unhandled;
        put(response, refused);
        response.set_header("Connection", "close"); // what follows in it was not read
        return httplib::Server::HandlerResponse::Handled;
    });
    for (const Route &route : http.routes) {
        const auto answer = [&http, &route](const httplib::Request &request,
                                            httplib::Response &response) {
            http.answer(route, request, response);
        };
        if (route.method == "GET")
            http.server.Get(route.path, answer);
        else
            http.server.Post(route.path, answer);
    }
    if (port == 0) {
        http.port = http.server.bind_to_any_port(here);
        if (http.port <= 0)
            throw model::BadInput("whirl: expected a free port, the system has none");
    } else {
        http.port = port;
        if (!http.server.bind_to_port(here, port))
            throw model::BadInput(fmt::format("whirl: --port {0}: expected a free port, {0} is "
                                              "taken or not for this user; without --port any "
                                              "that is free is taken",
                                              port));
    }
}

Server::~Server() = default;

std::string Server::address() const {
    return fmt::format("http://{}:{}/?token={}", here, _http->port, _http->token);
}

const std::string &Server::token() const { return _http->token; }

void Server::serve() { _http->server.listen_after_bind(); }

} // namespace whirl::studio
