#include "graph/language/yaml_events.h"

#include <fmt/format.h>
#include <yaml.h>

#include <algorithm>
#include <new>
#include <utility>

namespace jarol {
namespace {

constexpr std::string_view byte_order_mark = "\xef\xbb\xbf";

}  // namespace

Places::Place Places::of_character(std::size_t index) {
  if (index < character_) *this = Places(text_, begin_);
  const auto continues = [&] {
    return byte_ < text_.size() && (static_cast<unsigned char>(text_[byte_]) & 0xc0) == 0x80;
  };
  for (; byte_ < text_.size() && character_ < index; ++character_) {
    if (text_[byte_++] == '\n') {
      ++line_;
      line_begin_ = byte_;
    }
    while (continues()) ++byte_;
  }
  return {line_, static_cast<int>(byte_ - line_begin_) + 1};
}

Places::Place Places::of_byte(std::size_t byte) const {
  const std::string_view before = text_.substr(0, byte);
  return {1 + static_cast<int>(std::count(before.begin(), before.end(), '\n')),
          static_cast<int>(before.size() - (before.rfind('\n') + 1)) + 1};
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
    : source_(std::move(source)),
      problems_(problems),
      begin_(source_->text.starts_with(byte_order_mark) ? byte_order_mark.size() : 0),
      places_(source_->text, begin_),
      state_(std::make_unique<State>()) {
  yaml_parser_set_encoding(&state_->parser, YAML_UTF8_ENCODING);
  const std::string& text = source_->text;
  yaml_parser_set_input_string(&state_->parser, reinterpret_cast<const unsigned char*>(text.data()) + begin_,
                               text.size() - begin_);
  refuse_what_hides();
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

void YamlEvents::refuse(const Location& where, const std::string& text, std::vector<Note> notes) {
  problems_.add(where, text, std::move(notes));
  throw NotYaml();
}

// What would be something else to YAML 1.1 than it is to an editor, or takes time that grows with its square.
void YamlEvents::refuse_what_hides() {
  const std::string_view text = source_->text;
  for (const auto& [character, name] :
       {std::pair{"\xc2\x85", "U+0085"}, {"\xe2\x80\xa8", "U+2028"}, {"\xe2\x80\xa9", "U+2029"}})
    if (const std::size_t found = text.find(character); found != std::string_view::npos)
      refuse(at(places_.of_byte(found)),
             std::string("not valid YAML: it ends a line here, by ") + name + ", where no editor does; leave it out");
  for (std::size_t found = text.find('\r'); found != std::string_view::npos; found = text.find('\r', found + 1))
    if (found + 1 == text.size() || text[found + 1] != '\n')
      refuse(at(places_.of_byte(found)), "not valid YAML: a line ends with CR alone; end lines with LF, or CR LF");
  for (std::size_t found = text.find("%TAG"); found != std::string_view::npos; found = text.find("%TAG", found + 1))
    if (found == begin_ || text[found - 1] == '\n')
      refuse(at(places_.of_byte(found)), "tags are not supported; leave the line out");
}

// Bytes that are no text.
void YamlEvents::refuse_unreadable() {
  const yaml_parser_t& parser = state_->parser;
  const std::string_view text = source_->text;
  std::size_t byte = begin_ + parser.problem_offset;
  const auto byte_at = [&](std::size_t i) { return i < text.size() ? static_cast<unsigned char>(text[i]) : 0U; };
  if (std::string_view(parser.problem).find("UTF-8") == std::string_view::npos)
    refuse(at(places_.of_byte(byte)), "not valid YAML: " + std::string(parser.problem) + ": 0x" +
                                          fmt::format("{:02x}", std::max(parser.problem_value, 0)));
  // what should have followed another byte is found behind it
  if (std::string_view(parser.problem).find("trailing") != std::string_view::npos) {
    do --byte;
    while ((byte_at(byte) & 0xc0) == 0x80);
  }
  refuse(at(places_.of_byte(byte)), "not valid YAML: no UTF-8 from here on: 0x" + fmt::format("{:02x}", byte_at(byte)));
}

void YamlEvents::refuse() {
  const yaml_parser_t& parser = state_->parser;
  if (parser.error == YAML_MEMORY_ERROR) throw std::bad_alloc();
  if (parser.error == YAML_READER_ERROR) refuse_unreadable();
  const Location where = at(parser.problem_mark);
  const std::string_view before = line_of(*source_, where.line).substr(0, static_cast<std::size_t>(where.column));
  if (before.ends_with('\t'))
    refuse(where, before.find_first_not_of(" \t") == std::string_view::npos
                      ? "not valid YAML: a tab can't indent a line; indent with blanks"
                      : "not valid YAML: a tab can't stand here; write blanks");
  std::vector<Note> notes;
  if (parser.context != nullptr && parser.context_mark.index != parser.problem_mark.index)
    notes.push_back({at(parser.context_mark), std::string(parser.context) + ", from here on"});
  refuse(where, std::string("not valid YAML: ") + parser.problem, std::move(notes));
}

}  // namespace jarol
