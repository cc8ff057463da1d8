// What the process has mapped, as the system lists it: /proc/self/maps.
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

namespace jarol {

/// Addresses from `begin` to before `end`.
struct Pages {
  std::uintptr_t begin = 0, end = 0;
  bool operator==(const Pages&) const = default;
};

/// A line of it: "7f00-7f10 rw-p 00000000 00:00 0    [heap]".
struct MapLine {
  /// Takes the first line off a text.
  explicit MapLine(std::string_view& text);
  /// The text ends with a zero, or where it ends.
  static bool is_left(std::string_view text) { return !text.empty() && text.front() != '\0'; }

  bool is_writable() const { return permissions[1] == 'w'; }
  /// Nobody can read or write it.
  bool is_closed() const { return permissions.starts_with("---"); }
  /// As mprotect takes it, with PROT_WRITE.
  int writable_protection() const;
  /// That does not have the system itself write to its data, which says EFAULT where it can't: the C library does, and
  /// what is not of the system may.
  bool is_of_system_library() const;

  Pages pages;
  std::string_view permissions, name;  // "rw-p"; a path, "[stack]" or empty
};

/// All that is mapped, whatever its protection, as few pieces as it has.
std::vector<Pages> find_mapped(std::string_view text);

}  // namespace jarol
