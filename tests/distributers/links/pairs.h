// Two links that are each other's peer, of each kind.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "distributers/links/link.h"
#include "distributers/messages/javiator.h"
#include "tests/distributers/links/raw_ends.h"

namespace jarol::tests {

inline constexpr std::chrono::seconds patience{20};  // a busy machine may take long; nothing waits so long otherwise

bool wait_for(const std::function<bool()>& done);

/// Keeps the ids of the motor signals that came.
struct Ids : messages::Receiver {
  void receive(messages::MessageRef message) override {
    if (const auto* motors = message.as<messages::javiator::MotorSignals>()) ids.push_back(motors->id);
  }
  std::vector<int> ids;
};

void send_id(distributers::Link& link, int id);

/// Two pseudo terminals, each the other's line.
class Line;

struct Pair {
  Pair();
  Pair(Pair&&) noexcept;
  ~Pair();
  std::unique_ptr<Line> line;
  std::unique_ptr<distributers::Link> one, other;
};

std::unique_ptr<distributers::Link> make(std::unique_ptr<distributers::Transport> transport,
                                         const distributers::LinkOptions& options = {});

Pair udp(const std::string& host, const distributers::LinkOptions& options = {});
Pair tcp(const std::string& host, const distributers::LinkOptions& options = {});
Pair serial(const distributers::LinkOptions& options = {});

/// Until both have heard each other; false: they do not.
bool meet(Pair& pair);

}  // namespace jarol::tests
