#include "distributers/links/secret_key.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sodium.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "distributers/links/descriptor.h"
#include "graph/language/inputs.h"
#include "graph/text/errors.h"
#include "graph/text/shell_word.h"

namespace jarol::distributers {
namespace {

constexpr std::size_t min_bytes = 32, max_bytes = 4096;

}  // namespace

SecretKey read_key(const std::string& path) {
  const auto refuse = [&](const std::string& why) { throw InputError("the key file '" + path + "' " + why); };
  const std::string by = "; make one by: (umask 077; head -c 32 /dev/urandom > " + shell_word(path) + ")";
  // a pipe without a writer would be waited for
  const Descriptor file(::open(path.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC | O_NOCTTY));
  if (!file) refuse(std::string("can't be read: ") + std::strerror(errno) + (errno == ENOENT ? by : ""));
  struct stat found {};
  if (fstat(file.get(), &found) != 0) refuse(std::string("can't be read: ") + std::strerror(errno));
  if (!S_ISREG(found.st_mode))
    refuse(fmt::format("is no regular file; it has to be one of {} to {} bytes", min_bytes, max_bytes));
  if ((found.st_mode & 077) != 0)
    refuse(fmt::format("has the mode {:04o}, so that others than its owner may use it; chmod 600 {}",
                       found.st_mode & 07777, path));
  note_input(path, found);
  std::array<unsigned char, max_bytes + 1> bytes{};
  std::size_t size = 0;
  while (size < bytes.size()) {
    const auto length = ::read(file.get(), bytes.data() + size, bytes.size() - size);
    if (length < 0 && errno != EINTR) refuse(std::string("can't be read: ") + std::strerror(errno));
    if (length == 0) break;
    if (length > 0) size += static_cast<std::size_t>(length);
  }
  if (size < min_bytes || size > max_bytes)
    refuse(fmt::format("has {} bytes; it needs from {} to {}{}", size > max_bytes ? "too many" : std::to_string(size),
                       min_bytes, max_bytes, by));
  SecretKey key{};
  crypto_generichash(reinterpret_cast<unsigned char*>(key.data()), key.size(), bytes.data(), size, nullptr, 0);
  sodium_memzero(bytes.data(), bytes.size());
  return key;
}

}  // namespace jarol::distributers
