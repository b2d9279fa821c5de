// What the server answers to a page: each line of STREAM.md, and each reason to refuse.
#include <gmock/gmock.h>

#include <set>

#include "common/live/access.hpp"
#include "page_side.hpp"

namespace {

using namespace std::chrono_literals;
using fc_test::Connection;
using fc_test::Message;
using fc_test::Served;
using fc_test::soon;
using fc_test::StreamReader;
using testing::HasSubstr;

TEST(Server, TellsItsAddressWithANewKeyOf128Bits) {
  const Served one, other;
  EXPECT_EQ(one.server.address(), "http://" + one.host() + "/?key=" + one.server.key());
  EXPECT_EQ(one.server.key().size(), 32u);
  EXPECT_EQ(one.server.key().find_first_not_of("0123456789abcdef"), std::string::npos);
  EXPECT_NE(one.server.key(), other.server.key());
}

TEST(Server, GivesThePageWithItsPolicy) {
  const Served live;
  const auto page = live.get("/");
  EXPECT_EQ(page.status, 200);
  EXPECT_EQ(page.body, "<p>the page</p>");
  EXPECT_THAT(page.headers.at("content-type"), HasSubstr("text/html"));
  EXPECT_THAT(page.headers.at("content-security-policy"), HasSubstr("default-src 'none'"));
  EXPECT_EQ(page.headers.at("referrer-policy"), "no-referrer");
  EXPECT_EQ(page.headers.at("cache-control"), "no-store");
  EXPECT_EQ(page.headers.count("access-control-allow-origin"), 0u);
}

TEST(Server, GivesTheSceneAndTheState) {
  const Served live;
  live.command(R"({"do": "pause"})");
  const auto glb = live.get("/scene.glb");
  EXPECT_EQ(glb.status, 200);
  EXPECT_EQ(glb.headers.at("content-type"), "model/gltf-binary");
  EXPECT_EQ(glb.body, "glTF 0 at frame " + std::to_string(live.scene.frames));
  const auto state = live.get("/state");
  EXPECT_EQ(state.headers.at("content-type"), "application/json");
  EXPECT_EQ(state.json()["frame"], live.scene.frames.load());
  EXPECT_EQ(state.json()["running"], false);
}

TEST(Server, CarriesOutCommands) {
  const Served live;
  const auto done = live.command(R"({"do": "set", "key": "step.dt", "value": "0.02"})");
  EXPECT_EQ(done.status, 200);
  EXPECT_EQ(done.json()["ok"], true);
  EXPECT_EQ(done.json()["rebuilt"], true);
  EXPECT_EQ(live.state()["dt"], 0.02);
  const auto saved = live.command(R"({"do": "save"})").json();
  EXPECT_EQ(saved["scene"], "step: {dt: 0.01}\nbodies: []\n");
  const auto refused = live.command(R"({"do": "grab", "body": 9, "point": [0, 0, 0]})");
  EXPECT_EQ(refused.status, 400);
  EXPECT_EQ(refused.json()["ok"], false);
  EXPECT_EQ(refused.json()["text"], "there is no body 9");
  const auto unreadable = live.command("{\"do\": ");
  EXPECT_EQ(unreadable.status, 400);
  EXPECT_EQ(unreadable.json()["text"], "the command is not JSON");
  EXPECT_FALSE(live.scene.two_threads);
}

TEST(Server, RefusesWhoeverLacksTheKey) {
  const Served live;
  std::string wrong = live.server.key();
  wrong.back() = wrong.back() == '0' ? '1' : '0';
  for (const char* path : {"/", "/state", "/stream", "/scene.glb", "/algorithm", "/command", "/nowhere"})
    for (const std::string& query :
         {std::string(), std::string("?key="), "?key=" + wrong, "?key=" + live.server.key() + "0",
          "?Key=" + live.server.key(), "?key=" + wrong + "&key=" + live.server.key()})
      for (const char* method : {"GET", "POST", "PUT", "DELETE", "OPTIONS", "HEAD"})
        EXPECT_EQ(live.exchange(live.request(method, path + query)).status, 403)
            << method << " " << path << query;
  EXPECT_EQ(live.scene.geometry(), 0);
}

TEST(Server, RefusesOtherHostsAndOrigins) {
  const Served live;
  const std::string port = ":" + std::to_string(live.server.port()), target = live.target("/state");
  const auto status = [&](const std::string& headers) {
    return live.exchange("GET " + target + " HTTP/1.1\r\n" + headers + "\r\n").status;
  };
  const std::string host = "Host: 127.0.0.1" + port + "\r\n";
  EXPECT_EQ(status(host), 200);
  EXPECT_EQ(status("Host: localhost" + port + "\r\n"), 200);
  EXPECT_EQ(status(host + "Origin: http://127.0.0.1" + port + "\r\n"), 200);
  EXPECT_EQ(status(host + "Origin: http://localhost" + port + "\r\n"), 200);
  for (const std::string& bad :
       {std::string(), std::string("Host: \r\n"), std::string("Host: 127.0.0.1\r\n"),
        "Host: evil.example" + port + "\r\n", "Host: 127.0.0.1" + port + "1\r\n",
        "Host: 127.0.0.1.evil.example" + port + "\r\n", host + "Host: evil.example\r\n",
        host + "Origin: null\r\n", host + "Origin: https://127.0.0.1" + port + "\r\n",
        host + "Origin: http://evil.example\r\n", host + "Origin: http://127.0.0.1\r\n",
        host + "Origin: http://127.0.0.1" + port + "/\r\n",
        host + "Origin: http://127.0.0.1" + port + "\r\nOrigin: http://evil.example\r\n"})
    EXPECT_EQ(status(bad), 403) << bad;
}

TEST(Server, APortThatBrowsersLeaveOutIsLeftOut) {
  const fc::live::Access usual(80);
  EXPECT_EQ(usual.refuses({{"localhost"}, {"http://localhost"}, usual.key()}), std::nullopt);
  EXPECT_NE(usual.refuses({{"localhost:81"}, {}, usual.key()}), std::nullopt);
}

TEST(Server, RefusesWhatItDoesNotHave) {
  const Served live;
  EXPECT_EQ(live.get("/nowhere").status, 404);
  EXPECT_EQ(live.get("/sceneXglb").status, 404);
  EXPECT_EQ(live.get("/state/").status, 404);
  for (const char* method : {"PUT", "DELETE", "OPTIONS", "PATCH", "HEAD"}) {
    EXPECT_EQ(live.exchange(live.request(method, live.target("/state"))).status, 405) << method;
    EXPECT_EQ(live.exchange(live.request(method, live.target("/command"))).status, 405) << method;
  }
  EXPECT_EQ(live.get("/command").status, 405);
  const std::string command = live.target("/command");
  EXPECT_EQ(live.exchange(live.request("GET", live.target("/scene.glb"), "Range: bytes=100000-\r\n")).status,
            416);
  const std::string host = "Host: " + live.host() + "\r\n";
  EXPECT_EQ(live.exchange("POST " + command + " HTTP/1.1\r\n" + host + "\r\n").status, 411);
  EXPECT_EQ(live.exchange(live.request("POST", command, "Content-Type: multipart/form-data; boundary=x\r\n",
                                       "--x--"))
                .status,
            415);
}

TEST(Server, RefusesACommandOfMoreThan64KB) {
  const Served live;
  const std::string head = "POST " + live.target("/command") + " HTTP/1.1\r\nHost: " + live.host() + "\r\n";
  const std::string full =
      R"({"do": "run")" + std::string(65535 - 12, ' ') + "}";  // 64 KB: as much as is read
  EXPECT_EQ(live.command(full).status, 200);
  EXPECT_EQ(live.command(full + " ").status, 413);
  EXPECT_EQ(live.command(std::string(1000000, '[')).status, 413);
  std::string chunks;
  for (int i = 0; i < 17; ++i) chunks += "1000\r\n" + std::string(4096, ' ') + "\r\n";
  EXPECT_EQ(live.exchange(head + "Transfer-Encoding: chunked\r\n\r\n" + chunks).status, 413);
  EXPECT_EQ(
      live.exchange(head + "Transfer-Encoding: chunked\r\n\r\nd\r\n{\"do\": \"run\"}\r\n0\r\n\r\n").status,
      200);
}

TEST(Stream, SendsStateAndFramesAsTheyCome) {
  const Served live(3, 0.005);
  StreamReader stream(live.server.port(), live.stream());
  Message message;
  ASSERT_TRUE(stream.next(message));
  EXPECT_EQ(message.kind, 2u);  // the state first
  EXPECT_EQ(nlohmann::json::parse(message.bytes)["title"], "fake & <scene>");
  std::uint32_t last = 0;
  for (int i = 0; i < 20; ++i) {
    message = stream.next(1);
    EXPECT_GE(message.frame(), last);
    last = message.frame();
    EXPECT_TRUE(message.runs());
    EXPECT_EQ(message.at<std::uint32_t>(20), 3u);
    EXPECT_EQ(message.at<float>(32 + 4), static_cast<float>(last));  // y of body 0
    EXPECT_EQ(message.bytes.size(), 32u + 3 * 28 + 40);
  }
  EXPECT_GT(last, 10u);
}

TEST(Stream, AfterACommandTheStateComesAtOnce) {
  const Served live;
  StreamReader stream(live.server.port(), live.stream());
  stream.next(2);
  live.command(R"({"do": "pause"})");
  while (nlohmann::json::parse(stream.next(2).bytes)["running"] == true) {
  }
  live.command(R"({"do": "throw", "from": [0, 0, 0], "velocity": [1, 0, 0]})");
  EXPECT_EQ(nlohmann::json::parse(stream.next(2).bytes)["geometry"], 1);
  EXPECT_EQ(live.get("/scene.glb").body, "glTF 1 at frame " + std::to_string(live.scene.frames));
}

TEST(Stream, AFailureComesInBothKinds) {
  Served live(3, 0.002);
  StreamReader stream(live.server.port(), live.stream());
  stream.next(1);
  live.scene.fails_at = live.scene.frames + 5;
  Message frame = stream.next(1);
  while (!frame.failed()) frame = stream.next(1);
  EXPECT_FALSE(frame.runs());
  EXPECT_EQ(live.state()["failed"], "energy grew\\x0aby 3 J");
  live.scene.fails_at = -1;
  EXPECT_EQ(live.command(R"({"do": "reset"})").status, 200);
  frame = stream.next(1);
  EXPECT_FALSE(frame.failed());
  EXPECT_EQ(frame.frame(), 0u);
}

TEST(Stream, SeveralPagesSeeTheSameAndEndWithTheScene) {
  Served live(3, 0.002);
  std::vector<std::thread> pages;
  std::atomic<int> ended = 0, reading = 0;
  for (int i = 0; i < 5; ++i)
    pages.emplace_back([&] {
      StreamReader stream(live.server.port(), live.stream());
      stream.next(1);
      ++reading;
      Message message;
      while (stream.next(message)) {
      }
      ++ended;  // not cut: it throws then
    });
  EXPECT_TRUE(soon([&] { return reading == 5; }));
  live.stop();
  for (std::thread& page : pages) page.join();
  EXPECT_EQ(ended, 5);
}

TEST(Stream, APageThatReadsNothingHoldsUpNobody) {
  Served live(10000, 0.005);  // a quarter of a megabyte a frame
  const Connection slow(live.server.port(), 4096);
  slow.send(live.stream());
  const Connection idle(live.server.port());  // says nothing
  std::this_thread::sleep_for(50ms);          // the slow page's buffers are full by then
  const auto before = live.scene.frames.load();
  StreamReader reader(live.server.port(), live.stream());
  std::set<std::uint32_t> seen;
  while (seen.size() < 20) seen.insert(reader.next(1).frame());
  EXPECT_GE(live.scene.frames, before + 15);
  EXPECT_EQ(live.command(R"({"do": "pause"})").status, 200);
  EXPECT_FALSE(live.scene.two_threads);
}

TEST(Stream, APageThatWasSlowGetsTheNewestFrame) {
  Served live(8000, 0.002);
  StreamReader slow(live.server.port(), live.stream(), 4096);
  const std::uint32_t first = slow.next(1).frame();
  EXPECT_TRUE(soon([&] { return live.scene.frames > first + 60; }));
  live.command(R"({"do": "pause"})");
  const auto last = static_cast<std::uint32_t>(live.scene.frames);
  int messages = 0;
  while (slow.next(1).frame() != last) ++messages;
  EXPECT_LT(messages, 20);  // what the buffers held, and not sixty
}

TEST(Stream, The33rdIsRefusedUntilAnotherHasGone) {
  const Served live;
  std::vector<std::unique_ptr<StreamReader>> pages;
  for (int i = 0; i < 32; ++i) {
    pages.push_back(std::make_unique<StreamReader>(live.server.port(), live.stream()));
    EXPECT_EQ(pages.back()->status(), 200);
  }
  EXPECT_EQ(live.exchange(live.stream()).status, 503);
  EXPECT_EQ(live.command(R"({"do": "pause"})").status, 200);
  pages.pop_back();
  EXPECT_TRUE(soon([&] { return StreamReader(live.server.port(), live.stream()).status() == 200; }));
}

TEST(Server, TheCommandStopIsAnsweredAndEndsIt) {
  Served live;
  StreamReader stream(live.server.port(), live.stream());
  stream.next(1);
  const Connection idle(live.server.port()), silent(live.server.port());
  idle.send("GET /sta");
  const auto answer = live.command(R"({"do": "stop"})");
  EXPECT_EQ(answer.status, 200);
  EXPECT_EQ(answer.json()["ok"], true);
  live.join();
  Message message;
  while (stream.next(message)) {
  }
  EXPECT_THROW(Connection(live.server.port()), std::runtime_error);
}

TEST(Server, APortInUseIsRefusedInALine) {
  const Served live;
  fc_test::FakeScene scene;
  try {
    const fc::live::Server second(scene, "", live.server.port());
    FAIL() << "two servers at one port";
  } catch (const fc::InputError& error) {
    EXPECT_EQ(std::string(error.what()),
              "--live=" + std::to_string(live.server.port()) +
                  ": the port is in use, or not allowed; choose another, or none, and a free one is taken");
  }
}

}  // namespace
