// The live scene's only file that includes the HTTP library.
#include "common/live/server.hpp"

#include <fmt/format.h>
#include <httplib.h>

#include <atomic>
#include <future>
#include <utility>

#include "common/errors.hpp"
#include "common/live/access.hpp"
#include "common/live/connections.hpp"
#include "common/live/loop.hpp"

namespace fc::live {
namespace {

using namespace std::chrono_literals;
using Handled = httplib::Server::HandlerResponse;
using Text = std::shared_ptr<const std::string>;

constexpr int most_streams = 32;  // each holds a thread
constexpr std::size_t threads =
    32 + 16;  // 16 for all other requests: commands wait for their answers in them
constexpr std::size_t longest_body = 65536;  // bytes of a command
constexpr const char* json_type = "application/json";
constexpr const char* text_type = "text/plain; charset=utf-8";

// All that the page needs comes with it, from this server.
constexpr const char* page_policy =
    "default-src 'none'; script-src 'unsafe-inline'; style-src 'unsafe-inline'; img-src 'self' data: blob:; "
    "connect-src 'self'; base-uri 'none'; form-action 'none'; frame-ancestors 'none'";

void answer(httplib::Response& response, int status, const std::string& text, const char* type) {
  response.status = status;
  response.set_content(text, type);
}

// An answer that is shared and may be large: it is neither copied nor compressed.
void answer_shared(httplib::Response& response, Text text, std::size_t from, const char* type) {
  if (!text) return answer(response, 503, "the scene has been stopped\n", text_type);
  response.set_content_provider(
      text->size() - from, type,
      [text, from](std::size_t offset, std::size_t length, httplib::DataSink& sink) {
        return sink.write(text->data() + from + offset, length);
      });
}

std::vector<std::string> headers(const httplib::Request& request, const char* name) {
  std::vector<std::string> values;
  const auto [first, last] = request.headers.equal_range(name);
  for (auto header = first; header != last; ++header) values.push_back(header->second);
  return values;
}

Access::Request said_by(const httplib::Request& request) {
  Access::Request said{headers(request, "Host"), headers(request, "Origin"), std::nullopt};
  if (request.has_param("key")) said.key = request.get_param_value("key");
  return said;
}

}  // namespace

class Server::Http {
 public:
  Http(Simulation& simulation, std::string page, int port)
      : loop_(simulation),
        page_(std::make_shared<const std::string>(std::move(page))),
        port_(bound(port)),
        access_(port_) {
    set_limits();
    set_routes();
  }

  void run();
  void stop() { loop_.stop(); }
  int port() const { return port_; }
  const Access& access() const { return access_; }

 private:
  int bound(int port);
  void set_limits();
  void set_routes();
  Handled admit(const httplib::Request& request, httplib::Response& response) const;
  void take_command(httplib::Response& response, const httplib::ContentReader& read);
  void open_stream(httplib::Response& response);
  void close(std::future<bool>& served);

