#include "tools/log_reader.h"

#include <algorithm>

#include "graph/values/pack.h"

namespace jarol::tools {
namespace {

constexpr std::size_t longest_header = std::size_t{64} << 20;
constexpr std::uint32_t largest_record = std::uint32_t{1} << 20;  // beyond what a recorder takes

}  // namespace

LogReader::LogReader(std::string path) : path_(std::move(path)), file_(path_, std::ios::binary) {
  if (!file_) throw LogError("can't read '" + path_ + "': " + std::strerror(errno));
  std::string line;
  for (char c; line.size() < longest_header && file_.get(c) && c != '\n';) line += c;
  try {
    header_ = parse_header(line);
  } catch (const LogError& error) { fail(std::string(error.what()) + "; one comes from jarol run --log"); }
  first_ = file_.tellg();
  Duration newest{};
  while (next()) {
    if (record_.output == LogRecord::end) {
      std::memcpy(&end_.emplace(), bytes_.data(), sizeof(LogEnd));
    } else if (record_.output == LogRecord::miss) {
      std::memcpy(&misses_.emplace_back(), bytes_.data(), sizeof(Miss));
    } else {
      ++values_;
      newest = Duration(record_.instant);
    }
  }
  covered_ = end_ ? Duration(end_->covered) : newest;
  file_.clear();
  if (!end_) breaks_off_ = good_until_;
}

// False at the end, or where the log breaks off.
bool LogReader::next() {
  has_record_ = false;
  good_until_ = file_.tellg();
  if (end_ && graph_ == nullptr) return false;
  if (!file_.read(reinterpret_cast<char*>(&record_), sizeof record_) || record_.size > largest_record) return false;
  bytes_.resize(record_.size);
  if (!file_.read(bytes_.data(), record_.size) || LogRecord::sum_of(record_, bytes_) != record_.sum) return false;
  const std::uint32_t due = record_.output == LogRecord::end    ? sizeof(LogEnd)
                            : record_.output == LogRecord::miss ? sizeof(Miss)
                                                                : record_.size;
  const bool known = record_.output >= LogRecord::end || record_.output < header_.inputs.size();
  return has_record_ = known && record_.size == due;
}

std::vector<Miss> LogReader::begin(const Graph& graph) {
  graph_ = &graph;
  communicators_.clear();
  const std::vector<std::size_t> inputs = logged_inputs(graph);
  for (const LogHeader::Input& logged : header_.inputs) {
    const auto at = std::find_if(inputs.begin(), inputs.end(),
                                 [&](std::size_t i) { return graph.communicators[i].name == logged.name; });
    if (at == inputs.end())
      fail("has values of '" + logged.name + "', which takes none in graph '" + graph.name +
           "'; replay the graph of the run");
    if (signature_of(*graph.communicators[*at].type) != logged.signature)
      fail("has values of '" + logged.name + "' of another type than graph '" + graph.name +
           "'; replay the graph of the run");
    communicators_.push_back(*at);
  }
  for (const std::size_t i : inputs)
    if (std::find(communicators_.begin(), communicators_.end(), i) == communicators_.end())
      fail("has no values of '" + graph.communicators[i].name + "', which graph '" + graph.name +
           "' takes; replay the graph of the run");
  std::vector<Miss> misses = misses_;
  for (Miss& miss : misses) {
    const std::string name = miss.task < header_.tasks.size() ? header_.tasks[miss.task] : "";
    const auto task =
        std::find_if(graph.tasks.begin(), graph.tasks.end(), [&](const Task& t) { return t.name == name; });
    if (task == graph.tasks.end())
      fail("says that task '" + name + "' was late, which graph '" + graph.name +
           "' does not have; replay the graph of the run");
    miss.task = static_cast<std::uint32_t>(task - graph.tasks.begin());
  }
  file_.clear();
  file_.seekg(first_);
  while (next() && record_.output >= header_.inputs.size()) {}
  return misses;
}

bool LogReader::take(Duration instant, std::size_t communicator, void* value) {
  throw_if_before(instant);
  if (!has_record_ || Duration(record_.instant) != instant || communicators_[record_.output] != communicator)
    return false;
  unpack(*graph_->communicators[communicator].type, reinterpret_cast<const std::byte*>(bytes_.data()), value);
  while (next() && record_.output >= header_.inputs.size()) {}
  return true;
}

void LogReader::require_all_taken() { throw_if_before(covered_); }

void LogReader::throw_if_before(Duration instant) const {
  if (!has_record_ || Duration(record_.instant) >= instant) return;
  fail("has a value of '" + header_.inputs[record_.output].name + "' at " + seconds_text(Duration(record_.instant)) +
       " s, when it takes none in graph '" + graph_->name + "'; replay the graph of the run");
}

void LogReader::fail(const std::string& what) const { throw LogError("'" + path_ + "' " + what); }

}  // namespace jarol::tools
