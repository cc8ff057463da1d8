#include "distributers/links/linked.h"

namespace jarol::distributers {

LinkedChannels::LinkedChannels(std::unique_ptr<Link> link, std::unique_ptr<Adapter> adapter)
    : link_(std::move(link)), adapter_(std::move(adapter)), to_peer_(*link_) {}

void LinkedChannels::reach(Duration instant) {
  link_->receive(*adapter_);
  adapter_->reach(instant, to_peer_);
  link_->flush();
}

void LinkedChannels::hand_over(std::size_t channel, const void* value) {
  adapter_->hand_over(channel, value, to_peer_);
  link_->flush();
}

}  // namespace jarol::distributers
