#include "distributers/session/threads_run.h"

namespace jarol {

ThreadsRun::ThreadsRun(Loaded& loaded, std::vector<RecordSink*> sinks, Duration end,
                       std::optional<Duration> longest_rest, RealTimeOptions real_time, NoteSink note)
    : JoinedGraph(*loaded.graph, pointers_to(loaded.systems), std::move(sinks)),
      core_(*loaded.graph, std::move(loaded.systems), JoinedGraph::sinks().recorder()),
      end_(end),
      longest_rest_(longest_rest),
      real_time_(std::move(real_time)),
      note_(std::move(note)) {
  core_.on_rest([this](Duration begun) { JoinedGraph::sinks().judge_before(begun); });
}

void ThreadsRun::cover() {
  // what one thread is refused, all are
  core_.cover(end_, [this, caller = std::this_thread::get_id()] {
    const std::vector<std::string> refusals = prepare_thread(real_time_);
    if (std::this_thread::get_id() != caller) return;
    for (const std::string& refusal : refusals) note_(refusal);
  });
}

std::vector<HangingTask> ThreadsRun::running() const {
  std::optional<HangingTask> task = core_.running();
  return task ? std::vector{std::move(*task)} : std::vector<HangingTask>();
}

}  // namespace jarol
