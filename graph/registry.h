// The task types, distributer classes, scheduling policies and timing grammars that graphs may name.
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "graph/language/grammar.h"
#include "graph/language/spec.h"
#include "graph/named_list.h"
#include "graph/policy.h"
#include "graph/task.h"

namespace jarol {

namespace distributers {
class AnyDistributer;
}
namespace messages {
struct MessageSet;
}

/// A channel that a distributer class defines: `in` brings values into the graph, `out` takes them to the outside.
struct ChannelClass {
  std::string name;
  Direction direction = Direction::in;
  const Type* type = nullptr;
  std::string text;
};

/// A kind of external system: the adaptation layer's part that a graph can name.
struct DistributerClass {
  std::string name;
  std::string summary;
  std::vector<ChannelClass> channels;
  bool is_vehicle = false;           // else an operator
  const Type* parameters = nullptr;  // a struct; null: it has none

  /// From a value of the type of parameters. Throws InputError if there can be none with them. Null: it
  /// speaks no messages, and can be played from a script only.
  std::unique_ptr<distributers::AnyDistributer> (*make)(const void* parameters) = nullptr;
  /// That it speaks; null as `make`.
  const messages::MessageSet& (*message_set)() = nullptr;
};

class Registry {
 public:
  /// Throws InputError if there is one of that name, or it has values of more than 1 GiB.
  void add(TaskClass task);
  void add(DistributerClass distributer);
  void add(const Policy& policy) { policies_.add(policy); }
  void add(const Grammar& grammar) { grammars_.add(grammar); }

  const TaskClass* find_task(std::string_view name) const;
  const DistributerClass* find_distributer(std::string_view name) const;
  const Policy* find_policy(std::string_view name) const { return policies_.find(name); }
  const Grammar* find_grammar(std::string_view name) const { return grammars_.find(name); }
  /// A type that some input, output or channel has, or null.
  const Type* find_type(std::string_view name) const;

  /// Some classes are not there, and that was reported: a name that is not found may be one of theirs.
  void mark_incomplete() { complete_ = false; }
  bool is_complete() const { return complete_; }

  /// In bytewise order of name.
  const std::vector<TaskClass>& tasks() const { return tasks_; }
  const std::vector<DistributerClass>& distributers() const { return distributers_; }
  std::vector<std::string> type_names() const;
  /// In the order in which they were added.
  const std::vector<Policy>& policies() const { return policies_.entries(); }
  const std::vector<Grammar>& grammars() const { return grammars_.entries(); }

 private:
  void add_type(const Type& type);

  std::vector<TaskClass> tasks_;
  std::vector<DistributerClass> distributers_;
  std::vector<const Type*> types_;  // in bytewise order of name
  NamedList<Policy> policies_;
  NamedList<Grammar> grammars_;
  bool complete_ = true;
};

/// The names of a list of classes.
template <class C>
std::vector<std::string> names_of(const std::vector<C>& classes) {
  std::vector<std::string> names;
  for (const C& c : classes) names.emplace_back(c.name);
  return names;
}

}  // namespace jarol
