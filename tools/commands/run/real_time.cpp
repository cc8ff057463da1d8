#include "tools/commands/run/real_time.h"

#include <fmt/format.h>
#include <algorithm>
#include <nlohmann/json.hpp>
#include <thread>

#include "graph/language/quantities.h"
#include "graph/text/errors.h"
#include "tools/report/command_line.h"
#include "tools/report/exit_code.h"
#include "tools/report/value_json.h"

namespace jarol::tools {
namespace {

// One CPU or a range of them, as in 2 or 0-3.
void add_cpus(const std::string& part, const std::string& list, std::vector<int>& cpus) {
  const auto number = [&](const std::string& digits) {
    if (digits.empty() || digits.size() > 4 || digits.find_first_not_of("0123456789") != std::string::npos)
      throw InputError("--cpus: '" + list + "' is not a list of CPUs as in 0,2-3");
    return std::stoi(digits);
  };
  const std::size_t dash = part.find('-');
  const int first = number(part.substr(0, dash));
  const int last = dash == std::string::npos ? first : number(part.substr(dash + 1));
  const int count = static_cast<int>(std::thread::hardware_concurrency());
  if (last < first) throw InputError("--cpus: '" + part + "' ends before it begins");
  if (last >= count)
    throw InputError("--cpus: there is no CPU " + std::to_string(last) + "; this machine has 0 to " +
                     std::to_string(count - 1));
  for (int cpu = first; cpu <= last; ++cpu) {
    if (std::find(cpus.begin(), cpus.end(), cpu) != cpus.end())
      throw InputError("--cpus: '" + list + "' names CPU " + std::to_string(cpu) + " twice");
    cpus.push_back(cpu);
  }
}

// The safe value as a graph has it: {signals: [0, 0, 0, 0], unlocked: false}.
std::string value_text(const Communicator& out) {
  std::string text;
  for (const char c : to_json(*out.type, out.safe->data()).dump())
    if (c != '"') text += c == ':' || c == ',' ? std::string(1, c) + " " : std::string(1, c);
  return text;
}

}  // namespace

const RunWords run_words{.priority = "--rt-priority",
                         .cpus = "--cpus",
                         .set = "--set",
                         .force = "--force",
                         .workers = "--workers",
                         .execution = "--execution",
                         .checkpoints = "--record-checkpoints",
                         .end = "--for 100s",
                         .real_clock = "--clock real",
                         .only = "--only",
                         .from = "--from",
                         .graph = "jarol replay LOG FILE"};

void add_real_time_options(Command& command, RealTimeArguments& arguments) {
  command
      .add_option(
          "--rt-priority", arguments.priority,
          "Real clock: SCHED_FIFO priority of the thread that keeps the time, and of tasks where these have no thread "
          "of their "
          "own, else those are below it; default: the ordinary scheduler, but with the policy fixed_priority the "
          "least that leaves one for each thread")
      ->in_range(1, 99);
  command.add_option("--cpus", arguments.cpus,
                     "Real clock: CPUs on which tasks may run, as in 0,2-3, one for each core; default: any");
  command.add_flag("--spin", arguments.spin, "Real clock: wait for the instant without sleeping, at the cost of a CPU");
  command.add_flag("--force", arguments.force, "Real clock: run also what check has a negative verdict on");
  command.add_flag("--no-guardian", arguments.no_guardian,
                   "Real clock: no process beside this one that hands over 'safe' after a crash or kill -9");
}

RealTimeOptions options_of(const RealTimeArguments& arguments) {
  RealTimeOptions options;
  if (arguments.priority > 0) options.priority = arguments.priority;
  options.spin = arguments.spin;
  for (std::size_t at = 0; !arguments.cpus.empty() && at != std::string::npos;) {
    const std::size_t comma = arguments.cpus.find(',', at);
    add_cpus(arguments.cpus.substr(at, comma == std::string::npos ? comma : comma - at), arguments.cpus, options.cpus);
    at = comma == std::string::npos ? comma : comma + 1;
  }
  return options;
}

std::string to_text(const Graph& graph, const RealClock& clock) {
  const auto us = [](Duration of) { return static_cast<double>(of.count()) * 1e-3; };
  const Histogram& late = clock.lateness();
  std::string text = fmt::format("  lateness    {:.1f} us median, {:.1f} us 99 %, {:.1f} us worst\n",
                                 us(late.percentile(0.5)), us(late.percentile(0.99)), us(late.max()));
  std::size_t width = 4;
  for (const Task& task : graph.tasks) width = std::max(width, task.name.size());
  text += fmt::format("  {:<{}}  {:>11}  {:>10}  {:>10}  {:>11}  {:>6}  {:>8}\n", "task", width, "activations",
                      "99 % us", "worst us", "response us", "late", "left out");
  for (std::size_t i = 0; i < graph.tasks.size(); ++i) {
    const TaskTiming& t = clock.timing(i);
    text += fmt::format("  {:<{}}  {:>11}  {:>10.1f}  {:>10.1f}  {:>11.1f}  {:>6}  {:>8}\n", graph.tasks[i].name, width,
                        t.execution.count(), us(t.execution.percentile(0.99)), us(t.execution.max()),
                        us(t.response.max()), t.late, t.left_out);
  }
  return text;
}

nlohmann::ordered_json to_json(const Graph& graph, const RealClock& clock) {
  const Histogram& late = clock.lateness();
  auto tasks = nlohmann::ordered_json::object();
  for (std::size_t i = 0; i < graph.tasks.size(); ++i) {
    const TaskTiming& t = clock.timing(i);
    tasks[graph.tasks[i].name] = {{"activations", t.execution.count()},
                                  {"execution_99_ns", t.execution.percentile(0.99).count()},
                                  {"execution_max_ns", t.execution.max().count()},
                                  {"response_99_ns", t.response.percentile(0.99).count()},
                                  {"response_max_ns", t.response.max().count()},
                                  {"late", t.late},
                                  {"left_out", t.left_out}};
  }
  return {{"lateness_50_ns", late.percentile(0.5).count()},
          {"lateness_99_ns", late.percentile(0.99).count()},
          {"lateness_max_ns", late.max().count()},
          {"tasks", tasks}};
}

std::string to_text(const Graph& graph, const std::vector<FailsafeReport>& failsafe, const Ending& ending) {
  std::string text;
  for (const FailsafeReport& safe : failsafe) {
    const std::string& name = graph.communicators[safe.communicator].name;
    if (!safe.heard && safe.at_start > 0)
      text += fmt::format("  safe        {}: all {} commands, for nothing ever came\n", name, safe.at_start);
    if (safe.commands > 0)
      text += fmt::format("  safe        {}: {} times for silence, {} commands, the first at {} s, the last at {} s\n",
                          name, safe.times, safe.commands, seconds_text(safe.first), seconds_text(safe.last));
    if (!safe.at_end) continue;
    const std::string when = seconds_text(safe.at_end->time) + " s, as " + ending.reason;
    if (safe.at_end->failure.empty())
      text +=
          "  safe        " + name + ": " + value_text(graph.communicators[safe.communicator]) + " at " + when + "\n";
    else
      text += "  safe        " + name + ": NOT HANDED OVER at " + when + ": " + safe.at_end->failure + "\n";
  }
  return text;
}

nlohmann::ordered_json to_json(const Graph& graph, const std::vector<FailsafeReport>& failsafe) {
  auto json = nlohmann::ordered_json::object();
  for (const FailsafeReport& safe : failsafe) {
    const Communicator& out = graph.communicators[safe.communicator];
    json[out.name] = {{"heard", safe.heard},
                      {"at_start", safe.at_start},
                      {"times", safe.times},
                      {"commands", safe.commands},
                      {"first_ns", safe.first.count()},
                      {"last_ns", safe.last.count()},
                      {"at_end", safe.at_end.has_value() && safe.at_end->failure.empty()}};
    if (!safe.at_end) continue;
    json[out.name]["at_end_ns"] = safe.at_end->time.count();
    json[out.name]["at_end_value"] = to_json(*out.type, out.safe->data());
    if (!safe.at_end->failure.empty()) json[out.name]["at_end_failure"] = safe.at_end->failure;
  }
  return json;
}

int exit_code_of(const std::vector<FailsafeReport>& failsafe) {
  const bool lost = std::any_of(failsafe.begin(), failsafe.end(), [](const FailsafeReport& safe) {
    return safe.at_end && !safe.at_end->failure.empty() && !safe.at_end->is_alone;
  });
  return lost ? exit_unfinished : exit_good;
}

std::string to_text(const LinkReport& link) {
  std::string counts;
  for (const auto& [name, count] : link.counts)
    if (count > 0) counts += (counts.empty() ? "" : ", ") + std::to_string(count) + " " + name;
  std::string text =
      "  link        " + link.link + ": " + (counts.empty() ? "nothing came and nothing went" : counts) + "\n";
  for (const LinkReport::Peer& peer : link.peers)
    text += fmt::format("              peer {}, {} packets\n", peer.address, peer.packets);
  for (const LinkReport::Takeover& takeover : link.takeovers)
    text += fmt::format("              taken over by {} at {} s, after {} had been silent\n", takeover.to,
                        seconds_text(takeover.at), takeover.from);
  for (const LinkReport::Stranger& stranger : link.strangers)
    text += fmt::format("              stranger {}, {} times\n", stranger.address, stranger.times);
  if (link.more_strangers > 0) text += fmt::format("              more strangers, {} times\n", link.more_strangers);
  if (link.heard > 0) return text;
  // of what came nothing was of use, as of a line that echoes
  const bool has_come = link.dropped > 0 || std::any_of(link.counts.begin(), link.counts.end(), [](const auto& count) {
                          return count.first == "packets in" && count.second > 0;
                        });
  return text + "              NO PACKET " + (has_come ? "THAT COUNTS " : "") + "HAS COME over " + link.link + "\n";
}

nlohmann::ordered_json to_json(const LinkReport& link) {
  auto counts = nlohmann::ordered_json::object();
  for (const auto& [name, count] : link.counts) counts[name] = count;
  auto peers = nlohmann::ordered_json::array(), strangers = peers, takeovers = peers;
  for (const LinkReport::Peer& peer : link.peers)
    peers.push_back({{"address", peer.address}, {"packets", peer.packets}});
  for (const LinkReport::Stranger& stranger : link.strangers)
    strangers.push_back({{"address", stranger.address}, {"times", stranger.times}});
  for (const LinkReport::Takeover& takeover : link.takeovers)
    takeovers.push_back({{"from", takeover.from}, {"to", takeover.to}, {"at_ns", takeover.at.count()}});
  return {{"link", link.link},     {"heard", link.heard > 0}, {"counts", counts},
          {"peers", peers},        {"strangers", strangers},  {"more_strangers", link.more_strangers},
          {"takeovers", takeovers}};
}

}  // namespace jarol::tools
