#include "distributers/session/replay_start.h"

#include <algorithm>

#include "graph/language/quantities.h"
#include "graph/language/read_source.h"
#include "graph/language/source_set.h"
#include "graph/text/errors.h"
#include "runtime/checkpoint/checkpoint.h"

namespace jarol {
namespace {

// A recording may come from anybody: what is no regular file, or larger than a source may be, is not read.
bool is_on_disk(const RecordedFile& file) {
  try {
    return read_source(file.path)->text == file.text;
  } catch (const SpecError&) { return false; }
}

}  // namespace

Overrides overrides_of(const Recording& recording, const std::string& file, const Overrides& given,
                       const std::string& how_named) {
  Overrides overrides = recording.header().overrides;
  overrides.no_plugins = given.no_plugins;
  if (overrides.no_plugins.empty() && file.empty() && std::none_of(given.set.begin(), given.set.end(), names_plugins))
    overrides.no_plugins =
        "the recording names this graph, and a recording names no code; name it yourself: " + how_named;
  if (!given.profile.empty()) overrides.profile = given.profile;
  overrides.set.insert(overrides.set.end(), given.set.begin(), given.set.end());
  return overrides;
}

void give_recorded(const Recording& recording, const Overrides& overrides, const std::string& how_named,
                   SourceSet& sources) {
  for (const RecordedFile& recorded : recording.files()) sources.give(recorded.path, recorded.text);
  const Overrides& own = recording.header().overrides;
  if (overrides.set == own.set && overrides.profile == own.profile)
    sources.close("the recording does not hold it, and is not to say what else is read; name the graph: " + how_named);
}

Loaded load_recorded(const Recording& recording, const distributers::Registries& known, const std::string& file,
                     const Overrides& overrides, RecordedWorld world, const NoteSink& note,
                     const std::string& how_named) {
  const auto load = [&](const std::string& path) {
    if (world == RecordedWorld::systems)
      return load_graph(read_source(path), known, overrides, recording.header().seed, note);
    return load_without_systems(read_source(path), known, overrides, note,
                                world == RecordedWorld::truth ? &recording.header() : nullptr);
  };
  if (!file.empty()) return load(file);
  SourceSet sources;
  give_recorded(recording, overrides, how_named, sources);
  return load(recording.header().file);
}

std::vector<std::string> changed_files(const Recording& recording) {
  std::vector<std::string> changed;
  for (const RecordedFile& file : recording.files())
    if (file.path != "-" && !is_on_disk(file)) changed.push_back(file.path);
  return changed;
}

bool is_text_of_run(const std::string& file, const Recording& recording) {
  const std::string text = read_source(file)->text;
  return std::any_of(recording.files().begin(), recording.files().end(),
                     [&](const RecordedFile& f) { return f.path == recording.header().file && f.text == text; });
}

Duration replay_begin(const std::optional<Duration>& from, const RecordedRun& log, const std::string& option) {
  const Duration begin = log.header().begin;
  if (!from) return begin;
  if (*from < begin) throw InputError(option + ": the recording begins at " + seconds_text(begin) + " s");
  if (*from >= log.covered())
    throw InputError(option + ": the recording ends at " + seconds_text(log.covered()) + " s");
  if (const std::optional<Duration> saved = log.saved_before(*from)) return *saved;
  if (*from > begin && !log.saved_before(log.covered()))
    throw InputError(
        option +
        ": the recording holds no checkpoints; record it with --record-checkpoints 10s, or replay it as a whole");
  return begin;
}

void restore_recorded(GraphRun& run, Noted& noted, const RecordedRun& log, Duration at, RunOrigin origin) {
  run.set_origin(std::move(origin));
  const std::string text = log.saved_at(at);
  try {
    const auto* const bytes = reinterpret_cast<const std::byte*>(text.data());
    const Checkpoint saved = Checkpoint::from_bytes({bytes, bytes + text.size()});
    run.require_same_origin(saved);
    if (saved.instant() != at || !saved.restore("run", run.executor()))
      throw CheckpointError("is damaged: a part of it is missing");
    saved.restore("notes", noted);
  } catch (const CheckpointError& wrong) {
    throw InputError("the checkpoint at " + seconds_text(at) + " s of '" + log.recording().path() + "' " +
                     wrong.what());
  }
}

}  // namespace jarol
