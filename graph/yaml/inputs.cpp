#include "graph/yaml/inputs.h"

#include <map>
#include <mutex>
#include <utility>

namespace jarol {
namespace {

using Identity = std::pair<dev_t, ino_t>;

std::mutex mutex;

std::map<Identity, std::string>& names() {
  static std::map<Identity, std::string> all;
  return all;
}

}  // namespace

void note_input(const std::string& path, const struct stat& status) {
  if (!S_ISREG(status.st_mode)) return;
  const std::lock_guard lock(mutex);
  names().emplace(Identity(status.st_dev, status.st_ino), path);
}

void note_input(const std::string& path) {
  struct stat status {};
  if (::stat(path.c_str(), &status) == 0) note_input(path, status);
}

std::string input_at(const std::string& path) {
  struct stat status {};
  if (::stat(path.c_str(), &status) != 0) return "";
  const std::lock_guard lock(mutex);
  const auto found = names().find(Identity(status.st_dev, status.st_ino));
  return found == names().end() ? "" : found->second;
}

}  // namespace jarol
