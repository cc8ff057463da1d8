// The words of a condition one after the other, and what they may be; what is wrong is reported at its place.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "graph/expect/tokens.h"
#include "graph/language/problems.h"
#include "graph/language/quantities.h"
#include "graph/language/yaml.h"

namespace jarol::expect {

/// Ends the reading of a text in which something was wrong, which was reported.
struct Stop {};

/// Of a text that stands in a file; all three outlive it.
class TokenReader {
 public:
  /// `key` begins messages.
  TokenReader(const Yaml& yaml, const std::string& key, Problems& problems);

  const Token& now() const { return tokens_[at_]; }
  const Token& next() const { return tokens_[at_ + 1]; }  // not at the end
  const Token& first() const { return tokens_.front(); }
  bool is(std::string_view text) const { return now().kind != Token::Kind::end && now().text == text; }
  void go_on() { ++at_; }
  bool accept(std::string_view text);

  /// `need` says what needs that word.
  void require(std::string_view text, const std::string& need);
  void require_end() const;

  /// A time with its unit.
  Duration read_time();
  /// A number, in that unit or with one of its own.
  double read_number(const std::string& unit);

  [[noreturn]] void fail(const Token& token, const std::string& text) const;
  /// What stands here instead of what is needed.
  std::string but() const;

  /// Something can't be judged, for a reason that is known: units and types are not known either.
  bool is_lenient = false;

 private:
  const Yaml& yaml_;
  const std::string& key_;
  Problems& problems_;
  std::vector<Token> tokens_;
  std::size_t at_ = 0;
};

}  // namespace jarol::expect
