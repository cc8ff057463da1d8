// A linked shared library or program, by addresses: its functions, its data, and what each pointer in it refers to.
#pragma once

#include <algorithm>
#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "graph/isolation/elf_file.h"

namespace jarol::isolation {

using Address = std::uint64_t;

struct Symbol {
  Address begin = 0, end = 0;  // end: of its code or data, where that is known
  std::string name;            // mangled, without version; empty: no symbol stands here

  /// The part of a function that compilers put elsewhere, as it hardly ever runs.
  bool is_cold() const { return name.find(".cold") != std::string::npos; }
};

/// What the loader writes into a place of eight bytes.
struct Pointer {
  // copy: all of an import's bytes, into a program
  enum class To : std::uint8_t { address, import, copy, thread_local_data };
  To to = To::address;
  Address address = 0;
  std::string name;  // of the import or the thread-local
};

enum class Place : std::uint8_t { nowhere, code, constant, offset_table, writable, thread_local_data };

class Object {
 public:
  /// Throws InputError with words that follow the file's name.
  explicit Object(const std::string& path);

  Place place_of(Address address) const;
  Bytes bytes(Address begin, Address end) const;

  /// The function that an address of code lies in; where there is no symbol, code up to the next one.
  Symbol function_at(Address address) const;
  /// The same for data.
  Symbol data_at(Address address) const;
  /// Data with a name, or a place that holds a pointer.
  bool begins_at(Address address) const;
  std::vector<Symbol> functions_named(std::string_view name) const;
  /// Those of that name and of it with a number: f.__part.7 of "f.__part.".
  std::vector<Symbol> parts_of(std::string_view name) const;
  const std::vector<Symbol>& functions() const { return functions_; }

  /// Something of another library whose name begins so.
  bool imports_any(std::string_view beginning) const {
    return std::any_of(pointers_.begin(), pointers_.end(), [&](const auto& pointer) {
      return pointer.second.to == Pointer::To::import && pointer.second.name.starts_with(beginning);
    });
  }

  /// Null: the place holds no pointer.
  const Pointer* pointer_at(Address address) const;
  /// All pointers within a range, by place.
  std::vector<std::pair<Address, const Pointer*>> pointers_in(Address begin, Address end) const;

  /// What a call of an entry of the table of procedure linkage ends up in; null: it is no such entry.
  const Pointer* behind_stub(Address address) const;

 private:
  struct Section {
    Address begin, end;
    Place place;
    Bytes bytes;
    bool stubs;
  };
  const Section* section_at(Address address) const;
  void read_symbols(const Elf64_Shdr& table);
  void read_pointers(const Elf64_Shdr& table);
  void read_relative_pointers(const Elf64_Shdr& table);
  Pointer pointer_of(const Elf64_Rela& relocation, const std::vector<Elf64_Sym>& symbols,
                     const Elf64_Shdr& names) const;
  std::string thread_local_at(Address offset) const;

  ElfFile file_;
  std::vector<Section> sections_;         // by address
  std::vector<Symbol> functions_, data_;  // by address
  std::map<std::string, std::vector<std::size_t>, std::less<>> by_name_;
  std::map<Address, std::string> thread_locals_;  // by offset
  std::map<Address, Pointer> pointers_;
};

}  // namespace jarol::isolation
