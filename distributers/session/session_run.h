// What a session is made of.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "distributers/session/fed_system.h"
#include "distributers/session/observed.h"
#include "distributers/session/runner.h"
#include "distributers/session/session.h"

namespace jarol {

class Session::Run {
 public:
  Run(const distributers::Registries& known, std::shared_ptr<const Source> source, const SessionOptions& options);
  ~Run();
  Run(const Run&) = delete;
  Run& operator=(const Run&) = delete;

  void run_until(Duration end);
  void feed(std::string_view name, const Type& type, const void* value);
  RunVerdict finish();
  Checkpoint checkpoint();
  void restore(const Checkpoint& checkpoint);

  void watch(const std::string& pattern);

  GraphRun& graph_run() { return runner_->exotasks(); }
  const GraphRun& graph_run() const { return runner_->exotasks(); }

  std::unique_ptr<Observed> observed;

 private:
  void end();
  Loaded feed_in_place_of_links(Loaded loaded, const std::vector<std::string>& patterns);

  DistributerClass without_channel_;  // of communicators that the program feeds
  std::vector<FedSystem*> fed_;       // per distributer, null: it has its link
  bool started_ = false;              // the real clock

  std::optional<Runner> runner_;
  Duration asked_{};  // to which it was to run last
  NoteSink note_;
  std::string over_;  // why no more can be run; empty: it can
  bool finished_ = false;
};

}  // namespace jarol
