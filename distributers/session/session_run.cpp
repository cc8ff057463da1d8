#include "distributers/session/session_run.h"

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "graph/floating_point.h"
#include "graph/language/problems.h"
#include "graph/text/article.h"
#include "graph/text/errors.h"

namespace jarol {
namespace {

bool can_be_fed(const Communicator& c) { return c.direction == Direction::in && !c.distributer; }

// What can be fed, by name.
std::vector<std::string> names_to_feed(const Graph& graph) {
  std::vector<std::string> names;
  for (const Distributer& distributer : graph.distributers) names.push_back(distributer.name);
  for (const Communicator& c : graph.communicators)
    if (can_be_fed(c)) names.push_back(c.name);
  return names;
}

// "distributer.channel", or the communicator's own name where the graph gives it none.
std::string channel_name(const Graph& graph, const Communicator& c) {
  if (!c.distributer || graph.distributers[*c.distributer].name.empty()) return c.name;
  const Distributer& distributer = graph.distributers[*c.distributer];
  return distributer.name + "." + distributer.distributer_class->channels[c.channel].name;
}

void require_no_clock(const Loaded& loaded) {
  if (const Distributer* distributer = find_in_real_time(loaded))
    throw NeedsRealClock("distributer '" + distributer->name +
                         "' has a link to what goes on by itself; open the session with .real_clock = true, or with "
                         ".fed = {\"" +
                         distributer->name + "\"} and feed it");
}

// `without_channel`: what is fed to communicators alone.
void require_recordable(const RecordingOptions& recording, const DistributerClass& without_channel) {
  if (recording.checkpoints > Duration{})
    throw InputError(".recording.checkpoints belongs to a Runner; a session is saved by checkpoint() where it stands");
  if (!recording.file.empty() && !without_channel.channels.empty())
    throw InputError(".recording: '" + without_channel.channels.front().name +
                     "' is fed and has no channel, from which a replay would take its values; give it one "
                     "in the graph, as in {channel: dune.motion}");
}

}  // namespace

Session::Run::Run(const distributers::Registries& known, std::shared_ptr<const Source> source,
                  const SessionOptions& options)
    : note_(options.note ? options.note : no_notes) {
  if (source == nullptr) throw NoSource("a session is of a graph's text; the source is null");
  const DefaultFloatingPoint arithmetic;  // of vehicles and parameters, and of threads that are started here
  const Overrides overrides{options.profile, options.set, options.no_plugins};
  Loaded loaded =
      feed_in_place_of_links(load_graph(source, known, overrides, options.seed, note_, options.fed), options.fed);
  if (!options.real_clock) require_no_clock(loaded);
  require_recordable(options.recording, without_channel_);
  observed = std::make_unique<Observed>(*loaded.graph, outputs_of(*loaded.graph));
  runner_.emplace(std::move(loaded), RunOptions{.end = Duration::max(),
                                                .overrides = overrides,
                                                .seed = options.seed,
                                                .fed = options.fed,
                                                .real_clock = options.real_clock,
                                                .workers = options.workers,
                                                .real_time = options.real_time,
                                                .force = options.force,
                                                .execution = options.execution,
                                                .recording = options.recording,
                                                .sinks = {observed.get()},
                                                .note = note_});
  runner_->connect();
}

Session::Run::~Run() {
  if (runner_ && !finished_) end();
}

// What has a safe gets it, then the links are let go.
void Session::Run::end() {
  const DefaultFloatingPoint arithmetic;
  runner_->stop(asked_);
}

void Session::Run::watch(const std::string& pattern) {
  if (finished_) throw RunOver("the run is over: " + over_);
  observed->watch(pattern);
}

Loaded Session::Run::feed_in_place_of_links(Loaded loaded, const std::vector<std::string>& patterns) {
  Graph& graph = *loaded.graph;
  const std::vector<std::string> names = names_to_feed(graph);
  for (const std::string& pattern : patterns)
    if (std::none_of(names.begin(), names.end(), [&](const std::string& name) { return fits(name, {pattern}); }))
      throw UnknownName("no distributer, and no 'in' communicator without a channel, has the name '" + pattern + "'" +
                        did_you_mean(pattern, names) + "; there are: " + list_of(names));
  for (Communicator& c : graph.communicators) {
    if (!can_be_fed(c) || !fits(c.name, patterns)) continue;
    c.distributer = graph.distributers.size();
    c.channel = without_channel_.channels.size();
    without_channel_.channels.push_back({c.name, Direction::in, c.type, ""});
  }
  if (!without_channel_.channels.empty()) {
    without_channel_.name = "Session";
    Distributer added;
    added.distributer_class = &without_channel_;
    graph.distributers.push_back(std::move(added));
    loaded.systems.emplace_back();
  }
  fed_.resize(loaded.systems.size());
  for (std::size_t i = 0; i < fed_.size(); ++i) {
    if (loaded.systems[i] != nullptr) continue;
    auto made = std::make_unique<FedSystem>(*graph.distributers[i].distributer_class);
    fed_[i] = made.get();
    loaded.systems[i] = std::move(made);
  }
  return loaded;
}

void Session::Run::run_until(Duration end) {
  const DefaultFloatingPoint arithmetic;
  Executor& executor = graph_run().executor();
  if (!over_.empty()) throw RunOver("the run is over at " + seconds_text(executor.now()) + " s: " + over_);
  if (end > longest_duration) throw WrongInstant("a run has ten years at most, not " + seconds_text(end) + " s");
  if (end < executor.now())
    throw WrongInstant("a run does not go back: it has reached " + seconds_text(executor.now()) +
                       " s, and was to run until " + seconds_text(end) + " s");
  asked_ = end;
  if (runner_->has_real_clock() && !std::exchange(started_, true)) runner_->start();
  try {
    executor.run_until(end);
  } catch (const std::exception& error) { over_ = error.what(); } catch (...) {
    over_ = "something was thrown that is no exception";
  }
  graph_run().sinks().catch_up();
  graph_run().sinks().rethrow_failure();
  if (!over_.empty()) throw SystemLost(over_);
  // on the real clock it goes on
  if (const std::string& lost = graph_run().sinks().lost(); !runner_->has_real_clock() && !lost.empty()) {
    over_ = lost;
    throw ValueTooLarge(over_);
  }
  if (executor.report().stopped) over_ = to_text(executor.report().faults.back());
}

Checkpoint Session::Run::checkpoint() {
  const DefaultFloatingPoint arithmetic;
  if (finished_ || (!over_.empty() && !graph_run().executor().report().stopped))
    throw RunOver("there is nothing to save, as the run is over: " + over_);
  try {
    Checkpoint made = graph_run().checkpoint();
    made.save("notes", runner_->noted());
    made.save("values", *observed);
    return made;
  } catch (const CheckpointError& error) { throw CheckpointRefused(error.what()); }
}

void Session::Run::restore(const Checkpoint& checkpoint) {
  const DefaultFloatingPoint arithmetic;
  if (finished_) throw RunOver("the run was finished");
  if (runner_->has_real_clock()) throw CheckpointRefused("a run on the real clock does not go on from a checkpoint");
  if (runner_->recording() != nullptr)
    throw CheckpointRefused(
        "a run that is recorded does not go on from a checkpoint; restore it in a session without .recording");
  try {
    graph_run().require_same_origin(checkpoint);
    over_ = "what was to be restored is damaged";
    graph_run().restore(checkpoint);
    checkpoint.restore("notes", runner_->noted());
    if (!checkpoint.restore("values", *observed)) observed->forget();
  } catch (const CheckpointError& error) { throw CheckpointRefused(std::string("the checkpoint ") + error.what()); }
  asked_ = checkpoint.instant();
  const Report& report = graph_run().executor().report();
  over_ = !report.stopped ? "" : report.faults.empty() ? "a fault" : to_text(report.faults.back());
}

void Session::Run::feed(std::string_view name, const Type& type, const void* value) {
  if (finished_) throw RunOver("the run is over: " + over_);
  const Graph& graph = graph_run().graph();
  std::vector<std::string> names;
  for (const Communicator& c : graph.communicators) {
    if (c.direction != Direction::in) continue;
    const std::string channel = channel_name(graph, c);
    names.push_back(c.name);
    if (channel != c.name) names.push_back(channel);
    if (name != c.name && name != channel) continue;
    if (!same_type(*c.type, type))
      throw WrongType("'" + std::string(name) + "' takes " + with_article(c.type->name) + ", not " +
                      with_article(type.name));
    if (c.distributer && fed_[*c.distributer] != nullptr) return fed_[*c.distributer]->feed(c.channel, value);
    const std::string who = c.distributer ? graph.distributers[*c.distributer].name : c.name;
    throw NotFed("'" + std::string(name) +
                 "' is not fed: " + (c.distributer ? "distributer '" + who + "' has its link" : "it has no channel") +
                 "; open the session with .fed = {\"" + who + "\"}");
  }
  throw UnknownName("no 'in' communicator, and no channel of one, has the name '" + std::string(name) + "'" +
                    did_you_mean(name, names) + "; there are: " + list_of(names));
}

RunVerdict Session::Run::finish() {
  const DefaultFloatingPoint arithmetic;
  if (finished_) throw RunOver("the run was finished before");
  finished_ = true;
  const std::string stopped = std::exchange(over_, "it was finished");
  this->end();
  const RunOutcome outcome = runner_->finish();
  RunVerdict verdict = outcome.verdict;
  verdict.stopped = stopped;
  verdict.unseen = outcome.unwritten;
  if (stopped.empty() && !verdict.unheard.empty())
    verdict.stopped = "nothing came from the vehicle of '" + verdict.unheard.front() + "'";
  return verdict;
}

}  // namespace jarol
