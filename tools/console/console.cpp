#include "tools/console/console.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <utility>

#include "graph/text/errors.h"
#include "tools/console/page_message.h"
#include "tools/console/seconds.h"
#include "tools/console/shortened.h"

namespace jarol::tools::console {
namespace {

using Json = nlohmann::ordered_json;

// Of samples in one message.
constexpr std::size_t max_bytes = std::size_t{256} << 10;

std::string dump(const Json& json) { return json.dump(-1, ' ', true, Json::error_handler_t::replace); }

std::vector<std::string> names_of_tasks(const Graph& graph) {
  std::vector<std::string> names;
  for (const Task& task : graph.tasks) names.push_back(task.name);
  return names;
}

Json event_json(const FeedEvent& event, const std::vector<std::string>& tasks) {
  Json json{{"t", seconds(event.instant)}};
  switch (event.kind) {
    case RunEvent::Kind::fault:
      json["kind"] = "fault";
      json["task"] = tasks[event.task];
      json["activation"] = event.activation;
      json["text"] = event.cause;
      break;
    case RunEvent::Kind::rest_begun:
      json["kind"] = "rest";
      json["text"] = "the vehicle is brought to rest";
      break;
    case RunEvent::Kind::at_rest:
      json["kind"] = "rest";
      json["text"] = "the vehicle is at rest";
      break;
    case RunEvent::Kind::mishap:
      json["kind"] = "mishap";
      json["text"] = to_text(RunVerdict::VehicleMishap{event.distributer, event.cause});
      break;
  }
  return json;
}

nlohmann::json parse(const std::string& message) { return parse_request(message, R"({"do": "pause"})"); }

Json hello_of(const Watched& watched, const Desk& desk) {
  Json hello = describe_run(watched.run);
  hello["paced"] = watched.pace != nullptr;
  if (!desk.empty()) hello["desks"] = desk.describe();
  return hello;
}

}  // namespace

Console::Console(Watched watched, std::size_t max_at_once, std::vector<std::uint64_t> strides)
    : watched_(std::move(watched)),
      feed_(types_of_run(watched_.run.graph, watched_.run.true_types), max_at_once, std::move(strides)),
      samples_(types_of_run(watched_.run.graph, watched_.run.true_types)),
      tasks_(names_of_tasks(watched_.run.graph)),
      desk_(watched_.operators) {}

void Console::open() {
  server_ = std::make_unique<Server>(
      watched_.server, dump({{"hello", hello_of(watched_, desk_)}}), [this] { return next_messages(); },
      [this](const Page& page, const std::string& message) { return answer(page, message); },
      [this](std::uint64_t page) { desk_.leave(page); });
}

void Console::end(const std::string& text) {
  const std::lock_guard lock(mutex_);
  ended_ = text;
}

// Samples are messages of their own, so that none is long; what stands before them is there always.
std::vector<std::string> Console::next_messages() {
  const Batch& batch = feed_.take_batch();
  const Json desk = desk_.news(Desk::Clock::now()), answers = desk_.answers();
  const std::lock_guard lock(mutex_);
  now_ = std::max(now_, batch.newest());
  const std::pair shown(now_, watched_.pace != nullptr ? watched_.pace->state() : Pace::State{});
  thinned_ += batch.thinned;
  std::vector<std::string> messages;
  if (!batch.empty() || shown_ != shown || !desk.is_null() || !answers.is_null()) {
    Json json{{"now", seconds(now_)}};
    if (watched_.pace != nullptr) {
      json["paused"] = shown.second.paused;
      json["speed"] = shown.second.speed ? Json(*shown.second.speed) : Json("max");
    }
    if (!desk.is_null()) json["desk"] = desk;
    if (!answers.is_null()) json["answers"] = answers;
    if (thinned_ > 0) json["thinned"] = thinned_;
    if (batch.lost_events > 0) json["lost_events"] = batch.lost_events;
    for (const FeedEvent& event : batch.events) json["events"].push_back(event_json(event, tasks_));
    std::string head = dump(json);
    head.pop_back();
    for (const std::string& part : samples_.parts_of(batch, max_bytes)) {
      messages.push_back(head + ",\"samples\":[" + part + "]}");
      head = "{\"now\":" + json["now"].dump();
    }
    shown_ = shown;
  }
  if (ended_) messages.push_back(dump({{"ended", *std::exchange(ended_, std::nullopt)}}));
  return messages;
}

std::string Console::answer(const Page& page, const std::string& message) {
  const nlohmann::json json = parse(message);
  if (json.contains("desk")) {
    desk_.obey(page.number, json, Desk::Clock::now(), page.behind);
    return "";
  }
  if (watched_.pace == nullptr)
    throw InputError("this run goes on by itself; only one on the virtual clock can be paced and paused");
  // the time that a vehicle waits for its operator is that of the run: who changes it could end another one's flight
  if (const std::string desk = desk_.commanded_by_others(page.number); !desk.empty())
    throw InputError("another page commands '" + desk +
                     "'; only a page that commands alone changes the pace, pauses and steps");
  obey(*watched_.pace, message);
  return "";
}

void obey(Pace& pace, const std::string& message) {
  const nlohmann::json json = parse(message);
  const std::string what = json["do"];
  if (what == "pause") return pace.pause();
  if (what == "go_on") return pace.go_on();
  if (what == "step") {
    const auto instants = json.value("instants", nlohmann::json(1));
    if (!instants.is_number_unsigned() || instants < 1 || instants > Pace::max_steps)
      throw InputError("'instants' of step is no whole number from 1 to 10000");
    return pace.step(instants);
  }
  if (what == "speed") {
    const auto speed = json.value("speed", nlohmann::json());
    if (speed == "max") return pace.set_speed(std::nullopt);
    if (!speed.is_number() || !(speed >= Pace::min && speed <= Pace::max))
      throw InputError("'speed' is no number from 0.001 to 1000, nor \"max\"");
    return pace.set_speed(speed.get<double>());
  }
  throw InputError("there is no '" + shortened(what) + "' to do; there are: pause, go_on, step, speed");
}

}  // namespace jarol::tools::console
