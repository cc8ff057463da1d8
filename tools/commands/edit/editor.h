// The editor of a graph's file: what pages ask for, and the server that they are at.
#pragma once

#include <chrono>
#include <memory>
#include <mutex>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "tools/commands/edit/graph_file.h"
#include "tools/commands/edit/trial.h"
#include "tools/commands/edit/worker.h"
#include "tools/console/server.h"

namespace jarol::tools::edit {

struct EditorOptions {
  std::string file;
  std::string program;       // jarol, for runs in simulation
  std::string profile;       // that pages begin with; empty: none
  std::string no_plugins{};  // why plugins are refused; empty: they are not
  console::ServerOptions server{};
};

class Editor {
 public:
  /// Throws what GraphFile::read and the server throw.
  explicit Editor(EditorOptions options);
  ~Editor();
  Editor(const Editor&) = delete;
  Editor& operator=(const Editor&) = delete;

  const std::string& url() const { return server_->url(); }

  /// Of a text that a page sends, escapes included.
  static constexpr std::size_t max_message = std::size_t{16} << 20;
  /// Of answers that a page does not take.
  static constexpr std::size_t max_answers = std::size_t{64} << 20;

 private:
  using Clock = std::chrono::steady_clock;

  std::string answer(std::uint64_t page, const std::string& message);
  void judge(std::uint64_t page, const nlohmann::json& json);
  std::string save(const std::string& text, const std::string& over);
  void run(const nlohmann::json& json);
  void say_of_trial(std::string state);
  void send(std::uint64_t page, std::string message);
  std::vector<std::string> next_messages();

  const EditorOptions options_;
  const GraphFile file_;
  std::mutex mutex_;                  // of what stands below
  std::vector<std::string> plugins_;  // of the file as it was opened
  std::string seen_;                  // hash of the file when it was looked at last
  Clock::time_point looked_{};
  std::vector<std::string> messages_;  // for all pages
  std::string trial_state_;            // the last message of the newest trial; empty: there was none
  std::string stamp_;                  // size and time of the file then

  std::unique_ptr<Trial> trial_;             // on the server's thread
  Worker suggesting_, drawing_, judging_;    // the last one asks the first
  std::unique_ptr<console::Server> server_;  // gone first
};

}  // namespace jarol::tools::edit
