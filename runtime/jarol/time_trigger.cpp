#include "runtime/jarol/time_trigger.h"

#include <stdexcept>
#include <string>

namespace jarol {
namespace {

std::chrono::nanoseconds above_zero(std::chrono::nanoseconds period) {
  if (period.count() <= 0)
    throw std::invalid_argument("the period of a time trigger is " + std::to_string(period.count()) +
                                " ns; it must be above zero");
  return period;
}

}  // namespace

template class BasicTimeTrigger<Futex>;

TimeTrigger::TimeTrigger(std::chrono::nanoseconds period) : TimeTrigger(period, Futex::now() + above_zero(period)) {}

TimeTrigger::TimeTrigger(std::chrono::nanoseconds period, Time first) : BasicTimeTrigger(above_zero(period), first) {}

}  // namespace jarol
