#include "graph/isolation/elf_file.h"

#include <algorithm>
#include <fstream>
#include <iterator>

namespace jarol::isolation {
namespace {

// Far more than a library has, debug data and all.
constexpr std::streamoff max_bytes = std::streamoff{2} << 30;

}  // namespace

std::vector<unsigned char> read_elf(const std::string& path) {
  std::ifstream in(path, std::ios::binary | std::ios::ate);
  const std::streamoff size = in ? static_cast<std::streamoff>(in.tellg()) : 0;
  char mark[SELFMAG] = {};
  in.seekg(0);
  if (size < SELFMAG || size > max_bytes || !in.read(mark, SELFMAG) || std::memcmp(mark, ELFMAG, SELFMAG) != 0)
    return {};
  std::vector<unsigned char> bytes(static_cast<std::size_t>(size));
  in.seekg(0);
  in.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  bytes.resize(static_cast<std::size_t>(std::max<std::streamsize>(in.gcount(), 0)));
  return bytes;
}

ElfFile::ElfFile(const std::string& path) : bytes_(read_elf(path)) {
  const auto head = read<Elf64_Ehdr>(0);
  if (!head || std::memcmp(head->e_ident, ELFMAG, SELFMAG) != 0 || head->e_ident[EI_CLASS] != ELFCLASS64 ||
      head->e_machine != EM_X86_64)
    return;
  type_ = head->e_type;
  names_ = head->e_shstrndx;
  for (std::size_t i = 0; i < head->e_shnum; ++i) {
    const auto section = read<Elf64_Shdr>(head->e_shoff + i * sizeof(Elf64_Shdr));
    if (!section) {
      sections_.clear();
      return;
    }
    sections_.push_back(*section);
  }
  for (std::size_t i = 0; i < head->e_phnum; ++i)
    if (const auto segment = read<Elf64_Phdr>(head->e_phoff + i * sizeof(Elf64_Phdr))) segments_.push_back(*segment);
}

bool ElfFile::stays_writable(Elf64_Addr begin, Elf64_Addr end) const {
  constexpr Elf64_Addr page = 4096;
  // what the loader closes: whole pages
  const auto is_closed = [&](Elf64_Addr from, Elf64_Addr to) {
    return std::any_of(segments_.begin(), segments_.end(), [&](const Elf64_Phdr& segment) {
      return segment.p_type == PT_GNU_RELRO && from >= segment.p_vaddr / page * page &&
             to <= (segment.p_vaddr + segment.p_memsz) / page * page;
    });
  };
  return std::any_of(segments_.begin(), segments_.end(), [&](const Elf64_Phdr& segment) {
    const Elf64_Addr from = std::max(begin, segment.p_vaddr / page * page),
                     to = std::min(end, (segment.p_vaddr + segment.p_memsz + page - 1) / page * page);
    return segment.p_type == PT_LOAD && (segment.p_flags & PF_W) != 0 && from < to && !is_closed(from, to);
  });
}

Bytes ElfFile::content(const Elf64_Shdr& section) const {
  if (section.sh_type == SHT_NOBITS || section.sh_offset > bytes_.size() ||
      section.sh_size > bytes_.size() - section.sh_offset)
    return {};
  return Bytes(bytes_).subspan(section.sh_offset, section.sh_size);
}

std::string_view ElfFile::name(const Elf64_Shdr& section) const {
  Elf64_Shdr in_names{};
  in_names.sh_link = static_cast<Elf64_Word>(names_);
  return text(in_names, section.sh_name);
}

std::string_view ElfFile::text(const Elf64_Shdr& section, std::size_t offset) const {
  if (section.sh_link >= sections_.size()) return {};
  const Bytes table = content(sections_[section.sh_link]);
  if (offset >= table.size()) return {};
  const auto begin = table.begin() + static_cast<std::ptrdiff_t>(offset);
  const auto end = std::find(begin, table.end(), 0);
  return {reinterpret_cast<const char*>(&*begin), static_cast<std::size_t>(end - begin)};
}

}  // namespace jarol::isolation
