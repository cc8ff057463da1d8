#include "distributers/session/linked.h"

#include <algorithm>
#include <atomic>
#include <exception>
#include <string>
#include <thread>
#include <utility>

namespace jarol {
namespace {

// Outlives a thread that never ends.
struct Finishing {
  explicit Finishing(const std::vector<ExternalSystem*>& all) : systems(all) { failures.reserve(all.size()); }
  const std::vector<ExternalSystem*> systems;
  std::vector<std::string> failures;    // those of the first that have finished are written
  std::atomic<std::uint32_t> begun{0};  // finished, and the one at work
};

// Why it has failed, or nothing.
std::string finish_one(ExternalSystem& system) {
  try {
    system.finish();
    return "";
  } catch (const std::exception& error) { return error.what(); } catch (...) {
    return "something was thrown that is no exception";
  }
}

}  // namespace

std::vector<ExternalSystem*> pointers_to(const std::vector<std::unique_ptr<ExternalSystem>>& all) {
  std::vector<ExternalSystem*> pointers;
  for (const auto& system : all) pointers.push_back(system.get());
  return pointers;
}

Linked::Linked(std::vector<ExternalSystem*> systems, NoteSink note)
    : systems_(std::move(systems)), note_(std::move(note)) {
  for (ExternalSystem* each : systems_) each->begin();
}

void Linked::finish() {
  for (ExternalSystem* system : systems_)
    if (const std::string failure = finish_one(*system); !failure.empty()) note_(failure);
}

std::optional<std::size_t> Linked::finish_until(Futex::Time time, std::vector<std::string>& unkept) {
  const auto finishing = std::make_shared<Finishing>(systems_);
  std::atomic<std::uint32_t>& begun = finishing->begun;
  std::thread thread([finishing] {
    const auto go_on = [&] {
      finishing->begun.fetch_add(1, std::memory_order_release);
      Futex::wake_all(finishing->begun);
    };
    go_on();
    for (ExternalSystem* system : finishing->systems) {
      finishing->failures.push_back(finish_one(*system));
      go_on();
    }
  });
  // a thread that gets no processor is none that hangs
  for (const Futex::Time late = Futex::now() + begin_patience; begun.load(std::memory_order_acquire) == 0;)
    if (!Futex::wait(begun, 0, late)) break;
  time = std::max(time, Futex::now() + finish_patience);
  for (std::uint32_t at = 0; (at = begun.load(std::memory_order_acquire)) <= systems_.size();)
    if (!Futex::wait(begun, at, time)) break;
  const std::uint32_t finished = std::max(begun.load(std::memory_order_acquire), 1U) - 1;
  for (std::size_t i = 0; i < finished; ++i)
    if (const std::string& failure = finishing->failures[i]; !failure.empty()) unkept.push_back(failure);
  if (finished < systems_.size()) {
    thread.detach();
    return finished;
  }
  thread.join();
  return std::nullopt;
}

std::vector<LinkReport> Linked::reports() const {
  std::vector<LinkReport> reports;
  for (const ExternalSystem* system : systems_)
    if (auto report = system->link_report()) reports.push_back(std::move(*report));
  return reports;
}

void finish_links(Linked& linked, const Graph& graph, RunEnd& end) {
  const auto hangs = linked.finish_until(end.until, end.unkept);
  if (hangs) end.distributer = HangingDistributer{graph.distributers[*hangs].name};
}

std::vector<FailsafeReport> failsafe_after(const RunEnd& end, const Graph& graph,
                                           const std::vector<ExternalSystem*>& systems,
                                           std::vector<FailsafeReport> reports) {
  const auto hangs = [&](const Distributer& d) { return end.distributer && end.distributer->distributer == d.name; };
  const auto first_left = static_cast<std::size_t>(
      std::find_if(graph.distributers.begin(), graph.distributers.end(), hangs) - graph.distributers.begin());
  for (FailsafeReport& report : reports) {
    if (!report.at_end || !report.at_end->failure.empty()) continue;
    const std::size_t distributer = *graph.communicators[report.communicator].distributer;
    const ExternalSystem& system = *systems[distributer];
    // one that hangs and those behind it may still be at work
    const bool is_left = distributer >= first_left;
    if (is_left && system.sends()) report.at_end->failure = busy_link_text;
    if (is_left || end.hangs || system.unsent() == report.at_end->unsent) continue;
    report.at_end->is_alone = !system.has_sent();
    report.at_end->failure = report.at_end->is_alone ? alone_text : unsent_text;
  }
  return reports;
}

}  // namespace jarol
