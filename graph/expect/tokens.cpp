#include "graph/expect/tokens.h"

#include <algorithm>
#include <array>

namespace jarol::expect {
namespace {

bool is_digit(char c) { return c >= '0' && c <= '9'; }
bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_'; }

std::size_t end_of_word(std::string_view text, std::size_t at) {
  while (at < text.size() && (is_letter(text[at]) || is_digit(text[at]) || text[at] == '.')) ++at;
  return at;
}

std::size_t end_of_unit(std::string_view text, std::size_t at) {
  while (at < text.size() &&
         (is_letter(text[at]) || is_digit(text[at]) || text[at] == '/' || text[at] == '^' || text[at] == '%'))
    ++at;
  return at;
}

// With its exponent, and with its unit unless what follows a space is a word of the language.
std::size_t end_of_number(std::string_view text, std::size_t at) {
  while (at < text.size() && (is_digit(text[at]) || text[at] == '.')) ++at;
  if (at < text.size() && (text[at] == 'e' || text[at] == 'E')) {
    std::size_t digits = at + 1;
    if (digits < text.size() && (text[digits] == '-' || text[digits] == '+')) ++digits;
    if (digits < text.size() && is_digit(text[digits])) at = digits;
    while (at < text.size() && is_digit(text[at])) ++at;
  }
  std::size_t unit = at;
  while (unit < text.size() && text[unit] == ' ') ++unit;
  if (unit == text.size() || !(is_letter(text[unit]) || text[unit] == '%')) return at;
  const std::size_t end = end_of_unit(text, unit);
  return is_keyword(text.substr(unit, end - unit)) ? at : end;
}

}  // namespace

bool is_keyword(std::string_view word) {
  constexpr std::array keywords{"of", "within", "is",     "not",  "after",   "before", "and",
                                "to", "never",  "always", "once", "between", "or"};
  return std::find(keywords.begin(), keywords.end(), word) != keywords.end();
}

std::vector<Token> tokens_of(std::string_view text) {
  std::vector<Token> tokens;
  for (std::size_t at = 0; at < text.size();) {
    const char c = text[at];
    std::size_t end = at + 1;
    Token::Kind kind = Token::Kind::sign;
    if (c == ' ' || c == '\t' || c == '\n' || c == '\r') {
      ++at;
      continue;
    }
    if (is_letter(c)) {
      kind = Token::Kind::word;
      end = end_of_word(text, at);
    } else if (is_digit(c) || (c == '.' && end < text.size() && is_digit(text[end]))) {
      kind = Token::Kind::number;
      end = end_of_number(text, at);
    } else if ((c == '<' || c == '>') && end < text.size() && text[end] == '=') {
      ++end;
    }
    tokens.push_back({kind, text.substr(at, end - at), at});
    at = end;
  }
  tokens.push_back({Token::Kind::end, {}, text.size()});
  return tokens;
}

}  // namespace jarol::expect
