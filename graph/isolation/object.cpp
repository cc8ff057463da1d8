#include "graph/isolation/object.h"

#include <algorithm>
#include <array>

#include "graph/isolation/import_list.h"
#include "graph/text/errors.h"

namespace jarol::isolation {
namespace {

// SHT_RELR, and what Android packs: of elf.h only since glibc 2.36
constexpr Elf64_Word relative_relocations = 19, android_rel = 0x60000001, android_rela = 0x60000002;

// It has that name, or one that begins with it and a point.
bool is_of(std::string_view name, std::string_view kind) {
  return name.starts_with(kind) && (name.size() == kind.size() || name[kind.size()] == '.');
}

Place place_of_section(std::string_view name, const Elf64_Shdr& section) {
  if ((section.sh_flags & SHF_ALLOC) == 0) return Place::nowhere;
  if ((section.sh_flags & SHF_EXECINSTR) != 0)
    return (section.sh_flags & SHF_WRITE) != 0 ? Place::writable : Place::code;
  if ((section.sh_flags & SHF_TLS) != 0) return Place::thread_local_data;
  if (name.starts_with(".got")) return Place::offset_table;
  return Place::constant;  // if the loader closes it
}

// What tasks run and read.
bool has_to_be_constant(std::string_view name) {
  constexpr std::array kinds{".text", ".plt", ".rodata", ".data.rel.ro", ".eh_frame", ".gcc_except_table"};
  return std::any_of(kinds.begin(), kinds.end(), [&](std::string_view kind) { return is_of(name, kind); });
}

// As in the source: without a version, and what compilers and linkers add to tell parts of the program apart.
std::string without_suffixes(std::string_view name) {
  std::string bare(name.substr(0, name.find('@')));
  for (const std::string_view of_part : {".lto_priv.", ".__uniq.", ".llvm."}) {
    const std::size_t at = bare.find(of_part);
    if (at == std::string::npos) continue;
    std::size_t end = at + of_part.size();
    while (end < bare.size() && bare[end] >= '0' && bare[end] <= '9') ++end;
    bare.erase(at, end - at);
  }
  return bare;
}

bool is_section_of_stubs(std::string_view name) {
  return name == ".plt" || name == ".plt.got" || name == ".plt.sec" || name == ".iplt";
}

// The last that begins at or before an address.
const Symbol* last_before(const std::vector<Symbol>& symbols, Address address) {
  const auto after = std::upper_bound(symbols.begin(), symbols.end(), address,
                                      [](Address a, const Symbol& symbol) { return a < symbol.begin; });
  return after == symbols.begin() ? nullptr : &*std::prev(after);
}

Address next_begin(const std::vector<Symbol>& symbols, Address address, Address limit) {
  const auto after = std::upper_bound(symbols.begin(), symbols.end(), address,
                                      [](Address a, const Symbol& symbol) { return a < symbol.begin; });
  return after == symbols.end() ? limit : std::min(limit, after->begin);
}

// One for each address, the longest, and of several names the first.
void order(std::vector<Symbol>& symbols) {
  std::sort(symbols.begin(), symbols.end(), [](const Symbol& a, const Symbol& b) {
    return std::tuple(a.begin, ~a.end, std::string_view(a.name)) <
           std::tuple(b.begin, ~b.end, std::string_view(b.name));
  });
  symbols.erase(
      std::unique(symbols.begin(), symbols.end(), [](const Symbol& a, const Symbol& b) { return a.begin == b.begin; }),
      symbols.end());
}

}  // namespace

Object::Object(const std::string& path) : file_(path) {
  if (file_.sections().empty()) throw InputError("is no object file for x86-64 that can be read");
  if (file_.type() != ET_DYN)
    throw InputError("is no shared library; link it with -shared, as graph/plugins/plugin.h says");
  const Elf64_Shdr* symbols = nullptr;
  for (const Elf64_Shdr& section : file_.sections()) {
    const std::string_view name = file_.name(section);
    if (section.sh_type == SHT_SYMTAB) symbols = &section;
    Place place = place_of_section(name, section);
    if (place == Place::nowhere || section.sh_size == 0) continue;
    if (place == Place::thread_local_data && section.sh_type == SHT_NOBITS) continue;  // takes no addresses
    const Address end = section.sh_addr + section.sh_size;
    if (end < section.sh_addr) throw InputError("is damaged");
    if ((place == Place::code || place == Place::constant) && file_.stays_writable(section.sh_addr, end)) {
      if (has_to_be_constant(name))
        throw InputError("has its " + std::string(name) +
                         " in memory that stays writable; link it without -z norelro, -N and --omagic");
      place = Place::writable;
    }
    sections_.push_back({section.sh_addr, end, place, file_.content(section), is_section_of_stubs(name)});
  }
  std::sort(sections_.begin(), sections_.end(), [](const Section& a, const Section& b) { return a.begin < b.begin; });
  if (symbols == nullptr)
    throw InputError("has no table of symbols, so that its code has no names; link it without -s and don't strip it");
  read_symbols(*symbols);
  for (const Elf64_Shdr& section : file_.sections()) {
    if ((section.sh_flags & SHF_ALLOC) == 0) continue;
    if (section.sh_type == SHT_RELA) read_pointers(section);
    if (section.sh_type == relative_relocations) read_relative_pointers(section);
    if (section.sh_type == SHT_REL || section.sh_type == android_rel || section.sh_type == android_rela)
      throw InputError("has relocations of a form that is not known here; link it without packing them");
  }
}

void Object::read_symbols(const Elf64_Shdr& table) {
  for (const auto& symbol : file_.entries<Elf64_Sym>(table)) {
    if (symbol.st_shndx == SHN_UNDEF || symbol.st_shndx >= file_.sections().size()) continue;
    const unsigned type = ELF64_ST_TYPE(symbol.st_info);
    const std::string name = without_suffixes(file_.text(table, symbol.st_name));
    if (type == STT_TLS) {
      thread_locals_.emplace(symbol.st_value, name);
      continue;
    }
    if (type == STT_SECTION || type == STT_FILE || name.empty()) continue;
    const Place place = place_of(symbol.st_value);
    const Symbol found{symbol.st_value, symbol.st_value + symbol.st_size, name};
    if (place == Place::code && (type == STT_FUNC || type == STT_GNU_IFUNC || type == STT_NOTYPE))
      functions_.push_back(found);
    else if (type == STT_OBJECT)
      data_.push_back(found);
  }
  order(functions_);
  order(data_);
  for (std::size_t i = 0; i < functions_.size(); ++i) by_name_[functions_[i].name].push_back(i);
}

std::string Object::thread_local_at(Address offset) const {
  const auto found = thread_locals_.find(offset);
  return found == thread_locals_.end() ? "" : found->second;
}

Pointer Object::pointer_of(const Elf64_Rela& relocation, const std::vector<Elf64_Sym>& symbols,
                           const Elf64_Shdr& names) const {
  const std::size_t index = ELF64_R_SYM(relocation.r_info);
  const auto addend = static_cast<Address>(relocation.r_addend);
  const Elf64_Sym* const symbol = index != 0 && index < symbols.size() ? &symbols[index] : nullptr;
  const std::string name = symbol != nullptr ? without_suffixes(file_.text(names, symbol->st_name)) : "";
  switch (ELF64_R_TYPE(relocation.r_info)) {
    case R_X86_64_DTPMOD64: {
      // the offset within the module stands beside it
      const Bytes offset = bytes(relocation.r_offset + 8, relocation.r_offset + 16);
      Address value = 0;
      if (!offset.empty()) std::memcpy(&value, offset.data(), sizeof value);
      return {Pointer::To::thread_local_data, 0, symbol != nullptr ? name : thread_local_at(value)};
    }
    case R_X86_64_DTPOFF64:
    case R_X86_64_TPOFF64:
    case R_X86_64_TLSDESC:
      return {Pointer::To::thread_local_data, 0, symbol != nullptr ? name : thread_local_at(addend)};
    case R_X86_64_COPY: return {Pointer::To::copy, 0, name};
    default: break;
  }
  if (symbol == nullptr) return {Pointer::To::address, addend, ""};
  // C's functions, new and delete are taken from the libraries that the program has loaded, though they are here, too;
  // but where there is nothing to allocate, as a place is given
  const bool is_operator = name.starts_with("_Zn") || name.starts_with("_Zd");
  const bool is_placed = is_operator && (name.ends_with("mPv") || name.ends_with("PvS_"));
  const bool is_theirs = (is_operator || !name.starts_with("_Z")) && !is_placed && !kind_of_refused(name).empty();
  if (symbol->st_shndx == SHN_UNDEF || is_theirs) return {Pointer::To::import, 0, name};
  const bool exact = ELF64_R_TYPE(relocation.r_info) == R_X86_64_64;
  return {Pointer::To::address, symbol->st_value + (exact ? addend : 0), ""};
}

void Object::read_pointers(const Elf64_Shdr& table) {
  if (table.sh_link >= file_.sections().size()) return;
  const Elf64_Shdr& names = file_.sections()[table.sh_link];
  const auto symbols = file_.entries<Elf64_Sym>(names);
  for (const auto& relocation : file_.entries<Elf64_Rela>(table)) {
    if (place_of(relocation.r_offset) == Place::code)
      throw InputError("has code that the loader changes; build it with -fPIC, as graph/plugins/plugin.h says");
    pointers_.emplace(relocation.r_offset, pointer_of(relocation, symbols, names));
  }
}

// An even entry is a place that holds an address; an odd one has a bit for each of the 63 words behind the last.
void Object::read_relative_pointers(const Elf64_Shdr& table) {
  constexpr Address word = 8, words = 63;
  const auto add = [&](Address at) {
    const Bytes bytes_there = bytes(at, at + word);
    Address value = 0;
    if (bytes_there.size() == word) std::memcpy(&value, bytes_there.data(), word);
    if (place_of(at) == Place::code || place_of(at) == Place::nowhere) throw InputError("is damaged");
    pointers_.emplace(at, Pointer{Pointer::To::address, value, ""});
  };
  Address next = 0;
  for (const auto& entry : file_.entries<Elf64_Xword>(table)) {
    if ((entry & 1) == 0) {
      add(entry);
      next = entry + word;
      continue;
    }
    for (Address i = 0; i < words; ++i)
      if ((entry >> (i + 1) & 1) != 0) add(next + word * i);
    next += word * words;
  }
}

const Object::Section* Object::section_at(Address address) const {
  const auto after = std::upper_bound(sections_.begin(), sections_.end(), address,
                                      [](Address a, const Section& section) { return a < section.begin; });
  if (after == sections_.begin()) return nullptr;
  const Section& section = *std::prev(after);
  return address < section.end ? &section : nullptr;
}

Place Object::place_of(Address address) const {
  const Section* const section = section_at(address);
  if (section != nullptr) return section->place;
  // between sections, too, memory can be written
  return file_.stays_writable(address, address + 1) ? Place::writable : Place::nowhere;
}

Bytes Object::bytes(Address begin, Address end) const {
  const Section* const section = section_at(begin);
  if (section == nullptr || end < begin || end > section->end || section->bytes.empty()) return {};
  return section->bytes.subspan(begin - section->begin, end - begin);
}

Symbol Object::function_at(Address address) const {
  const Section* const section = section_at(address);
  const Address limit = section == nullptr ? address : section->end;
  const Symbol* const found = last_before(functions_, address);
  if (found != nullptr && (address == found->begin || address < found->end || found->end == found->begin) &&
      section != nullptr && found->begin >= section->begin) {
    Symbol whole = *found;
    if (whole.end == whole.begin) whole.end = next_begin(functions_, address, limit);
    whole.end = std::min(whole.end, limit);
    return whole;
  }
  return {address, next_begin(functions_, address, limit), ""};
}

Symbol Object::data_at(Address address) const {
  const Section* const section = section_at(address);
  const Address limit = section == nullptr ? address : section->end;
  const Symbol* const found = last_before(data_, address);
  if (found != nullptr && address < found->end) return *found;
  return {address, next_begin(data_, address, limit), ""};
}

bool Object::begins_at(Address address) const {
  const Symbol* const found = last_before(data_, address);
  return (found != nullptr && found->begin == address) || pointer_at(address) != nullptr;
}

std::vector<Symbol> Object::functions_named(std::string_view name) const {
  std::vector<Symbol> found;
  if (const auto at = by_name_.find(name); at != by_name_.end())
    for (const std::size_t i : at->second) found.push_back(function_at(functions_[i].begin));
  return found;
}

std::vector<Symbol> Object::parts_of(std::string_view name) const {
  std::vector<Symbol> found;
  for (auto at = by_name_.lower_bound(name); at != by_name_.end() && at->first.starts_with(name); ++at) {
    const std::string_view rest = std::string_view(at->first).substr(name.size());
    if (rest.find_first_not_of("0123456789") != std::string_view::npos) continue;
    for (const std::size_t i : at->second) found.push_back(function_at(functions_[i].begin));
  }
  return found;
}

const Pointer* Object::pointer_at(Address address) const {
  const auto found = pointers_.find(address);
  return found == pointers_.end() ? nullptr : &found->second;
}

std::vector<std::pair<Address, const Pointer*>> Object::pointers_in(Address begin, Address end) const {
  std::vector<std::pair<Address, const Pointer*>> found;
  for (auto at = pointers_.lower_bound(begin); at != pointers_.end() && at->first < end; ++at)
    found.emplace_back(at->first, &at->second);
  return found;
}

const Pointer* Object::behind_stub(Address address) const {
  const Section* const section = section_at(address);
  if (section == nullptr || !section->stubs) return nullptr;
  // an indirect jump relative to the place of the next instruction, FF 25 and four bytes, after at most ten others
  const Bytes code = bytes(address, std::min(section->end, address + 16));
  for (std::size_t i = 0; i + 6 <= code.size(); ++i) {
    if (code[i] != 0xff || code[i + 1] != 0x25) continue;
    std::int32_t distance = 0;
    std::memcpy(&distance, code.data() + i + 2, sizeof distance);
    return pointer_at(address + i + 6 + static_cast<Address>(static_cast<std::int64_t>(distance)));
  }
  return nullptr;
}

}  // namespace jarol::isolation
