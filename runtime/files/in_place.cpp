#include "runtime/files/in_place.h"

#include <fcntl.h>
#include <limits.h>
#include <poll.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <memory>
#include <thread>

#include "runtime/machine/asked_to_end.h"

namespace jarol {
namespace {

using Clock = std::chrono::steady_clock;

struct Opened {
  int descriptor;
  bool given_up = false;  // nobody waits again
};

bool wait_for_room(Opened& opened) {
  const auto since = Clock::now();
  while (!opened.given_up) {
    pollfd polled{opened.descriptor, POLLOUT, 0};
    if (::poll(&polled, 1, static_cast<int>(look_at_end.count())) > 0) return true;
    opened.given_up = has_waited_enough(since);
  }
  errno = ETIMEDOUT;
  return false;
}

// No more at a time than surely fits where there is room, so that nothing blocks.
ssize_t write_some(void* cookie, const char* bytes, std::size_t size) {
  auto& opened = *static_cast<Opened*>(cookie);
  std::size_t written = 0;
  while (written < size) {
    if (!wait_for_room(opened)) return 0;
    const ssize_t now = ::write(opened.descriptor, bytes + written, std::min<std::size_t>(size - written, PIPE_BUF));
    if (now < 0 && errno != EINTR && errno != EAGAIN) return 0;
    if (now > 0) written += static_cast<std::size_t>(now);
  }
  return static_cast<ssize_t>(written);
}

int close_it(void* cookie) {
  const std::unique_ptr<Opened> opened(static_cast<Opened*>(cookie));
  return ::close(opened->descriptor);
}

bool is_fifo(const std::string& path) {
  struct stat there {};
  return ::stat(path.c_str(), &there) == 0 && S_ISFIFO(there.st_mode);
}

std::FILE* stream_of(int descriptor) {
  if (descriptor < 0) return nullptr;
  auto opened = std::make_unique<Opened>(Opened{descriptor});
  std::FILE* const file =
      ::fopencookie(opened.get(), "wb", {.read = nullptr, .write = write_some, .seek = nullptr, .close = close_it});
  if (file == nullptr)
    ::close(descriptor);
  else
    opened.release();  // the stream's
  return file;
}

}  // namespace

std::FILE* open_in_place(const std::string& path) {
  for (const auto since = Clock::now();;) {
    const int descriptor = ::open(path.c_str(), O_WRONLY | O_NONBLOCK | O_NOCTTY | O_CLOEXEC);
    const bool waits_for_reader = descriptor < 0 && errno == ENXIO && is_fifo(path);
    if (!waits_for_reader) return stream_of(descriptor);
    if (has_waited_enough(since)) {
      errno = ETIMEDOUT;
      return nullptr;
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
}

std::FILE* open_in_place(int descriptor) { return stream_of(::fcntl(descriptor, F_DUPFD_CLOEXEC, 0)); }

}  // namespace jarol
