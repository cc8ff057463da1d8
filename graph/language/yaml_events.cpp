#include "graph/language/yaml_events.h"

#include <fmt/format.h>
#include <yaml.h>

#include <new>
#include <utility>

namespace jarol {

template <class Before>
Places::Place Places::walk(const Before& is_before) {
  const auto continues = [&] {
    return byte_ < text_.size() && (static_cast<unsigned char>(text_[byte_]) & 0xc0) == 0x80;
  };
  while (byte_ < text_.size() && is_before()) {
    if (text_[byte_++] == '\n') {
      ++line_;
      line_begin_ = byte_;
    }
    while (continues()) ++byte_;
    ++character_;
  }
  return {line_, static_cast<int>(byte_ - line_begin_) + 1};
}

Places::Place Places::of_character(std::size_t index) {
  if (index < character_) *this = Places(text_);
  return walk([&] { return character_ < index; });
}

Places::Place Places::of_byte(std::size_t byte) {
  if (byte < byte_) *this = Places(text_);
  return walk([&] { return byte_ < byte; });
}

struct YamlEvents::State {
  State() {
    if (yaml_parser_initialize(&parser) == 0) throw std::bad_alloc();
  }
  ~State() {
    yaml_event_delete(&event);
    yaml_parser_delete(&parser);
  }
  State(const State&) = delete;
  State& operator=(const State&) = delete;

  yaml_parser_t parser{};
  yaml_event_t event{};
};

YamlEvents::YamlEvents(std::shared_ptr<const Source> source, Problems& problems)
    : source_(std::move(source)), problems_(problems), places_(source_->text), state_(std::make_unique<State>()) {
  yaml_parser_set_encoding(&state_->parser, YAML_UTF8_ENCODING);
  const std::string& text = source_->text;
  yaml_parser_set_input_string(&state_->parser, reinterpret_cast<const unsigned char*>(text.data()), text.size());
}

YamlEvents::~YamlEvents() = default;

const yaml_event_t& YamlEvents::next() {
  yaml_event_delete(&state_->event);
  if (yaml_parser_parse(&state_->parser, &state_->event) == 0) refuse();
  bytes_ = state_->parser.offset;
  return state_->event;
}

Location YamlEvents::at(const yaml_mark_t& mark) { return at(places_.of_character(mark.index)); }

Location YamlEvents::where() { return at(state_->event.start_mark); }

void YamlEvents::refuse() {
  const yaml_parser_t& parser = state_->parser;
  const char* const what = parser.problem == nullptr ? "" : parser.problem;
  std::vector<Note> notes;
  Location where;
  std::string reason;
  switch (parser.error) {
    case YAML_MEMORY_ERROR: throw std::bad_alloc();
    case YAML_READER_ERROR:
      where = at(places_.of_byte(parser.problem_offset));
      reason = what;
      if (parser.problem_value >= 0) reason += ": 0x" + fmt::format("{:02x}", parser.problem_value);
      break;
    default:
      where = at(parser.problem_mark);
      reason = what;
      if (parser.context != nullptr && parser.context_mark.index != parser.problem_mark.index)
        notes.push_back({at(parser.context_mark), std::string(parser.context) + ", from here on"});
  }
  const std::string_view before = line_of(*source_, where.line).substr(0, static_cast<std::size_t>(where.column));
  const bool is_tab = before.ends_with('\t') && before.find_first_not_of(" \t") == std::string_view::npos;
  if (is_tab)
    problems_.add(where, "not valid YAML: a tab can't indent a line; indent with blanks");
  else
    problems_.add(where, "not valid YAML: " + reason, std::move(notes));
  throw NotYaml();
}

}  // namespace jarol
