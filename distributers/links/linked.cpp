#include "distributers/links/linked.h"

namespace jarol::distributers {

LinkedChannels::LinkedChannels(std::unique_ptr<Link> link, std::unique_ptr<Link> announcer,
                               std::unique_ptr<AnyDistributer> adapter)
    : link_(std::move(link)),
      announcer_(std::move(announcer)),
      adapter_(std::move(adapter)),
      from_peer_(*link_, *adapter_),
      to_link_(*link_) {}

void LinkedChannels::FromPeer::receive(messages::MessageRef message) {
  if (link.peer() != peer) adapter.peer_changed();
  peer = link.peer();
  adapter.receive(message);
}

void LinkedChannels::begin() {
  link_->connect();
  if (announcer_) announcer_->connect();
  adapter_->listen_at(link_->transport().address());
}

void LinkedChannels::finish() {
  link_->disconnect();
  if (announcer_) announcer_->disconnect();
  adapter_->finish();
}

void LinkedChannels::reach(Duration instant) {
  link_->receive(from_peer_);
  adapter_->reach(instant, to_link_);
  link_->flush();
  if (!announcer_) return;
  ToLink to_all(*announcer_);
  adapter_->announce(instant, to_all);
  announcer_->flush();
}

void LinkedChannels::hand_over(std::size_t channel, const void* value) {
  adapter_->hand_over(channel, value, to_link_);
  link_->flush();
}

}  // namespace jarol::distributers
