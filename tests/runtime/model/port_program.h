// A writer and a reader on a port, and all that a port promises: for the explorer.
#pragma once

#include <array>
#include <memory>
#include <vector>

#include "tests/runtime/model/explorer.h"
#include "tests/runtime/model/model_threads.h"

namespace jarol::model {

template <class Port>
struct PortRun {
  explicit PortRun(std::size_t capacity) : port(capacity, sizeof(Value)) {}

  using Value = std::array<std::uint64_t, 2>;
  static constexpr bool pushes = requires(const Port& p) { p.lost(); };

  void write() {
    const std::size_t taken = known(taken_at);
    const Value value{++tried, ~tried};
    if (port.write(value.data())) {
      accepted.push_back(tried);
      written_at.push_back(event());
    } else {
      check(accepted.size() - taken >= port.capacity(), "refused although there is room");
    }
  }

  bool read() {
    const std::size_t written = known(written_at);
    Value value{};
    if (!port.read(value.data())) {
      check(written <= last, "nothing is found although a value was written before");
      check(value == Value{}, "touched what it had no value for");
      return false;
    }
    check(value[1] == ~value[0], "torn");
    check(value[0] > last, "out of order");
    if (pushes) check(value[0] + port.capacity() > written, "older than the newest ones");
    last = pushes ? value[0] : last + 1;
    got.push_back(value[0]);
    taken_at.push_back(event());
    return true;
  }

  void finish() {
    const std::uint64_t before = last;
    const std::size_t first = got.size();
    while (read()) {}
    if (!pushes) return check(got == accepted, "lost or made up");
    std::uint64_t expected = std::max(before + 1, tried - std::min<std::uint64_t>(tried, port.capacity()) + 1);
    for (std::size_t i = first; i < got.size(); ++i) check(got[i] == expected++, "not the oldest that is left");
    check(expected == tried + 1, "the newest are not all there");
    if constexpr (pushes) check(port.lost() + got.size() == tried, "lost without being counted");
  }

  // how many of these have happened for the thread that asks
  static std::size_t known(const std::vector<Event>& events) {
    std::size_t count = 0;
    while (count < events.size() && happened(events[count])) ++count;
    return count;
  }

  Port port;
  std::uint64_t tried = 0;
  std::uint64_t last = 0;  // value read, or number of values read
  std::vector<std::uint64_t> accepted, got;
  std::vector<Event> written_at, taken_at;
};

template <class Port>
Result explore_port(std::size_t capacity, int before, int writes, int reads) {
  return explore([=] {
    auto run = std::make_shared<PortRun<Port>>(capacity);
    for (int i = 0; i < before; ++i) run->write();
    return Program{{[=] {
                      for (int i = 0; i < writes; ++i) run->write();
                    },
                    [=] {
                      for (int i = 0; i < reads; ++i) run->read();
                    }},
                   [=] { run->finish(); }};
  });
}

}  // namespace jarol::model
