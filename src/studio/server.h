#pragma once

#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace whirl::studio {

/// What a page asks for.
struct Question {
    std::string body;                        ///< of a POST
    std::map<std::string, std::string> of{}; ///< behind the "?" of the address, without the token
    std::function<bool()> gone;              ///< whether whoever asks has left
};

struct Reply {
    int status = 200;
    std::string type = "application/json";
    std::string content;
    bool lasting = false; ///< the same for as long as the program runs
};

/// An address of the page and what answers it.
struct Route {
    std::string method; ///< "GET" or "POST"
    std::string path;
    std::function<Reply(const Question &)> answer;
};

/// HTTP for the browser of this machine alone: bound to 127.0.0.1, and whoever asks without the
/// token of its address is refused with 403 whatever he asks for, also under another name of this
/// machine (a page of another site whose name leads here) or from the page of another site. There
/// are no files behind it: what no route answers is 404, a route under another method 405. A
/// connection has two seconds for its first question, however slowly it comes.
class Server {
  public:
    /// @param port  0: any that is free
    /// @throws model::BadInput where the port is taken, or none is to be had
    Server(std::vector<Route> routes, int port);
    ~Server();
    Server(const Server &) = delete;
    Server &operator=(const Server &) = delete;
    Server(Server &&) = delete;
    Server &operator=(Server &&) = delete;

    /// "http://127.0.0.1:8080/?token=..."
    [[nodiscard]] std::string address() const;
    [[nodiscard]] const std::string &token() const;

    /// Answers until the program ends.
    void serve();

  private:
    struct Http;
    std::unique_ptr<Http> _http;
};

} // namespace whirl::studio
