// The folder of a run's results: written aside, and put in place when the run has ended (contract 1.3).
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace fc {

// The files below a folder, relative to it ("steps.csv", "ccd.tolerance=1e-4/steps.csv"), sorted.
std::vector<std::string> files_below(const std::filesystem::path& folder);

// Until put_in_place() the previous run's files stay as they are: the new ones are written into a folder
// inside it, named .unfinished-XXXXXX, on the same file system. If the run is refused, or the program is
// ended by Ctrl-C, SIGTERM or SIGHUP, that folder is removed, and with it the folders that were made for the
// run; after SIGKILL it stays and may be deleted.
class ResultsFolder {
 public:
  // Makes the folder, with its parents. Throws InputError if that cannot be done, or it cannot be written.
  explicit ResultsFolder(std::filesystem::path folder);
  ~ResultsFolder();  // what is not in place by now is removed

  // Where the run writes; exists.
  const std::filesystem::path& aside() const { return aside_; }
  // From now on a signal keeps the folder aside, and prints where it is: it holds a sweep's finished values.
  void keep_if_killed();
  // Moves every file into place. Files that the previous run wrote, by the list in its summary.json, and this
  // one did not, are removed, so that results of two runs never mix; all other files stay. Throws InputError if
  // something cannot be replaced, and says where the results are. A folder in the way of a file is found before
  // the first file is moved, so nothing has changed then; if the move of one file fails later, that one and
  // those after it stay aside.
  void put_in_place();

 private:
  class Watch;  // for signals

  void remove_aside();

  std::filesystem::path folder_, aside_;
  std::vector<std::filesystem::path> made_;  // folders that did not exist before, the outermost first
  std::unique_ptr<Watch> watch_;
};

}  // namespace fc
