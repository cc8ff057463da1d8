#include "tools/bench/recording.h"

#include <unistd.h>

#include <algorithm>
#include <filesystem>

#include "runtime/execute/log_end.h"
#include "runtime/record/recording_writer.h"
#include "tools/bench/graphs.h"
#include "tools/bench/timing.h"

namespace jarol::bench {
namespace {

constexpr int chain_length = 100;
constexpr int milliseconds = 40'000;

// A name in the folder for temporary files, where nothing stands once this is gone.
class FileName {
 public:
  FileName()
      : path_(std::filesystem::temp_directory_path() / ("jarol_bench_" + std::to_string(::getpid()) + ".mcap")) {}
  ~FileName() {
    std::error_code none;
    std::filesystem::remove(path_, none);
  }
  FileName(const FileName&) = delete;
  FileName& operator=(const FileName&) = delete;
  std::string text() const { return path_.string(); }

 private:
  std::filesystem::path path_;
};

double ns_per_value(const Graph& graph, bool digest) {
  const FileName file;
  RecordingWriter writer(file.text(),
                         {.graph = "bench", .file = "", .overrides = {}, .clock = "virtual", .what = "all"}, {}, graph,
                         mcap::Compression::none);
  writer.open();
  Recorder recorder({writer.publications()});
  Executor executor(graph, {}, {.digest = digest, .recorder = &recorder, .log = writer.recorder()});
  // all that is recorded is in the file, for what its system calls so: whether it is on the disk is the disk's affair
  const double seconds = seconds_of([&] {
    executor.run_until(std::chrono::milliseconds(milliseconds));
    recorder.close();
    writer.finish(log_end_of(executor.report()));
  });
  return 1e9 * seconds / (static_cast<double>(chain_length) * milliseconds);
}

}  // namespace

Figure measure_recording(const std::string& name, bool digest, double goal, int repeats) {
  Figure figure{name,
                1e300,
                "ns",
                1,
                0,
                goal,
                std::string("a value of 64 bytes computed") + (digest ? ", in the digest" : "") +
                    " and recorded to an MCAP file, not compressed, of four million / 1 ns"};
  const Graph graph = graph_of(chain(chain_length, same_rate));
  for (int i = 0; i < std::max(3, repeats / 8); ++i) figure.value = std::min(figure.value, ns_per_value(graph, digest));
  figure.ratio = figure.value / figure.floor;
  return figure;
}

}  // namespace jarol::bench
