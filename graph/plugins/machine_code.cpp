#include "graph/plugins/machine_code.h"

#include <algorithm>
#include <array>
#include <span>
#include <string_view>

#include "graph/isolation/elf_file.h"
#include "graph/isolation/import_list.h"
#include "graph/isolation/instruction.h"

namespace jarol {
namespace {

using namespace std::literals;
using isolation::Bytes;
using Elf = isolation::ElfFile;

// An instruction that loads MXCSR begins here, or bytes that look like one: LDMXCSR 0F AE /2, FXRSTOR /1, XRSTOR /5
// with an operand in memory (Intel SDM volume 2), VLDMXCSR the same after a VEX prefix in place of 0F.
bool loads_control(Bytes code) {
  if (code.empty()) return false;
  const std::size_t opcode = code[0] == 0x0f ? 1 : code[0] == 0xc5 ? 2 : code[0] == 0xc4 ? 3 : 0;
  if (opcode == 0 || code.size() < opcode + 2 || code[opcode] != 0xae) return false;
  const unsigned operand = code[opcode + 1];
  const unsigned extension = operand >> 3 & 7U;
  const bool in_memory = operand >> 6 != 3;
  return in_memory && (extension == 1 || extension == 2 || extension == 5);
}

bool begins_with_one_of(std::string_view name, std::span<const std::string_view> beginnings) {
  return std::any_of(beginnings.begin(), beginnings.end(),
                     [&](std::string_view beginning) { return name.starts_with(beginning); });
}

// A list has a space before and after each of its words.
bool holds(std::string_view list, std::string_view word) {
  return list.find(" " + std::string(word) + " ") != std::string_view::npos;
}

// What may be called: mathematics and memory of the C library, the C++ library, what compilers call by themselves, and
// what Jarol's headers use. Whatever of these changes the environment for a moment gives it back.
bool leaves_it_alone(std::string_view name) {
  static constexpr std::string_view others =
      " lgamma lgammaf abort bcmp free malloc calloc realloc aligned_alloc posix_memalign memchr memcmp memcpy "
      "memmove memset strlen strcmp strncmp strchr strtod strtol strtoul snprintf qsort rand "
      "__errno_location __dso_handle _GLOBAL_OFFSET_TABLE_ __gmon_start__ "
      "_ITM_deregisterTMCloneTable _ITM_registerTMCloneTable __tls_get_addr __stack_chk_fail "
      "__assert_fail __memcpy_chk __memmove_chk __memset_chk __snprintf_chk ";
  // mangled: std::, operators new and delete, type information, and jarol::
  static constexpr std::array beginnings = {
      "__cxa_"sv, "__gxx_personality"sv, "_Unwind_"sv, "_ZNSt"sv, "_ZNKSt"sv, "_ZSt"sv,      "_ZTV"sv,      "_ZTI"sv,
      "_ZTS"sv,   "_ZTTNSt"sv,           "_ZTTSt"sv,   "_Zn"sv,   "_Zd"sv,    "_ZN5jarol"sv, "_ZNK5jarol"sv};
  if (name.starts_with("_ZN5jarol26set_floating_point_control")) return false;
  if (holds(others, name) || begins_with_one_of(name, beginnings)) return true;
  return isolation::is_mathematics(std::string(name));
}

constexpr const char* loads = "holds an instruction that loads it";

// The x87 control word's are two bytes, which stand by chance in any longer code: here only as instructions count.
// Whatever else computes with x87 registers, or with those of MMX, which are the same, may leave some in use.
std::string find_x87(Bytes code) {
  const auto all = isolation::decode_section(code);
  if (!all) return loads;  // nobody knows
  std::string found;
  for (const isolation::Instruction& instruction : *all) {
    if (*instruction.forbidden != '\0' && holds(" fldcw fldenv frstor fninit ", instruction.text)) return loads;
    if (instruction.x87) found = "computes with x87 registers";
  }
  return found;
}

std::string find_instruction(Bytes code) {
  for (std::size_t i = 0; i < code.size(); ++i)
    if (loads_control(code.subspan(i))) return loads;
  return find_x87(code);
}

std::string find_call(const Elf& file, const Elf64_Shdr& table) {
  for (const auto& symbol : file.entries<Elf64_Sym>(table)) {
    std::string_view name = file.text(table, symbol.st_name);
    name = name.substr(0, name.find('@'));  // without its version
    const bool elsewhere = symbol.st_shndx == SHN_UNDEF && ELF64_ST_BIND(symbol.st_info) != STB_LOCAL;
    if (elsewhere && !leaves_it_alone(name)) return "calls '" + std::string(name) + "'";
  }
  return "";
}

std::string find_library(const Elf& file, const Elf64_Shdr& dynamic) {
  static constexpr std::string_view known = " libc.so.6 libm.so.6 libstdc++.so.6 libgcc_s.so.1 ld-linux-x86-64.so.2 ";
  for (const auto& entry : file.entries<Elf64_Dyn>(dynamic)) {
    if (entry.d_tag == DT_NULL) break;
    const std::string_view name = entry.d_tag == DT_NEEDED ? file.text(dynamic, entry.d_un.d_val) : "";
    if (!name.empty() && !holds(known, name)) return "uses the library '" + std::string(name) + "'";
  }
  return "";
}

}  // namespace

std::string find_floating_point_change(const std::string& path) {
  const Elf file(path);
  if (file.sections().empty()) return "is no object file that can be read here";
  for (const Elf64_Shdr& section : file.sections()) {
    std::string found;
    if ((section.sh_flags & SHF_EXECINSTR) != 0) found = find_instruction(file.content(section));
    if (section.sh_type == SHT_SYMTAB || section.sh_type == SHT_DYNSYM) found = find_call(file, section);
    if (section.sh_type == SHT_DYNAMIC) found = find_library(file, section);
    if (!found.empty()) return found;
  }
  return "";
}

}  // namespace jarol
