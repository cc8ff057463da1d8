// Collects everything that is wrong with an input, so that one report shows it all.
#pragma once

#include <stdexcept>
#include <string>
#include <vector>

#include "graph/language/source.h"

namespace jarol {

struct Note {
  Location where;
  std::string text;
};

struct Problem {
  Location where;
  std::string text;  // "<subject> <what is wrong>; <what would be right>"
  std::vector<Note> notes;
};

/// An input that can't be used: the message is the whole report.
class SpecError : public std::runtime_error {
 public:
  explicit SpecError(std::vector<Problem> problems);
  const std::vector<Problem>& problems() const { return problems_; }

 private:
  std::vector<Problem> problems_;
};

class Problems {
 public:
  /// Throws SpecError with all so far where there are too many for anyone to read.
  void add(Location where, std::string text, std::vector<Note> notes = {});
  bool empty() const { return problems_.empty(); }
  std::size_t size() const { return problems_.size(); }
  const std::vector<Problem>& list() const { return problems_; }

  /// Throws SpecError with all problems, in the order of their places, unless there are none.
  void throw_if_any() const;

 private:
  std::vector<Problem> problems_;
};

/// `file:line:column: error: text`, then the line and a caret; notes likewise.
std::string to_text(const Problem& problem);

/// "; did you mean 'period'?" if one of the candidates is close to the word, else nothing.
std::string did_you_mean(std::string_view word, const std::vector<std::string>& candidates);

/// "a, b, c" or "nothing" of an empty list.
std::string list_of(const std::vector<std::string>& words);

}  // namespace jarol
