#include "common/yaml_tree.hpp"

#include <yaml-cpp/eventhandler.h>
#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <optional>
#include <sstream>
#include <unordered_map>
#include <unordered_set>

#include "common/text.hpp"
#include "common/yaml_syntax.hpp"

namespace fc {
namespace {

// Builds the tree from the parser's events.
class TreeBuilder : public YAML::EventHandler {
 public:
  TreeBuilder(YamlOrigin origin, bool has_lines) : origin_(std::move(origin)), has_lines_(has_lines) {}

  YamlPtr root() const { return root_; }

  void OnDocumentStart(const YAML::Mark&) override {}
  void OnDocumentEnd() override {}

  void OnNull(const YAML::Mark& mark, YAML::anchor_t anchor) override {
    if (wants_key()) refuse(at(mark), "a key is missing or null here; write the key as plain text");
    auto node = std::make_shared<YamlNode>();
    // The parser marks a missing value at whatever follows it, perhaps lines below; people look at its key.
    node->place = open_.empty() || !open_.back().key ? at(mark) : open_.back().key->key_place;
    finish(node, anchor);
  }

  void OnScalar(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                const std::string& value) override {
    refuse_tag(mark, tag);
    if (wants_key()) {
      begin_entry(mark, value);
      return;
    }
    auto node = start_node(mark, YamlNode::Kind::text);
    node->text = value;
    node->is_quoted = tag == "!";
    finish(node, anchor);
  }

  void OnAlias(const YAML::Mark& mark, YAML::anchor_t anchor) override {
    if (wants_key()) refuse(at(mark), "an alias cannot be a key; write the key as plain text");
    const auto it = anchored_.find(anchor);
    if (it == anchored_.end())
      refuse(at(mark), "the alias stands inside its own anchor; write the value out");
    attach(it->second, at(mark));
  }

  void OnSequenceStart(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                       YAML::EmitterStyle::value) override {
    open(mark, tag, anchor, YamlNode::Kind::list);
  }
  void OnSequenceEnd() override { close(); }
  void OnMapStart(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                  YAML::EmitterStyle::value) override {
    open(mark, tag, anchor, YamlNode::Kind::map);
  }
  void OnMapEnd() override { close(); }

 private:
  // A list or map whose end has not been seen.
  struct Open {
    std::shared_ptr<YamlNode> node;
    YAML::anchor_t anchor;
    std::optional<YamlNode::Entry> key;          // of a map: the key that waits for its value
    std::unordered_map<std::string, int> lines;  // of a map: each key's line
  };

  YamlPlace at(const YAML::Mark& mark) const {
    if (!has_lines_) return {origin_, 0, 0};
    return {origin_, mark.line + 1, mark.column + 1};
  }
  bool wants_key() const {
    return !open_.empty() && open_.back().node->kind == YamlNode::Kind::map && !open_.back().key;
  }
  void refuse_tag(const YAML::Mark& mark, const std::string& tag) const {
    if (tag.empty() || tag == "?" || tag == "!") return;
    refuse(at(mark), "the tag " + in_quotes(tag) + " has no meaning in a scene; remove it");
  }
  std::shared_ptr<YamlNode> start_node(const YAML::Mark& mark, YamlNode::Kind kind) const {
    auto node = std::make_shared<YamlNode>();
    node->kind = kind;
    node->place = at(mark);
    return node;
  }
  void begin_entry(const YAML::Mark& mark, const std::string& key) {
    Open& map = open_.back();
    const auto [first, is_new] = map.lines.emplace(key, mark.line + 1);
    if (!is_new) {
      const std::string where = has_lines_ ? ", first at line " + std::to_string(first->second) : "";
      refuse(at(mark), "the key " + in_quotes(key) + " is given twice" + where + "; keep one of them");
    }
    map.key = YamlNode::Entry{key, at(mark), nullptr};
  }
  void open(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor, YamlNode::Kind kind) {
    refuse_tag(mark, tag);
    if (wants_key()) refuse(at(mark), "a list or map cannot be a key; write the key as plain text");
    open_.push_back({start_node(mark, kind), anchor, {}, {}});
  }
  void close() {
    const Open done = std::move(open_.back());
    open_.pop_back();
    finish(done.node, done.anchor);
  }
  void finish(const YamlPtr& node, YAML::anchor_t anchor) {
    if (anchor != YAML::NullAnchor) anchored_[anchor] = node;
    attach(node, node->place);
  }
  void attach(const YamlPtr& node, const YamlPlace& place) {
    if (open_.empty()) {
      root_ = node;
      return;
    }
    Open& parent = open_.back();
    parent.node->height = std::max(parent.node->height, node->height + 1);
    if (parent.node->height > deepest_yaml) {  // a chain of aliases; the syntax check covers the rest
      refuse(place, "aliases nest more than " + std::to_string(deepest_yaml) + " deep; write the values out");
    }
    if (parent.node->kind == YamlNode::Kind::list) {
      parent.node->items.push_back(node);
    } else {
      parent.key->value = node;
      parent.node->entries.push_back(std::move(*parent.key));
      parent.key.reset();
    }
  }

  YamlOrigin origin_;
  bool has_lines_;
  YamlPtr root_;
  std::vector<Open> open_;
  std::unordered_map<YAML::anchor_t, YamlPtr> anchored_;
};

}  // namespace

const YamlNode::Entry* YamlNode::find(std::string_view key) const {
  for (const Entry& entry : entries) {
    if (entry.key == key) return &entry;
  }
  return nullptr;
}

void refuse(const YamlPlace& place, const std::string& message) {
  throw InputError(one_line(InputError(place.mark(), message).what()));
}

YamlPtr parse_yaml(const std::string& text, const YamlOrigin& origin, bool is_option_value) {
  check_yaml_syntax(text, origin, is_option_value);
  TreeBuilder builder(origin, !is_option_value);
  std::istringstream stream(with_end_comment(text));
  YAML::Parser parser(stream);
  while (parser.HandleNextDocument(builder)) {
  }
  if (builder.root()) return builder.root();
  auto nothing = std::make_shared<YamlNode>();
  nothing->place = {origin, is_option_value ? 0 : 1, is_option_value ? 0 : 1};
  return nothing;
}

}  // namespace fc
