#include <fmt/format.h>

#include <algorithm>
#include <iostream>
#include <map>
#include <nlohmann/json.hpp>

#include "graph/text/escape.h"
#include "runtime/record/differences.h"
#include "runtime/record/instants.h"
#include "runtime/record/recorded_run.h"
#include "tools/commands/log/break_note.h"
#include "tools/commands/log/log_commands.h"
#include "tools/commands/log/recorded_graph.h"
#include "tools/report/differences_report.h"
#include "tools/report/exit_code.h"
#include "tools/report/json_line.h"

namespace jarol::tools {
namespace {

// Topics of both with one schema; what only one has, or has otherwise, is a difference, or left out.
struct Common {
  std::vector<bool> a = std::vector<bool>(65536), b = std::vector<bool>(65536);
  std::map<std::string, MessageLayout> layouts;
  std::vector<std::string> apart;     // sentences
  std::vector<std::string> left_out;  // likewise
};

// What was published, came from outside, and where vehicles truly were.
bool is_compared(const ReadTopic& topic) {
  const std::string& name = topic.channel.topic;
  return !topic.is_own() || name.starts_with(topics::taken) || name.starts_with(topics::truth);
}

Common common_of(const Recording& a, const Recording& b) {
  Common common;
  for (const auto& [id, topic] : a.topics()) {
    if (!is_compared(topic)) continue;
    const ReadTopic* const other = b.find(topic.channel.topic);
    if (other == nullptr) {
      common.apart.push_back("'" + topic.channel.topic + "' is only in A");
    } else if (other->schema != topic.schema) {
      common.apart.push_back("'" + topic.channel.topic + "' has another type in B");
    } else {
      common.a[id] = common.b[other->channel.id] = true;
      common.layouts.emplace(topic.channel.topic, MessageLayout(topic));
    }
  }
  for (const auto& [id, topic] : b.topics())
    if (is_compared(topic) && a.find(topic.channel.topic) == nullptr)
      common.apart.push_back("'" + topic.channel.topic + "' is only in B");
  return common;
}

// Which of them are not whole, and where they end.
std::map<std::string, std::string> breaks_of(const Recording& a, const Recording& b) {
  std::map<std::string, std::string> breaks;
  if (!a.is_whole()) breaks.emplace("A", a.text_of_break());
  if (!b.is_whole()) breaks.emplace("B", b.text_of_break());
  return breaks;
}

// The first that the other has not; empty: there is none.
std::string find_other_event(const RecordedEvents& a, const RecordedEvents& b, const LogOptions& options) {
  const auto within = [&](const TimedEvent& e) { return e.instant >= options.from && e.instant < options.until; };
  const auto text = [](const TimedEvent& e, const char* where) {
    const std::string what =
        e.kind == RunEvent::Kind::fault ? "a fault of '" + e.task + "', " + e.cause + "," : words_of(e);
    return "at " + seconds_text(e.instant) + " s: " + what + " only in " + where;
  };
  auto in_a = a.events.begin(), in_b = b.events.begin();
  for (;; ++in_a, ++in_b) {
    in_a = std::find_if(in_a, a.events.end(), within);
    in_b = std::find_if(in_b, b.events.end(), within);
    const bool no_a = in_a == a.events.end(), no_b = in_b == b.events.end();
    if (no_a && no_b) return "";
    if (no_b || (!no_a && *in_a < *in_b)) return text(*in_a, "A");
    if (no_a || *in_b < *in_a) return text(*in_b, "B");
  }
}

// What the runs came to, of which a recording may hold more than the values: its digest is of all that was published.
std::vector<std::string> find_other_ends(const Recording& a, const Recording& b) {
  const std::optional<LogEnd> was = find_end(a), is = find_end(b);
  std::vector<std::string> apart;
  if (!was || !is) return apart;  // one breaks off, which is said
  const auto compare = [&](const char* what, std::uint64_t in_a, std::uint64_t in_b) {
    if (in_a != in_b) apart.push_back(fmt::format("at the end: {} {} in A, {} in B", what, in_a, in_b));
  };
  if (was->digest != is->digest)
    apart.push_back(fmt::format("at the end: digest 0x{:016x} in A, 0x{:016x} in B", was->digest, is->digest));
  compare("activations", was->activations, is->activations);
  compare("faults", was->faults, is->faults);
  return apart;
}

// The first of the digests on their way that differs, which are of all that was published; empty: none does.
std::string find_other_digest(const Recording& a, const Recording& b, Duration until) {
  const std::vector<RunningDigest> was = read_digests(a), is = read_digests(b);
  auto now = is.begin();
  for (const RunningDigest& before : was) {
    if (before.exact == 0 || Duration(before.settled) > until) continue;
    now = std::find_if(now, is.end(),
                       [&](const RunningDigest& other) { return other.exact != 0 && other.settled >= before.settled; });
    if (now == is.end()) break;
    if (now->settled == before.settled && now->digest != before.digest)
      return fmt::format("at {} s: digest 0x{:016x} in A, 0x{:016x} in B", seconds_text(Duration(before.settled)),
                         before.digest, now->digest);
  }
  return "";
}

// Goes through two instants that are one, by name.
void compare_instant(Duration instant, const std::vector<RecordedInstants::Message>& was,
                     const std::vector<RecordedInstants::Message>& is, const Common& common, Differences& differences) {
  auto w = was.begin();
  auto i = is.begin();
  while (w != was.end() || i != is.end()) {
    const int order = w == was.end()  ? 1
                      : i == is.end() ? -1
                                      : w->topic->channel.topic.compare(i->topic->channel.topic);
    const std::string& name = (order <= 0 ? w : i)->topic->channel.topic;
    std::string_view before, now;
    if (order <= 0) before = w->data;
    if (order >= 0) now = i->data;
    differences.compare(instant, name, common.layouts.at(name), order <= 0 ? &before : nullptr,
                        order >= 0 ? &now : nullptr);
    if (order <= 0) ++w;
    if (order >= 0) ++i;
  }
}

// What is apart beside values: of whole runs.
void compare_runs(const Recording& a, const Recording& b, const LogOptions& options, bool all,
                  std::vector<std::string>& apart) {
  if (std::string text = find_other_event(read_events(a), read_events(b), options); !text.empty())
    apart.push_back(std::move(text));
  if (all)
    for (std::string& text : find_other_ends(a, b)) apart.push_back(std::move(text));
  if (options.from <= Duration{})
    if (std::string text = find_other_digest(a, b, options.until); !text.empty()) apart.push_back(std::move(text));
}

}  // namespace

int log_diff(const LogOptions& options) {
  const Recording a(options.file), b(options.other);
  note_rest(a, options.file);
  note_rest(b, options.other);
  note_gaps(a, options.file);
  note_gaps(b, options.other);
  Common common = common_of(a, b);
  if (options.common) common.left_out.swap(common.apart);
  Differences differences;
  RecordedInstants was(a, common.a, options.from), is(b, common.b, options.from);
  const std::vector<RecordedInstants::Message> none;
  bool more_was = was.next(), more_is = is.next();
  while (more_was || more_is) {
    const Duration instant = !more_was  ? is.instant()
                             : !more_is ? was.instant()
                                        : std::min(was.instant(), is.instant());
    if (instant >= options.until) break;
    const bool in_was = more_was && was.instant() == instant, in_is = more_is && is.instant() == instant;
    compare_instant(instant, in_was ? was.messages() : none, in_is ? is.messages() : none, common, differences);
    if (in_was) more_was = was.next();
    if (in_is) more_is = is.next();
  }
  const bool all = options.from <= Duration{} && options.until == Duration::max();
  const bool ends = !options.common && all && find_end(a) && find_end(b);
  if (!options.common) compare_runs(a, b, options, all, common.apart);
  const auto breaks = breaks_of(a, b);
  const bool same = !differences.first() && common.apart.empty();
  // two recordings of inputs alone are compared by their ends
  const bool nothing = same && differences.compared() == 0 && !ends;
  if (options.json) {
    auto json = json_of(differences);
    json["schema"] = "jarol.log_diff/1";
    json["verdict"] = nothing ? "nothing_compared" : !same ? "different" : breaks.empty() ? "same" : "same_so_far";
    json["apart"] = common.apart;
    if (options.common) json["left_out"] = common.left_out;
    json["breaks_off"] = nlohmann::ordered_json::object();
    for (const auto& [name, where] : breaks) json["breaks_off"][name] = where;
    std::cout << json_line(json);
  } else {
    if (nothing)
      std::cout << "NOTHING TO COMPARE: " << (options.common ? "no topic of both has values" : "both have no values")
                << (all ? "" : " in that time") << "\n";
    if (same && !nothing)
      std::cout << fmt::format("the same, {} values{}{}\n", differences.compared(),
                               options.common ? " of topics that both have" : "",
                               breaks.empty() ? "" : ", as far as both go");
    if (!same) std::cout << fmt::format("DIFFERENT, {} values compared\n", differences.compared());
    std::cout << text_of(differences);
    for (const std::string& text : common.apart) std::cout << "  apart       " << printable(text) << "\n";
    for (const std::string& text : common.left_out) std::cout << "  left out    " << printable(text) << "\n";
    for (const auto& [name, where] : breaks)
      std::cout << fmt::format("  breaks off  {} {}; what it lacks after that counts as different\n", name,
                               printable(where));
  }
  if (nothing) return exit_input;
  return same && breaks.empty() ? exit_good : exit_negative;
}

}  // namespace jarol::tools
