// What a session is made of.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "distributers/session/fed_channels.h"
#include "distributers/session/linked.h"
#include "distributers/session/observed.h"
#include "distributers/session/session.h"
#include "runtime/execute/expectations.h"

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

  Loaded loaded;
  DistributerClass without_channel;  // of communicators that the program feeds
  std::vector<Channels*> channels;
  std::vector<FedChannels*> fed;  // per distributer, null: it has its link
  std::unique_ptr<Observed> observed;
  std::unique_ptr<Expectations> expectations;
  std::unique_ptr<Recorder> recorder;
  std::unique_ptr<Executor> executor;
  std::optional<Linked> linked;
  std::string over;  // why no more can be run; empty: it can

 private:
  bool finished_ = false;
  void feed_in_place_of_links(const std::vector<std::string>& patterns);
};

}  // namespace jarol
