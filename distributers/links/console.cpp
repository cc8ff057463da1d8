#include "distributers/links/console.h"

#include "distributers/links/link_type.h"
#include "distributers/links/translator.h"
#include "graph/text/errors.h"

namespace jarol::distributers {

ConsolePort::ConsolePort(const messages::MessageSet& set)
    : set_(set),
      header_(*set.header),
      port_(max_packets, longest_packet(set)),
      answers_(max_packets, longest_packet(set)),
      answers_read_{std::vector<std::byte>(longest_packet(set)), messages::PacketReader(set)},
      read_{std::vector<std::byte>(longest_packet(set)), messages::PacketReader(set)} {}

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

// No more than there is room for, however fast the other side writes.
template <class Take>
void ConsolePort::read_all(PacketPort& port, Reading& reading, Take take) {
  for (std::size_t left = port.capacity(); left > 0; --left) {
    const std::optional<std::size_t> size = port.read(reading.room);
    if (!size) return;
    if (reading.reader.read(std::span(reading.room).first(*size)) == messages::PacketError::none)
      take(reading.reader.message());
  }
}

void ConsolePort::receive(messages::Receiver& receiver) {
  read_all(port_, read_, [&](messages::MessageRef message) {
    const bool waited_too_long = taken_++ < left_out_before_.load(std::memory_order_acquire);
    if (waited_too_long && !is_for_emergencies(message.descriptor->name))
      left_out_.fetch_add(1, std::memory_order_relaxed);
    else
      receiver.receive(message);
  });
}

void ConsolePort::answer(messages::MessageRef message) {
  if (messages::write_packet(header_, message, set_.order, answer_packet_) && answers_.write(answer_packet_))
    answered_.fetch_add(1, std::memory_order_relaxed);
  else
    lost_.fetch_add(1, std::memory_order_relaxed);
}

void ConsolePort::receive_answers(messages::Receiver& receiver) {
  read_all(answers_, answers_read_, [&](messages::MessageRef message) { receiver.receive(message); });
}

ConsoleSystem::ConsoleSystem(std::unique_ptr<AnyDistributer> distributer)
    : distributer_(std::move(distributer)), port_(std::make_shared<ConsolePort>(distributer_->message_set())) {}

void ConsoleSystem::reach(Duration instant) {
  port_->receive(*distributer_);
  distributer_->reach(instant, answers_);
}

std::optional<LinkReport> ConsoleSystem::link_report() const {
  LinkReport report;
  report.link = "console";
  report.heard = port_->given();
  report.dropped = port_->refused() + port_->left_out();
  report.counts = {{"messages in", report.heard},
                   {"refused", port_->refused()},
                   {"left out: the page was gone", port_->left_out()},
                   {"messages out", port_->answered()},
                   {"lost", port_->lost()}};
  return report;
}

LinkType console_link() {
  struct ConsoleSpec {};
  LinkType type = link_type<ConsoleSpec>(
      "console", "an operator at the page of this run's console", {},
      [](const ConsoleSpec&, const LinkRequest& request, Problems& problems) -> std::unique_ptr<ExternalSystem> {
        try {
          return std::make_unique<ConsoleSystem>(request.make_distributer());
        } catch (const InputError& error) {
          problems.add(request.yaml().where, "distributer '" + request.whose().name + "': " + error.what());
          return nullptr;
        }
      });
  type.for_operators = true;
  return type;
}

}  // namespace jarol::distributers
