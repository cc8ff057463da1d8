// The events of a YAML text, as libyaml reads it, each with its place.
#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <string_view>

#include "graph/language/problems.h"

struct yaml_event_s;  // libyaml's, as yaml.h has them
struct yaml_mark_s;

namespace jarol {

/// Where characters of a text stand. Columns count bytes, as those of any Location do.
class Places {
 public:
  /// Characters are counted after so many bytes.
  explicit Places(std::string_view text, std::size_t begin = 0) : text_(text), begin_(begin), byte_(begin) {}

  struct Place {
    int line = 1, column = 1;
  };
  /// Counted from 0. Quick where they are asked for in their order.
  Place of_character(std::size_t index);
  /// Counted from 0, by going through all before it.
  Place of_byte(std::size_t byte) const;

 private:
  std::string_view text_;
  std::size_t begin_, byte_, character_ = 0, line_begin_ = 0;
  int line_ = 1;
};

/// A text that can't be read on; what is wrong is a Problem by then.
struct NotYaml {};

class YamlEvents {
 public:
  /// Throws NotYaml.
  YamlEvents(std::shared_ptr<const Source> source, Problems& problems);
  ~YamlEvents();
  YamlEvents(const YamlEvents&) = delete;
  YamlEvents& operator=(const YamlEvents&) = delete;

  /// The next one, until another is asked for. Throws NotYaml, after which there is no other.
  const yaml_event_s& next();

  /// Ends the reading for what is wrong there.
  [[noreturn]] void refuse(const Location& where, const std::string& text, std::vector<Note> notes = {});

  /// Of the event at hand.
  Location where();
  /// Bytes that were read so far, or somewhat fewer.
  std::size_t bytes() const { return bytes_; }

 private:
  struct State;  // of libyaml
  [[noreturn]] void refuse();
  [[noreturn]] void refuse_unreadable();
  void refuse_what_hides();
  Location at(Places::Place place) const { return {source_, place.line, place.column}; }
  Location at(const yaml_mark_s& mark);

  std::shared_ptr<const Source> source_;
  Problems& problems_;
  std::size_t begin_;  // after the mark of the order of bytes
  Places places_;
  std::unique_ptr<State> state_;
  std::size_t bytes_ = 0;
};

}  // namespace jarol
