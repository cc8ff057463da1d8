#include "distributers/links/descriptor.h"

#include <poll.h>
#include <sys/eventfd.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <cerrno>
#include <cstdint>
#include <system_error>
#include <vector>

namespace jarol::distributers {

void Descriptor::close() {
  if (fd_ >= 0) ::close(fd_);
  fd_ = -1;
}

Interrupter::Interrupter() : event_(eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK)) {
  if (!event_) throw std::system_error(errno, std::generic_category(), "eventfd");
}

void Interrupter::interrupt() {
  const std::uint64_t one = 1;
  // it can fail only where it is set already
  [[maybe_unused]] const auto written = ::write(event_.get(), &one, sizeof one);
}

void Interrupter::reset() {
  std::uint64_t count = 0;
  [[maybe_unused]] const auto got = ::read(event_.get(), &count, sizeof count);
}

namespace {

// How many are ready. A signal to the process is no reason to come back.
int poll_for(std::span<pollfd> polled, std::chrono::milliseconds time) {
  const auto end = std::chrono::steady_clock::now() + time;
  int ready = 0;
  while ((ready = poll(polled.data(), polled.size(), static_cast<int>(time.count()))) < 0 && errno == EINTR)
    if (time.count() >= 0)
      time = std::max(std::chrono::ceil<std::chrono::milliseconds>(end - std::chrono::steady_clock::now()),
                      std::chrono::milliseconds(0));
  return ready;
}

}  // namespace

Interrupter::Woken Interrupter::wait(int fd, std::chrono::milliseconds time, bool write) const {
  std::array<pollfd, 2> polled{{{event_.get(), POLLIN, 0}, {fd, static_cast<short>(write ? POLLOUT : POLLIN), 0}}};
  const int ready = poll_for(polled, time);
  if (ready > 0 && polled[0].revents != 0) return Woken::interrupted;
  return ready == 0 ? Woken::timed_out : Woken::ready;
}

Interrupter::Either Interrupter::wait_for_either(int one, int other, std::chrono::milliseconds time) const {
  std::array<pollfd, 3> polled{{{event_.get(), POLLIN, 0}, {one, POLLIN, 0}, {other, POLLIN, 0}}};
  if (poll_for(polled, time) <= 0) return {};
  return {polled[0].revents != 0, polled[1].revents != 0, polled[2].revents != 0};
}

Interrupter::Some Interrupter::wait_for_some(std::span<const int> descriptors, std::chrono::milliseconds time) const {
  assert(descriptors.size() <= max_waited);
  std::array<pollfd, max_waited + 1> polled{};
  for (std::size_t i = 0; i < descriptors.size(); ++i) polled[i] = {descriptors[i], POLLIN, 0};
  polled[descriptors.size()] = {event_.get(), POLLIN, 0};
  Some some;
  if (poll_for(std::span(polled).first(descriptors.size() + 1), time) <= 0) return some;
  for (std::size_t i = 0; i < descriptors.size(); ++i) some.ready[i] = polled[i].revents != 0;
  some.interrupted = polled[descriptors.size()].revents != 0;
  return some;
}

Interrupter::Any Interrupter::wait_for_any(std::span<const int> descriptors, std::chrono::milliseconds time) const {
  std::vector<pollfd> polled;
  for (const int descriptor : descriptors) polled.push_back({descriptor, POLLIN, 0});
  polled.push_back({event_.get(), POLLIN, 0});
  if (poll_for(polled, time) <= 0) return {};
  const auto first = std::find_if(polled.begin(), polled.end(), [](const pollfd& p) { return p.revents != 0; });
  const auto place = static_cast<std::size_t>(first - polled.begin());
  if (polled.back().revents != 0) return {.interrupted = true};
  return {.ready = place};
}

}  // namespace jarol::distributers
