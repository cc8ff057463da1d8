// All that the code of tasks can reach: functions and constant data, and what leads from one to another.
#pragma once

#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "graph/isolation/flow.h"
#include "graph/isolation/object.h"

namespace jarol::isolation {

struct Edge {
  Address at;       // of the instruction; 0: a pointer in data
  Address to;       // the begin of another node
  bool by_address;  // refers to a function without calling it
};

struct Held {
  Address at;
  Offence offence;
};

struct PointerCall {
  Address at;
  Origin target;
};

/// A function or an object of constant data.
struct Node {
  Symbol symbol;
  bool is_code = false;
  std::vector<Edge> edges{};
  std::vector<Held> held{};
  std::vector<PointerCall> pointer_calls{};
  std::set<std::string> of_c_library{};  // mathematics whose last bits are the C library's
};

class Closure {
 public:
  /// `own`: Jarol's own functions for tasks are not followed.
  Closure(const Object& object, const std::vector<Address>& roots, bool own);

  /// Of a function or of data, by its begin.
  const Node& node(Address begin) const { return nodes_.at(begin); }

 private:
  struct Work {
    Arguments arguments{};
    bool is_done = false;
  };

  void enter_code(Address at, const Arguments& arguments);
  void enter_data(const Symbol& data);
  void enter_table(const Symbol& table, const std::vector<Address>& targets);
  std::vector<Address> targets_of_distances(Address table) const;
  void look_at(Node& node, const Arguments& arguments);
  void refer(Node& from, Address at, Address to, bool calls, const Arguments& arguments);
  void import(Node& from, Address at, const std::string& name);

  const Object& object_;
  const bool own_;
  std::map<Address, Node> nodes_;
  std::map<Address, Work> work_;
  std::set<std::pair<Address, bool>> entered_;  // data by its begin; true: as a table of distances
};

}  // namespace jarol::isolation
