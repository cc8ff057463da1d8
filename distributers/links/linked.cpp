#include "distributers/links/linked.h"

namespace jarol::distributers {

LinkedChannels::LinkedChannels(std::unique_ptr<Link> link, std::unique_ptr<Adapter> adapter)
    : link_(std::move(link)), adapter_(std::move(adapter)), from_peer_(*link_, *adapter_), to_peer_(*link_) {}

void LinkedChannels::FromPeer::receive(messages::MessageRef message) {
  if (link.peer() != peer) adapter.peer_changed();
  peer = link.peer();
  adapter.receive(message);
}

void LinkedChannels::reach(Duration instant) {
  link_->receive(from_peer_);
  adapter_->reach(instant, to_peer_);
  link_->flush();
}

void LinkedChannels::hand_over(std::size_t channel, const void* value) {
  adapter_->hand_over(channel, value, to_peer_);
  link_->flush();
}

}  // namespace jarol::distributers
