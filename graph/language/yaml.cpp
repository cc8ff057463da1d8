#include "graph/language/yaml.h"

#include <yaml.h>

#include <algorithm>
#include <array>
#include <map>
#include <unordered_set>
#include <utility>

#include "graph/language/read_source.h"
#include "graph/language/yaml_events.h"

namespace jarol {
namespace {

constexpr std::size_t max_values = 6'000'000;
// Many values in little text take a hundred times its memory. Those of a graph take some 5 bytes each where it is
// terse, as in `t61867: {type: Sum, period: 1ms}`, and none of them is empty.
constexpr std::size_t max_short_values = 100'000, max_empty_values = 100'000;
constexpr std::size_t min_bytes_each = 4;  // beyond that many
constexpr std::size_t max_aliased = 100'000;
constexpr std::size_t max_depth = 64;

std::string_view text_of(const yaml_char_t* text) {
  return text == nullptr ? std::string_view() : std::string_view(reinterpret_cast<const char*>(text));
}

// The keys of a mapping; of few, all are looked at.
class Keys {
 public:
  // False: it is there already.
  bool add(const std::string& key, const std::vector<Yaml>& before) {
    constexpr std::size_t few = 16;
    if (before.size() < few)
      return std::none_of(before.begin(), before.end(), [&](const Yaml& other) { return other.key == key; });
    if (before.size() == few && many_.empty())
      for (const Yaml& other : before) many_.insert(other.key);
    return many_.insert(key).second;
  }

 private:
  std::unordered_set<std::string> many_;  // asked, never iterated
};

// Builds the tree from events, which still know anchors, quotes and every key.
class TreeBuilder {
 public:
  TreeBuilder(YamlEvents& events, Problems& problems) : events_(events), problems_(problems) {}

  // From after the begin of a document to its end.
  Yaml read() {
    for (;;) {
      const yaml_event_t& event = events_.next();
      switch (event.type) {
        case YAML_ALIAS_EVENT: take_alias(std::string(text_of(event.data.alias.anchor))); break;
        case YAML_SCALAR_EVENT: take_scalar(event.data.scalar); break;
        case YAML_SEQUENCE_START_EVENT:
          open(Yaml::Kind::sequence, event.data.sequence_start.anchor, event.data.sequence_start.tag);
          break;
        case YAML_MAPPING_START_EVENT:
          open(Yaml::Kind::mapping, event.data.mapping_start.anchor, event.data.mapping_start.tag);
          break;
        case YAML_SEQUENCE_END_EVENT:
        case YAML_MAPPING_END_EVENT: close(); break;
        case YAML_DOCUMENT_END_EVENT: return std::move(root_);
        case YAML_NO_EVENT:
        case YAML_STREAM_START_EVENT:
        case YAML_STREAM_END_EVENT:
        case YAML_DOCUMENT_START_EVENT: break;
      }
    }
  }

 private:
  struct Open {
    Yaml value;
    std::string anchor;
    bool has_key = false;
    Yaml key;
    Keys keys;
  };

  void take_alias(const std::string& name) {
    Yaml value;
    value.where = here();
    const auto found = anchored_.find(name);
    if (found != anchored_.end()) {
      // aliases of aliases multiply
      aliased_ += count(found->second);
      if (aliased_ > max_aliased) too_much("aliases stand for more than " + std::to_string(max_aliased) + " values");
      return finish(Yaml(found->second), "");
    }
    if (std::none_of(open_.begin(), open_.end(), [&](const Open& outer) { return outer.anchor == name; }))
      events_.refuse(value.where, "alias '*" + name + "' has no anchor before it; write '&" + name +
                                      "' before what it is to stand for");
    problems_.add(value.where, "an alias stands inside the very value it refers to; a value can't contain itself");
    finish(std::move(value), "");
  }

