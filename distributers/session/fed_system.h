// What a program feeds to a distributer, in place of its external system.
#pragma once

#include <vector>

#include "graph/registry.h"
#include "graph/values/value.h"
#include "runtime/external_system.h"

namespace jarol {

class FedSystem : public ExternalSystem {
 public:
  explicit FedSystem(const DistributerClass& distributer);

  /// The newest value of an `in` channel, until its communicator takes it. One that is not finite is counted, and the
  /// one before it stays.
  void feed(std::size_t channel, const void* value);

  void reach(Duration) override {}
  bool take(std::size_t channel, void* value) override;
  void hand_over(std::size_t, const void*) override {}
  void serialize(Archive& archive) override;
  std::uint64_t non_finite_inputs() const override { return non_finite_; }

 private:
  struct Fed {
    Value value;
    bool is_new = false;
  };
  std::vector<Fed> fed_;  // per channel
  std::uint64_t non_finite_ = 0;
};

}  // namespace jarol
