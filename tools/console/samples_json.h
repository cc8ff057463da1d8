// Values on their way to a page, as JSON: numbers exactly, in the order of their leaves.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "graph/values/bind.h"
#include "tools/console/feed.h"

namespace jarol::tools::console {

class SamplesJson {
 public:
  /// Of outputs with these types; null: there is none.
  explicit SamplesJson(const std::vector<const Type*>& types);

  /// Lists [output, seconds, leaf, leaf, ...], separated by commas: truth values are 0 and 1, enumerators their
  /// numbers. Cut where a part has reached `max` bytes; at least one part.
  std::vector<std::string> parts_of(const Batch& batch, std::size_t max) const;

  /// Values of the leaves of one value, as in "0.5,1,[1,2]".
  static void append(std::string& text, std::span<const Leaf> leaves, const void* value);

  const std::vector<Leaf>& leaves(std::size_t output) const { return leaves_[output]; }

 private:
  std::vector<std::vector<Leaf>> leaves_;  // per output
};

}  // namespace jarol::tools::console