  void take_scalar(const decltype(yaml_event_t::data.scalar)& scalar) {
    static constexpr std::array<std::string_view, 5> nothing{"", "~", "null", "Null", "NULL"};
    const std::string_view text(reinterpret_cast<const char*>(scalar.value), scalar.length);
    Yaml value;
    value.where = here();
    value.quoted = scalar.style != YAML_PLAIN_SCALAR_STYLE;
    refuse_tag(scalar.tag, value.where);
    if (value.quoted || scalar.tag != nullptr || std::find(nothing.begin(), nothing.end(), text) == nothing.end()) {
      value.kind = Yaml::Kind::scalar;
      value.text = text;
    }
    finish(std::move(value), text_of(scalar.anchor));
  }

  // of the event at hand
  const Location& here() { return last_ = events_.where(); }

  void refuse_tag(const yaml_char_t* tag, const Location& where) {
    if (tag != nullptr) problems_.add(where, "tag '" + std::string(text_of(tag)) + "' is not supported; leave it out");
  }

  void open(Yaml::Kind kind, const yaml_char_t* anchor, const yaml_char_t* tag) {
    Open value;
    value.value.kind = kind;
    value.value.where = here();
    refuse_tag(tag, last_);
    if (open_.size() >= max_depth) too_much("values are nested deeper than " + std::to_string(max_depth) + " levels");
    value.anchor = text_of(anchor);
    // the name is another's from now on
    if (!value.anchor.empty()) anchored_.erase(value.anchor);
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

  [[noreturn]] void too_much(const std::string& text) { events_.refuse(last_, text); }

  void finish(Yaml&& value, std::string_view anchor) {
    if (++values_ > max_values) too_much("the text holds more than " + std::to_string(max_values) + " values");
    if (value.children.empty() && value.text.empty() && ++empty_values_ > max_empty_values)
      too_much("more than " + std::to_string(max_empty_values) + " values are empty");
    if (values_ > max_short_values + events_.bytes() / min_bytes_each)
      too_much("more than " + std::to_string(max_short_values) + " values stand so close that each takes less than " +
               std::to_string(min_bytes_each) + " bytes");
    if (!anchor.empty()) keep(std::string(anchor), value);
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
  void keep(const std::string& anchor, const Yaml& value) {
    anchored_values_ += count(value);
    if (anchored_values_ > max_aliased)
      events_.refuse(value.where, "anchors name more than " + std::to_string(max_aliased) + " values");
    anchored_.insert_or_assign(anchor, value);
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
    if (!mapping.keys.add(key.text, mapping.value.children)) {
      const Yaml* first = mapping.value.find(key.text);
      problems_.add(key.where, "key '" + key.text + "' appears twice in one mapping; keep one",
                    {{first->key_where, "first here"}});
      return;
    }
    value.key = std::move(key.text);
    value.key_where = std::move(key.where);
    mapping.value.children.push_back(std::move(value));
  }

  YamlEvents& events_;
  Problems& problems_;
  Location last_;
  Yaml root_;
  std::vector<Open> open_;
  std::map<std::string, Yaml, std::less<>> anchored_;
  std::size_t values_ = 0, empty_values_ = 0;
  std::size_t aliased_ = 0;          // values that aliases stand for
  std::size_t anchored_values_ = 0;  // values that anchors keep
};

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
  Yaml root;
  root.where = {source, 1, 1};
  if (source->text.size() > max_source_bytes) {
    problems.add(root.where, "the text is larger than " + std::to_string(max_source_bytes >> 20) + " MiB");
    return root;
  }
  try {
    YamlEvents events(source, problems);
    events.next();  // the begin of the stream
    if (events.next().type != YAML_DOCUMENT_START_EVENT) return root;
    root = TreeBuilder(events, problems).read();
    if (events.next().type == YAML_DOCUMENT_START_EVENT) {
      events.next();
      problems.add(events.where(), "a second document begins here; a file holds one");
    }
  } catch (const NotYaml&) {
    // it is a problem by now
  }
  return root;
}

}  // namespace jarol
