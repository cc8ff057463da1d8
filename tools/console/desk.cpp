#include "tools/console/desk.h"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <utility>

#include "distributers/messages/json.h"
#include "graph/language/problems.h"
#include "graph/language/quantities.h"
#include "graph/text/errors.h"
#include "tools/console/shortened.h"

namespace jarol::tools::console {
namespace {

using Received = nlohmann::json;

std::string text_of(const Received& message, const char* key) {
  const auto found = message.find(key);
  if (found == message.end() || !found->is_string()) throw InputError(fmt::format("expected a text as \"{}\"", key));
  return *found;
}

std::string age_text(Duration age) {
  return seconds_text(std::chrono::round<std::chrono::duration<std::int64_t, std::deci>>(age)) + " s";
}

bool sends(const Received& message, const char* abbrev) {
  return text_of(message, "do") == "send" && text_of(message, "message") == abbrev;
}

// These are obeyed however late they come.
bool is_for_emergencies(const Received& message) {
  return text_of(message, "do") == "send" && distributers::ConsolePort::is_for_emergencies(text_of(message, "message"));
}

// What a take-over could jerk the vehicle by.
void require_centred(const Received& message) {
  const auto sticks = message.find("sticks");
  if (sticks == message.end() || !sticks->is_object())
    throw InputError("expected the sticks' places as \"sticks\", as in {\"roll\": 0}");
  for (const auto& [name, place] : sticks->items())
    if (!place.is_number() || !(std::abs(place.get<double>()) <= Desk::centred))
      throw InputError(
          fmt::format("stick '{}' is at {}; centre it to take over", shortened(name), shortened(place.dump())));
}

}  // namespace

Desk::Desk(std::vector<DeskOperator> operators) {
  for (DeskOperator& each : operators) seats_.push_back({std::move(each)});
}

nlohmann::ordered_json Desk::describe() const {
  auto desks = nlohmann::ordered_json::array();
  for (const Seat& seat : seats_)
    desks.push_back({{"name", seat.of.name}, {"type", seat.of.type}, {"messages", seat.of.port->message_set().name}});
  return desks;
}

void Desk::obey(std::uint64_t page, const Received& message, Clock::time_point now, Duration behind) {
  const std::string what = text_of(message, "do");
  Seat& seat = find(message);
  if (behind > max_behind && what != "release" && !is_for_emergencies(message)) {
    if (seat.page == page || what == "take") leave_out(seat, message, behind);
    return;
  }
  // where nobody commands any page may abort, however old what it shows
  if (!seat.page && sends(message, "Abort")) {
    seat.sequence = 0;
    return send(seat, message);
  }
  if (what == "take") {
    take(seat, page, message);
  } else if (!seat.page && what == "release") {
    return;  // it lost the seat before it let go of it
  } else if (seat.page != page) {
    throw InputError(fmt::format("this page does not command '{}'; take it first", seat.of.name));
  } else if (what == "send") {
    send(seat, message);
  } else if (what == "release") {
    free(seat, "it was released");
  } else if (what != "alive") {
    throw InputError(
        fmt::format("there is no '{}' to do at a desk; there are: alive, release, send, take", shortened(what)));
  }
  seat.heard = now;
  seat.behind = {};
}

std::string Desk::commanded_by_others(std::uint64_t page) const {
  for (const Seat& seat : seats_)
    if (seat.page && seat.page != page) return seat.of.name;
  return "";
}

void Desk::leave_out(Seat& seat, const Received& message, Duration behind) {
  const std::string what = text_of(message, "do");
  const std::string age = fmt::format("what this page shows is {} old", age_text(behind));
  if (what == "take") throw InputError(age + ": it can't take over");
  seat.behind = behind;
  if (what != "alive")
    throw InputError(fmt::format("{}: '{}' is not sent", age, shortened(text_of(message, "message"))));
}

void Desk::leave(std::uint64_t page) {
  for (Seat& seat : seats_)
    if (seat.page == page) free(seat, "the page that commanded is gone");
}

nlohmann::ordered_json Desk::news(Clock::time_point now) {
  for (Seat& seat : seats_)
    if (seat.page && now - seat.heard > patience)
      free(seat, seat.behind == Duration{} ? "the page that commanded was silent"
                                           : "what the page that commanded shows is " + age_text(seat.behind) + " old");
  if (seats_.empty() || (!std::exchange(changed_, false) && now - reported_ < repeat)) return {};
  reported_ = now;
  nlohmann::ordered_json news;
  for (const Seat& seat : seats_) {
    auto& its = news[seat.of.name];
    its["commander"] = seat.page ? nlohmann::ordered_json(seat.as) : nlohmann::ordered_json();
    if (!seat.why.empty()) its["why"] = seat.why;
  }
  return news;
}

nlohmann::ordered_json Desk::answers() {
  struct AsJson : messages::Receiver {
    void receive(messages::MessageRef message) override {
      all.push_back({{"message", message.descriptor->name},
                     {"fields", nlohmann::ordered_json::parse(messages::to_json(message))}});
    }
    nlohmann::ordered_json all = nlohmann::ordered_json::array();
  };
  nlohmann::ordered_json answers;
  for (const Seat& seat : seats_) {
    AsJson its;
    seat.of.port->receive_answers(its);
    if (!its.all.empty()) answers[seat.of.name] = std::move(its.all);
  }
  return answers;
}

Desk::Seat& Desk::find(const Received& message) {
  const std::string name = text_of(message, "desk");
  std::vector<std::string> names;
  for (Seat& seat : seats_) {
    if (seat.of.name == name) return seat;
    names.push_back(seat.of.name);
  }
  throw InputError(fmt::format("there is no desk of '{}'; there are: {}", shortened(name), list_of(names)));
}

void Desk::take(Seat& seat, std::uint64_t page, const Received& message) {
  if (seat.page && seat.page != page)
    throw InputError(fmt::format("another page commands '{}'; it has to release it, or to fall silent", seat.of.name));
  require_centred(message);
  seat.as = text_of(message, "as");
  if (seat.as.size() > 64) throw InputError("what a page calls itself has at most 64 characters");
  seat.page = page;
  seat.sequence = 0;
  seat.why.clear();
  changed_ = true;
}

// One that is no newer than another was held up on its way: what it commands is past.
void Desk::send(Seat& seat, const Received& message) {
  const auto sequence = message.find("sequence");
  if (sequence == message.end() || !sequence->is_number_unsigned())
    throw InputError("expected a number that grows as \"sequence\"");
  if (sequence->get<std::uint64_t>() <= seat.sequence) return;
  const messages::MessageSet& set = seat.of.port->message_set();
  const std::string abbrev = text_of(message, "message");
  const messages::MessageDescriptor* const descriptor = set.find(abbrev);
  if (descriptor == nullptr) throw InputError(fmt::format("{} has no message '{}'", set.name, shortened(abbrev)));
  messages::Message made(*descriptor);
  std::string why;
  const auto fields = message.find("fields");
  if (fields != message.end() && !messages::from_json(fields->dump(), made, why))
    throw InputError(fmt::format("{}: {}", abbrev, why));
  if (!seat.of.port->send(made, why)) throw InputError(fmt::format("{} is lost: {}", abbrev, why));
  seat.sequence = *sequence;
}

void Desk::free(Seat& seat, const std::string& why) {
  seat.page.reset();
  seat.why = why;
  // a run that is paused or slow would obey whom it does not hear any more
  seat.of.port->leave_out_waiting();
  changed_ = true;
}

}  // namespace jarol::tools::console
