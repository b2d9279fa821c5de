// The page's side of HTTP, independent of the server's library: raw bytes over a socket.
#pragma once

#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <sys/time.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <cstdint>
#include <cstring>
#include <map>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "common/live/server.hpp"
#include "fake_scene.hpp"

namespace fc_test {

// A connection to 127.0.0.1; what waits longer than 30 s throws.
class Connection {
 public:
  explicit Connection(int port, int receive_buffer = 0) : socket_(::socket(AF_INET, SOCK_STREAM, 0)) {
    const timeval longest{30, 0};
    setsockopt(socket_, SOL_SOCKET, SO_RCVTIMEO, &longest, sizeof longest);
    setsockopt(socket_, SOL_SOCKET, SO_SNDTIMEO, &longest, sizeof longest);
    if (receive_buffer > 0)
      setsockopt(socket_, SOL_SOCKET, SO_RCVBUF, &receive_buffer, sizeof receive_buffer);
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    address.sin_port = htons(static_cast<std::uint16_t>(port));
    if (connect(socket_, reinterpret_cast<sockaddr*>(&address), sizeof address) != 0) {
      ::close(socket_);
      throw std::runtime_error("no connection");
    }
  }
  ~Connection() { ::close(socket_); }
  Connection(const Connection&) = delete;
  Connection& operator=(const Connection&) = delete;

  // False if the other side has closed.
  bool send(const std::string& bytes) const {
    for (std::size_t sent = 0; sent < bytes.size();) {
      const ssize_t n = ::send(socket_, bytes.data() + sent, bytes.size() - sent, MSG_NOSIGNAL);
      if (n <= 0) return false;
      sent += static_cast<std::size_t>(n);
    }
    return true;
  }

  // What has come, at least a byte; "" at the end.
  std::string receive() const {
    char buffer[65536];
    const ssize_t n = recv(socket_, buffer, sizeof buffer, 0);
    if (n < 0 && (errno == EAGAIN || errno == EWOULDBLOCK)) throw std::runtime_error("nothing came for 30 s");
    return n <= 0 ? std::string() : std::string(buffer, static_cast<std::size_t>(n));
  }
  void end_sending() const { shutdown(socket_, SHUT_WR); }

  // Whether something has come by then; the end counts.
  bool has_come(std::chrono::milliseconds longest) const {
    pollfd waited{socket_, POLLIN, 0};
    return poll(&waited, 1, static_cast<int>(longest.count())) > 0;
  }
  std::string receive_all() const {
    std::string all;
    for (std::string more = receive(); !more.empty(); more = receive()) all += more;
    return all;
  }

 private:
  int socket_;
};

struct HttpAnswer {
  int status = 0;
  std::map<std::string, std::string> headers;  // names in lower case
  std::string body;

  nlohmann::json json() const { return nlohmann::json::parse(body); }
};

inline HttpAnswer parse_answer(const std::string& bytes) {
  HttpAnswer answer;
  const std::size_t end = bytes.find("\r\n\r\n");
  if (!bytes.starts_with("HTTP/1.1 ") || end == std::string::npos)
    throw std::runtime_error("no answer: " + bytes.substr(0, 100));
  answer.status = std::stoi(bytes.substr(9));
  for (std::size_t at = bytes.find("\r\n") + 2; at < end + 2;) {
    const std::size_t line_end = bytes.find("\r\n", at), colon = bytes.find(": ", at);
    std::string name = bytes.substr(at, colon - at);
    std::transform(name.begin(), name.end(), name.begin(), [](unsigned char c) { return std::tolower(c); });
    answer.headers[name] = bytes.substr(colon + 2, line_end - colon - 2);
    at = line_end + 2;
  }
  answer.body = bytes.substr(end + 4);
  return answer;
}

struct Message {
  std::uint32_t kind = 0;
  std::string bytes;  // without the header

