#include "distributers/session/record_run.h"

#include <gnu/libc-version.h>
#include <sys/utsname.h>

#include "distributers/session/execution.h"
#include "distributers/session/recorded_truth.h"

namespace jarol {
namespace {

std::string platform_text() {
  utsname machine{};
  if (::uname(&machine) != 0) return "";
  return std::string(machine.sysname) + " " + machine.release + " " + machine.machine + ", glibc " +
         gnu_get_libc_version();
}

RecordingHeader header_of(const RunOptions& options, const Loaded& loaded) {
  return {.graph = loaded.graph->name,
          .file = SourceSet::full_path(loaded.files.front()->name),
          .overrides = options.overrides,
          .clock = options.real_clock ? "real" : "virtual",
          .begin = options.resumed != nullptr ? options.resumed->instant() : Duration{},
          .until = options.end,
          .mission = end_of_mission(pointers_to(loaded.systems)),
          .seed = options.seed,
          .execution = recorded_execution(options.execution),
          .what = options.recording.what,
          .version = options.recording.version,
          .platform = platform_text(),
          .split = options.recording.split};
}

std::vector<RecordedFile> files_of(const RunOptions& options, const Loaded& loaded) {
  std::vector<RecordedFile> files;
  if (options.recording.sources != nullptr)
    for (const auto& [path, source] : options.recording.sources->read()) files.push_back({path, source->text});
  else
    for (const auto& source : loaded.files) files.push_back({SourceSet::full_path(source->name), source->text});
  return files;
}

}  // namespace

std::unique_ptr<RecordingWriter> make_recording(const RunOptions& options, const Loaded& loaded) {
  if (options.recording.file.empty()) return nullptr;
  RecordingHeader header = header_of(options, loaded);
  if (std::erase_if(header.overrides.set, names_plugins) > 0)
    options.note("the recording does not name the plugins of " + options.words.set +
                 "; give them again to jarol replay");
  return std::make_unique<RecordingWriter>(options.recording.file, std::move(header), files_of(options, loaded),
                                           *loaded.graph, options.recording.compression, types_of_truth(loaded));
}

}  // namespace jarol
