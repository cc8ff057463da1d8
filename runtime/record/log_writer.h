// Writes the log of a run while it goes on.
#pragma once

#include <cstdio>
#include <memory>
#include <string>
#include <vector>

#include "runtime/files/output_lock.h"
#include "runtime/record/log.h"
#include "runtime/record/log_format.h"
#include "runtime/record/recorder.h"

namespace jarol {

class LogWriter : private RecordSink {
 public:
  /// `header` without inputs and tasks, which are the graph's.
  LogWriter(std::string path, LogHeader header, const Graph& graph);
  ~LogWriter() override;
  LogWriter(const LogWriter&) = delete;
  LogWriter& operator=(const LogWriter&) = delete;

  /// For ExecutorOptions::log.
  Recorder* recorder() { return recorder_.get(); }

  /// Before the run, when nothing else stands against it: makes the file, or replaces a log. Throws std::runtime_error,
  /// "can't write 'path': reason".
  void open();

  /// After the run. Throws std::runtime_error if anything could not be written.
  void close(const LogEnd& end);

 private:
  void take(Duration instant, std::uint32_t output, const void* value) override;
  void pause() override;
  void finish() override {}
  void append(Duration instant, std::uint32_t output, const void* bytes, std::size_t size);
  [[noreturn]] void fail(const std::string& reason) const;

  std::string path_;
  std::string line_;             // the header
  std::vector<Output> outputs_;  // of the recorder
  std::string packed_;
  OutputLock lock_;
  std::FILE* file_ = nullptr;
  std::unique_ptr<Recorder> recorder_;
};

}  // namespace jarol
