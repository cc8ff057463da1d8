#include "distributers/session/fed_channels.h"

#include <utility>

namespace jarol {

FedChannels::FedChannels(const DistributerClass& distributer) {
  for (const ChannelClass& channel : distributer.channels) fed_.push_back({Value(*channel.type)});
}

void FedChannels::feed(std::size_t channel, const void* value) {
  Fed& fed = fed_[channel];
  copy_value(*fed.value.type(), fed.value.data(), value);
  fed.is_new = true;
}

bool FedChannels::take(std::size_t channel, void* value) {
  Fed& fed = fed_[channel];
  if (!std::exchange(fed.is_new, false)) return false;
  copy_value(*fed.value.type(), value, fed.value.data());
  return true;
}

void FedChannels::serialize(Archive& archive) {
  for (Fed& fed : fed_) {
    archive(fed.is_new);
    archive.value(*fed.value.type(), fed.value.data());
  }
}

}  // namespace jarol
