// A program with --live, from outside: its options, what it prints, and how it ends.
#include <sys/wait.h>
#include <csignal>

#include "page_side.hpp"
#include "tests/support/run_files.hpp"

namespace {

using namespace std::chrono_literals;
using fc_test::Connection;
using fc_test::parse_answer;
using fc_test::StreamReader;

// The fake chapter as a process of its own, with signals as a terminal gives them.
class Process {
 public:
  explicit Process(const std::vector<std::string>& arguments) {
    int out[2];
    if (pipe(out) != 0) throw std::runtime_error("no pipe");
    pid_ = fork();
    if (pid_ == 0) {
      std::signal(SIGINT, SIG_DFL);  // a test that runs in the background has it ignored
      std::signal(SIGTERM, SIG_DFL);
      dup2(out[1], STDOUT_FILENO);
      close(out[0]);
      close(out[1]);
      std::vector<char*> argv = {const_cast<char*>(FC_FAKE_CHAPTER)};
      for (const std::string& argument : arguments) argv.push_back(const_cast<char*>(argument.c_str()));
      argv.push_back(nullptr);
      execv(FC_FAKE_CHAPTER, argv.data());
      _exit(127);
    }
    close(out[1]);
    out_ = fdopen(out[0], "r");
  }
  ~Process() {
    if (pid_ > 0) {
      kill(pid_, SIGKILL);
      waitpid(pid_, nullptr, 0);
    }
    fclose(out_);
  }

  std::string line() {
    char buffer[500];
    if (fgets(buffer, sizeof buffer, out_) == nullptr) return "";
    return buffer;
  }
  // Reads on to the address, and takes it apart.
  void find_page() {
    for (std::string text = line(); !text.empty(); text = line()) {
      if (!text.starts_with("http://127.0.0.1:")) continue;
      address_ = text.substr(0, text.size() - 1);
      port_ = std::stoi(address_.substr(17));
      key_ = address_.substr(address_.find("key=") + 4);
      return;
    }
    throw std::runtime_error("no address was printed");
  }
  std::string request(const std::string& method, const std::string& path,
                      const std::string& body = "") const {
    return method + " " + path + "?key=" + key_ + " HTTP/1.1\r\nHost: 127.0.0.1:" + std::to_string(port_) +
           "\r\nContent-Length: " + std::to_string(body.size()) + "\r\n\r\n" + body;
  }
  void send(int signal) const { kill(pid_, signal); }
  // The exit code, or minus the signal.
  int wait() {
    int status = 0;
    waitpid(pid_, &status, 0);
    pid_ = -1;
    return WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
  }
  int port() const { return port_; }

