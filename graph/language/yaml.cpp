#include "graph/language/yaml.h"

#include <yaml-cpp/eventhandler.h>
#include <yaml-cpp/exceptions.h>
#include <yaml-cpp/mark.h>
#include <yaml-cpp/parser.h>

#include <algorithm>
#include <istream>
#include <map>
#include <unordered_set>

#include "graph/language/read_source.h"
#include "graph/language/text_pieces.h"

namespace jarol {
namespace {

constexpr std::size_t max_values = 6'000'000;
// Many values in little text take a hundred times its memory. Those of a graph take some 5 bytes each where it is
// terse, as in `t61867: {type: Sum, period: 1ms}`, and none of them is empty.
constexpr std::size_t max_short_values = 100'000, max_empty_values = 100'000;
constexpr std::size_t min_bytes_each = 4;  // beyond that many
constexpr std::size_t max_aliased = 100'000;
constexpr std::size_t max_depth = 64;

// Builds the tree from yaml-cpp's events, which still know anchors, quotes and every key.
class Builder : public YAML::EventHandler {
 public:
  Builder(std::shared_ptr<const Source> source, TextPieces& pieces, Problems& problems)
      : source_(std::move(source)), pieces_(pieces), problems_(problems) {}

  Yaml take() { return std::move(root_); }

  void report_too_far_ahead() {
    problems_.add(last_, "what follows here is too long for one line, text, comment or nest of brackets: more than " +
                             std::to_string(max_bytes_ahead >> 20) + " MiB or " + std::to_string(max_marks_ahead) +
                             " marks; write it without outer brackets, on several lines");
  }

  void OnDocumentStart(const YAML::Mark& mark) override { at(mark); }
  void OnDocumentEnd() override {}

  void OnNull(const YAML::Mark& mark, YAML::anchor_t anchor) override {
    Yaml value;
    value.where = at(mark);
    finish(std::move(value), anchor);
  }

  void OnAlias(const YAML::Mark& mark, YAML::anchor_t anchor) override {
    const auto found = anchored_.find(anchor);
    if (found != anchored_.end()) {
      // aliases of aliases multiply
      aliased_ += count(found->second);
      if (aliased_ > max_aliased)
        too_much(mark, "aliases stand for more than " + std::to_string(max_aliased) + " values");
      return finish(Yaml(found->second), 0);
    }
    problems_.add(at(mark), "an alias stands inside the very value it refers to; a value can't contain itself");
    Yaml value;
    value.where = at(mark);
    finish(std::move(value), 0);
  }

  void OnScalar(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                const std::string& text) override {
    Yaml value;
    value.where = at(mark);
    value.quoted = tag == "!";
    value.text = text;
    value.kind = Yaml::Kind::scalar;
    refuse_tag(tag, mark);
    finish(std::move(value), anchor);
  }

  void OnSequenceStart(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                       YAML::EmitterStyle::value) override {
    refuse_tag(tag, mark);
    open(Yaml::Kind::sequence, mark, anchor);
  }
  void OnSequenceEnd() override { close(); }

  void OnMapStart(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                  YAML::EmitterStyle::value) override {
    refuse_tag(tag, mark);
    open(Yaml::Kind::mapping, mark, anchor);
  }
  void OnMapEnd() override { close(); }

 private:
  struct Open {
    Yaml value;
    YAML::anchor_t anchor = 0;
    bool has_key = false;
    Yaml key;
    std::unordered_set<std::string> keys;  // asked, never iterated
  };

  // of each event
  Location at(const YAML::Mark& mark) {
    pieces_.understood();
    if (!mark.is_null()) last_ = {source_, mark.line + 1, mark.column + 1};
    return last_;
  }

  void refuse_tag(const std::string& tag, const YAML::Mark& mark) {
    if (tag.empty() || tag == "?" || tag == "!") return;
    problems_.add(at(mark), "tag '" + tag + "' is not supported; leave it out");
  }

  void open(Yaml::Kind kind, const YAML::Mark& mark, YAML::anchor_t anchor) {
    if (open_.size() >= max_depth) {
      problems_.add(at(mark), "values are nested deeper than " + std::to_string(max_depth) + " levels");
      throw TooMuch();
    }
    Open value;
    value.value.kind = kind;
    value.value.where = at(mark);
    value.anchor = anchor;
    open_.push_back(std::move(value));
  }

  void close() {
    Open done = std::move(open_.back());
    open_.pop_back();
    finish(std::move(done.value), done.anchor);
  }

  static std::size_t count(const Yaml& value) {
    std::size_t sum = 1;
    for (const Yaml& child : value.children) sum += count(child);
    return sum;
  }

  [[noreturn]] void too_much(const YAML::Mark& mark, const std::string& text) {
    problems_.add(at(mark), text);
    throw TooMuch();
  }

