#include "runtime/machine/arithmetic.h"

#include <dlfcn.h>
#include <elf.h>
#include <link.h>
#include <algorithm>

#include <cstdint>
#include <cstring>
#include <filesystem>
#include <map>
#include <string_view>

#include "graph/isolation/import_list.h"
#include "graph/math/names.h"
#include "graph/plugins/loaded_libraries.h"

namespace jarol {
namespace {

using Functions = std::map<std::string_view, const void*>;

struct Search {
  Functions functions;
  std::vector<std::string> plugins;  // as the loader names them
  std::vector<std::string> foreign;
};

std::string file_name(const char* path) { return std::filesystem::path(path).filename(); }

// Of one loaded object: what its dynamic section says of its imports.
struct Imports {
  const ElfW(Sym) * symbols = nullptr;
  const char* strings = nullptr;
  const ElfW(Rela) * tables[2]{};
  std::size_t sizes[2]{};
};

Imports imports_of(const ElfW(Dyn) * entry, ElfW(Addr) base) {
  Imports found;
  for (; entry->d_tag != DT_NULL; ++entry) {
    // an address or, where the C library leaves it so, an offset; or a size
    const bool is_size = entry->d_tag == DT_PLTRELSZ || entry->d_tag == DT_RELASZ;
    const auto value = entry->d_un.d_ptr + (!is_size && entry->d_un.d_ptr < base ? base : 0);
    switch (entry->d_tag) {
      case DT_SYMTAB: found.symbols = reinterpret_cast<const ElfW(Sym)*>(value); break;
      case DT_STRTAB: found.strings = reinterpret_cast<const char*>(value); break;
      case DT_JMPREL: found.tables[0] = reinterpret_cast<const ElfW(Rela)*>(value); break;
      case DT_PLTRELSZ: found.sizes[0] = value / sizeof(ElfW(Rela)); break;
      case DT_RELA: found.tables[1] = reinterpret_cast<const ElfW(Rela)*>(value); break;
      case DT_RELASZ: found.sizes[1] = value / sizeof(ElfW(Rela)); break;
      default: break;
    }
  }
  return found;
}

bool lies_in(const dl_phdr_info& object, std::uintptr_t address) {
  for (int i = 0; i < object.dlpi_phnum; ++i) {
    const auto& part = object.dlpi_phdr[i];
    if (part.p_type == PT_LOAD && address - object.dlpi_addr - part.p_vaddr < part.p_memsz) return true;
  }
  return false;
}

int look_at(dl_phdr_info* object, std::size_t, void* data) {
  auto& search = *static_cast<Search*>(data);
  const ElfW(Dyn)* dynamic = nullptr;
  for (int i = 0; i < object->dlpi_phnum; ++i)
    if (object->dlpi_phdr[i].p_type == PT_DYNAMIC)
      dynamic = reinterpret_cast<const ElfW(Dyn)*>(object->dlpi_addr + object->dlpi_phdr[i].p_vaddr);
  // the kernel's object has nothing to relocate, and addresses of another kind
  if (dynamic == nullptr || std::strstr(object->dlpi_name, "vdso") != nullptr) return 0;
  const Imports imports = imports_of(dynamic, object->dlpi_addr);
  const bool is_plugin =
      std::find(search.plugins.begin(), search.plugins.end(), object->dlpi_name) != search.plugins.end();
  for (int table = 0; table < 2; ++table)
    for (std::size_t i = 0; i < imports.sizes[table]; ++i) {
      const ElfW(Rela)& relocation = imports.tables[table][i];
      const auto symbol = ELF64_R_SYM(relocation.r_info);
      if (symbol == 0 || imports.symbols[symbol].st_shndx != SHN_UNDEF) continue;
      const char* name = imports.strings + imports.symbols[symbol].st_name;
      const auto function = search.functions.find(name);
      const bool is_ours = function != search.functions.end();
      if (!is_ours && !(is_plugin && isolation::is_of_c_library(name))) continue;
      // where the call leads; before its first, that is back into the object, which then asks in the order of look-up
      auto target = *reinterpret_cast<const std::uintptr_t*>(object->dlpi_addr + relocation.r_offset);
      if (lies_in(*object, target)) target = reinterpret_cast<std::uintptr_t>(dlsym(RTLD_DEFAULT, name));
      if (is_ours && target == reinterpret_cast<std::uintptr_t>(function->second)) continue;
      Dl_info there{};
      const bool known = dladdr(reinterpret_cast<const void*>(target), &there) != 0 && there.dli_fname != nullptr;
      const std::string who = *object->dlpi_name ? file_name(object->dlpi_name) : "this program";
      search.foreign.push_back(who + " calls " + name + " of " + (known ? file_name(there.dli_fname) : "elsewhere"));
    }
  return 0;
}

}  // namespace

Arithmetic find_arithmetic() {
  Search search{.functions = {}, .plugins = LoadedLibraries::of_process().places(), .foreign = {}};
  for (const math::Named& function : math::names()) search.functions[function.name] = function.address;
  dl_iterate_phdr(look_at, &search);
  std::sort(search.foreign.begin(), search.foreign.end());
  search.foreign.erase(std::unique(search.foreign.begin(), search.foreign.end()), search.foreign.end());
  Arithmetic found{.foreign_calls = std::move(search.foreign), .blas = {}, .blas_varies = false};
  Dl_info blas{};
  if (const void* product = dlsym(RTLD_DEFAULT, "dgemm_"); product != nullptr && dladdr(product, &blas) != 0) {
    std::error_code ignored;
    found.blas = std::filesystem::canonical(blas.dli_fname, ignored);
    for (const char* varies : {"openblas", "atlas", "blis", "mkl", "flexiblas"})
      found.blas_varies = found.blas_varies || found.blas.find(varies) != std::string::npos;
  }
  return found;
}

std::vector<std::string> warnings(const Arithmetic& arithmetic) {
  std::vector<std::string> lines;
  for (const std::string& call : arithmetic.foreign_calls)
    lines.push_back(call + ", which may give another digest on another processor");
  if (arithmetic.blas_varies)
    lines.push_back("BLAS is " + arithmetic.blas + ", which may give another digest on another processor");
  return lines;
}

}  // namespace jarol
