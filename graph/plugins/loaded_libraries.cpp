#include "graph/plugins/loaded_libraries.h"

#include <dlfcn.h>
#include <sys/stat.h>

#include <algorithm>
#include <iterator>
#include <utility>

#include "graph/isolation/elf_file.h"
#include "graph/isolation/names.h"

namespace jarol {
namespace {

// Of several the one that the author of a task knows best.
std::string most_readable(const std::vector<std::string>& symbols) {
  static constexpr const char* of_libraries[] = {"jarol::", "std::", "Eigen::", "guard variable for "};
  const auto readable = [](const std::string& symbol) {
    std::string text = isolation::demangled(symbol);
    const auto is_of = [&](const char* beginning) { return text.starts_with(beginning); };
    const auto* const library = std::find_if(std::begin(of_libraries), std::end(of_libraries), is_of);
    const auto rank = library == std::end(of_libraries) ? -1 : library - std::begin(of_libraries);
    return std::pair(rank, std::move(text));
  };
  auto best = readable(symbols.front());
  for (const std::string& symbol : symbols) best = std::min(best, readable(symbol));
  return best.second;
}

}  // namespace

LoadedLibraries& LoadedLibraries::of_process() {
  static LoadedLibraries all;
  return all;
}

bool LoadedLibraries::look_at(const std::string& path, File& file, State& state) {
  struct stat status {};
  if (::stat(path.c_str(), &status) != 0) return false;
  file = {status.st_dev, status.st_ino};
  state = {status.st_size, std::int64_t{status.st_mtim.tv_sec} * 1'000'000'000 + status.st_mtim.tv_nsec};
  return true;
}

// What g++ makes one of in the whole process, wherever a library is loaded: constants and the like of classes, inline
// variables, statics of inline functions (STB_GNU_UNIQUE). Where the program has it, too, all use the program's.
std::vector<std::string> LoadedLibraries::shared_symbols(const std::string& path) {
  std::vector<std::string> found;
  const isolation::ElfFile file(path);
  for (const Elf64_Shdr& section : file.sections()) {
    if (section.sh_type != SHT_DYNSYM) continue;
    for (const auto& symbol : file.entries<Elf64_Sym>(section)) {
      if (ELF64_ST_BIND(symbol.st_info) != STB_GNU_UNIQUE || symbol.st_shndx == SHN_UNDEF) continue;
      std::string name(file.text(section, symbol.st_name));
      if (dlsym(RTLD_DEFAULT, name.c_str()) == nullptr) found.push_back(std::move(name));
    }
  }
  std::sort(found.begin(), found.end());
  return found;
}

std::string LoadedLibraries::find_conflict(const std::string& path) const {
  const std::lock_guard lock(mutex_);
  File file;
  State state;
  if (all_.empty() || !look_at(path, file, state)) return "";
  for (const Library& library : all_)
    if (library.file == file)
      return library.state == state ? ""
                                    : "was changed in its place after this process had loaded it; build it as a new "
                                      "file, or start the process again";
  const std::vector<std::string> shared = shared_symbols(path);
  for (const Library& library : all_) {
    std::vector<std::string> both;
    std::set_intersection(shared.begin(), shared.end(), library.shared.begin(), library.shared.end(),
                          std::back_inserter(both));
    if (both.empty()) continue;
    const bool is_earlier = library.path == path;
    return "and " + (is_earlier ? "an earlier build of it, which this process has loaded," : "'" + library.path + "'") +
           " both define '" + most_readable(both) +
           "' for the whole process (g++'s unique symbols), so that one would use the other's; build both with "
           "-fno-gnu-unique";
  }
  return "";
}

std::string LoadedLibraries::place_of(const std::string& path) const {
  const std::lock_guard lock(mutex_);
  File file;
  State state;
  const bool is_there = look_at(path, file, state);
  // without a slash the loader would search elsewhere
  std::string place = path.find('/') == std::string::npos ? "./" + path : path;
  for (const Library& library : all_)
    if (is_there && library.file == file) return library.place;
  while (std::any_of(all_.begin(), all_.end(), [&](const Library& library) { return library.place == place; }))
    place = (place.starts_with('/') ? "/." : "./") + place;
  return place;
}

void LoadedLibraries::add(const std::string& path, const std::string& place) {
  Library library{path, place, {}, {}, {}};
  look_at(path, library.file, library.state);
  const std::lock_guard lock(mutex_);
  const bool is_known =
      std::any_of(all_.begin(), all_.end(), [&](const Library& known) { return known.place == place; });
  if (is_known) return;
  library.shared = shared_symbols(path);
  all_.push_back(std::move(library));
}

std::vector<std::string> LoadedLibraries::places() const {
  const std::lock_guard lock(mutex_);
  std::vector<std::string> places;
  for (const Library& library : all_) places.push_back(library.place);
  return places;
}

}  // namespace jarol
