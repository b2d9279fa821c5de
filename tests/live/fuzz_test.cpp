// Five thousand malformed requests over raw sockets, beside the ten thousand commands of command_test.cpp: none crashes the server, stops the scene or gets past the key.
#include <future>
#include <random>

#include "page_side.hpp"

namespace {

using fc_test::Connection;
using fc_test::Served;

class Fuzzer {
 public:
  Fuzzer(const Served& live, unsigned seed) : live_(live), random_(seed) {}

  std::string request() {
    switch (below(8)) {
      case 0:
        return bytes(below(2000)) + "\r\n\r\n";
      case 1:
        return spoilt(live_.request("GET", live_.target("/state"), header())) + "\r\n\r\n";
      case 2:
        return spoilt(live_.request("POST", live_.target("/command"), header(), command()));
      case 3:
        return live_.request(word() + bytes(below(3)), live_.target("/" + bytes(below(200))), header());
      case 4:
        return live_.request("POST", live_.target("/command"), header(), command());
      case 5:
        return live_.request("GET", "/" + std::string(below(9000), 'a') + bytes(3), header());
      case 6:
        return wrong_length(command());
      default:
        return live_.request(below(4) == 0 ? word() : "GET",
                             live_.target(below(2) == 0 ? "/scene.glb" : "/algorithm"),
                             header() + header() + header());
    }
  }

 private:
  std::size_t below(std::size_t n) { return std::uniform_int_distribution<std::size_t>(0, n - 1)(random_); }

  std::string bytes(std::size_t n) {
    std::string text(n, '\0');
    for (char& c : text) c = static_cast<char>(below(256));
    return text;
  }
  std::string word() {
    const char* words[] = {"GET", "POST", "PUT", "HEAD", "PRI", "TRACE", "CONNECT", "get", "", "STOP"};
    return words[below(std::size(words))];
  }
  std::string header() {
    switch (below(12)) {
      case 0:
        return "Range: bytes=" + std::string(below(8000), static_cast<char>('0' + below(3))) + "-\r\n";
      case 1:
        return "Range: bytes=0-1,5-,-7," + std::to_string(below(1000000000)) + "-\r\n";
      case 2:
        return "Expect: 100-continue\r\n";
      case 3:
        return "Content-Type: multipart/form-data; boundary=" + std::string(below(100), '-') + "\r\n";
      case 4:
        return "Content-Encoding: gzip\r\n";
      case 5:
        return "Transfer-Encoding: chunked\r\n";
      case 6:
        return "Accept-Encoding: br, gzip\r\n";
      case 7:
        return "X-" + bytes(below(50)) + ": " + bytes(below(300)) + "\r\n";
      case 8:
        return "Host: " + std::string(below(9000), 'h') + "\r\n";
      case 9:
        return "Connection: keep-alive\r\nOrigin: %00%0d%0a\r\n";
      default:
        return "";
    }
  }
  std::string command() {
    const std::string commands[] = {R"({"do": "set", "key": "step.dt", "value": "0.01"})",
                                    R"({"do": "grab", "body": 1, "point": [1, 2, 3]})",
                                    R"({"do": "throw", "from": [0, 0, 0], "velocity": [1e308, -1e308, 0]})",
                                    R"({"do": "drag", "to": [1e400, 0, 0]})",
                                    R"({"do": "twin", "on": true})",
                                    R"({"do": "set", "key": "drift", "value": "1", "of": "twin"})",
                                    R"({"do": "twin", "on": false})",
                                    std::string(below(140000), '['),
                                    R"({"do": ["run", {"run": [1, [2]]}]})",
                                    R"({"do": "pause", "do": "reset"})"};
    return below(2) == 0 ? spoilt(commands[below(std::size(commands))])
                         : commands[below(std::size(commands))];
  }
  std::string spoilt(std::string text) {
    for (std::size_t changes = 1 + below(5); changes > 0 && !text.empty(); --changes) {
      const std::size_t at = below(text.size());
      switch (below(4)) {
        case 0:
          text[at] = static_cast<char>(below(256));
          break;
        case 1:
          text.erase(at, 1 + below(20));
          break;
        case 2:
          text.insert(at, bytes(1 + below(5)));
          break;
        default:
          text.resize(at);
          break;
      }
    }
    return text;
  }
  std::string wrong_length(const std::string& body) {
    const char* lengths[] = {"-1", "99999999999999999999", "1e3", "", "0", "70000", "3"};
    return "POST " + live_.target("/command") + " HTTP/1.1\r\nHost: " + live_.host() +
           "\r\nContent-Length: " + lengths[below(std::size(lengths))] + "\r\n" + header() + "\r\n" + body;
  }

  const Served& live_;
  std::mt19937_64 random_;
};

// Sends requests, and counts the statuses that answer them.
std::map<int, int> statuses_of(const Served& live, unsigned seed, int requests) {
  Fuzzer fuzzer(live, seed);
  std::map<int, int> statuses;
  for (int i = 0; i < requests; ++i) {
    const Connection connection(live.server.port());
    connection.send(fuzzer.request());
    // Of what has no end the server waits for the rest, until there can be none. (Said at once, it would take the page for
    // gone, and answer nobody.)
    if (!connection.has_come(std::chrono::milliseconds(10))) connection.end_sending();
    const std::string answer = connection.receive();  // its beginning: a stream would not end
    if (answer.starts_with("HTTP/1.1 ")) ++statuses[std::stoi(answer.substr(9))];
  }
  return statuses;
}

TEST(Fuzz, FiveThousandMalformedRequests) {
  constexpr unsigned pages = 4;  // the library lets five wait to be accepted
  const Served live(3, 0.005);
  std::vector<std::future<std::map<int, int>>> counted;
  for (unsigned page = 0; page < pages; ++page)
    counted.push_back(std::async(std::launch::async, statuses_of, std::cref(live), page, 5000 / pages));
  std::map<int, int> statuses;
  for (auto& counts : counted)
    for (const auto& [status, count] : counts.get()) statuses[status] += count;
  for (const int expected : {200, 400, 403, 404, 405, 413, 415, 416, 503})
    EXPECT_GT(statuses[expected], 0) << expected;
  EXPECT_EQ(statuses[500], 0);
  EXPECT_FALSE(live.scene.two_threads);
  EXPECT_EQ(live.command(R"({"do": "reset"})").status, 200);
  EXPECT_EQ(live.command(R"({"do": "step"})").status, 200);
  EXPECT_EQ(live.state()["failed"], nullptr);
}

// What reaches the server without its key changes nothing: every request is well formed but for the key.
TEST(Fuzz, NoGuessedKeyChangesAnything) {
  const Served live;
  std::mt19937_64 random(20080101);
  for (int i = 0; i < 500; ++i) {
    std::string key = live.server.key();
    key[random() % key.size()] = "ghijklmnop%&=? "[random() % 15];
    if (i % 3 == 0) key.resize(random() % 32);
    const std::string body = R"({"do": "stop"})";
    const auto answer = live.exchange(live.request("POST", "/command?key=" + key, "", body));
    EXPECT_TRUE(answer.status == 403 || answer.status == 400) << answer.status << " " << key;
  }
  EXPECT_EQ(live.state()["running"], true);
}

}  // namespace
