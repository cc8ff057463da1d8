#include "runtime/machine/map_line.h"

#include <sys/mman.h>

#include <charconv>

namespace jarol {
namespace {

std::uintptr_t read_hexadecimal(std::string_view& line) {
  std::uintptr_t read = 0;
  const auto [end, error] = std::from_chars(line.data(), line.data() + line.size(), read, 16);
  line.remove_prefix(static_cast<std::size_t>(end - line.data()));
  return read;
}

}  // namespace

MapLine::MapLine(std::string_view& text) {
  const std::size_t end = text.find('\n');
  std::string_view line = text.substr(0, end);
  text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
  pages.begin = read_hexadecimal(line);
  line.remove_prefix(1);
  pages.end = read_hexadecimal(line);
  permissions = line.substr(1, 4);
  const std::size_t name_at = line.find_first_of("/[");
  if (name_at != std::string_view::npos) name = line.substr(name_at);
}

int MapLine::writable_protection() const {
  return (permissions[0] == 'r' ? PROT_READ : 0) | PROT_WRITE | (permissions[2] == 'x' ? PROT_EXEC : 0);
}

bool MapLine::is_of_system_library() const {
  const std::string_view file = name.substr(name.rfind('/') + 1);
  return name.starts_with("/usr/lib/") && !file.starts_with("libc.") && !file.starts_with("libc-") &&
         !file.starts_with("ld-");
}

std::vector<Pages> find_mapped(std::string_view text) {
  std::vector<Pages> mapped;
  while (MapLine::is_left(text)) {
    const Pages pages = MapLine(text).pages;
    if (!mapped.empty() && mapped.back().end == pages.begin)
      mapped.back().end = pages.end;
    else
      mapped.push_back(pages);
  }
  return mapped;
}

}  // namespace jarol
