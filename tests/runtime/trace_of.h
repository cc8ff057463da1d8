// Runs a text and keeps every publication as text, for tests.
#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include "graph/values/bind.h"
#include "runtime/execute/executor.h"
#include "tests/graph/graph_of.h"

namespace jarol::tests {

/// Keeps "time name=value" lines; of a run that was so many times as slow, at full speed.
class TraceLines : public RecordSink {
 public:
  explicit TraceLines(const Graph& graph, int times = 1) : outputs_(outputs_of(graph)), times_(times) {}
  void take(Duration instant, std::uint32_t output, const void* value) override {
    const Output& o = outputs_[output];
    std::string text;
    for (const Leaf& leaf : leaves_of(*o.type))
      text += (text.empty() ? "" : ",") + scalar_text(*leaf.type, static_cast<const std::byte*>(value) + leaf.offset);
    lines.push_back(duration_text(instant / times_) + " " + o.name + "=" + text);
  }
  void finish() override {}

  std::vector<std::string> lines;

 private:
  std::vector<Output> outputs_;
  int times_;
};

struct Run {
  Report report;
  std::vector<std::string> lines;  // as recorded: in the order in which they were published
};

inline Run run_graph(const Graph& graph, Duration end, std::vector<std::unique_ptr<ExternalSystem>> systems = {}) {
  TraceLines lines(graph);
  Run run;
  Recorder recorder({&lines});
  Executor executor(graph, std::move(systems), {.digest = true, .recorder = &recorder});
  executor.run_until(end);
  recorder.close();
  run.report = executor.report();
  run.lines = lines.lines;
  return run;
}

inline Run run_text(const std::string& text, Duration end) { return run_graph(graph_of(text), end); }

/// The lines of one output only.
inline std::string lines_of(const Run& run, const std::string& output) {
  std::string text;
  for (const std::string& line : run.lines)
    if (line.find(" " + output + "=") != std::string::npos) text += (text.empty() ? "" : "; ") + line;
  return text;
}

}  // namespace jarol::tests
