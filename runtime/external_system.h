// All channels of one distributer while a graph runs: how values of the core reach an external system and come from it.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "graph/language/yaml.h"
#include "graph/values/archive.h"
#include "graph/values/type_of.h"

namespace jarol {

/// What a link to another process or device has carried, and what it dropped and why.
struct LinkReport {
  std::string link;
  std::vector<std::pair<std::string, std::uint64_t>> counts;
  std::uint64_t heard = 0;    // packets that came and counted
  std::uint64_t dropped = 0;  // what came and did not, each packet and each stretch of garbage once

  /// Of a link that may have several peers at once: who they were; the first few.
  struct Peer {
    std::string address;
    std::uint64_t packets = 0;  // that counted
  };
  std::vector<Peer> peers{};

  /// Who sent without being the link's peer; those beyond the first few are in `more_strangers`.
  struct Stranger {
    std::string address;
    std::uint64_t times = 0;  // datagrams, or connections
  };
  std::vector<Stranger> strangers{};
  std::uint64_t more_strangers = 0;  // their datagrams or connections

  /// A peer that had fallen silent was replaced by another; the first few.
  struct Takeover {
    std::string from, to;
    Duration at{};  // since the link was connected
  };
  std::vector<Takeover> takeovers{};
};

class ExternalSystem {
 public:
  virtual ~ExternalSystem() = default;

  /// Before the first instant of a run. Throws InputError if there is no way to the external system.
  virtual void begin() {}
  /// After the last instant; what is under way is completed. Throws std::runtime_error if something can't be kept for
  /// the next run; a second call does nothing.
  virtual void finish() {}

  /// The external system goes on by itself, whatever the logical clock says.
  virtual bool needs_real_clock() const { return false; }

  /// The external system is there after the run, and goes on with what it was handed last.
  virtual bool outlives_run() const { return needs_real_clock(); }

  /// What was handed over last may not have gone out yet, until it has finished; any thread.
  virtual bool sends() const { return false; }

  /// Of what was handed over, how much found no room or could not be sent so far. By the thread that hands over, or
  /// after `finish`.
  virtual std::uint64_t unsent() const { return 0; }
  /// Something that was handed over has gone out.
  virtual bool has_sent() const { return true; }

  /// What is wrong with how its link is set up, though it works, as in "listens where ..."; empty: nothing.
  virtual std::string doubt() const { return {}; }

  /// What was carried until now, for a system that is on a link.
  virtual std::optional<LinkReport> link_report() const { return std::nullopt; }

  /// What was not finite within what came, and was left out of a channel's value.
  virtual std::uint64_t non_finite_inputs() const { return 0; }

  /// Describes the true values of a vehicle that is simulated in this process; null: there is none.
  virtual const Type* true_type() const { return nullptr; }
  /// They, at the instant that was reached last.
  virtual void copy_true_values(void*) const {}
  /// What has become of that vehicle that no mission wants; empty: nothing.
  virtual std::string mishap() const { return {}; }
  /// Why that vehicle is not at rest, whatever its graph believes; empty: it is, or it is not known.
  virtual std::string unrest() const { return {}; }

  /// Step 0 of an instant: the external system reaches it with the inputs that it held before; sensors sample.
  virtual void reach(Duration instant) = 0;

  /// Copies the channel's newest value if one came since the last call; false: there is none.
  virtual bool take(std::size_t channel, void* value) = 0;

  /// Gives the channel a value at the present instant.
  virtual void hand_over(std::size_t channel, const void* value) = 0;

  /// Sends what was handed over, where it would wait for the next instant. Throws Unfinished if it can't.
  virtual void flush() {}

  /// From the next instant on the vehicle is brought to rest, as `at_end` of the graph states; before `reach`, once.
  virtual void ending() {}
  /// Then: its operator has demanded a stop, and what it commands counts in place of `at_end`. Any thread.
  virtual bool overrides_end() const { return false; }

  /// What changes while a run goes on, on the virtual clock, between two instants. Throws NotSaveable.
  virtual void serialize(Archive&) { throw NotSaveable("its link can't be saved"); }

  /// The instant at which the mission ends, for an external system that has one.
  virtual std::optional<Duration> end() const { return std::nullopt; }
  /// What that mission is to reach: conditions, beside those of the key `expect` of the graph.
  virtual std::span<const Yaml> expectations() const { return {}; }
};

}  // namespace jarol
