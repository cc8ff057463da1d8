#include "runtime/files/appender.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <sys/uio.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <span>
#include <system_error>

namespace jarol {
namespace {

// Shorter files are left to the system; of longer ones as much is allocated ahead as there is, up to the second.
constexpr std::uint64_t long_file = std::uint64_t{4} << 20, longest_step = std::uint64_t{64} << 20;

[[noreturn]] void fail() { throw std::system_error(errno, std::generic_category()); }

// What is left of them once so many bytes are gone.
std::span<iovec> without(std::span<iovec> pieces, std::size_t bytes) {
  while (!pieces.empty() && bytes >= pieces.front().iov_len) {
    bytes -= pieces.front().iov_len;
    pieces = pieces.subspan(1);
  }
  if (bytes > 0) {
    pieces.front().iov_base = static_cast<char*>(pieces.front().iov_base) + bytes;
    pieces.front().iov_len -= bytes;
  }
  return pieces;
}

void write_all(int descriptor, std::span<iovec> pieces) {
  while (!(pieces = without(pieces, 0)).empty()) {
    const ssize_t written = ::writev(descriptor, pieces.data(), static_cast<int>(pieces.size()));
    if (written < 0 && errno != EINTR) fail();
    if (written > 0) pieces = without(pieces, static_cast<std::size_t>(written));
  }
}

}  // namespace

Appender::Appender(std::FILE* file) : file_(file) {
  struct stat status {};
  const int descriptor = ::fileno(file);
  if (descriptor >= 0 && ::fstat(descriptor, &status) == 0 && S_ISREG(status.st_mode)) descriptor_ = descriptor;
}

void Appender::append(std::string_view first, std::string_view second, std::string_view third) {
  const std::array pieces{first, second, third};
  const std::uint64_t bytes = first.size() + second.size() + third.size();
  if (descriptor_ >= 0) {
    if (bytes_ + bytes > std::max(allocated_, long_file)) allocate_ahead();
    std::array<iovec, pieces.size()> vectors{};
    for (std::size_t i = 0; i < pieces.size(); ++i)
      vectors[i] = {const_cast<char*>(pieces[i].data()), pieces[i].size()};
    write_all(descriptor_, vectors);
  } else {
    for (const std::string_view piece : pieces)
      if (!piece.empty() && std::fwrite(piece.data(), 1, piece.size(), file_) != piece.size()) fail();
    if (std::fflush(file_) != 0) fail();
  }
  bytes_ += bytes;
}

// Only to be quicker: where it can't be, all goes on without.
void Appender::allocate_ahead() {
  const std::uint64_t from = std::max(bytes_, allocated_), step = std::clamp(from, long_file, longest_step);
  ::fallocate(descriptor_, FALLOC_FL_KEEP_SIZE, static_cast<off_t>(from), static_cast<off_t>(step));
  allocated_ = from + step;
}

void Appender::end() {
  // that it failed would change nothing in the file
  if (allocated_ > bytes_) static_cast<void>(!::ftruncate(descriptor_, static_cast<off_t>(bytes_)));
  allocated_ = 0;
}

}  // namespace jarol
