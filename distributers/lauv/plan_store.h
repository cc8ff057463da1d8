// The plans that operators have stored in the vehicle, while it runs.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <string_view>

#include "distributers/messages/imc.h"

namespace jarol::distributers {

/// Of its sizes those of the payloads are known; the MD5 sums that IMC has for comparing plans are left empty.
class PlanStore {
 public:
  /// Why a plan can't be flown, or nothing.
  using Check = std::function<std::string(const messages::imc::PlanSpecification&)>;

  /// Answers a request. Changes are by that system, at that time in s since 1970; what can't be flown is not stored.
  messages::imc::PlanDB answer(const messages::imc::PlanDB& request, std::uint16_t system, double time,
                               const Check& check);

  /// Stores it under that name, unchecked. Why not, or nothing.
  std::string set(std::string_view name, const messages::imc::PlanSpecification& plan, std::uint16_t system,
                  double time);
  /// Null: there is none of that name.
  const messages::imc::PlanSpecification* find(std::string_view name) const;

 private:
  struct Stored {
    messages::imc::PlanSpecification plan;
    messages::imc::PlanDBInformation information;
  };

  std::string carry_out(const messages::imc::PlanDB& request, std::uint16_t system, double time, const Check& check,
                        messages::InlineMessage& result);
  messages::imc::PlanDBState state(bool detailed) const;

  std::map<std::string, Stored, std::less<>> plans_;
  double changed_at_ = 0;
  std::uint16_t changed_by_ = 0xffff;
};

}  // namespace jarol::distributers
