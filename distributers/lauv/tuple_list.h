// Texts of the form "name=value;name=value", as IMC's TupleList.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace jarol::distributers {

class TupleList {
 public:
  /// Parts without '=' are left out.
  explicit TupleList(std::string_view text);

  /// The finite number that has that name, or none.
  std::optional<double> number(std::string_view name) const;
  /// There is such a number and it is not 0, as for a button that is pressed.
  bool is_set(std::string_view name) const { return number(name).value_or(0) != 0; }
  /// Names and texts, in their order.
  const std::vector<std::pair<std::string, std::string>>& pairs() const { return pairs_; }

 private:
  std::vector<std::pair<std::string, std::string>> pairs_;
};

}  // namespace jarol::distributers
