// Whoever looks on at a run: gets what is published, and what happens beside that.
#pragma once

#include <cstdint>
#include <string_view>

#include "runtime/machine/bell.h"
#include "runtime/plan/output.h"

namespace jarol {

/// What happens in a run and is no publication.
struct RunEvent {
  // mishap: what had become of a simulated vehicle by the end, as in "crashed: a rotor met the ground, at 10.32 s"
  enum class Kind : std::uint32_t { fault, rest_begun, at_rest, mishap };
  Kind kind = Kind::fault;
  Duration instant{};              // of a fault: at which it would have published
  std::uint32_t task = 0;          // of a fault: index in the graph
  std::int64_t activation = 0;     // of a fault
  std::string_view cause{};        // of a fault or mishap, in words
  std::string_view distributer{};  // of a mishap
};

/// What a sink wants and will never get.
struct Loss {
  Duration from{}, to{};     // instants of the first and the last
  std::uint64_t values = 0;  // of all, how many
};

class DirectSink;

/// All is called in the order in which it took place, one call after the other: on the recorder's thread, or on one
/// that waits for the sinks to have all.
class RecordSink {
 public:
  virtual ~RecordSink() = default;
  /// Itself, if it is one.
  virtual DirectSink* direct() { return nullptr; }
  /// False: publications of that output need not be recorded for it.
  virtual bool wants(std::uint32_t) const { return true; }
  /// A publication, by the index of its output, or the true values of a vehicle.
  virtual void take(Duration instant, std::uint32_t output, const void* value) = 0;
  virtual void take_event(const RunEvent&) {}
  /// After the last value, where the recorder has lost some.
  virtual void take_loss(const Loss&) {}
  /// There is nothing more to take for now.
  virtual void pause() {}
  /// After the last value. Throws if anything was lost. A sink that has thrown, here or above, gets nothing more, nor
  /// is it asked to finish: what it has is not whole.
  virtual void finish() = 0;
};

/// A sink that can take what comes directly from the thread that publishes, where there is no heap, and where it
/// neither locks nor calls the system as long as the recorder's thread keeps up and values are not large: what it makes
/// of a value is then the only copy.
class DirectSink : public RecordSink {
 public:
  DirectSink* direct() override { return this; }
  /// From now on `take`, `take_event` and `pause` are called by the thread that publishes, and the bell wakes the
  /// recorder's; null: it is a sink as any other. Before the first value.
  virtual void take_directly(Bell* bell) = 0;
  /// On the recorder's thread, often: hands on what was taken; false: there was nothing. Throws nothing.
  virtual bool carry() = 0;
};

}  // namespace jarol