  template <class Number>
  Number at(std::size_t offset) const {  // tests run on little-endian machines
    Number number;
    std::memcpy(&number, bytes.substr(offset, sizeof number).data(), sizeof number);
    return number;
  }
  std::uint32_t frame() const { return at<std::uint32_t>(4); }
  bool runs() const { return at<std::uint32_t>(16) & 1; }
  bool failed() const { return at<std::uint32_t>(16) & 2; }
};

// Takes the messages out of a chunked body as it comes.
class StreamReader {
 public:
  StreamReader(int port, const std::string& request, int receive_buffer = 0)
      : connection_(port, receive_buffer) {
    connection_.send(request);
  }

  int status() {
    while (raw_.find("\r\n\r\n") == std::string::npos)
      if (!more()) throw std::runtime_error("the stream ended before it began");
    const int status = std::stoi(raw_.substr(9));
    headers_read_ = true;
    raw_.erase(0, raw_.find("\r\n\r\n") + 4);
    return status;
  }

  // False: the stream has ended, and as it should.
  bool next(Message& message) {
    if (!headers_read_ && status() != 200) throw std::runtime_error("the stream was refused");
    while (!take_message(message)) {
      if (take_chunk()) continue;
      if (ended_) return false;
      if (!more()) throw std::runtime_error("the stream was cut");
    }
    return true;
  }
  Message next(std::uint32_t kind) {
    Message message;
    do {
      if (!next(message)) throw std::runtime_error("the stream ended");
    } while (message.kind != kind);
    return message;
  }

 private:
  bool more() {
    const std::string bytes = connection_.receive();
    raw_ += bytes;
    return !bytes.empty();
  }
  bool take_chunk() {
    const std::size_t line_end = raw_.find("\r\n");
    if (ended_ || line_end == std::string::npos) return false;
    const std::size_t length = std::stoul(raw_, nullptr, 16);
    if (raw_.size() < line_end + 2 + length + 2) return false;
    body_ += raw_.substr(line_end + 2, length);
    raw_.erase(0, line_end + 2 + length + 2);
    ended_ = length == 0;
    return !ended_;
  }
  bool take_message(Message& message) {
    std::uint32_t length = 0;
    if (body_.size() < 8) return false;
    std::memcpy(&length, body_.data(), 4);
    if (body_.size() < 4 + std::size_t{length}) return false;
    std::memcpy(&message.kind, body_.data() + 4, 4);
    message.bytes = body_.substr(8, length - 4);
    body_.erase(0, 4 + std::size_t{length});
    return true;
  }

  Connection connection_;
  std::string raw_, body_;
  bool headers_read_ = false, ended_ = false;
};

// A fake scene that is served.
class Served {
 public:
  explicit Served(int bodies = 3, double dt = 0.01) : scene(bodies, dt), server(scene, "<p>the page</p>", 0) {
    thread_ = std::thread([this] { server.run(); });
  }
  ~Served() { stop(); }
  void stop() {
    server.stop();
    join();
  }
  void join() {
    if (thread_.joinable()) thread_.join();
  }

  std::string host() const { return "127.0.0.1:" + std::to_string(server.port()); }
  std::string target(const std::string& path) const { return path + "?key=" + server.key(); }
  std::string request(const std::string& method, const std::string& target, const std::string& more = "",
                      const std::string& body = "") const {
    std::string text = method + " " + target + " HTTP/1.1\r\nHost: " + host() + "\r\n" + more;
    if (method == "POST") text += "Content-Length: " + std::to_string(body.size()) + "\r\n";
    return text + "\r\n" + body;
  }
  HttpAnswer exchange(const std::string& bytes) const {
    const Connection connection(server.port());
    connection.send(bytes);
    return parse_answer(connection.receive_all());
  }
  HttpAnswer get(const std::string& path) const { return exchange(request("GET", target(path))); }
  HttpAnswer command(const std::string& json) const {
    return exchange(request("POST", target("/command"), "", json));
  }
  nlohmann::json state() const { return get("/state").json(); }
  std::string stream() const { return request("GET", target("/stream")); }

  FakeScene scene;
  fc::live::Server server;

 private:
  std::thread thread_;
};

// Waits until something holds; a busy machine may take its time.
template <class Condition>
bool soon(Condition holds) {
  for (int i = 0; i < 3000; ++i) {
    if (holds()) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  return false;
}

}  // namespace fc_test
