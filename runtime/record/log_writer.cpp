#include "runtime/record/log_writer.h"

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <utility>

#include "graph/values/pack.h"
#include "runtime/files/sync.h"
#include "runtime/files/whole_file.h"

namespace jarol {
namespace {

// Nothing that somebody would miss: no regular file, an empty one, or a log.
bool may_be_replaced(const std::string& path) {
  std::error_code none;
  if (!std::filesystem::is_regular_file(path, none) || std::filesystem::file_size(path, none) == 0) return true;
  std::string begin(to_line({}).find(','), '\0');
  std::ifstream(path, std::ios::binary).read(begin.data(), static_cast<std::streamsize>(begin.size()));
  return to_line({}).starts_with(begin);
}

}  // namespace

LogWriter::LogWriter(std::string path, LogHeader header, const Graph& graph)
    : path_(std::move(path)), outputs_(log_outputs(graph)) {
  for (const std::size_t i : logged_inputs(graph))
    header.inputs.push_back({graph.communicators[i].name, signature_of(*graph.communicators[i].type)});
  for (const Task& task : graph.tasks) header.tasks.push_back(task.name);
  line_ = to_line(header);
  recorder_ = std::make_unique<Recorder>(std::vector<RecordSink*>{this});
}

LogWriter::~LogWriter() {
  recorder_.reset();
  if (file_ != nullptr) std::fclose(file_);
}

void LogWriter::open() {
  require_no_input(path_);
  lock_ = OutputLock(target_of(path_));
  if (!may_be_replaced(path_)) fail("it is there and no log; choose another file, or remove it");
  file_ = std::fopen(path_.c_str(), "wb");
  if (file_ == nullptr || std::fwrite(line_.data(), 1, line_.size(), file_) != line_.size()) fail(std::strerror(errno));
  append(Duration{}, LogRecord::header, line_.data(), 0);
  pause();
}

void LogWriter::close(const LogEnd& end) {
  recorder_->close();
  append(Duration(end.covered), LogRecord::end, &end, sizeof end);
  // what is in the buffer goes out here at the latest, so that a full disk shows
  if (!sync(file_)) fail(std::strerror(errno));
  if (std::fclose(std::exchange(file_, nullptr)) != 0) fail(std::strerror(errno));
  sync_folder_of(path_);
}

void LogWriter::take(Duration instant, std::uint32_t output, const void* value) {
  switch (outputs_.size() - output) {
    case 3: return append(instant, LogRecord::miss, value, sizeof(Miss));
    case 2: return append(instant, LogRecord::checkpoint, value, sizeof(Checkpoint));
    case 1: return append(instant, LogRecord::rest, value, sizeof(RestBegin));
    default: break;
  }
  const Type& type = *outputs_[output].type;
  packed_.resize(packed_size(type, value));
  pack(type, value, reinterpret_cast<std::byte*>(packed_.data()));
  append(instant, output, packed_.data(), packed_.size());
}

// The first one stands for the header's line.
void LogWriter::append(Duration instant, std::uint32_t output, const void* bytes, std::size_t size) {
  LogRecord record{instant.count(), output, static_cast<std::uint32_t>(size), 0};
  record.sum =
      LogRecord::sum_of(record, output == LogRecord::header ? std::string_view(line_)
                                                            : std::string_view(static_cast<const char*>(bytes), size));
  if (std::fwrite(&record, sizeof record, 1, file_) != 1 || std::fwrite(bytes, 1, size, file_) != size)
    fail(std::strerror(errno));
}

void LogWriter::pause() {
  if (std::fflush(file_) != 0) fail(std::strerror(errno));
}

void LogWriter::fail(const std::string& reason) const {
  throw std::runtime_error("can't write '" + path_ + "': " + reason);
}

}  // namespace jarol
