// A text that is edited, run in simulation: by jarol run in a process of its own, so that whatever the graph does, the
// editor goes on.
#pragma once

#include <chrono>
#include <functional>
#include <string>
#include <thread>

#include "distributers/links/descriptor.h"

namespace jarol::tools::edit {

struct TrialOptions {
  std::string file{};                 // of the graph: paths in the text are relative to its folder
  std::string text{};                 // what is run
  std::string profile{};              // empty: none
  std::string length{};               // of logical time, as in "10s"; empty: to the end of the mission
  bool watched = false;               // on a page of its own
  std::string listen = "127.0.0.1";   // of that page
  std::chrono::seconds longest{120};  // on the wall clock, but for one that is watched
};

struct TrialEnd {
  int exit_code = 0;   // minus the signal that ended it
  bool ended = false;  // by whoever asked, or as it took too long
  std::string text;    // all that it printed, the last 256 kB
};

/// Throws InputError for a length or profile that is none.
void require_sound(const TrialOptions& options);

class Trial {
 public:
  /// `page`: where it is watched; `end` once it has ended. Both are called by a thread of the trial's own. `program` is
  /// jarol. Throws what require_sound throws.
  Trial(const std::string& program, const TrialOptions& options, std::function<void(const std::string& url)> page,
        std::function<void(const TrialEnd& end)> end);
  /// Ends it.
  ~Trial();
  Trial(const Trial&) = delete;
  Trial& operator=(const Trial&) = delete;

  /// As Ctrl-C does; what does not end then is killed.
  void stop();

  static constexpr std::size_t max_text = std::size_t{256} << 10;

 private:
  void run(const std::string& program, const TrialOptions& options);
  bool show_page(const std::string& text);

  std::function<void(const std::string&)> page_;
  std::function<void(const TrialEnd&)> end_;
  distributers::Interrupter stop_;
  std::thread thread_;
};

}  // namespace jarol::tools::edit
