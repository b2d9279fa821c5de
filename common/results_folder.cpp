#include "common/results_folder.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <fstream>
#include <functional>
#include <mutex>
#include <nlohmann/json.hpp>
#include <thread>
#include <utility>

#include "common/errors.hpp"
#include "common/text.hpp"

namespace fc {
namespace fs = std::filesystem;
namespace {

[[noreturn]] void refuse_folder(const fs::path& folder, const std::string& why) {
  throw InputError("--out " + folder.string() + ": " + why + "; choose another folder");
}

// Makes the folder, with its parents; returns those that were made, the outermost first.
std::vector<fs::path> make_folders(const fs::path& folder) {
  std::vector<fs::path> missing;
  std::error_code error;
  for (fs::path f = folder; !f.empty() && !fs::exists(f, error) && !error; f = f.parent_path())
    missing.push_back(f);
  std::reverse(missing.begin(), missing.end());
  fs::create_directories(folder, error);
  std::error_code ignored;
  if (!fs::is_directory(folder, ignored)) refuse_folder(folder, error ? error.message() : "not a folder");
  return missing;
}

fs::path make_aside(const fs::path& folder) {
  std::string name = (folder / ".unfinished-XXXXXX").string();
  if (mkdtemp(name.data()) == nullptr)
    refuse_folder(folder, std::string("cannot be written: ") + std::strerror(errno));
  fs::permissions(name, fs::status(folder).permissions());  // mkdtemp's own are narrower
  return name;
}

// The files that the previous run lists in its summary.json, as far as they are plain names inside the
// folder.
std::vector<fs::path> files_before(const fs::path& folder) {
  std::ifstream stream(folder / "summary.json", std::ios::binary);
  const auto json = nlohmann::json::parse(stream, nullptr, false);
  std::vector<fs::path> files;
  if (!json.is_object() || !json.contains("files") || !json["files"].is_array()) return files;
  for (const auto& entry : json["files"]) {
    if (!entry.is_string()) continue;
    const fs::path file(entry.get<std::string>());
    const bool inside = file.is_relative() && std::find(file.begin(), file.end(), "..") == file.end();
    if (inside) files.push_back(file);
  }
  return files;
}

void remove_stale(const fs::path& folder, const std::vector<fs::path>& before,
                  const std::vector<std::string>& now) {
  for (const fs::path& file : before) {
    if (std::binary_search(now.begin(), now.end(), file.string())) continue;
    std::error_code ignored;
    if (!fs::is_regular_file(fs::symlink_status(folder / file, ignored))) continue;
    fs::remove(folder / file, ignored);
    for (fs::path parent = file.parent_path(); !parent.empty(); parent = parent.parent_path())
      fs::remove(folder / parent, ignored);  // only if nothing is left in it
  }
}

}  // namespace

std::vector<std::string> files_below(const fs::path& folder) {
  std::vector<std::string> files;
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(folder))
    if (entry.is_regular_file()) files.push_back(fs::relative(entry.path(), folder).string());
  std::sort(files.begin(), files.end());
  return files;
}

// Waits for the signals that end a program. A thread may clean up in ways that a signal handler may not.
class ResultsFolder::Watch {
 public:
  explicit Watch(std::function<void(bool keep)> clean_up) : clean_up_(std::move(clean_up)) {
    sigset_t watched;
    sigemptyset(&watched);
    for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
      struct sigaction action {};
      sigaction(signal, nullptr, &action);
      if (action.sa_handler != SIG_DFL) continue;  // ignored (nohup), or somebody else's
      sigaddset(&watched, signal);
      last_ = signal;
    }
    if (last_ == 0) return;
    pthread_sigmask(SIG_BLOCK, &watched, &before_);
    thread_ = std::thread([this, watched] { wait(watched); });
  }
  ~Watch() {
    if (!thread_.joinable()) return;
    {
      const std::lock_guard lock(mutex_);
      over_ = true;
    }
    pthread_kill(thread_.native_handle(), last_);
    thread_.join();
    pthread_sigmask(SIG_SETMASK, &before_, nullptr);
  }

  std::mutex& mutex() { return mutex_; }  // held: no signal ends the program
  bool keep = false;

 private:
  void wait(const sigset_t& watched) {
    int signal = 0;
    sigwait(&watched, &signal);
    mutex_.lock();
    if (over_) return mutex_.unlock();
    clean_up_(keep);
    std::signal(signal, SIG_DFL);
    pthread_sigmask(SIG_UNBLOCK, &watched, nullptr);
    raise(signal);  // as if nobody had waited for it: the caller sees what ended the program
  }

  std::function<void(bool keep)> clean_up_;
  sigset_t before_{};
  int last_ = 0;
  std::mutex mutex_;
  bool over_ = false;
  std::thread thread_;
};

ResultsFolder::ResultsFolder(fs::path folder) : folder_(std::move(folder)), made_(make_folders(folder_)) {
  aside_ = make_aside(folder_);
  watch_ = std::make_unique<Watch>([this](bool keep) {
    if (!keep || aside_.empty()) return remove_aside();
    fmt::print(stderr, "stopped; the results so far are in {}\n", one_line(aside_.string()));
  });
}

ResultsFolder::~ResultsFolder() {
  watch_.reset();
  if (!aside_.empty()) remove_aside();
}

void ResultsFolder::keep_if_killed() {
  const std::lock_guard lock(watch_->mutex());
  watch_->keep = true;
}

void ResultsFolder::put_in_place() {
  const std::lock_guard lock(watch_->mutex());
  const std::vector<std::string> now = files_below(aside_);
  const std::vector<fs::path> before = files_before(folder_);
  const fs::path kept =
      std::exchange(aside_, {});  // whatever goes wrong from here on: results are not thrown away
  const auto refuse_place = [&](const std::string& file, const std::string& why) {
    throw InputError({(folder_ / file).string()},
                     why + "; the results are in " + kept.string() + ", choose another folder by --out");
  };
  for (const std::string& file : now) {
    std::error_code error;
    fs::create_directories((folder_ / file).parent_path(), error);
    if (error) refuse_place(file, error.message());
    if (fs::is_directory(folder_ / file, error)) refuse_place(file, "is a folder");
  }
  for (const std::string& file : now) {
    std::error_code error;
    fs::rename(kept / file, folder_ / file, error);
    if (error) refuse_place(file, error.message());
  }
  remove_stale(folder_, before, now);
  fs::remove_all(kept);
  made_.clear();
}

void ResultsFolder::remove_aside() {
  std::error_code error;
  for (int attempt = 0; attempt < 100; ++attempt)  // a run that goes on may still make files in it
    if (fs::remove_all(aside_, error); !error) break;
  for (; !made_.empty(); made_.pop_back()) fs::remove(made_.back(), error);  // only if nothing is in it
}

}  // namespace fc
