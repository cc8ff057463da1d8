#include "runtime/run/fault_text.h"

#include "graph/values/bind.h"

namespace jarol {
namespace {

std::string find_in(const Type& type, const void* value, const std::string& path) {
  const auto* bytes = static_cast<const std::byte*>(value);
  const std::string prefix = path.empty() ? "" : path + ".";
  const auto find_element = [&](std::size_t count, const std::byte* elements) -> std::string {
    for (std::size_t i = 0; i < count; ++i)
      if (const std::byte* element = elements + i * type.element->size; !type.element->finite(element))
        return find_in(*type.element, element, prefix + std::to_string(i));
    return "";
  };
  if (type.kind == Kind::array) return find_element(type.count, bytes);
  if (type.kind == Kind::sequence)
    return find_element(type.length(value), static_cast<const std::byte*>(type.elements(value)));
  for (const TypeField& f : type.fields)
    if (!f.type->finite(bytes + f.offset)) return find_in(*f.type, bytes + f.offset, prefix + f.name);
  return "output '" + path + "' is " + scalar_text(type, value);
}

}  // namespace

std::string find_non_finite(const Type& type, const void* value) { return find_in(type, value, ""); }

std::string to_text(const Fault& fault) {
  return "task '" + fault.task + "' activation " + std::to_string(fault.activation) + " at " +
         seconds_text(fault.instant) + " s: " + fault.cause;
}

std::string late_text(std::optional<Duration> ended, Duration deadline) {
  return "late: " +
         (ended ? "ended " + duration_text(*ended) + " after its release" : "had not ended when it was due") +
         ", deadline " + duration_text(deadline);
}

}  // namespace jarol
