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

// Of a value within an output; `range`: of the field that it belongs to.
std::string find_outside(const Type& type, const FieldRange& range, const std::string& unit, const void* value,
                         const std::string& path) {
  const auto* bytes = static_cast<const std::byte*>(value);
  const std::string prefix = path.empty() ? "" : path + ".";
  const auto find_element = [&](std::size_t count, const std::byte* elements) -> std::string {
    for (std::size_t i = 0; i < count; ++i)
      if (std::string found =
              find_outside(*type.element, range, unit, elements + i * type.element->size, prefix + std::to_string(i));
          !found.empty())
        return found;
    return "";
  };
  if (type.kind == Kind::array) return find_element(type.count, bytes);
  if (type.kind == Kind::sequence)
    return find_element(type.length(value), static_cast<const std::byte*>(type.elements(value)));
  if (range.is_stated()) {
    if (range.has(read_ranged(type, value))) return "";
    const std::string number =
        type.kind == Kind::duration ? duration_text(Duration(read_integer(type, value))) : scalar_text(type, value);
    return "output '" + path + "' is " + number + (unit.empty() ? "" : " " + unit) + ", out of its range " +
           range_text(type, range);
  }
  for (const TypeField& f : type.fields)
    if (std::string found = find_outside(*f.type, f.range, f.unit, bytes + f.offset, prefix + f.name); !found.empty())
      return found;
  return "";
}

constexpr std::string_view by_limit = ", which is its fault_limit";

}  // namespace

std::string find_out_of_range(const Type& type, const void* value) { return find_outside(type, {}, "", value, ""); }

std::string limit_text(const FaultLimit& limit) {
  return "; that is fault " + std::to_string(limit.faults) + " in " + std::to_string(limit.releases) + " releases" +
         std::string(by_limit);
}

bool is_by_limit(const Fault& fault) { return fault.cause.ends_with(by_limit); }

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
