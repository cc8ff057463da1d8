#include "tools/log_writer.h"

#include <cerrno>
#include <cstring>
#include <utility>

#include "graph/values/pack.h"

namespace jarol::tools {

LogWriter::LogWriter(std::string path, LogHeader header, const Graph& graph)
    : path_(std::move(path)), outputs_(log_outputs(graph)), input_of_(graph.communicators.size()) {
  const std::vector<std::size_t> inputs = logged_inputs(graph);
  for (std::size_t i = 0; i < inputs.size(); ++i) {
    const Communicator& c = graph.communicators[inputs[i]];
    input_of_[inputs[i]] = static_cast<std::uint32_t>(i);
    header.inputs.push_back({c.name, signature_of(*c.type)});
  }
  for (const Task& task : graph.tasks) header.tasks.push_back(task.name);
  file_ = std::fopen(path_.c_str(), "wb");
  if (file_ == nullptr) fail();
  const std::string line = to_line(header);
  if (std::fwrite(line.data(), 1, line.size(), file_) != line.size()) fail();
  recorder_ = std::make_unique<Recorder>(std::vector<RecordSink*>{this});
}

LogWriter::~LogWriter() {
  recorder_.reset();
  if (file_ != nullptr) std::fclose(file_);
}

void LogWriter::close(const Report& report) {
  recorder_->close();
  const LogEnd end{report.covered.count(), report.simulated.count(), report.digest,
                   report.activations,     report.instants,          report.fault_count};
  append(report.covered, LogRecord::end, &end, sizeof end);
  // the buffer goes out on closing, so that a full disk shows here at the latest
  if (std::fclose(std::exchange(file_, nullptr)) != 0) fail();
}

void LogWriter::take(Duration instant, std::uint32_t output, const void* value) {
  if (output == input_of_.size()) return append(instant, LogRecord::miss, value, sizeof(Miss));
  const Type& type = *outputs_[output].type;
  packed_.resize(packed_size(type, value));
  pack(type, value, reinterpret_cast<std::byte*>(packed_.data()));
  append(instant, input_of_[output], packed_.data(), packed_.size());
}

void LogWriter::append(Duration instant, std::uint32_t output, const void* bytes, std::size_t size) {
  LogRecord record{instant.count(), output, static_cast<std::uint32_t>(size), 0};
  record.sum = LogRecord::sum_of(record, {static_cast<const char*>(bytes), size});
  if (std::fwrite(&record, sizeof record, 1, file_) != 1 || std::fwrite(bytes, 1, size, file_) != size) fail();
}

void LogWriter::pause() {
  if (std::fflush(file_) != 0) fail();
}

void LogWriter::fail() const { throw std::runtime_error("can't write '" + path_ + "': " + std::strerror(errno)); }

}  // namespace jarol::tools
