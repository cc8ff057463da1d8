#include "graph/expect/token_reader.h"

#include "graph/language/spec.h"

namespace jarol::expect {

TokenReader::TokenReader(const Yaml& yaml, const std::string& key, Problems& problems)
    : yaml_(yaml), key_(key), problems_(problems), tokens_(tokens_of(yaml.text)) {}

bool TokenReader::accept(std::string_view text) {
  if (!is(text)) return false;
  ++at_;
  return true;
}

void TokenReader::require(std::string_view text, const std::string& need) {
  if (!accept(text)) fail(now(), need + " needs '" + std::string(text) + "' here" + but());
}

void TokenReader::require_end() const {
  if (now().kind != Token::Kind::end)
    fail(now(), "'" + std::string(now().text) + "' is more than a condition needs; leave it out");
}

Duration TokenReader::read_time() {
  const Token& token = now();
  if (token.kind != Token::Kind::number) fail(token, "an instant is needed here, as in 30s" + but());
  Duration time{};
  const std::string wrong = parse_duration(token.text, time);
  if (!wrong.empty()) fail(token, "'" + std::string(token.text) + "' " + wrong);
  if (time > longest_duration) fail(token, "'" + std::string(token.text) + "' is longer than ten years");
  ++at_;
  return time;
}

double TokenReader::read_number(const std::string& unit) {
  const Token& begin = now();
  const bool negative = accept("-");
  const Token& token = now();
  if (token.kind != Token::Kind::number) fail(token, "a number is needed here" + but());
  ++at_;
  if (is_lenient) return 0;
  double number = 0;
  const std::string wrong = parse_number(token.text, unit, number);
  if (!wrong.empty()) fail(begin, "'" + std::string(token.text) + "' " + wrong);
  return negative ? -number : number;
}

void TokenReader::fail(const Token& token, const std::string& text) const {
  Location where = yaml_.where;
  where.column += static_cast<int>(token.column) + (yaml_.quoted ? 1 : 0);
  problems_.add(where, key_ + ": " + text);
  throw Stop{};
}

std::string TokenReader::but() const {
  return now().kind == Token::Kind::end ? ", but it ends there" : ", not '" + std::string(now().text) + "'";
}

}  // namespace jarol::expect