 private:
  pid_t pid_ = -1;
  FILE* out_ = nullptr;
  std::string address_, key_;
  int port_ = 0;
};

TEST(LiveProgram, PrintsItsAddressOnALineOfItsOwn) {
  Process program({"scene.yaml", "--live"});
  EXPECT_EQ(program.line(), "fake & <scene>: open this address in a browser; Ctrl-C ends it\n");
  program.find_page();
  const Connection connection(program.port());
  connection.send(program.request("GET", "/"));
  const auto page = parse_answer(connection.receive_all());
  EXPECT_EQ(page.status, 200);
  EXPECT_NE(page.body.find("fake &amp; &lt;scene>"), std::string::npos);
  EXPECT_EQ(page.body.find("MOTION_GLB_BASE64"), std::string::npos);
}

TEST(LiveProgram, QuietPrintsNothingElse) {
  Process program({"scene.yaml", "--live", "--quiet"});
  EXPECT_TRUE(program.line().starts_with("http://127.0.0.1:"));
}

// Within a second, whatever the pages do: one reads the stream, one says nothing, one has not finished its request. The best
// of three, as the machine may be busy.
TEST(LiveProgram, SignalsEndItWithZeroWithinASecond) {
  for (const int signal : {SIGINT, SIGTERM}) {
    auto best = std::chrono::steady_clock::duration::max();
    for (int attempt = 0; attempt < 3 && best > 1s; ++attempt) {
      Process program({"scene.yaml", "--live"});
      program.find_page();
      StreamReader stream(program.port(), program.request("GET", "/stream"));
      stream.next(1);
      const Connection silent(program.port()), half(program.port());
      half.send("POST /command?key=");
      const auto start = std::chrono::steady_clock::now();
      program.send(signal);
      EXPECT_EQ(program.wait(), 0);
      best = std::min(best, std::chrono::steady_clock::now() - start);
    }
    EXPECT_LT(best, 1s);
  }
}

TEST(LiveProgram, ASecondSignalDoesNotWaitForALongStep) {
  setenv("FC_STEP_MS", "60000", 1);
  Process program({"scene.yaml", "--live"});
  unsetenv("FC_STEP_MS");
  program.find_page();
  std::this_thread::sleep_for(100ms);  // the step has begun
  program.send(SIGINT);
  std::this_thread::sleep_for(100ms);
  program.send(SIGINT);
  EXPECT_EQ(program.wait(), -SIGINT);
}

TEST(LiveProgram, ThePagesStopEndsItWithZero) {
  Process program({"scene.yaml", "--live"});
  program.find_page();
  const Connection connection(program.port());
  connection.send(program.request("POST", "/command", R"({"do": "stop"})"));
  EXPECT_EQ(parse_answer(connection.receive_all()).status, 200);
  EXPECT_EQ(program.wait(), 0);
}

// What a command line that must not serve prints and returns.
fc_test::Outcome refused(const std::string& arguments, const std::string& environment = "") {
  return fc_test::run(environment + " timeout 20 '" FC_FAKE_CHAPTER "' scene.yaml " + arguments);
}

TEST(LiveProgram, APortInUseIsALineAndExitCode2) {
  Process first({"scene.yaml", "--live"});
  first.find_page();
  const auto second = refused("--live=" + std::to_string(first.port()));
  EXPECT_EQ(second.exit_code, 2);
  EXPECT_EQ(second.out, "");
  EXPECT_EQ(second.err,
            "--live=" + std::to_string(first.port()) +
                ": the port is in use, or not allowed; choose another, or none, and a free one is taken\n");
}

TEST(LiveProgram, TakesThePortThatItIsTold) {
  int port = 0;
  {
    Process first({"scene.yaml", "--live=0"});
    first.find_page();
    port = first.port();
    first.send(SIGTERM);
    EXPECT_EQ(first.wait(), 0);
  }
  Process second({"--live=" + std::to_string(port), "scene.yaml"});
  second.find_page();
  EXPECT_EQ(second.port(), port);
}

TEST(LiveProgram, OptionsThatHaveNoEffectBesideItAreRefused) {
  const std::pair<const char*, const char*> cases[] = {
      {"--live --out here", "--out has no effect beside --live; leave one of them out\n"},
      {"--live --poses", "--poses has no effect beside --live; leave one of them out\n"},
      {"--live --explain", "--explain has no effect beside --live; leave one of them out\n"},
      {"--live --clear", "--clear has no effect beside --live; leave one of them out\n"},
      {"--live --mine", "--mine has no effect beside --live; leave one of them out\n"},
      {"--live --sweep step.dt=1,2", "--sweep has no effect beside --live; leave one of them out\n"},
      {"--live --live=3", "--live is given twice, '0' and '3'; there is one page\n"},
      {"--live=65536",
       "--live=65536: a port is a whole number from 1 to 65535; leave it out, and a free one is taken\n"},
      {"--live=-1",
       "--live=-1: a port is a whole number from 1 to 65535; leave it out, and a free one is taken\n"},
      {"--live=8o",
       "--live=8o: a port is a whole number from 1 to 65535; leave it out, and a free one is taken\n"}};
  for (const auto& [arguments, why] : cases) {
    const auto result = refused(arguments);
    EXPECT_EQ(result.exit_code, 2) << arguments;
    EXPECT_EQ(result.err, why) << arguments;
    EXPECT_EQ(result.out, "") << arguments;
  }
}

TEST(LiveProgram, EarlierChaptersHaveNone) {
  const auto third = refused("--live", "FC_CHAPTER=3");
  EXPECT_EQ(third.exit_code, 2);
  EXPECT_EQ(
      third.err,
      "--live has no effect in chapter 3 (impulse LCP): it opens the scene to a browser while it runs, in chapter 4 "
      "on; leave it out\n");
  EXPECT_EQ(refused("--live", "FC_NOT_LIVE=1").err, "--live: this program has no live scene; leave it out\n");
}

TEST(LiveProgram, AFailureToBeginIsExitCode3) {
  const auto result = refused("--live --set fails=1");
  EXPECT_EQ(result.exit_code, 3);
  EXPECT_EQ(result.err, "no scene at all\n");
}

TEST(LiveProgram, HelpNamesThePort) {
  EXPECT_NE(fc_test::run("'" FC_FAKE_CHAPTER "' --help").out.find("--live[=PORT] "), std::string::npos);
}

}  // namespace
