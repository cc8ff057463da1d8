#include "runtime/run/fault_summary.h"

namespace jarol {
namespace {

bool is_digit(char c) { return c >= '0' && c <= '9'; }

// The end of a number, with its fraction and its unit of time.
std::size_t end_of_number(std::string_view text, std::size_t at) {
  while (at < text.size() && (is_digit(text[at]) || text[at] == '.')) ++at;
  while (at < text.size() && text[at] >= 'a' && text[at] <= 'z') ++at;
  return at;
}

}  // namespace

bool same_but_for_numbers(std::string_view a, std::string_view b) {
  if (a == b) return true;
  std::size_t i = 0, j = 0;
  while (i < a.size() && j < b.size()) {
    if (is_digit(a[i]) && is_digit(b[j])) {
      i = end_of_number(a, i);
      j = end_of_number(b, j);
    } else if (a[i++] != b[j++]) {
      return false;
    }
  }
  return i == a.size() && j == b.size();
}

void FaultSummary::add(const FaultWords& fault) {
  for (FaultGroup& group : groups_) {
    if (group.first.task != fault.task || !same_but_for_numbers(group.first.cause, fault.cause)) continue;
    ++group.count;
    group.last_activation = fault.activation;
    group.last_instant = fault.instant;
    return;
  }
  if (groups_.size() == max_groups) {
    ++others_;
    return;
  }
  groups_.push_back({fault.kept(), fault.activation, fault.instant, 1});
}

}  // namespace jarol
