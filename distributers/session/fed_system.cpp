#include "distributers/session/fed_system.h"

#include <utility>

namespace jarol {

FedSystem::FedSystem(const DistributerClass& distributer) {
  for (const ChannelClass& channel : distributer.channels) fed_.push_back({Value(*channel.type)});
}

void FedSystem::feed(std::size_t channel, const void* value) {
  Fed& fed = fed_[channel];
  if (!fed.value.type()->finite(value)) {
    ++non_finite_;
    return;
  }
  copy_value(*fed.value.type(), fed.value.data(), value);
  fed.is_new = true;
}

bool FedSystem::take(std::size_t channel, void* value) {
  Fed& fed = fed_[channel];
  if (!std::exchange(fed.is_new, false)) return false;
  copy_value(*fed.value.type(), value, fed.value.data());
  return true;
}

void FedSystem::serialize(Archive& archive) {
  archive(non_finite_);
  for (Fed& fed : fed_) {
    archive(fed.is_new);
    archive.value(*fed.value.type(), fed.value.data());
  }
}

}  // namespace jarol
