// A run that a program steps, feeds and watches: a graph joined to its world, on the virtual clock or the real one.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "distributers/session/errors.h"
#include "distributers/session/load.h"
#include "distributers/session/program_build.h"
#include "distributers/session/recording_options.h"
#include "distributers/session/verdict.h"
#include "graph/values/type_of.h"
#include "graph/values/value.h"
#include "runtime/checkpoint/checkpoint.h"
#include "runtime/execute/executor.h"

namespace jarol {

struct SessionOptions {
  std::string profile{};           // of the graph; empty: none
  std::vector<std::string> set{};  // "path=value", as in "tasks.depth.parameters.kp=0.7"
  std::uint64_t seed = 0;          // of all noise
  std::vector<std::string> fed{};  // what the program feeds, by name, * for any part: distributers, whose links are
                                   // not used, and `in` communicators that have no channel
  std::size_t workers = 1;         // threads that run tasks, 1 to 64; the outcome is the same for any number
  bool real_clock = false;         // against the machine's clock; else as fast as possible
  RealTimeOptions real_time{};     // on the real clock: priority and CPUs of the threads that run the graph
  bool force = false;              // on the real clock: also what check has a negative verdict on
  std::string execution{};         // on the virtual clock, what activations take: wcet, random, a file; empty: no time
  RecordingOptions recording{};    // closed by finish, then jarol replay repeats the run; without it, it breaks off
  std::string no_plugins{};        // why plugins that the graph names are an error; empty: they are loaded
  NoteSink note = no_notes;        // gets what is worth knowing and no error; null: nobody does
};

/// A publication.
template <class T>
struct Sample {
  Duration instant{};
  T value{};
};

/// Names are those of the trace: "task.output", "communicator", and fields within their values, as "depth.moment.z" or
/// "fins.actuation.fins.0". Used by one thread at a time; any number of sessions may live side by side. One that was
/// moved from throws RunOver, whatever is asked of it. It computes in the default floating-point environment, and
/// leaves that of the thread as it was.
class Session {
 public:
  /// A graph's file with what it may name, which outlives the session. Throws SpecError with all that is wrong with the
  /// file, the options and the links; UnknownName where nothing fits a name in `fed`; NeedsRealClock;
  /// NotExecutable, for a number of workers that can't be, too; InputError where the execution times or the
  /// recording can't have their effect, std::runtime_error where a file of it can't be made; WrongBuild where the
  /// program was compiled with options that give its values another layout or another arithmetic.
  Session(const distributers::Registries& known, const std::string& path, SessionOptions options = {},
          const BuildOptions& program = options_of_this_file());
  /// The same of a text; paths in it are relative to the folder of the source's name. Throws NoSource for a null one,
  /// too.
  Session(const distributers::Registries& known, std::shared_ptr<const Source> source, SessionOptions options = {},
          const BuildOptions& program = options_of_this_file());
  Session(const distributers::Registries& known, std::nullptr_t, SessionOptions options = {}) = delete;
  ~Session();
  Session(Session&&) noexcept;
  Session& operator=(Session&&) noexcept;

  /// Covers the instants from `now()` to before `end`; in pieces it is the same run. Ends earlier at a fault that stops
  /// the run. Throws WrongInstant for an `end` before `now()` or after ten years; RunOver where it was stopped before,
  /// or finished; SystemLost, whatever it is that a vehicle or a distributer throws; ValueTooLarge.
  ///
  /// On the real clock instant 0 is at the first call. The calling thread keeps the time, and gets its priority and
  /// CPUs; values that nobody could take in time are lost, which the verdict says. What has a `safe`
  /// gets that at the end, also if the process dies; `at_end` of a graph is for a Runner.
  void run_until(Duration end);
  /// Throws WrongInstant for what is longer than ten years from the start, too.
  void run_for(Duration length);

  /// The run as it is now, on the virtual clock: tasks, their heaps, values under way, vehicles, noise, conditions. The
  /// same session, or another of the same graph, overrides and seed, in this program or in another process of it, goes
  /// on from it to the bit; parameters of tasks may differ, for the future. Throws CheckpointRefused; RunOver where the
  /// run is over.
  Checkpoint checkpoint();
  /// What was kept of outputs that are watched is gone, and so is an end by a fault or a lost vehicle. Throws
  /// CheckpointRefused; RunOver after finish, and from then on after one that is damaged within.
  void restore(const Checkpoint& checkpoint);

  /// The instant that is reached; the instants before it were run.
  Duration now() const;
  /// When the mission of the graph's scripts ends; zero: it has none.
  Duration end_of_mission() const;
  const Graph& graph() const;
  /// Digest, counts and faults so far.
  const Report& report() const;

  /// Gives an `in` communicator, or the channel "distributer.channel", a value: it is taken at the next instant at
  /// which that acts, now() included. A value that is not finite is counted and not taken, and the one that was fed
  /// before it stays. Throws UnknownName, WrongType, NotFed; RunOver after finish.
  template <class T>
  void feed(std::string_view name, const T& value) {
    feed_value(name, type_of<T>(), &value);
  }

  /// What was published last, or what that reads as until then. Throws UnknownName, WrongType.
  template <class T>
  T value(std::string_view name) const {
    return *static_cast<const T*>(last_value(name, type_of<T>()));
  }

  /// From now on each publication of the outputs with that name, * for any part, is kept. Throws UnknownName; RunOver
  /// after finish.
  void watch(const std::string& pattern);

  /// All that was kept, in order. Throws UnknownName, WrongType, NotWatched.
  template <class T>
  std::vector<Sample<T>> samples(std::string_view name) const {
    std::vector<Sample<T>> all;
    for_each_kept(name, type_of<T>(), [&](Duration instant, const void* value) {
      all.push_back({instant, *static_cast<const T*>(value)});
    });
    return all;
  }

  /// Where a vehicle truly is, in the words of `expect`: "depth of dune". Throws UnknownName.
  double true_value(const std::string& field_of_distributer) const;

  /// Ends the run; what the graph expects of it is judged. The verdict on one that a fault or a lost system stopped,
  /// of which values were lost, or that has heard nothing from its vehicle over a link, is negative whatever was
  /// expected. Throws RunOver the second time.
  RunVerdict finish();

 private:
  void feed_value(std::string_view name, const Type& type, const void* value);
  const void* last_value(std::string_view name, const Type& type) const;
  void for_each_kept(std::string_view name, const Type& type,
                     const std::function<void(Duration instant, const void* value)>& visit) const;

  class Run;
  Run& run() const;

  std::unique_ptr<Run> run_;  // null: moved from
};

}  // namespace jarol
