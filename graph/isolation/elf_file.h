// An ELF file for x86-64 as bytes: its sections, tables, and parts of memory.
#pragma once

#include <elf.h>

#include <cstring>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace jarol::isolation {

using Bytes = std::span<const unsigned char>;

/// The bytes of a file; none if it does not begin as an ELF file does, or has more than 2 GiB.
std::vector<unsigned char> read_elf(const std::string& path);

/// A file whose numbers may be anything; what lies outside of it is not there.
class ElfFile {
 public:
  explicit ElfFile(const std::string& path);

  /// Empty: it is no ELF file of this kind, or a damaged one.
  const std::vector<Elf64_Shdr>& sections() const { return sections_; }

  /// Some byte of a range of addresses stays writable when the loader is done, whatever its section says.
  bool stays_writable(Elf64_Addr begin, Elf64_Addr end) const;

  /// ET_DYN for a shared library.
  unsigned type() const { return type_; }

  Bytes content(const Elf64_Shdr& section) const;
  std::string_view name(const Elf64_Shdr& section) const;

  /// The text at an offset of the string table that belongs to a section.
  std::string_view text(const Elf64_Shdr& section, std::size_t offset) const;

  /// All entries of a table.
  template <class Entry>
  std::vector<Entry> entries(const Elf64_Shdr& section) const {
    const Bytes table = content(section);
    std::vector<Entry> all(table.size() / sizeof(Entry));
    if (!all.empty()) std::memcpy(all.data(), table.data(), all.size() * sizeof(Entry));
    return all;
  }

 private:
  template <class T>
  std::optional<T> read(std::size_t offset) const {
    if (offset > bytes_.size() || bytes_.size() - offset < sizeof(T)) return std::nullopt;
    T value;
    std::memcpy(&value, bytes_.data() + offset, sizeof value);
    return value;
  }

  std::vector<unsigned char> bytes_;
  std::vector<Elf64_Shdr> sections_;
  std::vector<Elf64_Phdr> segments_;
  unsigned type_ = ET_NONE;
  std::size_t names_ = 0;  // the section with the names of sections
};

}  // namespace jarol::isolation
