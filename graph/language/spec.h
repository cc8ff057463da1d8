// What a graph file says, with the place of each word; nothing is resolved or checked against the tasks that exist.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "graph/language/quantities.h"
#include "graph/language/yaml.h"

namespace jarol {

/// Of any duration in a graph: more than a score of them can be added without overflow.
inline constexpr Duration longest_duration = std::chrono::hours(24) * 365 * 10;

/// A value and where it was written.
template <class T>
struct Located {
  T value{};
  Location where;
};

/// A value that may be left out; `bad`: it is there and can't be used, which was reported.
template <class T>
struct Maybe : std::optional<Located<T>> {
  using std::optional<Located<T>>::operator=;
  bool bad = false;
};

/// What follows a fault: specs/running.md, "Faults".
enum class OnFault { stop, hold, skip, restart };
/// So many faults in so many releases end the run.
struct FaultLimit {
  std::int64_t faults = 0, releases = 0;
};
enum class Direction { in, out };
enum class Isolation { strong, weak };

/// One end of a connection: "task.field" or "communicator".
struct EndSpec {
  std::string name;
  std::string field;  // empty: written without
  Location where;
};

struct ConnectionSpec {
  EndSpec from;
  EndSpec to;
  Location where;
};

struct TaskSpec {
  std::string name;
  Location where;
  Maybe<std::string> type;
  Maybe<Duration> period, offset, let, deadline, wcet;
  Maybe<Duration> jitter, blocking;
  Maybe<std::int64_t> priority, core, heap;
  Maybe<OnFault> on_fault;
  Maybe<FaultLimit> fault_limit;
  Maybe<Isolation> isolation;
  Maybe<Yaml> parameters, init;
};

struct CommunicatorSpec {
  std::string name;
  Location where;
  Maybe<std::string> channel, type;
  Maybe<Direction> direction;
  Maybe<Duration> period, offset, timeout;
  Maybe<Yaml> init, safe;
};

struct DistributerSpec {
  std::string name;
  Location where;
  Maybe<std::string> type;
  Maybe<Yaml> link, parameters;
};

struct TimingSpec {
  Maybe<Duration> period;
};

enum class Phasing { given, any };

struct PlatformSpec {
  Maybe<std::int64_t> cores;
  Maybe<Yaml> policy;  // a name
  Maybe<Phasing> phasing;
  Maybe<Duration> dispatch, copy;
};

struct ChainSpec {
  std::string name;
  Location where;
  Maybe<Yaml> path;
  Maybe<Duration> reaction, age;
  Maybe<double> crossover;
};

struct AtEndSpec {
  Maybe<Yaml> command, until;
  Maybe<Duration> longest;
};

enum class Sampling { random, latin };

struct CampaignSpec {
  Maybe<Yaml> vary, metrics;
  Maybe<std::int64_t> runs;
  Maybe<Sampling> sampling;
  Maybe<Duration> length;
};

struct GraphSpec {
  Maybe<std::string> name;
  Location where;  // of the whole
  TimingSpec timing;
  std::vector<Located<std::string>> plugins;  // paths, relative to the graph's file
  std::vector<DistributerSpec> distributers;
  std::vector<CommunicatorSpec> communicators;
  std::vector<TaskSpec> tasks;
  std::vector<ConnectionSpec> connections;
  PlatformSpec platform;
  std::vector<ChainSpec> chains;
  Maybe<Yaml> expect;
  std::optional<AtEndSpec> at_end;
  std::optional<CampaignSpec> campaign;
  Maybe<double> fault_limit;
};

}  // namespace jarol
