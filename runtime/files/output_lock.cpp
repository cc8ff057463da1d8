#include "runtime/files/output_lock.h"

#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstddef>
#include <filesystem>
#include <utility>

#include "graph/text/errors.h"
#include "graph/values/digest.h"

namespace jarol {
namespace {

std::string number_text(std::uint64_t number) { return std::to_string(number) + " "; }

// The same for the same place, by whatever path.
std::string name_of(const std::filesystem::path& path) {
  const std::filesystem::path folder = path.has_parent_path() ? path.parent_path() : ".";
  struct stat status {};
  if (::stat(folder.c_str(), &status) != 0) return "";
  const std::string place = number_text(status.st_dev) + number_text(status.st_ino) + path.filename().string();
  return "jarol writes " + number_text(digest::name_hash(place)) + std::to_string(digest::name_hash(place + " again"));
}

}  // namespace

OutputLock::OutputLock(const std::string& path) {
  const std::string name = name_of(path);
  sockaddr_un address{};
  if (name.empty() || name.size() + 1 > sizeof address.sun_path) return;
  address.sun_family = AF_UNIX;
  std::copy(name.begin(), name.end(), address.sun_path + 1);  // a zero in front: no file
  const auto size = static_cast<socklen_t>(offsetof(sockaddr_un, sun_path) + 1 + name.size());
  socket_ = ::socket(AF_UNIX, SOCK_DGRAM | SOCK_CLOEXEC, 0);
  if (socket_ < 0 || ::bind(socket_, reinterpret_cast<const sockaddr*>(&address), size) == 0) return;
  const int reason = errno;
  ::close(std::exchange(socket_, -1));
  if (reason == EADDRINUSE)
    throw InputError("can't write '" + path + "': another run writes it; choose another file, or wait until that ends");
}

OutputLock::~OutputLock() {
  if (socket_ >= 0) ::close(socket_);
}

OutputLock::OutputLock(OutputLock&& other) noexcept : socket_(std::exchange(other.socket_, -1)) {}

OutputLock& OutputLock::operator=(OutputLock&& other) noexcept {
  std::swap(socket_, other.socket_);
  return *this;
}

}  // namespace jarol
