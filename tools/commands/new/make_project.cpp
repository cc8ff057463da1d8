#include "tools/commands/new/make_project.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <system_error>

#include "graph/text/errors.h"
#include "graph/text/escape.h"
#include "tools/commands/new/project_files.h"

namespace jarol::tools {
namespace {

namespace fs = std::filesystem;

// Targets that CMake, CTest or the build of a project have.
constexpr std::array reserved{"all",     "clean", "depend", "doctest", "edit_cache",    "help",
                              "install", "jarol", "ninja",  "package", "rebuild_cache", "test"};

// The name of the project, which is that of its folder.
std::string name_of(const fs::path& place) {
  std::string name = place.filename().string();
  const auto is_small = [](char c) { return c >= 'a' && c <= 'z'; };
  const bool good =
      !name.empty() && name.size() <= 40 && is_small(name[0]) &&
      std::all_of(name.begin(), name.end(), [&](char c) { return is_small(c) || (c >= '0' && c <= '9') || c == '_'; });
  if (!good)
    throw InputError("'" + printable(name) +
                     "' can't name a project; it needs small letters, digits and _, up to 40, and a letter "
                     "first");
  if (std::find(reserved.begin(), reserved.end(), name) != reserved.end())
    throw InputError("'" + name + "' can't name a project, as it names a target of every build; choose another");
  if (name == "null")  // the only one that its graph could not have as its name
    throw InputError("'null' can't name a project, as that is nothing in YAML; choose another");
  return name;
}

// Throws unless it can become the project's.
void require_free(const fs::path& place, const std::string& given) {
  std::error_code error;
  const fs::file_status status = fs::status(place, error);
  const std::string named = "'" + printable(given) + "'";
  if (fs::exists(status)) {
    if (!fs::is_directory(status)) throw InputError(named + " is there, and no folder; give another name");
    const bool empty = fs::is_empty(place, error);
    if (error) throw InputError("can't look into " + named + ": " + error.message());
    if (!empty) throw InputError(named + " is there, and not empty; give another name, or remove it");
  } else if (fs::symlink_status(place, error).type() == fs::file_type::symlink) {
    throw InputError(named + " is a link to nothing; give another name, or remove it");
  } else if (!fs::is_directory(place.parent_path(), error)) {
    throw InputError("there is no folder '" + printable(place.parent_path().string()) + "' to make " + named + " in");
  }
}

std::string replaced(std::string_view text, std::string_view word, const std::string& by) {
  std::string made(text);
  for (std::size_t at = 0; (at = made.find(word, at)) != std::string::npos; at += by.size())
    made.replace(at, word.size(), by);
  return made;
}

[[noreturn]] void fail_by_errno() { throw std::system_error(errno, std::generic_category()); }

void write(const fs::path& path, const std::string& text) {
  fs::create_directories(path.parent_path());
  std::ofstream file(path, std::ios::binary);
  if (!(file << text).flush()) fail_by_errno();
}

// A folder for what is not whole yet, gone at the end with what is left in it.
class Stage {
 public:
  explicit Stage(const fs::path& within) {
    std::string name = (within / ".jarol_new_XXXXXX").string();
    if (::mkdtemp(name.data()) == nullptr) fail_by_errno();
    folder_ = name;
    fs::create_directory(path());  // with the permissions of a folder that anyone makes
  }
  Stage(const Stage&) = delete;
  Stage& operator=(const Stage&) = delete;
  ~Stage() {
    std::error_code none;
    fs::remove_all(folder_, none);
  }
  fs::path path() const { return folder_ / "project"; }

 private:
  fs::path folder_;
};

// What is staged becomes the project: the folder itself, or where that was there, its entries.
void place_all(const fs::path& stage, const fs::path& place) {
  if (!fs::exists(place)) return fs::rename(stage, place);
  std::vector<fs::path> placed;
  try {
    for (const auto& entry : fs::directory_iterator(stage)) {
      placed.push_back(place / entry.path().filename());
      fs::rename(entry.path(), placed.back());
    }
  } catch (...) {
    std::error_code none;
    for (const fs::path& path : placed) fs::remove_all(path, none);
    throw;
  }
}

// Its files. Throws std::system_error, and leaves nothing then.
std::vector<std::string> make_at(const fs::path& place, const std::string& name, const std::string& kind) {
  // in it where it is there, so that both are on one file system
  const Stage stage(fs::exists(place) ? place : place.parent_path());
  std::vector<std::string> made;
  for (std::size_t i = 0; i < project_file_count; ++i) {
    const ProjectFile& file = project_files[i];
    if (!file.name.starts_with(kind + "/")) continue;
    made.push_back(replaced(file.name.substr(kind.size() + 1), "NAME", name));
    write(stage.path() / made.back(), replaced(file.text, "@NAME@", name));
  }
  place_all(stage.path(), place);
  std::sort(made.begin(), made.end());
  return made;
}

}  // namespace

std::vector<std::string> make_project(const std::string& folder, const std::string& kind) {
  fs::path place = fs::absolute(folder).lexically_normal();
  if (!place.has_filename()) place = place.parent_path();  // as of "demo/"
  const std::string name = name_of(place);
  require_free(place, folder);
  try {
    return make_at(place, name, kind);
  } catch (const std::system_error& error) {
    // not by the path of what is not whole yet, which is gone
    throw std::system_error(error.code(), "can't make '" + folder + "'");
  }
}

}  // namespace jarol::tools
