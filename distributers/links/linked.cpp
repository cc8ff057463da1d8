#include "distributers/links/linked.h"

#include <algorithm>

namespace jarol::distributers {

LinkedSystem::LinkedSystem(std::unique_ptr<Link> link, std::unique_ptr<AnyDistributer> distributer)
    : link_(std::move(link)),
      distributer_(std::move(distributer)),
      from_peer_(*link_, *distributer_),
      to_link_(*link_),
      to_all_(*link_) {}

void LinkedSystem::FromPeer::receive(messages::MessageRef message) {
  if (link.peer() != peer) distributer.peer_changed();
  peer = link.peer();
  distributer.receive(message);
}

void LinkedSystem::begin() {
  link_->connect();
  distributer_->listen_at(link_->transport().address());
}

void LinkedSystem::finish() {
  link_->disconnect();
  distributer_->finish();
}

// Of a vehicle what is of no use may be its own, as from a line that echoes.
std::uint64_t LinkedSystem::heard() const { return std::min(link_->heard(), distributer_->used()); }

std::optional<LinkReport> LinkedSystem::link_report() const {
  LinkReport report = link_->report();
  report.heard = heard();
  return report;
}

void LinkedSystem::reach(Duration instant) {
  link_->receive(from_peer_);
  distributer_->reach(instant, to_link_);
  report_steering();
  if (link_->announces()) distributer_->announce(instant, to_all_);
  link_->flush();
}

void LinkedSystem::report_steering() {
  const bool steers_itself = distributer_->steers_itself();
  if (steers_itself != steers_itself_ && link_->set_steers_itself(steers_itself)) steers_itself_ = steers_itself;
}

void LinkedSystem::hand_over(std::size_t channel, const void* value) {
  distributer_->hand_over(channel, value, to_link_);
  link_->flush();
}

}  // namespace jarol::distributers
