// A graph that is valid: everything resolved, checked and put in an order that declaration does not change.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "graph/model/condition.h"
#include "graph/model/end.h"
#include "graph/registry.h"
#include "graph/values/value.h"

namespace jarol {

constexpr std::size_t default_heap = std::size_t{64} << 10;  // bytes

struct Task {
  std::string name;
  Location where;
  const TaskClass* task_class = nullptr;
  Duration period{};
  Duration offset{};            // of the first release, below the period
  std::optional<Duration> let;  // none: a data-flow task
  Duration deadline{};          // relative to the release, derived or declared
  std::optional<Duration> wcet;
  Duration jitter{};                     // for the analysis only
  Duration blocking{};                   // for the analysis only
  std::optional<std::int64_t> priority;  // smaller is more urgent
  std::optional<std::int64_t> core;
  std::size_t heap = 0;  // bytes; of a task that needs one and does not say how large, `default_heap`
  OnFault on_fault = OnFault::stop;
  std::optional<FaultLimit> fault_limit;  // with which a fault stops the run, whatever else follows one
  Isolation isolation = Isolation::strong;
  Value parameters;
  Value out;  // what its outputs read as until first published
};

struct Communicator {
  std::string name;
  Location where;
  Direction direction = Direction::in;
  const Type* type = nullptr;
  Duration period{};
  Duration offset{};
  Value init;                              // of an `in`
  std::optional<Duration> timeout;         // of an `in`: without a new value for longer, its distributer is silent
  std::optional<Value> safe;               // of an `out`: what it hands over while its distributer is silent
  std::optional<std::size_t> distributer;  // none: no channel
  std::size_t channel = 0;                 // of the distributer's class
};

struct Distributer {
  std::string name;
  Location where;
  const DistributerClass* distributer_class = nullptr;
  Yaml link;
  Value parameters;  // of the class, if it has any
};

struct Connection {
  End from;
  End to;
  const Type* type = nullptr;
  Location where;
};

struct Platform {
  std::int64_t cores = 1;
  const Policy* policy = nullptr;  // null: none is stated
  Phasing phasing = Phasing::given;
  Duration dispatch{};  // overhead of each activation
  Duration copy{};      // overhead of each byte that an activation hands on
};

/// A path of connections along which latency matters.
struct Chain {
  std::string name;
  Location where;
  std::vector<End> path;  // tasks and communicators; fields do not count
  std::optional<Duration> reaction;
  std::optional<Duration> age;
  std::optional<double> crossover;  // rad/s
};

/// What a communicator reads as while a run ends; of other fields what comes.
struct EndCommand {
  std::size_t communicator = 0;  // an `in` of an operator
  Value value;
  std::vector<Leaf> stated{};  // the fields of the value that count
};

/// How the vehicle comes to rest when a run ends.
struct AtEnd {
  std::vector<EndCommand> commands;
  expect::Condition until;  // at rest; of what is published alone
  Duration longest{};
};

struct Graph {
  std::string name;
  Location where;
  std::optional<Duration> period;
  std::vector<Task> tasks;                  // in bytewise order of name
  std::vector<Communicator> communicators;  // in bytewise order of name
  std::vector<Distributer> distributers;    // in bytewise order of name
  std::vector<Connection> connections;      // by reader, in the order of tasks, fields, communicators
  std::vector<std::size_t> order;           // of tasks: data-flow tasks before those they feed, then by name
  Platform platform;
  std::vector<Chain> chains;                    // in bytewise order of name
  std::vector<expect::Condition> expectations;  // in the order of the file; `read_expectations` fills it
  std::optional<AtEnd> at_end;
  double fault_limit = 0.1;  // share of a task's activations that faults may leave without outputs
};

/// "task.output", or the communicator's name: what publications are called in trace and digest.
std::string end_name(const Graph& graph, const End& end, bool output);

}  // namespace jarol
