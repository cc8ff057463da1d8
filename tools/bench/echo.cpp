#include "tools/bench/echo.h"

#include <array>
#include <atomic>
#include <cstring>
#include <memory>
#include <thread>

#include "distributers/interfaces/typed.h"
#include "distributers/links/linked.h"
#include "distributers/links/udp.h"
#include "distributers/messages/javiator.h"
#include "graph/text/errors.h"
#include "runtime/execute/executor.h"
#include "tools/bench/graphs.h"
#include "tools/bench/timing.h"

namespace jarol::bench {
namespace {

using namespace distributers;
namespace javiator = messages::javiator;

// few enough that all threads mostly have the processors for as long
constexpr int round_trips = 40;

const Address& any_port() {
  static const Address address = Address::parse("0");
  return address;
}

Descriptor udp_socket(const Address& bound) {
  Descriptor made(socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0));
  if (!made || bind(made.get(), bound.get(), bound.size()) != 0)
    throw Unfinished("udp_echo: there is no socket to be had");
  return made;
}

std::vector<std::byte> packet_of(std::uint16_t id) {
  std::vector<std::byte> packet;
  const messages::MessageSet& set = javiator::message_set();
  write_packet(messages::Message(*set.header), messages::refer_to(javiator::MotorSignals{1, 2, 3, 4, id}), set.order,
               packet);
  return packet;
}

// Asks and waits for the answer, which has the same bytes; again where one of the two got lost.
class Asker {
 public:
  explicit Asker(int port) : socket_(udp_socket(any_port())), peer_(any_port().with_port(port)) {
    const timeval patience{1, 0};
    setsockopt(socket_.get(), SOL_SOCKET, SO_RCVTIMEO, &patience, sizeof patience);
  }

  double ns_per_round_trip() {
    for (int i = 0; i < round_trips / 4; ++i) ask();  // until all threads are there
    return 1e9 * seconds_of([&] {
             for (int i = 0; i < round_trips; ++i) ask();
           }) /
           round_trips;
  }

 private:
  void ask() {
    const std::vector<std::byte> packet = packet_of(++id_);
    std::array<std::byte, 128> answer{};
    for (int attempt = 0; attempt < 10; ++attempt) {
      sendto(socket_.get(), packet.data(), packet.size(), 0, peer_.get(), peer_.size());
      if (recv(socket_.get(), answer.data(), answer.size(), 0) == static_cast<ssize_t>(packet.size()) &&
          std::memcmp(answer.data(), packet.data(), packet.size()) == 0)
        return;
    }
    throw Unfinished("udp_echo: no answer");
  }

  Descriptor socket_;
  Address peer_;
  std::uint16_t id_ = 0;
};

// The id of a motor signal is the value; what has been answered is not answered again.
struct Echo {
  [[maybe_unused]] static constexpr std::string_view summary = "answers";
  [[maybe_unused]] static constexpr bool is_vehicle = false;
  struct In {
    Newest<double> in;
    static constexpr auto fields() { return describe(channel<&In::in>("the id of a motor signal")); }
  };
  struct Out {
    double out = 0;
    static constexpr auto fields() { return describe(channel<&Out::out>("the same")); }
  };
  static const messages::MessageSet& message_set() { return javiator::message_set(); }
  static constexpr auto handlers() {
    return handle(on<javiator::MotorSignals>(&Echo::motors), send<&Out::out>(&Echo::answer));
  }

  void motors(const javiator::MotorSignals& motors) { in.in = motors.id; }
  void answer(double value, messages::Receiver& system) {
    const auto id = static_cast<std::uint16_t>(value);
    if (id == answered) return;
    answered = id;
    system.receive(messages::refer_to(javiator::MotorSignals{1, 2, 3, 4, id}));
  }

