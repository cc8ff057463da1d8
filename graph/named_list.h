// A list of entries with a name each, as of vehicles, link types or policies.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "graph/text/errors.h"

namespace jarol {

/// In the order in which they were added.
template <class Entry>
class NamedList {
 public:
  /// Throws InputError if there is one of that name.
  void add(Entry entry) {
    if (find(entry.name) != nullptr)
      throw InputError("there is a '" + std::string(entry.name) + "' already; names are unique");
    entries_.push_back(std::move(entry));
  }

  /// The entry of that name, or null.
  const Entry* find(std::string_view name) const {
    for (const Entry& entry : entries_)
      if (entry.name == name) return &entry;
    return nullptr;
  }

  const std::vector<Entry>& entries() const { return entries_; }
  std::vector<std::string> names() const {
    std::vector<std::string> names;
    for (const Entry& entry : entries_) names.emplace_back(entry.name);
    return names;
  }

 private:
  std::vector<Entry> entries_;
};

}  // namespace jarol
