// The command as a process beside the test, that can be killed.
#pragma once

#include <sys/types.h>

#include <chrono>
#include <functional>
#include <mutex>
#include <nlohmann/json.hpp>
#include <string>
#include <thread>

namespace jarol::tests {

class Process {
 public:
  /// Runs `jarol ARGUMENTS` in the root of the tree.
  explicit Process(const std::string& arguments);
  /// Kills it, if it still runs.
  ~Process();
  Process(const Process&) = delete;
  Process& operator=(const Process&) = delete;

  pid_t id() const { return id_; }
  /// As a crash or a loss of power ends it: it does not get to say anything.
  void kill();
  /// As Ctrl-C ends it.
  void interrupt();
  void signal(int number);
  /// False once it has ended; before `end` is called.
  bool runs();
  /// Waits until its errors, or notes, have this. False if it does not come.
  bool says(const std::string& text, std::chrono::seconds patience = std::chrono::seconds(20));
  /// Waits likewise until its errors have a line with this, and is what stands behind it there; empty: it does not
  /// come.
  std::string rest_of_line(const std::string& text, std::chrono::seconds patience = std::chrono::seconds(20));
  /// Waits for its end; its exit code, or minus the signal that ended it.
  int end();

  /// After the end: what it printed, and as JSON.
  const std::string& output() const { return output_; }
  const std::string& errors() const { return errors_; }
  nlohmann::json json() const { return nlohmann::json::parse(output_); }

 private:
  void read(int fd, std::string& to);
  bool await(std::chrono::seconds patience, const std::function<bool()>& there);

  pid_t id_ = -1;
  int exit_code_ = 0;
  std::mutex mutex_;
  std::string output_, errors_;
  std::thread out_, err_;
};

/// A port that was free a moment ago, for UDP or TCP; none that the system gives to whoever asks for any, nor that
/// another process of tests has just got.
std::string free_port(int type);

}  // namespace jarol::tests