  In in;
  std::uint16_t answered = 0;
};

// The product: a graph that runs as fast as it can, so that a packet is taken at once.
class Engine {
 public:
  Engine()
      : graph_(graph_of(R"(graph: echo
timing: {period: 1us}
distributers: {outside: {type: Echo, link: {type: udp, listen: 0}}}
communicators:
  from: {channel: outside.in}
  to: {channel: outside.out}
tasks:
  relay: {type: Relay}
connections: [from -> relay.in, relay.out -> to]
)")) {
    auto transport = std::make_unique<UdpTransport>(any_port(), Address());
    const UdpTransport& udp = *transport;
    auto link = std::make_unique<Link>(std::move(transport), javiator::message_set(), LinkOptions{});
    std::vector<std::unique_ptr<ExternalSystem>> systems;
    systems.push_back(std::make_unique<LinkedSystem>(std::move(link), std::make_unique<Typed<Echo>>()));
    system_ = systems.back().get();
    executor_ = std::make_unique<Executor>(graph_, std::move(systems));
    system_->begin();
    port_ = udp.port();
    thread_ = std::thread([this] { executor_->run_until(Duration::max()); });
  }
  ~Engine() {
    executor_->interrupt();
    thread_.join();
    system_->finish();
  }
  int port() const { return port_; }

 private:
  Graph graph_;
  ExternalSystem* system_ = nullptr;
  std::unique_ptr<Executor> executor_;
  int port_ = 0;
  std::thread thread_;
};

// The floor: one thread receives, one looks for what came and passes it on, one is woken and sends.
class BareEcho {
 public:
  BareEcho() : socket_(udp_socket(any_port())) {
    receiver_ = std::thread([this] { receive(); });
    middle_ = std::thread([this] { pass(); });
    sender_ = std::thread([this] { send(); });
  }
  ~BareEcho() {
    ending_ = true;
    shutdown(socket_.get(), SHUT_RD);
    receiver_.join();
    middle_.join();
    passed_.fetch_add(1);
    passed_.notify_one();
    sender_.join();
  }
  int port() const { return port_of(socket_); }

 private:
  struct Datagram {
    std::array<std::byte, 128> bytes;
    std::size_t length = 0;
    sockaddr_storage from{};
    socklen_t size = sizeof from;
  };

  void receive() {
    while (!ending_) {
      in_.size = sizeof in_.from;
      const auto length = recvfrom(socket_.get(), in_.bytes.data(), in_.bytes.size(), 0,
                                   reinterpret_cast<sockaddr*>(&in_.from), &in_.size);
      if (length <= 0) continue;
      in_.length = static_cast<std::size_t>(length);
      received_.fetch_add(1, std::memory_order_release);
    }
  }
  void pass() {
    for (std::uint32_t seen = 0; !ending_.load(std::memory_order_relaxed);) {
      const std::uint32_t now = received_.load(std::memory_order_acquire);
      if (now == seen) continue;
      seen = now;
      out_ = in_;
      passed_.fetch_add(1, std::memory_order_release);
      passed_.notify_one();
    }
  }
  void send() {
    for (std::uint32_t seen = 0; !ending_;) {
      passed_.wait(seen, std::memory_order_acquire);
      seen = passed_.load(std::memory_order_acquire);
      sendto(socket_.get(), out_.bytes.data(), out_.length, 0, reinterpret_cast<const sockaddr*>(&out_.from),
             out_.size);
    }
  }

  Descriptor socket_;
  Datagram in_, out_;  // one question at a time is under way
  std::atomic<bool> ending_{false};
  std::atomic<std::uint32_t> received_{0}, passed_{0};
  std::thread receiver_, middle_, sender_;
};

// Only one of the two has threads at a time.
template <class Echo>
double ns_per_round_trip() {
  Echo echo;
  Asker asker(echo.port());
  return asker.ns_per_round_trip();
}

}  // namespace

Figure measure_udp_echo(const std::string& name, int repeats) {
  // which of the threads share a processor changes from one time to the next, and makes half of what is measured
  constexpr int times_as_many = 8;
  Figure figure = compare(name, "a packet over UDP, a port, a task, a port and back / a bare echo by as many threads",
                          1.3, times_as_many * repeats, ns_per_round_trip<Engine>, ns_per_round_trip<BareEcho>);
  for (double* ns : {&figure.value, &figure.floor}) *ns *= 1e-3;
  figure.unit = "us";
  return figure;
}

}  // namespace jarol::bench
