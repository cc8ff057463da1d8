#include "tools/bench/ports.h"

#include <atomic>
#include <thread>

#include "runtime/jarol/port.h"
#include "runtime/jarol/push_port.h"
#include "tools/bench/message.h"
#include "tools/bench/timing.h"

namespace jarol::bench {
namespace {

constexpr std::size_t slots = 1024;  // a power of two
// few enough that both threads mostly keep their processors for as long
constexpr int messages = 4000;
constexpr int port_round_trips = 400;

inline void pause() {
#if defined(__x86_64__) || defined(__i386__)
  __builtin_ia32_pause();
#elif defined(__aarch64__)
  asm volatile("yield");
#endif
}

// The floor: two counts, each with a copy of the other one at its side.
class PlainRing {
 public:
  bool write(const Message& message) {
    const std::uint64_t at = written_.load(std::memory_order_relaxed);
    if (at - seen_read_ == slots && at - (seen_read_ = read_.load(std::memory_order_acquire)) == slots) return false;
    slots_[at % slots] = message;
    written_.store(at + 1, std::memory_order_release);
    return true;
  }
  bool read(Message& message) {
    const std::uint64_t at = read_.load(std::memory_order_relaxed);
    if (at == seen_written_ && at == (seen_written_ = written_.load(std::memory_order_acquire))) return false;
    message = slots_[at % slots];
    read_.store(at + 1, std::memory_order_release);
    return true;
  }

 private:
  std::vector<Message> slots_ = std::vector<Message>(slots);
  alignas(apart) std::atomic<std::uint64_t> written_{0};
  std::uint64_t seen_read_ = 0;
  alignas(apart) std::atomic<std::uint64_t> read_{0};
  std::uint64_t seen_written_ = 0;
};

struct BenchPort : Port<Message> {
  BenchPort() : ValuesPort(slots) {}
};
struct BenchPushPort : PushPort<Message> {
  BenchPushPort() : ValuesPort(slots) {}
};

// Runs both at the same time, as soon as both have a processor; returns the seconds of the second one.
double together(const std::function<void()>& first, const std::function<void()>& second) {
  std::atomic<int> ready{0};
  const auto meet = [&] {
    ready.fetch_add(1);
    while (ready.load(std::memory_order_acquire) < 2) pause();
  };
  std::thread thread([&] {
    meet();
    first();
  });
  meet();
  const double seconds = seconds_of(second);
  thread.join();
  return seconds;
}

template <class Between>
double ns_per_message() {
  Between between;
  const auto read_all = [&] {
    Message message;
    do
      while (!between.read(message)) pause();
    while (message.words[0] < messages);
    keep(message.words[7]);
  };
  const auto write_all = [&] {
    Message message;
    for (int i = 1; i <= messages; ++i) {
      message.words[0] = message.words[7] = i;
      while (!between.write(message)) pause();
    }
  };
  return 1e9 * together(read_all, write_all) / messages;
}

template <class Between>
double ns_per_port_round_trip() {
  Between there, back;
  const auto answer = [&] {
    Message message;
    for (int i = 0; i < port_round_trips; ++i) {
      while (!there.read(message)) pause();
      back.write(message);
    }
  };
  const auto ask = [&] {
    Message message;
    for (int i = 0; i < port_round_trips; ++i) {
      message.words[0] = i;
      there.write(message);
      while (!back.read(message)) pause();
    }
    keep(message.words[0]);
  };
  return 1e9 * together(answer, ask) / port_round_trips;
}

}  // namespace

Figure measure_port_throughput(const std::string& name, int repeats) {
  return compare(name, "64 bytes through a port / a plain ring", 1.0, repeats, ns_per_message<BenchPort>,
                 ns_per_message<PlainRing>);
}

Figure measure_push_port_throughput(const std::string& name, int repeats) {
  return compare(name, "64 bytes through a push port / a plain ring", 1.0, repeats, ns_per_message<BenchPushPort>,
                 ns_per_message<PlainRing>);
}

Figure measure_port_round_trip(const std::string& name, int repeats) {
  return compare(name, "64 bytes there and back through ports / plain rings", 1.0, repeats,
                 ns_per_port_round_trip<BenchPort>, ns_per_port_round_trip<PlainRing>);
}

Figure measure_push_port_round_trip(const std::string& name, int repeats) {
  return compare(name, "64 bytes there and back through push ports / plain rings", 1.0, repeats,
                 ns_per_port_round_trip<BenchPushPort>, ns_per_port_round_trip<PlainRing>);
}

}  // namespace jarol::bench
