#include "tests/tools/actuator_peer.h"

#include <fcntl.h>
#include <stdlib.h>
#include <termios.h>

#include <algorithm>
#include <atomic>
#include <mutex>
#include <stdexcept>
#include <thread>

#include "distributers/links/link.h"
#include "distributers/links/lockstep.h"
#include "distributers/links/lockstep_server.h"
#include "distributers/links/serial.h"
#include "distributers/links/tcp.h"
#include "distributers/links/udp.h"
#include "distributers/messages/imc.h"
#include "tests/tools/process.h"

namespace jarol::tests {
namespace {

using namespace jarol::distributers;
using namespace std::chrono_literals;
namespace imc = messages::imc;

class Notes : public messages::Receiver {
 public:
  void receive(messages::MessageRef message) override {
    const auto* thruster = message.as<imc::SetThrusterActuation>();
    if (thruster == nullptr) return;
    const std::lock_guard lock(mutex_);
    all_.push_back({PeerClock::now(), thruster->value});
  }
  std::vector<Thrust> all() const {
    const std::lock_guard lock(mutex_);
    return all_;
  }

 private:
  mutable std::mutex mutex_;
  std::vector<Thrust> all_;
};

class LinkPeer : public ActuatorPeer {
 public:
  LinkPeer(std::string text, std::unique_ptr<Transport> transport)
      : text_(std::move(text)), link_(std::move(transport), imc::message_set(), {}) {
    link_.connect();
    thread_ = std::thread([this] {
      for (int i = 0; !ended_; ++i) {
        link_.receive(notes_);
        if (i % 20 == 0) link_.send(messages::refer_to(imc::SimulatedState{}));
        link_.flush();
        std::this_thread::sleep_for(1ms);
      }
    });
  }
  ~LinkPeer() override { vanish(); }
  std::string link() const override { return text_; }
  std::vector<Thrust> thrusts() const override { return notes_.all(); }
  void vanish() override {
    ended_ = true;
    if (thread_.joinable()) thread_.join();
    link_.disconnect();
  }

 private:
  std::string text_;
  Link link_;
  Notes notes_;
  std::atomic<bool> ended_{false};
  std::thread thread_;
};

// The device's side of a line of which the graph has the other.
class PtyTransport : public StreamTransport {
 public:
  PtyTransport() : device_(posix_openpt(O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC)) {
    if (grantpt(device_.get()) != 0 || unlockpt(device_.get()) != 0) throw std::runtime_error("no pseudo terminal");
    name_ = ptsname(device_.get());
    // held open, so that it does not hang up before the graph comes and when it has gone
    line_ = Descriptor(::open(name_.c_str(), O_RDWR | O_NOCTTY | O_CLOEXEC));
    termios settings{};
    tcgetattr(line_.get(), &settings);
    cfmakeraw(&settings);
    tcsetattr(line_.get(), TCSANOW, &settings);
  }
  const std::string& name() const { return name_; }
  std::string text() const override { return "pty " + name_; }
  void open() override {}

 protected:
  Descriptor get_stream() override { return Descriptor(fcntl(device_.get(), F_DUPFD_CLOEXEC, 0)); }

 private:
  Descriptor device_, line_;
  std::string name_;
};

// A vehicle that stands still.
class Still : public vehicles::Vehicle {
 public:
  explicit Still(Notes& notes) : notes_(notes) {}
  std::chrono::nanoseconds grid() const override { return 10ms; }
  void accept(messages::MessageRef command) override { notes_.receive(command); }
  void step() override {}
  void sense(messages::Receiver& receiver) const override {
    receiver.receive(messages::refer_to(imc::SimulatedState{}));
  }
  vehicles::VehicleState state() const override { return {}; }
  void place(const vehicles::VehicleState&) override {}
  void command(const void*) override {}
  const void* outputs() const override { return nullptr; }

 private:
  Notes& notes_;
};

class LockstepPeer : public ActuatorPeer {
 public:
  LockstepPeer() {
    thread_ = std::thread([this] {
      serve_lockstep(socket_,
                     {.set = imc::message_set(),
                      .name = "still",
                      .make = [this](std::uint64_t) { return std::make_unique<Still>(notes_); }},
                     interrupter_);
    });
  }
  ~LockstepPeer() override { vanish(); }
  std::string link() const override {
    return "{type: lockstep, peer: \"127.0.0.1:" + std::to_string(port_of(socket_)) + "\"}";
  }
  std::vector<Thrust> thrusts() const override { return notes_.all(); }
  void vanish() override {
    interrupter_.interrupt();
    if (thread_.joinable()) thread_.join();
  }

 private:
  Notes notes_;
  Descriptor socket_ = listen_at(Address::parse("0"));
  Interrupter interrupter_;
  std::thread thread_;
};

}  // namespace

bool ActuatorPeer::has(double thrust) const {
  const std::vector<Thrust> all = thrusts();
  return std::any_of(all.begin(), all.end(), [&](const Thrust& t) { return t.value == thrust; });
}

std::unique_ptr<ActuatorPeer> make_actuator_peer(const std::string& kind) {
  if (kind == "lockstep") return std::make_unique<LockstepPeer>();
  if (kind == "serial") {
    auto line = std::make_unique<PtyTransport>();
    const std::string text = "{type: serial, device: " + line->name() + "}";
    return std::make_unique<LinkPeer>(text, std::move(line));
  }
  const std::string here = free_port(kind == "udp" ? SOCK_DGRAM : SOCK_STREAM);
  const std::string there = free_port(kind == "udp" ? SOCK_DGRAM : SOCK_STREAM);
  if (kind == "udp")
    return std::make_unique<LinkPeer>("{type: udp, listen: " + there + ", peer: \"127.0.0.1:" + here + "\"}",
                                      std::make_unique<UdpTransport>(Address::parse(here), Address::parse(there)));
  if (kind == "tcp_client")
    return std::make_unique<LinkPeer>("{type: tcp_client, peer: \"127.0.0.1:" + here + "\"}",
                                      std::make_unique<TcpServer>(Address::parse(here)));
  if (kind == "tcp_server")
    return std::make_unique<LinkPeer>("{type: tcp_server, listen: " + there + "}",
                                      std::make_unique<TcpClient>(Address::parse(there)));
  throw std::invalid_argument("no link '" + kind + "'");
}

}  // namespace jarol::tests
