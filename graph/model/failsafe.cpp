#include "graph/model/failsafe.h"

#include <algorithm>

#include "graph/values/bind.h"

namespace jarol {
namespace {

class FailsafeReader {
 public:
  FailsafeReader(const GraphSpec& spec, Graph& graph, Problems& problems)
      : spec_(spec), graph_(graph), problems_(problems) {}

  void run() {
    for (const CommunicatorSpec& spec : spec_.communicators) {
      Communicator& communicator = communicator_of(spec);
      if (spec.timeout && belongs(spec, communicator, Direction::in, "timeout", spec.timeout->where))
        read_timeout(spec, communicator);
      if (spec.safe && belongs(spec, communicator, Direction::out, "safe", spec.safe->where)) {
        communicator.safe.emplace(*communicator.type);
        bind_value(spec.safe->value, *communicator.type, "", communicator.safe->data(), subject_of(spec) + " safe",
                   problems_);
      }
    }
    for (const CommunicatorSpec& spec : spec_.communicators) check_both_are_there(spec);
  }

 private:
  static std::string subject_of(const CommunicatorSpec& spec) { return "communicator '" + spec.name + "'"; }

  Communicator& communicator_of(const CommunicatorSpec& spec) {
    return *std::lower_bound(graph_.communicators.begin(), graph_.communicators.end(), spec.name,
                             [](const Communicator& c, const std::string& name) { return c.name < name; });
  }

  // The key is one of such a communicator.
  bool belongs(const CommunicatorSpec& spec, const Communicator& communicator, Direction direction,
               const std::string& key, const Location& where) {
    if (communicator.type == nullptr) return false;  // reported
    const bool in = direction == Direction::in;
    if (communicator.direction != direction) {
      problems_.add(where, subject_of(spec) + (in ? " is an 'out'" : " is an 'in'") + " and has a '" + key +
                               "'; that belongs to an '" + (in ? "in" : "out") + "' only");
    } else if (!communicator.distributer) {
      problems_.add(where, subject_of(spec) + " has no channel and a '" + key + "'; " +
                               (in ? "nothing comes there that could be awaited" : "nobody is handed anything there"));
    } else {
      return true;
    }
    return false;
  }

  void read_timeout(const CommunicatorSpec& spec, Communicator& communicator) {
    communicator.timeout = spec.timeout->value;
    if (*communicator.timeout < communicator.period && !spec.period.bad)
      problems_.add(spec.timeout->where, subject_of(spec) + " has timeout " + duration_text(*communicator.timeout) +
                                             " shorter than its period " + duration_text(communicator.period) +
                                             "; it looks for a new value no more often");
  }

  // A time-out that nothing follows from, or a safe value that never comes into force, is half a declaration.
  void check_both_are_there(const CommunicatorSpec& spec) {
    const Communicator& communicator = communicator_of(spec);  // of two with one name the first
    const bool in = spec.timeout && communicator.timeout;
    if (!in && !(spec.safe && communicator.safe)) return;
    std::vector<std::string> others;
    for (const CommunicatorSpec& s : spec_.communicators) {
      const Communicator& c = communicator_of(s);
      if (c.distributer != communicator.distributer || (c.direction == Direction::in) == in) continue;
      if (s.timeout || s.timeout.bad || s.safe) return;
      others.push_back(c.name);
    }
    const std::string& distributer = graph_.distributers[*communicator.distributer].name;
    problems_.add(in ? spec.timeout->where : spec.safe->where,
                  subject_of(spec) +
                      (in ? " has a 'timeout' without effect; add 'safe: value' to an 'out'"
                          : " has a 'safe' that never comes into force; add 'timeout: 1s' to an 'in'") +
                      " of distributer '" + distributer + "'" +
                      (others.empty() ? ", of which there is none" : ": " + list_of(others)));
  }

  const GraphSpec& spec_;
  Graph& graph_;
  Problems& problems_;
};

}  // namespace

void add_failsafe(const GraphSpec& spec, Graph& graph, Problems& problems) {
  FailsafeReader(spec, graph, problems).run();
}

std::vector<std::size_t> watched_by(const Graph& graph, const Communicator& out) {
  std::vector<std::size_t> watched;
  for (std::size_t i = 0; i < graph.communicators.size(); ++i) {
    const Communicator& c = graph.communicators[i];
    if (c.timeout && c.distributer == out.distributer) watched.push_back(i);
  }
  return watched;
}

}  // namespace jarol
