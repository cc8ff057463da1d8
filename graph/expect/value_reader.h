// What is judged: signals of a graph and what is computed of them at one instant.
#pragma once

#include <string>
#include <vector>

#include "graph/expect/names.h"
#include "graph/expect/token_reader.h"

namespace jarol::expect {

/// Reads values of one condition, whose signals it adds. Without vehicles no true value is known.
class ValueReader {
 public:
  ValueReader(TokenReader& tokens, const Graph& graph, const std::vector<TrueValues>* vehicles, Condition& condition)
      : in_(tokens), graph_(graph), vehicles_(vehicles), condition_(condition) {}

  /// A sum; only what is a number on both sides can be in it.
  Value read();

 private:
  struct Level;

  Value read_term();
  Value read_call(const Token& function);
  Value read_name(const Token& token);
  Value apply(Step::Kind kind, const Token& token, Value value) const;
  void require_number(const Token& token, const Value& value) const;
  void check_depth(const Value& value) const;

  TokenReader& in_;
  const Graph& graph_;
  const std::vector<TrueValues>* vehicles_;
  Condition& condition_;
  std::size_t depth_ = 0;
};

}  // namespace jarol::expect
