#include "graph/isolation/source_lines.h"

#include <dwarf.h>
#include <elfutils/libdw.h>
#include <elfutils/libdwfl.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>

#include "graph/isolation/names.h"

namespace jarol::isolation {
namespace {

// No debug data but those in the file: none is searched elsewhere.
int find_nothing(Dwfl_Module*, void**, const char*, Dwarf_Addr, const char*, const char*, GElf_Word, char**) {
  return -1;
}

const Dwfl_Callbacks callbacks{nullptr, find_nothing, dwfl_offline_section_address, nullptr};

std::string text_of(Dwarf_Die* die, unsigned attribute) {
  Dwarf_Attribute found;
  const char* const text = dwarf_formstring(dwarf_attr_integrate(die, attribute, &found));
  return text == nullptr ? "" : text;
}

// All that a piece of debug data stands in, from itself outwards.
std::vector<Dwarf_Die> with_parents(Dwarf_Die* die) {
  Dwarf_Die* scopes = nullptr;
  const int count = dwarf_getscopes_die(die, &scopes);
  std::vector<Dwarf_Die> all(scopes, scopes + std::max(count, 0));
  std::free(scopes);
  return all;
}

// Where a function is declared, of a copy of it that was inlined or a definition.
Dwarf_Die declaration_of(Dwarf_Die die) {
  for (const unsigned attribute : {DW_AT_abstract_origin, DW_AT_specification}) {
    Dwarf_Attribute found;
    Dwarf_Die other;
    if (dwarf_formref_die(dwarf_attr(&die, attribute, &found), &other) != nullptr) die = other;
  }
  return die;
}

std::string name_of(Dwarf_Die* die) {
  const std::string linked = text_of(die, DW_AT_linkage_name);
  if (!linked.empty()) return demangled(linked);
  // functions that exist as inlined copies only have no name for the linker
  Dwarf_Die declaration = declaration_of(*die);
  std::string name;
  for (Dwarf_Die& part : with_parents(&declaration)) {
    std::string word = text_of(&part, DW_AT_name);
    const int tag = dwarf_tag(&part);
    if (tag == DW_TAG_compile_unit) break;
    if (!name.empty() && tag == DW_TAG_subprogram) return name_of(&part) + "::" + name;
    const bool is_type = tag == DW_TAG_structure_type || tag == DW_TAG_class_type;
    if (word.empty() && is_type) word = "{lambda}";
    if (!word.empty() && tag != DW_TAG_lexical_block) name = name.empty() ? word : word + "::" + name;
  }
  return name;
}

Dwarf_Word number_of(Dwarf_Die* die, unsigned attribute) {
  Dwarf_Attribute found;
  Dwarf_Word number = 0;
  return dwarf_formudata(dwarf_attr(die, attribute, &found), &number) == 0 ? number : 0;
}

std::string file_of(Dwarf_Die* unit, Dwarf_Word number) {
  Dwarf_Files* files = nullptr;
  if (dwarf_getsrcfiles(unit, &files, nullptr) != 0) return "";
  const char* const name = dwarf_filesrc(files, number, nullptr, nullptr);
  return name == nullptr ? "" : name;
}

}  // namespace

struct SourceLines::Reader {
  Dwfl* session = nullptr;
  Dwfl_Module* module = nullptr;
  Dwarf_Addr begin = 0;  // where the session sees the file's address 0

  // The unit that has the code there, or null. clang writes no table of which has what: each is asked.
  Dwarf_Die* unit_at(Dwarf_Addr at, Dwarf_Addr& bias) const {
    if (Dwarf_Die* const unit = dwfl_module_addrdie(module, at, &bias)) return unit;
    Dwarf_Die* unit = nullptr;
    while ((unit = dwfl_module_nextcu(module, unit, &bias)) != nullptr)
      if (dwarf_haspc(unit, at - bias) > 0) return unit;
    return nullptr;
  }
};

SourceLines::SourceLines(const std::string& path) : reader_(std::make_unique<Reader>()) {
  reader_->session = dwfl_begin(&callbacks);
  if (reader_->session == nullptr) return;
  reader_->module = dwfl_report_offline(reader_->session, path.c_str(), path.c_str(), -1);
  dwfl_report_end(reader_->session, nullptr, nullptr);
  if (reader_->module == nullptr) return;
  GElf_Addr bias = 0;
  if (dwfl_module_getelf(reader_->module, &bias) == nullptr) reader_->module = nullptr;
  reader_->begin = bias;
}

SourceLines::~SourceLines() {
  if (reader_->session != nullptr) dwfl_end(reader_->session);
}

std::vector<Frame> SourceLines::frames_at(Address address) const {
  std::vector<Frame> frames;
  if (reader_->module == nullptr) return {{}};
  Dwarf_Addr bias = 0;
  Dwarf_Die* const unit = reader_->unit_at(address + reader_->begin, bias);
  if (unit == nullptr) return {{}};
  Frame innermost;
  if (Dwarf_Line* const line = dwarf_getsrc_die(unit, address + reader_->begin - bias))
    if (const char* const file = dwarf_linesrc(line, nullptr, nullptr);
        file != nullptr && dwarf_lineno(line, &innermost.line) == 0)
      innermost.file = file;
  Dwarf_Die* scopes = nullptr;
  const int count = dwarf_getscopes(unit, address + reader_->begin - bias, &scopes);
  std::vector<Dwarf_Die> around;
  if (count > 0) around = with_parents(&scopes[0]);
  std::free(scopes);
  for (Dwarf_Die& scope : around) {
    const int tag = dwarf_tag(&scope);
    if (tag != DW_TAG_inlined_subroutine && tag != DW_TAG_subprogram) continue;
    innermost.function = name_of(&scope);
    frames.push_back(innermost);
    if (tag == DW_TAG_subprogram) break;
    innermost = {"", file_of(unit, number_of(&scope, DW_AT_call_file)),
                 static_cast<int>(number_of(&scope, DW_AT_call_line))};
  }
  if (frames.empty()) frames.push_back(innermost);
  std::reverse(frames.begin(), frames.end());
  return frames;
}

}  // namespace jarol::isolation
