#include "graph/language/problems.h"

#include <algorithm>
#include <tuple>

#include "graph/text/escape.h"

namespace jarol {
namespace {

// Line 0 is the source as a whole, which could not be read.
std::string place(const Location& where) {
  if (!where.source || where.line == 0) return "";
  return printable(where.source->name) + ":" + std::to_string(where.line) + ":" + std::to_string(where.column) + ": ";
}

constexpr std::size_t max_shown = 160;  // characters of a line
constexpr std::size_t max_problems = 200;
constexpr std::size_t max_words = 100;  // of a list

// The line and a caret below the column. Tabs stay tabs, so that the caret stands where it should; what is not
// printable is shown as a dot, and of a long line only what surrounds the place.
std::string excerpt(const Location& where) {
  if (!where.source || where.line == 0) return "";
  const std::string_view line = line_of(*where.source, where.line);
  const std::size_t at = std::min(static_cast<std::size_t>(std::max(where.column, 1) - 1), line.size());
  const auto continues = [&](std::size_t i) { return (static_cast<unsigned char>(line[i]) & 0xc0) == 0x80; };
  std::size_t begin = at > max_shown - 40 ? at - (max_shown - 40) : 0;
  std::size_t end = std::min(begin + max_shown, line.size());
  while (begin > 0 && continues(begin)) --begin;
  while (end < line.size() && continues(end)) ++end;
  std::string shown(begin > 0 ? "..." : ""), caret(shown.size(), ' ');
  for (std::size_t i = begin; i < end;) {
    const Character c = first_character(line.substr(i, end - i));
    const bool tab = line[i] == '\t';
    shown += c.printable || tab ? line.substr(i, c.size) : ".";
    if (i < at) caret += tab ? '\t' : ' ';
    i += c.size;
  }
  if (end < line.size()) shown += "...";
  return "\n  " + shown + "\n  " + caret + "^";
}

// Edit distance with swaps of neighbours (Damerau 1964, optimal string alignment).
std::size_t distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> before(b.size() + 1), last(b.size() + 1), now(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) last[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    now[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      now[j] = std::min({last[j] + 1, now[j - 1] + 1, last[j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1)});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1]) now[j] = std::min(now[j], before[j - 2] + 1);
    }
    std::swap(before, last);
    std::swap(last, now);
  }
  return last[b.size()];
}

std::string report(const std::vector<Problem>& problems) {
  std::string text;
  for (const Problem& problem : problems) {
    if (!text.empty()) text += '\n';
    text += to_text(problem);
  }
  return text;
}

auto order_key(const Problem& p) {
  return std::tuple(p.where.source ? std::string_view(p.where.source->name) : std::string_view(), p.where.line,
                    p.where.column);
}

std::vector<Problem> in_order(std::vector<Problem> problems) {
  std::stable_sort(problems.begin(), problems.end(),
                   [](const Problem& a, const Problem& b) { return order_key(a) < order_key(b); });
  return problems;
}

}  // namespace

std::string_view line_of(const Source& source, int line) {
  std::string_view rest = source.text;
  for (int i = 1; i < line; ++i) {
    const std::size_t end = rest.find('\n');
    if (end == std::string_view::npos) return {};
    rest.remove_prefix(end + 1);
  }
  rest = rest.substr(0, rest.find('\n'));
  if (!rest.empty() && rest.back() == '\r') rest.remove_suffix(1);
  return rest;
}

SpecError::SpecError(std::vector<Problem> problems)
    : std::runtime_error(report(problems)), problems_(std::move(problems)) {}

void Problems::add(Location where, std::string text, std::vector<Note> notes) {
  if (problems_.size() == max_problems) {
    std::vector<Problem> all = in_order(problems_);
    all.push_back({{}, "there are more problems than these " + std::to_string(max_problems) + "; mend them first", {}});
    throw SpecError(std::move(all));
  }
  problems_.push_back({std::move(where), std::move(text), std::move(notes)});
}

void Problems::throw_if_any() const {
  if (!problems_.empty()) throw SpecError(in_order(problems_));
}

std::string to_text(const Problem& problem) {
  std::string text = place(problem.where) + "error: " + printable(problem.text) + excerpt(problem.where);
  for (const Note& note : problem.notes)
    text += "\n" + place(note.where) + "note: " + printable(note.text) + excerpt(note.where);
  return text;
}

std::string did_you_mean(std::string_view word, const std::vector<std::string>& candidates) {
  constexpr std::size_t longest = 200;  // the distance takes time as the square of it
  if (word.size() > longest) return "";
  const std::string* best = nullptr;
  std::size_t min = std::max<std::size_t>(1, word.size() / 3) + 1;
  for (const std::string& candidate : candidates) {
    if (candidate.size() >= word.size() + min || word.size() >= candidate.size() + min) continue;
    const std::size_t d = distance(word, candidate);
    if (d < min && d < word.size()) {
      min = d;
      best = &candidate;
    }
  }
  return best == nullptr ? "" : "; did you mean '" + *best + "'?";
}

std::string list_of(const std::vector<std::string>& words) {
  if (words.empty()) return "nothing";
  std::string text;
  for (std::size_t i = 0; i < std::min(words.size(), max_words); ++i) text += (i == 0 ? "" : ", ") + words[i];
  if (words.size() > max_words) text += " and " + std::to_string(words.size() - max_words) + " more";
  return text;
}

}  // namespace jarol
