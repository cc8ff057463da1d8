#include "graph/language/inputs.h"

#include <algorithm>
#include <map>
#include <mutex>
#include <utility>

namespace jarol {
namespace {

using Identity = std::pair<dev_t, ino_t>;

std::mutex inputs_mutex;

std::map<Identity, std::string>& names() {
  static std::map<Identity, std::string> all;
  return all;
}

}  // namespace

void note_input(const std::string& path, const struct stat& status) {
  if (!S_ISREG(status.st_mode)) return;
  const std::lock_guard lock(inputs_mutex);
  names().emplace(Identity(status.st_dev, status.st_ino), path);
}

void note_input(const std::string& path) {
  struct stat status {};
  if (::stat(path.c_str(), &status) == 0) note_input(path, status);
}

std::vector<std::string> inputs_read() {
  const std::lock_guard lock(inputs_mutex);
  std::vector<std::string> all;
  for (const auto& [identity, name] : names()) {
    struct stat now {};
    if (::stat(name.c_str(), &now) == 0 && Identity(now.st_dev, now.st_ino) == identity) all.push_back(name);
  }
  std::sort(all.begin(), all.end());
  return all;
}

std::string input_at(const std::string& path) {
  struct stat status {};
  if (::stat(path.c_str(), &status) != 0) return "";
  const std::lock_guard lock(inputs_mutex);
  const Identity identity(status.st_dev, status.st_ino);
  const auto found = names().find(identity);
  if (found == names().end()) return "";
  // one that was removed since may have left its number to another file
  struct stat now {};
  if (::stat(found->second.c_str(), &now) == 0 && Identity(now.st_dev, now.st_ino) == identity) return found->second;
  names().erase(found);
  return "";
}

}  // namespace jarol
