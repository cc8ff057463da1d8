#include "runtime/state/copy.h"

namespace jarol {
namespace {

JAROL_WIDE void transfer_all_wide(const ShortRange<Copy>& copies) {
  typedef char Half __attribute__((vector_size(32)));
  for (const Copy& c : copies) {
    if (c.size != 2 * sizeof(Half)) {
      transfer(c);
      continue;
    }
    const auto* const from = static_cast<const std::byte*>(c.from);
    std::byte* const to = c.to;
    Half first, second;
    std::memcpy(&first, from, sizeof first);
    std::memcpy(&second, from + sizeof first, sizeof second);
    std::memcpy(to, &first, sizeof first);
    std::memcpy(to + sizeof first, &second, sizeof second);
  }
}

}  // namespace

void transfer_all(const ShortRange<Copy>& copies, bool wide) {
  if (wide) {
    transfer_all_wide(copies);
    return;
  }
  for (const Copy& c : copies) transfer(c);
}

}  // namespace jarol
