// Random graphs are recorded as a whole and replayed from their files: every value is the same.
#include <doctest/doctest.h>

#include <filesystem>

#include "runtime/execute/log_end.h"
#include "runtime/record/recorded_run.h"
#include "runtime/record/recording_writer.h"
#include "runtime/record/replayed_values.h"
#include "tests/how_many.h"
#include "tests/runtime/random_model.h"
#include "tests/runtime/run_on_threads.h"

namespace {
using namespace jarol;
using namespace jarol::tests::threads;

class File {
 public:
  // of a name of its own: what was read is never replaced
  File() {
    static int made = 0;
    path_ = std::filesystem::temp_directory_path() /
            ("random_recordings_" + std::to_string(::getpid()) + "_" + std::to_string(++made));
  }
  ~File() { std::filesystem::remove(path_); }
  std::string path() const { return path_.string(); }

 private:
  std::filesystem::path path_;
};

// One of its communicators, if any comes in, has its values from outside.
std::string with_outside(std::string text) {
  const std::string own = "type: double, direction: in";
  const std::size_t at = text.find(own);
  if (at == std::string::npos) return text;
  return text.replace(at, own.size(), "channel: p.sensor") + "distributers: {p: {type: Plant, link: {type: test}}}\n";
}

std::vector<std::unique_ptr<ExternalSystem>> systems_of(const Graph& graph) {
  return graph.distributers.empty() ? std::vector<std::unique_ptr<ExternalSystem>>{} : tests::outside();
}

struct How {
  Duration end{};
  std::size_t workers = 1;
  bool real = false;
};

Report record(const Graph& graph, const std::string& path, const How& how) {
  const RecordingHeader header{
      .graph = graph.name, .file = "", .overrides = {}, .clock = how.real ? "real" : "virtual", .what = "all"};
  RecordingWriter writer(path, header, {}, graph);
  Recorder recorder({writer.publications()});
  RealClock clock(graph.tasks.size());
  const std::vector<analysis::TaskThread> threads =
      how.real ? analysis::threads_of(graph) : std::vector<analysis::TaskThread>{};
  Executor executor(graph, systems_of(graph),
                    {.recorder = &recorder,
                     .workers = how.workers,
                     .sharing = Sharing::always,
                     .clock = how.real ? &clock : nullptr,
                     .threads = threads,
                     .log = writer.recorder()});
  writer.open();
  if (how.real) clock.start();
  executor.run_until(how.end);
  recorder.close();
  writer.close(log_end_of(executor.report()));
  return executor.report();
}

void check_replay(const Graph& graph, const std::string& path, const Report& should) {
  RecordedRun log(path);
  const std::vector<Miss> misses = log.begin(graph);
  ReplayedValues values(log, outputs_of(graph));
  Recorder recorder({&values});
  Executor executor(graph, replayed_systems(graph, log), {.recorder = &recorder, .misses = misses});
  executor.run_until(log.covered());
  recorder.close();
  log.require_all_taken();
  CHECK(executor.report().digest == should.digest);
  CHECK(executor.report().activations == should.activations);
  CHECK(executor.report().fault_count == should.fault_count);
  CHECK(!values.differences().first());
  std::uint64_t recorded = 0;
  for (const auto& [id, topic] : log.recording().topics()) recorded += topic.is_own() ? 0 : topic.messages;
  CHECK(values.differences().compared() == recorded);
}

std::uint64_t count_of_graphs(std::uint64_t few) { return tests::how_many<std::uint64_t>(few, 1000); }
}  // namespace

TEST_SUITE("runtime/random_recordings") {
  TEST_CASE("random graphs that one, two or four workers run are replayed from their recordings, value by value") {
    std::uint64_t from_outside = 0;
    for (std::uint64_t seed = 0; seed < count_of_graphs(20); ++seed) {
      const std::string text = with_outside(to_yaml(oracle::random_model(seed), 0));
      CAPTURE(seed);
      CAPTURE(text);
      const Graph graph = graph_of(text);
      for (const std::size_t workers : {1, 2, 4}) {
        const File file;
        const Report report = record(graph, file.path(), {.end = 40ms, .workers = workers});
        check_replay(graph, file.path(), report);
        from_outside += RecordedRun(file.path()).values();
      }
    }
    CHECK(from_outside > 0);
  }

  TEST_CASE("those that a machine can't always keep up with, too, with all that they missed") {
    std::uint64_t faults = 0;
    const Mode every_mode[] = {table_1, table_2, priorities_1, priorities_2};
    for (std::uint64_t seed = 0; seed < count_of_graphs(12); ++seed) {
      const std::string text = on(every_mode[seed % 4], with_outside(oracle::hurried_random_graph(seed)));
      CAPTURE(seed);
      CAPTURE(text);
      const Graph graph = graph_of(text);
      const File file;
      keep_stacks_small();
      const Report report = record(graph, file.path(), {.end = 2ms, .real = true});
      munlockall();
      check_replay(graph, file.path(), report);
      faults += report.fault_count;
    }
    CHECK(faults > 0);
    MESSAGE(faults << " misses");
  }
}
