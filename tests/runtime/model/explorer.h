// Runs a small program of threads in every order of its steps, and with every value that C++ lets a load return, short
// of values from stores that come later in that order (load buffering). Threads are fibres; each operation on shared
// memory is a step. States that were met before are not gone through again.
// Memory: views and messages, as in Kang et al., "A promising semantics for relaxed-memory concurrency", 2017, without
// the promises; release sequences are those of C++20. No fences;
// and an exchange that fails sees the newest value.
#pragma once

#include <ucontext.h>

#include <atomic>
#include <functional>
#include <optional>
#include <string>
#include <unordered_set>
#include <vector>

#include "graph/build_options.h"
#include "tests/runtime/model/view.h"

namespace jarol::model {

/// The thread sanitizer does not know fibres.
constexpr bool available = options_of_this_file().thread_sanitizer == 0;

struct Program {
  std::vector<std::function<void()>> threads;
  std::function<void()> at_end;  // sees all that the threads did
};

struct Result {
  std::uint64_t executions = 0;
  std::uint64_t states = 0;
  std::string failure;  // of the first execution that failed, with its steps
};

/// `make` makes the program and all it works on afresh for each execution.
Result explore(const std::function<Program()>& make);

/// For programs: what does not hold ends the exploration.
void check(bool holds, const std::string& text);

/// An event of the thread that calls; does it happen before what the calling thread does now?
struct Event {
  std::size_t thread = 0;
  std::uint16_t number = 0;
};
Event event();
bool happened(const Event& event);

/// Lets the time of the model pass.
void set_time(std::int64_t time);
std::int64_t time();

class Explorer {
 public:
  static Explorer& current();

  std::size_t new_place(std::uint64_t value);
  std::uint64_t load(std::size_t place, std::memory_order order);
  void store(std::size_t place, std::uint64_t value, std::memory_order order);
  std::uint64_t change(std::size_t place, const std::function<std::uint64_t(std::uint64_t)>& f,
                       std::memory_order order);
  bool compare_exchange(std::size_t place, std::uint64_t& expected, std::uint64_t value, std::memory_order success,
                        std::memory_order failure);
  void plain(const void* at, bool writes);
  bool wait(std::size_t place, std::uint64_t old, std::optional<std::int64_t> deadline);
  void wake_all(std::size_t place);

 private:
  friend Result explore(const std::function<Program()>& make);
  friend void check(bool holds, const std::string& text);
  friend Event event();
  friend bool happened(const Event& event);
  friend void set_time(std::int64_t time);
  friend std::int64_t time();

  struct Message {
    std::uint64_t value;
    View view;
    std::uint64_t hash;
  };
  struct Plain {
    const void* at;
    Event writer;
    std::array<std::uint16_t, max_threads> readers;
  };
  enum class Status { runs, waits, done };
  struct Thread {
    View now;  // what happened before
    Status status = Status::runs;
    std::size_t place = 0;                 // on which it waits
    std::optional<std::int64_t> deadline;  // until when
    bool in_time = true;
    std::uint64_t history = 0;  // of all that it got: it is a function of that
    ucontext_t context{};
  };
  struct Step {
    std::size_t thread;
    const char* what;
    std::size_t place;
    std::uint64_t value;
  };
  struct Choice {
    std::size_t chosen;
    std::size_t count;
  };

  bool run(const std::function<Program()>& make);
  bool next_path();
  static void enter();
  void step();
  void switch_to(std::size_t thread);
  std::size_t pick();
  std::size_t choose(std::size_t count);
  std::uint64_t state() const;
  void fail(const std::string& text);
  void note(const char* what, std::size_t place, std::uint64_t value);
  void see(std::size_t place, std::size_t message, std::memory_order order);
  void add(std::size_t place, std::uint64_t value, std::memory_order order, const View* before);
  Thread& self() { return threads_[running_]; }

  std::vector<Choice> path_;
  std::size_t depth_ = 0;
  bool known_ = false;  // this execution only repeats others
  std::unordered_set<std::uint64_t> states_;
  std::string failure_;
  std::array<std::vector<std::byte>, max_threads> stacks_;

  // of one execution
  Program program_;
  std::vector<Thread> threads_;  // the first makes the program and sees its end
  std::size_t running_ = 0;
  bool starting_ = false;
  std::vector<std::vector<Message>> places_;
  std::vector<Plain> plains_;
  std::int64_t time_ = 0;
  std::vector<Step> steps_;
  std::uint64_t count_ = 0;
};

}  // namespace jarol::model
