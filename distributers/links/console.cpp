#include "distributers/links/console.h"

#include <stdexcept>

#include "distributers/links/link_type.h"
#include "distributers/links/translator.h"

namespace jarol::distributers {

ConsolePort::ConsolePort(const messages::MessageSet& set)
    : set_(set),
      port_(most_packets, longest_packet(set)),
      header_(*set.header),
      room_(longest_packet(set)),
      reader_(set) {}

bool ConsolePort::send(messages::MessageRef message, std::string& why) {
  if (!messages::write_packet(header_, message, set_.order, packet_, &why)) return false;
  if (port_.write(packet_)) {
    given_.fetch_add(1, std::memory_order_relaxed);
    return true;
  }
  refused_.fetch_add(1, std::memory_order_relaxed);
  why = "the run has not taken what was sent before";
  return false;
}

void ConsolePort::receive(messages::Receiver& receiver) {
  for (std::size_t left = port_.capacity(); left > 0; --left) {
    const std::optional<std::size_t> size = port_.read(room_);
    if (!size) return;
    if (reader_.read(std::span(room_).first(*size)) == messages::Flaw::none) receiver.receive(reader_.message());
  }
}

ConsoleChannels::ConsoleChannels(std::unique_ptr<AnyDistributer> distributer)
    : distributer_(std::move(distributer)), port_(std::make_shared<ConsolePort>(distributer_->message_set())) {}

void ConsoleChannels::reach(Duration instant) {
  port_->receive(*distributer_);
  distributer_->reach(instant, unread_);
}

std::optional<LinkReport> ConsoleChannels::link_report() const {
  LinkReport report;
  report.link = "console";
  report.heard = port_->given();
  report.dropped = port_->refused();
  report.counts = {{"messages in", report.heard}, {"refused", report.dropped}};
  return report;
}

LinkType console_link() {
  struct ConsoleSpec {};
  LinkType type = link_type<ConsoleSpec>(
      "console", "an operator at the page of this run's console", {},
      [](const ConsoleSpec&, const LinkRequest& request, Problems& problems) -> std::unique_ptr<Channels> {
        try {
          return std::make_unique<ConsoleChannels>(request.make_distributer());
        } catch (const std::invalid_argument& error) {
          problems.add(request.yaml().where, "distributer '" + request.whose().name + "': " + error.what());
          return nullptr;
        }
      });
  type.for_operators = true;
  return type;
}

}  // namespace jarol::distributers
