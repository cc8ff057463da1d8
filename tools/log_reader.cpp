#include "tools/log_reader.h"

#include <algorithm>
#include <cerrno>
#include <cstring>

#include "graph/values/pack.h"

namespace jarol::tools {
namespace {

constexpr std::size_t longest_header = std::size_t{64} << 20;
constexpr std::uint32_t largest_record = std::uint32_t{1} << 20;  // beyond what a recorder takes

// Of a record that is no input's.
std::uint32_t size_of(std::uint32_t kind) {
  if (kind == LogRecord::miss) return sizeof(Miss);
  if (kind == LogRecord::checkpoint) return sizeof(Checkpoint);
  return kind == LogRecord::end ? sizeof(LogEnd) : 0;
}

template <class T>
T from_bytes(const std::string& bytes) {
  T value;
  std::memcpy(&value, bytes.data(), sizeof value);
  return value;
}

}  // namespace

LogReader::LogReader(std::string path) : path_(std::move(path)), file_(path_, std::ios::binary) {
  if (!file_) throw LogError("can't read '" + path_ + "': " + std::strerror(errno));
  std::string line;
  for (char c; line.size() < longest_header && file_.get(c);) {
    line += c;
    if (c == '\n') break;
  }
  try {
    header_ = parse_header(line);
  } catch (const LogError& error) { fail(std::string(error.what()) + "; one comes from jarol run --log"); }
  file_.read(reinterpret_cast<char*>(&record_), sizeof record_);
  if (record_.sum != LogRecord::sum_of(record_, line)) fail("is damaged in its first line, and can't be replayed");
  first_ = file_.tellg();
  if (first_ < 0) fail("can't be read twice, as a pipe can't; give a file");
  while (!end_) {
    good_until_ = file_.tellg();
    if (!next()) break;
    switch (record_.output) {
      case LogRecord::end: end_ = from_bytes<LogEnd>(bytes_); break;
      case LogRecord::miss: misses_.push_back(from_bytes<Miss>(bytes_)); break;
      case LogRecord::checkpoint: checkpoints_.push_back(from_bytes<Checkpoint>(bytes_)); break;
      default: ++values_;
    }
  }
}

// False at the end, or where the log breaks off.
bool LogReader::next() {
  has_record_ = false;
  if (!file_.read(reinterpret_cast<char*>(&record_), sizeof record_) || record_.size > largest_record) return false;
  bytes_.resize(record_.size);
  if (!file_.read(bytes_.data(), record_.size) || LogRecord::sum_of(record_, bytes_) != record_.sum) return false;
  return has_record_ = record_.output < header_.inputs.size() || record_.size == size_of(record_.output);
}

void LogReader::next_value() {
  while (next() && record_.output >= header_.inputs.size()) {}
}

Duration LogReader::covered() const {
  if (end_) return Duration(end_->covered);
  Duration covered{};
  for (const Checkpoint& checkpoint : checkpoints_) covered = std::max(covered, Duration(checkpoint.settled));
  return covered;
}

std::vector<Miss> LogReader::begin(const Graph& graph) {
  graph_ = &graph;
  communicators_.clear();
  const std::vector<std::size_t> inputs = logged_inputs(graph);
  for (const LogHeader::Input& logged : header_.inputs) {
    const auto at = std::find_if(inputs.begin(), inputs.end(),
                                 [&](std::size_t i) { return graph.communicators[i].name == logged.name; });
    if (at == inputs.end()) fail_for_graph("has values of '" + logged.name + "', which takes none in");
    if (signature_of(*graph.communicators[*at].type) != logged.signature)
      fail_for_graph("has values of '" + logged.name + "', which have another type in");
    communicators_.push_back(*at);
  }
  for (const std::size_t i : inputs)
    if (std::find(communicators_.begin(), communicators_.end(), i) == communicators_.end())
      fail_for_graph("has no values of '" + graph.communicators[i].name + "', which takes some in");
  std::vector<Miss> misses = misses_;
  for (Miss& miss : misses) {
    const std::string name = miss.task < header_.tasks.size() ? header_.tasks[miss.task] : "";
    const auto task =
        std::find_if(graph.tasks.begin(), graph.tasks.end(), [&](const Task& t) { return t.name == name; });
    if (task == graph.tasks.end()) fail_for_graph("says that task '" + name + "' was late, which is not in");
    miss.task = static_cast<std::uint32_t>(task - graph.tasks.begin());
  }
  file_.clear();
  file_.seekg(first_);
  next_value();
  return misses;
}

bool LogReader::take(Duration instant, std::size_t communicator, void* value) {
  require_not_before(instant);
  if (!has_record_ || Duration(record_.instant) != instant || communicators_[record_.output] != communicator)
    return false;
  unpack(*graph_->communicators[communicator].type, reinterpret_cast<const std::byte*>(bytes_.data()), value);
  next_value();
  return true;
}

void LogReader::require_all_taken() const { require_not_before(covered()); }

void LogReader::require_not_before(Duration instant) const {
  if (!has_record_ || Duration(record_.instant) >= instant) return;
  fail_for_graph("has a value of '" + header_.inputs[record_.output].name + "' at " +
                 seconds_text(Duration(record_.instant)) + " s, when it takes none in");
}

void LogReader::fail_for_graph(const std::string& what) const {
  fail(what + " graph '" + graph_->name + "'; replay the graph of the run");
}

void LogReader::fail(const std::string& what) const { throw LogError("'" + path_ + "' " + what); }

}  // namespace jarol::tools
