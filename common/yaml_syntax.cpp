#include "common/yaml_syntax.hpp"

#include <yaml-cpp/eventhandler.h>
#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <sstream>

namespace fc {
namespace {

// yaml-cpp lets a quote run to the end of the file without an error. This pass adds a comment at the end,
// with a character that no text file of ours has: a value that contains it has a quote that never ended.
constexpr char end_mark = '\x01';

// A mistake that this pass finds and the parser itself accepts.
struct Problem {
  YAML::Mark mark;
  std::string message;
};

class SyntaxCheck : public YAML::EventHandler {
 public:
  // Stopping at the second document also stops yaml-cpp where it would go round for ever: after "...", a
  // stray bracket is to it an empty document, again and again.
  void OnDocumentStart(const YAML::Mark& mark) override {
    if (++documents_ > 1) throw Problem{mark, "a second document begins here; keep one document per file"};
  }
  void OnDocumentEnd() override {}
  void OnNull(const YAML::Mark&, YAML::anchor_t) override {}
  void OnAlias(const YAML::Mark&, YAML::anchor_t) override {}
  void OnScalar(const YAML::Mark& mark, const std::string&, YAML::anchor_t,
                const std::string& value) override {
    if (value.find(end_mark) != std::string::npos)
      throw Problem{mark, "a quote begins here and never ends; close it"};
  }
  void OnSequenceStart(const YAML::Mark& mark, const std::string&, YAML::anchor_t,
                       YAML::EmitterStyle::value) override {
    open(mark);
  }
  void OnSequenceEnd() override { --depth_; }
  void OnMapStart(const YAML::Mark& mark, const std::string&, YAML::anchor_t,
                  YAML::EmitterStyle::value) override {
    open(mark);
  }
  void OnMapEnd() override { --depth_; }

 private:
  void open(const YAML::Mark& mark) {
    if (++depth_ <= deepest_yaml) return;
    throw Problem{mark, "nested more than " + std::to_string(deepest_yaml) +
                            " deep, which no scene needs; check the brackets"};
  }
  int depth_ = 0, documents_ = 0;
};

}  // namespace

std::string with_end_comment(const std::string& text) {
  return text + "\n# " + end_mark + "\n";
}

void check_yaml_syntax(const std::string& text, const YamlOrigin& origin, bool is_option_value) {
  const auto place = [&](const YAML::Mark& mark) -> YamlPlace {
    if (is_option_value || mark.is_null()) return {origin};
    // The parser may notice only in the comment that we added: report the text's own last line.
    const auto last_line =
        static_cast<int>(std::count(text.begin(), text.end(), '\n')) + (text.ends_with('\n') ? 0 : 1);
    return mark.line < last_line ? YamlPlace{origin, mark.line + 1, mark.column + 1}
                                 : YamlPlace{origin, last_line, 1};
  };
  try {
    SyntaxCheck check;
    std::istringstream stream(with_end_comment(text));
    YAML::Parser parser(stream);
    while (parser.HandleNextDocument(check)) {
    }
  } catch (const Problem& problem) {
    refuse(place(problem.mark), problem.message);
  } catch (const YAML::Exception& error) {
    refuse(place(error.mark),
           "not valid YAML: " + error.msg + "; check brackets, colons, quotes and indentation up to here");
  }
}

}  // namespace fc
