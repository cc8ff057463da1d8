// What the linker calls this build of a program and of its libraries: the note .note.gnu.build-id, a hash of what it
// has linked.
#include <elf.h>
#include <link.h>

#include <fmt/format.h>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "graph/values/digest.h"
#include "runtime/checkpoint/run_origin.h"

namespace jarol {
namespace {

using Program = std::vector<std::pair<std::string, std::string>>;

constexpr std::size_t padded(std::size_t bytes) { return (bytes + 3) / 4 * 4; }

// The note within a segment of notes; empty: it is not there.
std::string find_build_id(const char* at, std::size_t size) {
  while (size >= sizeof(ElfW(Nhdr))) {
    const auto& note = *reinterpret_cast<const ElfW(Nhdr)*>(at);
    const std::size_t whole = sizeof note + padded(note.n_namesz) + padded(note.n_descsz);
    if (whole > size) return "";
    const char* const name = at + sizeof note;
    if (note.n_type == NT_GNU_BUILD_ID && std::string_view(name, note.n_namesz) == std::string_view("GNU", 4)) {
      std::string id;
      for (std::size_t i = 0; i < note.n_descsz; ++i)
        id += fmt::format("{:02x}", static_cast<unsigned char>(name[padded(note.n_namesz) + i]));
      return id;
    }
    at += whole;
    size -= whole;
  }
  return "";
}

// Of a file that was linked without one.
std::string sum_of_file(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  const std::string all{std::istreambuf_iterator<char>(file), {}};
  return fmt::format("sum {:016x}", digest::name_hash(all));
}

int add_part(dl_phdr_info* info, std::size_t, void* to) {
  auto& all = *static_cast<Program*>(to);
  const std::string path = info->dlpi_name;
  if (path.empty() && !all.empty()) return 0;    // the kernel's
  if (path.starts_with("linux-vdso")) return 0;  // is, too
  std::string id;
  for (int i = 0; id.empty() && i < info->dlpi_phnum; ++i) {
    const auto& part = info->dlpi_phdr[i];
    if (part.p_type == PT_NOTE)
      id = find_build_id(reinterpret_cast<const char*>(info->dlpi_addr + part.p_vaddr), part.p_memsz);
  }
  if (id.empty()) id = sum_of_file(path.empty() ? "/proc/self/exe" : path);
  all.emplace_back(path.empty() ? "this program" : std::filesystem::path(path).filename().string(), std::move(id));
  return 0;
}

}  // namespace

Program find_program() {
  Program all;
  dl_iterate_phdr(&add_part, &all);
  return all;
}

}  // namespace jarol