  void finish(Yaml&& value, YAML::anchor_t anchor) {
    if (++values_ > max_values)
      too_much(YAML::Mark::null_mark(), "the text holds more than " + std::to_string(max_values) + " values");
    if (value.children.empty() && value.text.empty() && ++empty_values_ > max_empty_values)
      too_much(YAML::Mark::null_mark(), "more than " + std::to_string(max_empty_values) + " values are empty");
    if (values_ > max_short_values + pieces_.read() / min_bytes_each)
      too_much(YAML::Mark::null_mark(), "more than " + std::to_string(max_short_values) +
                                            " values stand so close that " + "each takes less than " +
                                            std::to_string(min_bytes_each) + " bytes");
    if (anchor != 0) keep(anchor, value);
    if (open_.empty()) {
      root_ = std::move(value);
      return;
    }
    Open& parent = open_.back();
    if (parent.value.kind == Yaml::Kind::sequence) {
      parent.value.children.push_back(std::move(value));
    } else if (!parent.has_key) {
      parent.has_key = true;
      parent.key = std::move(value);
    } else {
      parent.has_key = false;
      add_entry(parent, std::move(value));
    }
  }

  // anchors inside anchored values multiply
  void keep(YAML::anchor_t anchor, const Yaml& value) {
    anchored_values_ += count(value);
    if (anchored_values_ > max_aliased) {
      problems_.add(value.where, "anchors name more than " + std::to_string(max_aliased) + " values");
      throw TooMuch();
    }
    anchored_.emplace(anchor, value);
  }

  void add_entry(Open& mapping, Yaml&& value) {
    Yaml& key = mapping.key;
    if (key.kind != Yaml::Kind::scalar) {
      problems_.add(key.where, "a key is " + std::string(kind_name(key)) + "; keys are plain words");
      return;
    }
    if (key.text == "<<" && !key.quoted) {
      problems_.add(key.where, "merge key '<<' is not supported; write the keys out, or use a profile");
      return;
    }
    if (!mapping.keys.insert(key.text).second) {
      const Yaml* first = mapping.value.find(key.text);
      problems_.add(key.where, "key '" + key.text + "' appears twice in one mapping; keep one",
                    {{first->key_where, "first here"}});
      return;
    }
    value.key = std::move(key.text);
    value.key_where = std::move(key.where);
    mapping.value.children.push_back(std::move(value));
  }

  std::shared_ptr<const Source> source_;
  TextPieces& pieces_;
  Problems& problems_;
  Location last_{source_, 1, 1};
  Yaml root_;
  std::vector<Open> open_;
  std::map<YAML::anchor_t, Yaml> anchored_;
  std::size_t values_ = 0, empty_values_ = 0;
  std::size_t aliased_ = 0;          // values that aliases stand for
  std::size_t anchored_values_ = 0;  // values that anchors keep
};

// yaml-cpp takes a tab in front of a line for anything but what it is.
void refuse_syntax(const Location& where, const std::string& reason, Problems& problems) {
  const std::string_view line = line_of(*where.source, where.line);
  const std::size_t tab = line.substr(0, line.find_first_not_of(" \t")).find('\t');
  if (tab == std::string_view::npos) return problems.add(where, "not valid YAML: " + reason);
  const int column = static_cast<int>(tab) + 1;
  std::vector<Note> notes;
  if (column != where.column) notes.push_back({where, "where it can't be read on: " + reason});
  problems.add({where.source, where.line, column}, "not valid YAML: a tab can't indent a line; indent with blanks",
               std::move(notes));
}

}  // namespace

const Yaml* Yaml::find(std::string_view name) const {
  for (const Yaml& child : children)
    if (child.key == name) return &child;
  return nullptr;
}

std::string_view kind_name(const Yaml& yaml) {
  switch (yaml.kind) {
    case Yaml::Kind::null: return "nothing";
    case Yaml::Kind::scalar: return "a scalar";
    case Yaml::Kind::sequence: return "a list";
    case Yaml::Kind::mapping: return "a mapping";
  }
  return "";
}

Yaml read_yaml(const std::shared_ptr<const Source>& source, Problems& problems) {
  if (source->text.size() > max_source_bytes) {
    problems.add({source, 1, 1}, "the text is larger than " + std::to_string(max_source_bytes >> 20) + " MiB");
    return {};
  }
  TextPieces pieces(source->text);
  Builder builder(source, pieces, problems);
  std::istream stream(&pieces);
  try {
    YAML::Parser parser(stream);
    if (!parser.HandleNextDocument(builder)) {
      Yaml empty;
      empty.where = {source, 1, 1};
      return empty;
    }
    Yaml root = builder.take();
    Builder second(source, pieces, problems);
    if (parser.HandleNextDocument(second)) {
      problems.add(second.take().where, "a second document begins here; a file holds one");
    }
    return root;
  } catch (const YAML::Exception& error) {
    const bool known = !error.mark.is_null();
    refuse_syntax({source, known ? error.mark.line + 1 : 1, known ? error.mark.column + 1 : 1}, error.msg, problems);
  } catch (const TooMuch& much) {
    if (much.ahead) builder.report_too_far_ahead();  // else it was reported where it was found
  }
  return {};
}

}  // namespace jarol