  Loop loop_;
  const Text page_;
  httplib::Server server_;
  const int port_;
  const Access access_;
  std::atomic<int> streams_ = 0;
};

int Server::Http::bound(int port) {
  server_.set_socket_options([](socket_t listening) {
    // Not the library's own SO_REUSEPORT, by which a second program could share the port. Accepted sockets inherit both.
    const int yes = 1;
    setsockopt(listening, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes);
    const int bytes = 1 << 18;  // what waits to be sent is old: a slow page should not get seconds of it
    setsockopt(listening, SOL_SOCKET, SO_SNDBUF, &bytes, sizeof bytes);
  });
  server_.set_tcp_nodelay(true);
  const std::string here = "127.0.0.1";
  const int taken = port == 0 ? server_.bind_to_any_port(here) : server_.bind_to_port(here, port) ? port : -1;
  if (taken > 0) return taken;
  if (port == 0) throw InputError("--live: this machine gives no port to listen at on 127.0.0.1");
  throw InputError(fmt::format(
      "--live={}: the port is in use, or not allowed; choose another, or none, and a free one is taken",
      port));
}

void Server::Http::set_limits() {
  server_.new_task_queue = [] { return new httplib::ThreadPool(threads); };
  server_.set_keep_alive_max_count(1);  // a connection that waits for its next request would hold a thread
  server_.set_payload_max_length(longest_body);
  server_.set_read_timeout(5s);
  server_.set_write_timeout(30s);  // a page that reads nothing for so long is gone
}

void Server::Http::set_routes() {
  server_.set_default_headers({{"Cache-Control", "no-store"},
                               {"Cross-Origin-Resource-Policy", "same-origin"},
                               {"Referrer-Policy", "no-referrer"},
                               {"X-Content-Type-Options", "nosniff"}});
  server_.set_pre_routing_handler(
      [this](const auto& request, auto& response) { return admit(request, response); });
  server_.Get("/", [this](const httplib::Request&, httplib::Response& response) {
    response.set_header("Content-Security-Policy", page_policy);
    answer_shared(response, page_, 0, "text/html; charset=utf-8");
  });
  server_.Get(R"(/scene\.glb)", [this](const httplib::Request&, httplib::Response& response) {
    answer_shared(response, loop_.glb(), 0, "model/gltf-binary");
  });
  server_.Get("/state", [this](const httplib::Request&, httplib::Response& response) {
    answer_shared(response, loop_.board().wait(0, 0, 5s).state.message, message_header, json_type);
  });
  server_.Get("/algorithm", [this](const httplib::Request&, httplib::Response& response) {
    const Loop::Reply reply = loop_.algorithm();
    if (reply.kind == Loop::Reply::Kind::done) return answer(response, 200, reply.json, json_type);
    answer(response, 503, reply.json + "\n", text_type);
  });
  server_.Get("/stream",
              [this](const httplib::Request&, httplib::Response& response) { open_stream(response); });
  server_.Post("/command", [this](const httplib::Request&, httplib::Response& response,
                                  const httplib::ContentReader& read) { take_command(response, read); });
  server_.set_exception_handler(
      [](const httplib::Request&, httplib::Response& response, std::exception_ptr error) {
        try {
          std::rethrow_exception(error);
        } catch (const std::exception& what) {
          answer(response, 500, refusal_text(what.what()), json_type);
        } catch (...) {
          answer(response, 500, refusal_text("an unknown error"), json_type);
        }
      });
  // What the library refuses by itself has no text.
  server_.set_error_handler([](const httplib::Request& request, httplib::Response& response) {
    if (!response.body.empty()) return;
    const std::string line = fmt::format("{}: the request cannot be read", response.status);
    if (request.path == "/command")
      response.set_content(refusal_text(line), json_type);
    else
      response.set_content(line + "\n", text_type);
  });
}

// Refuses, before a body is read, what is not exactly one of the requests that there are.
Handled Server::Http::admit(const httplib::Request& request, httplib::Response& response) const {
  const auto refuse = [&](int status, const std::string& why) {
    answer(response, status, why + "\n", text_type);
    return Handled::Handled;
  };
  if (const auto why = access_.refuses(said_by(request))) return refuse(403, *why);
  const bool is_command = request.path == "/command";
  if (!is_command && request.path != "/" && request.path != "/state" && request.path != "/stream" &&
      request.path != "/scene.glb" && request.path != "/algorithm")
    return refuse(404, "there is no such path");
  if (request.method != (is_command ? "POST" : "GET")) return refuse(405, "another method is wanted here");
  if (request.has_header("Range"))
    return refuse(416, "there are no ranges");  // the library's are not checked
  if (!is_command) return Handled::Unhandled;
  if (request.is_multipart_form_data()) return refuse(415, "a command is JSON");
  if (!request.has_header("Content-Length") && !request.has_header("Transfer-Encoding"))
    return refuse(411, "a command needs its length");  // the library would read until the connection ends
  return Handled::Unhandled;
}

void Server::Http::take_command(httplib::Response& response, const httplib::ContentReader& read) {
  std::string body;
  bool too_long = false;
  const bool whole = read([&](const char* data, std::size_t length) {
    too_long = body.size() + length > longest_body;
    if (!too_long) body.append(data, length);
    return !too_long;
  });
  if (too_long) response.status = 413;  // the library sees only a length that is given beforehand
  if (!whole) return;                   // with the library's own status, or this
  try {
    const Loop::Reply reply = loop_.ask(parse_command(body));
    const int status = reply.kind == Loop::Reply::Kind::done      ? 200
                       : reply.kind == Loop::Reply::Kind::refused ? 400
                                                                  : 503;
    answer(response, status, reply.json, json_type);
  } catch (const InputError& unreadable) {
    answer(response, 400, refusal_text(unreadable.what()), json_type);
  }
}

// Sends the newest messages until the page or the scene ends. What a page misses because it reads slowly is not made up for.
void Server::Http::open_stream(httplib::Response& response) {
  const std::shared_ptr<void> place(nullptr, [this](void*) { --streams_; });
  if (++streams_ > most_streams) return answer(response, 503, "too many pages watch this scene\n", text_type);
  const auto seen = std::make_shared<News>();
  response.set_chunked_content_provider(
      "application/octet-stream", [this, place, seen](std::size_t, httplib::DataSink& sink) {
        const News waited = loop_.board().wait(seen->frame.number, seen->state.number, 500ms);
        if (!waited.closed && !sink.is_writable())
          return false;  // it waits until there is room; then what is newest?
        const News newest = loop_.board().news();
        const auto send = [&](const Notice& notice, const Notice& last) {
          return notice.number == last.number || !notice.message ||
                 sink.write(notice.message->data(), notice.message->size());
        };
        if (!send(newest.state, seen->state) || !send(newest.frame, seen->frame) ||
            !send(newest.twin, seen->twin))
          return false;
        *seen = newest;
        if (newest.closed) sink.done();
        return true;
      });
}

void Server::Http::run() {
  std::future<bool> served = std::async(std::launch::async, [this] {
    const bool until_stopped = server_.listen_after_bind();
    loop_.stop();  // in case that the server ended first
    return until_stopped;
  });
  while (!server_.is_running() && served.wait_for(1ms) == std::future_status::timeout) {
  }
  try {
    loop_.run();
  } catch (...) {
    close(served);
    throw;
  }
  close(served);
  if (!served.get()) throw std::runtime_error("the server can no longer listen at its port");
}

// Answers under way get a moment; then every connection is cut, and with it each wait for a page that says nothing.
void Server::Http::close(std::future<bool>& served) {
  const auto end = std::chrono::steady_clock::now() + 200ms;
  while (streams_ > 0 && std::chrono::steady_clock::now() < end) std::this_thread::sleep_for(2ms);
  server_.stop();
  if (served.wait_for(200ms) == std::future_status::ready) return;
  do cut_connections(port_);
  while (served.wait_for(20ms) == std::future_status::timeout);
}

Server::Server(Simulation& simulation, std::string page, int port)
    : http_(std::make_unique<Http>(simulation, std::move(page), port)) {}
Server::~Server() = default;

int Server::port() const {
  return http_->port();
}
const std::string& Server::key() const {
  return http_->access().key();
}
std::string Server::address() const {
  return http_->access().address();
}
void Server::run() {
  http_->run();
}
void Server::stop() {
  http_->stop();
}

}  // namespace fc::live
