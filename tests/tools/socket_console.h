// A console that speaks IMC with a graph over UDP.
#pragma once

#include <algorithm>
#include <chrono>
#include <memory>
#include <string>
#include <thread>

#include "distributers/links/link.h"
#include "distributers/links/udp.h"
#include "distributers/messages/imc.h"

namespace jarol::tests {

/// A link over UDP from a port to another, as the system of that number.
inline std::unique_ptr<distributers::Link> imc_over_udp(const std::string& listen, const std::string& peer,
                                                        std::uint64_t id) {
  using namespace distributers;
  auto link = std::make_unique<Link>(
      std::make_unique<UdpTransport>(Address::parse(listen), Address::parse(peer)), messages::imc::message_set(),
      LinkOptions{.input = {PortKind::push, 4096}, .output = {PortKind::push, 1024}, .header = {{"src", id}}});
  link->connect();
  return link;
}

class SocketConsole : public messages::Receiver {
 public:
  explicit SocketConsole(const std::string& port, std::uint64_t id = 0x4001) : link_(imc_over_udp("0", port, id)) {}

  template <class M>
  void say(const M& message) {
    link_->send(messages::refer_to(message));
    link_->flush();
  }
  void receive(messages::MessageRef message) override {
    namespace imc = messages::imc;
    if (const auto* s = message.as<imc::EstimatedState>()) {
      state = *s;
      deepest = std::max(deepest, s->depth);
    }
    if (const auto* v = message.as<imc::VehicleState>()) op_mode = v->op_mode;
    if (const auto* a = message.as<imc::RemoteActionsRequest>()) actions = std::string(a->actions);
    if (message.as<imc::Heartbeat>() != nullptr) ++heartbeats;
    if (const auto* list = message.as<imc::EntityList>()) entities = std::string(list->list);
    if (const auto* p = message.as<imc::PlanControlState>()) plan = *p;
    if (const auto* entry = message.as<imc::LogBookEntry>()) log_book += std::string(entry->text) + "\n";
  }
  /// Says them every 100 ms, as a console does, until that is so; false: it never was.
  template <class Done, class... Messages>
  bool say_until(const Done& done, const Messages&... messages) {
    using Clock = std::chrono::steady_clock;
    using namespace std::chrono_literals;
    for (const auto end = Clock::now() + 90s; Clock::now() < end; std::this_thread::sleep_for(100ms)) {
      (say(messages), ...);
      link_->receive(*this);
      if (done()) return true;
    }
    return false;
  }

  messages::imc::EstimatedState state;
  messages::imc::PlanControlState plan;
  float deepest = 0;
  int op_mode = -1;
  int heartbeats = 0;
  std::string actions, entities, log_book;

 private:
  std::unique_ptr<distributers::Link> link_;
};

}  // namespace jarol::tests
