// Owned file descriptors, and waiting for one of them while another thread may end the wait.
#pragma once

#include <bitset>
#include <chrono>
#include <cstddef>
#include <optional>
#include <span>
#include <utility>

namespace jarol::distributers {

class Descriptor {
 public:
  Descriptor() = default;
  explicit Descriptor(int fd) : fd_(fd) {}
  Descriptor(Descriptor&& other) noexcept : fd_(std::exchange(other.fd_, -1)) {}
  Descriptor& operator=(Descriptor&& other) noexcept {
    std::swap(fd_, other.fd_);
    return *this;
  }
  ~Descriptor() { close(); }

  int get() const { return fd_; }
  explicit operator bool() const { return fd_ >= 0; }
  void close();

 private:
  int fd_ = -1;
};

/// Ends all waits, now and from now on, until it is reset.
class Interrupter {
 public:
  Interrupter();
  void interrupt();
  void reset();

  enum class Woken { ready, timed_out, interrupted };
  /// Waits until `fd` can be read (or, with `write`, written), has failed, or the time is over. A negative `fd` is
  /// never ready; a negative time is no limit.
  Woken wait(int fd, std::chrono::milliseconds time, bool write = false) const;

  /// Waits until one of two can be read or has failed.
  struct Either {
    bool interrupted = false, one = false, other = false;
  };
  Either wait_for_either(int one, int other, std::chrono::milliseconds time) const;

  /// Waits until some of several, at most `max_waited`, can be read or have failed.
  static constexpr std::size_t max_waited = 17;
  struct Some {
    bool interrupted = false;
    std::bitset<max_waited> ready{};
  };
  Some wait_for_some(std::span<const int> descriptors, std::chrono::milliseconds time) const;

  /// Waits until one of several can be read or has failed: the first of those, by its place.
  struct Any {
    bool interrupted = false;
    std::optional<std::size_t> ready{};
  };
  Any wait_for_any(std::span<const int> descriptors, std::chrono::milliseconds time) const;

 private:
  Descriptor event_;
};

}  // namespace jarol::distributers
