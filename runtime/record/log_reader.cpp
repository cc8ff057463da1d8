#include "runtime/record/log_reader.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <map>
#include <span>

#include "graph/language/inputs.h"
#include "graph/values/pack.h"

namespace jarol {
namespace {

constexpr std::size_t longest_header = std::size_t{8} << 20;
constexpr std::size_t most_kept = 10'000'000;                     // misses, and checkpoints
constexpr std::uint32_t largest_record = std::uint32_t{1} << 20;  // beyond what a recorder takes

bool is_time(std::int64_t ns) { return ns >= 0 && Duration(ns) <= longest_duration; }

// What can't be so.
std::string wrong_with(const Miss& miss, std::size_t tasks) {
  if (miss.task >= tasks)
    return "a miss of task " + std::to_string(miss.task) + ", and there are " + std::to_string(tasks);
  if (miss.left_out > 1) return "a miss that is neither late nor left out";
  return miss.activation < 0 || miss.ended_after < Miss::unknown ? "a miss at a time below zero" : "";
}

std::string wrong_with(const Checkpoint& checkpoint, const std::vector<Checkpoint>& before) {
  if (checkpoint.exact > 1) return "a checkpoint that is neither exact nor not";
  if (!is_time(checkpoint.settled)) return "a checkpoint at no time of a run";
  return !before.empty() && checkpoint.settled < before.back().settled ? "a checkpoint before the one before it" : "";
}

std::string wrong_with(const RestBegin& rest, bool has_begun) {
  if (!is_time(rest.begun)) return "a way to rest from no time of a run on";
  return has_begun ? "a second way to rest" : "";
}

std::string wrong_with(const LogEnd& end, const std::vector<Checkpoint>& before) {
  if (!is_time(end.covered) || !is_time(end.simulated)) return "an end at no time of a run";
  return !before.empty() && end.covered < before.back().settled ? "an end before its last checkpoint" : "";
}

}  // namespace

LogReader::LogReader(std::string path) : path_(std::move(path)) {
  std::error_code none;
  const auto status = std::filesystem::status(path_, none);
  if (std::filesystem::exists(status) && !std::filesystem::is_regular_file(status))
    fail("is no regular file, and a log is read twice; give a file");
  file_.open(path_, std::ios::binary);
  if (!file_) throw LogError("can't read '" + path_ + "': " + std::strerror(errno));
  note_input(path_);
  std::string line;
  for (char c; line.size() < longest_header && file_.get(c);) {
    line += c;
    if (c == '\n') break;
  }
  try {
    header_ = parse_header(line);
  } catch (const LogError& error) { fail(std::string(error.what()) + "; one comes from jarol run --log"); }
  for (const std::string& set : header_.overrides.set)
    if (names_plugins(set))
      fail("sets '" + set + "', and a log names no code to load; it is no log that jarol run --log has written");
  file_.read(reinterpret_cast<char*>(&record_), sizeof record_);
  if (record_.sum != LogRecord::sum_of(record_, line)) fail("is damaged in its first line, and can't be replayed");
  first_ = file_.tellg();
  while (!end_) {
    good_until_ = file_.tellg();
    if (!next()) break;
    keep();
  }
  if (end_) require_nothing_more();
}

// What follows its end may be another log, or what else somebody has added: it is not what the run was.
void LogReader::require_nothing_more() {
  const std::int64_t end = file_.tellg();
  file_.seekg(0, std::ios::end);
  const std::int64_t more = file_.tellg() - std::streamoff(end);
  if (more == 0) return;
  fail("goes on for " + std::to_string(more) + (more == 1 ? " byte" : " bytes") +
       " after its end; what was logged is: head -c " + std::to_string(end) + " " + path_);
}

// Of a record that is whole: what no run writes was made, and is refused.
void LogReader::keep() {
  const auto take = [&](auto value, const auto&... context) {
    if (bytes_.size() != sizeof value)
      fail_in_record(std::to_string(bytes_.size()) + " bytes where there are " + std::to_string(sizeof value));
    std::memcpy(&value, bytes_.data(), sizeof value);
    if (const std::string wrong = wrong_with(value, context...); !wrong.empty()) fail_in_record(wrong);
    return value;
  };
  switch (record_.output) {
    case LogRecord::end: end_ = take(LogEnd{}, checkpoints_); return;
    case LogRecord::miss: misses_.push_back(take(Miss{}, header_.tasks.size())); break;
    case LogRecord::rest: rest_begun_ = Duration(take(RestBegin{}, rest_begun_.has_value()).begun); break;
    case LogRecord::checkpoint: checkpoints_.push_back(take(Checkpoint{}, checkpoints_)); break;
    default:
      if (record_.output >= header_.inputs.size()) fail_in_record("what is of no known kind");
      if (!is_time(record_.instant) || record_.instant < last_value_)
        fail_in_record("a value of '" + header_.inputs[record_.output].name + "' before the one before it");
      last_value_ = record_.instant;
      ++values_;
  }
  if (misses_.size() > most_kept || checkpoints_.size() > most_kept)
    fail("has more than " + std::to_string(most_kept) + " misses or checkpoints; log a shorter run");
}

// False at the end, or where the log breaks off.
bool LogReader::next() {
  has_record_ = false;
  at_ = file_.tellg();
  if (!file_.read(reinterpret_cast<char*>(&record_), sizeof record_) || record_.size > largest_record) return false;
  bytes_.resize(record_.size);
  return has_record_ = file_.read(bytes_.data(), record_.size) && LogRecord::sum_of(record_, bytes_) == record_.sum;
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
  std::map<std::string_view, std::uint32_t> tasks;
  for (std::uint32_t i = 0; i < graph.tasks.size(); ++i) tasks.emplace(graph.tasks[i].name, i);
  std::vector<Miss> misses = misses_;
  for (Miss& miss : misses) {
    const std::string& name = header_.tasks[miss.task];
    const auto task = tasks.find(name);
    if (task == tasks.end()) fail_for_graph("says that task '" + name + "' was late, which is not in");
    miss.task = task->second;
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
  const Type& type = *graph_->communicators[communicator].type;
  const std::span<const std::byte> packed(reinterpret_cast<const std::byte*>(bytes_.data()), bytes_.size());
  if (const std::string wrong = wrong_packed(type, packed); !wrong.empty())
    fail_in_record("a value of '" + header_.inputs[record_.output].name + "' that " + wrong);
  unpack(type, packed.data(), value);
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

void LogReader::fail_in_record(const std::string& what) const {
  fail("has at byte " + std::to_string(at_) + " " + what + "; it is no log that jarol run --log has written");
}

void LogReader::fail(const std::string& what) const { throw LogError("'" + path_ + "' " + what); }

}  // namespace jarol
