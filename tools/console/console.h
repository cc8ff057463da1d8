// A run, or a recording of one, as people see it on a page: what joins its feed, its pace and the server.
#pragma once

#include <memory>
#include <mutex>
#include <optional>
#include <string>

#include "distributers/session/pace.h"
#include "tools/console/describe.h"
#include "tools/console/desk.h"
#include "tools/console/feed.h"
#include "tools/console/samples_json.h"
#include "tools/console/server.h"
#include "tools/console/view.h"

namespace jarol::tools::console {

struct Watched {
  Described run;
  ServerOptions server;
  Pace* pace = nullptr;                   // of a run on the virtual clock; outlives the console
  std::vector<DeskOperator> operators{};  // who are at its pages
};

class Console : public View {
 public:
  /// All that is named outlives it. Of each output at most so many samples go to pages in one thirtieth of a second,
  /// and no more than every so manieth.
  explicit Console(Watched watched, std::size_t max_at_once = 64, std::vector<std::uint64_t> strides = {});

  /// Throws also where --console-listen is wrong.
  void open() override;
  const std::string& url() const override { return server_->url(); }
  Feed& feed() override { return feed_; }
  void end(const std::string& text) override;

 private:
  std::vector<std::string> next_messages();
  std::string answer(const Page& page, const std::string& message);

  const Watched watched_;
  Feed feed_;
  const SamplesJson samples_;
  const std::vector<std::string> tasks_;  // names
  Desk desk_;                             // on the server's thread
  std::mutex mutex_;
  std::optional<std::string> ended_;  // and is not said yet
  std::uint64_t thinned_ = 0;
  Duration now_{};  // the newest instant that anything is known of
  std::optional<std::pair<Duration, Pace::State>> shown_;
  std::unique_ptr<Server> server_;  // last: its thread calls what stands above
};

/// What a page may ask for, as in {"do": "pause"}. Throws InputError.
void obey(Pace& pace, const std::string& message);

}  // namespace jarol::tools::console
