// Random and damaged frames on the lockstep link, at either end: nothing crashes, nothing has an effect after the first
// frame that is not as it has to be.
#include <doctest/doctest.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <atomic>
#include <cstring>
#include <thread>

#include "distributers/interfaces/typed.h"
#include "distributers/javiator/vehicle.h"
#include "distributers/links/lockstep.h"
#include "distributers/links/lockstep_server.h"
#include "distributers/links/tcp.h"
#include "distributers/messages/javiator.h"
#include "distributers/messages/packet.h"
#include "tests/distributers/messages/damage.h"
#include "tests/how_many.h"

namespace {
using namespace jarol;
using namespace jarol::distributers;
using namespace jarol::tests;
namespace javiator = messages::javiator;

// at either end, each with a random and a damaged packet
std::size_t session_count() { return tests::how_many(1'000, 500'000); }

const Protocol& protocol() { return protocols()[1]; }

void put(Bytes& to, FrameKind kind, std::span<const std::byte> bytes = {}) {
  const auto size = static_cast<std::uint32_t>(bytes.size());
  for (int shift = 0; shift < 32; shift += 8) to.push_back(static_cast<std::byte>(size >> shift));
  to.push_back(static_cast<std::byte>(kind));
  to.insert(to.end(), bytes.begin(), bytes.end());
}

// A message in a good frame, two that are thrown, and again a good one.
void put_garbage(Bytes& to, const std::vector<Bytes>& packets, Random& random) {
  const auto begin = static_cast<std::ptrdiff_t>(to.size());
  const auto any = [&]() -> const Bytes& { return packets[below(random, packets.size())]; };
  put(to, FrameKind::message, any());
  if (random() % 4 == 0) {
    const Bytes bytes = random_bytes(packets, random);
    to.insert(to.end(), bytes.begin(), bytes.end());
  } else {
    put(to, FrameKind::message, random_bytes(packets, random));
  }
  Bytes frame, packet = any();
  if (random() % 2 == 0) damage(packet, random);
  put(frame, FrameKind::message, packet);
  if (random() % 2 == 0) damage(frame, random);
  // either of them may be the first to be wrong
  to.insert(random() % 2 == 0 ? to.end() : to.begin() + begin, frame.begin(), frame.end());
  put(to, FrameKind::message, any());
}

// How many messages ought to have an effect: those before the first frame that is wrong. Sent by a runner, all count;
// by a vehicle, the answers that a distributer takes.
std::size_t messages_before_an_error(std::span<const std::byte> bytes, bool of_runner) {
  messages::PacketReader reader(protocol().set);
  Typed<JaviatorVehicle> distributer;
  std::size_t of_any = 0;
  const auto count = [&] {
    tasks::JaviatorSensors sensors;
    distributer.take(0, &sensors);
    return of_runner ? of_any : sensors.answers;
  };
  for (bool begun = false;; begun = true) {
    if (bytes.size() < 5) return count();
    std::uint32_t size = 0;
    std::memcpy(&size, bytes.data(), 4);
    const auto kind = static_cast<FrameKind>(bytes[4]);
    if (bytes.size() - 5 < size) return count();
    const auto content = bytes.subspan(5, size);
    bytes = bytes.subspan(5 + size);
    if (!begun) {
      if (kind != (of_runner ? FrameKind::begin : FrameKind::welcome) || size < 8) return count();
    } else if (kind == FrameKind::message) {
      if (reader.read(content) != messages::PacketError::none) return count();
      REQUIRE(protocol().is_sealed(content));
      ++of_any;
      distributer.receive(reader.message());
    } else if (!of_runner || (kind != FrameKind::step && kind != FrameKind::sense)) {
      return count();
    }
  }
}

// Keeps count of what it gets.
class Box : public vehicles::Vehicle {
 public:
  explicit Box(std::size_t& accepted) : accepted_(accepted) {}
  std::chrono::nanoseconds grid() const override { return std::chrono::milliseconds(5); }
  void accept(messages::MessageRef) override { ++accepted_; }
  void step() override {}
  void sense(messages::Receiver&) const override {}
  vehicles::VehicleState state() const override { return {}; }
  void place(const vehicles::VehicleState&) override {}
  void command(const void*) override {}
  const void* outputs() const override { return nullptr; }

 private:
  std::size_t& accepted_;
};

Bytes numbers(std::initializer_list<std::uint64_t> all) {
  Bytes bytes(8 * all.size());
  std::memcpy(bytes.data(), all.begin(), bytes.size());
  return bytes;
}

// What a runner and a vehicle send in the session of that number.
Bytes runner_session(const std::vector<Bytes>& packets, std::size_t session) {
  Random random(session);
  Bytes bytes;
  put(bytes, FrameKind::begin, numbers({0}));
  put_garbage(bytes, packets, random);
  return bytes;
}

Bytes vehicle_session(const std::vector<Bytes>& packets, std::size_t session) {
  Random random(session);
  Bytes welcome = numbers({2, 5'000'000}), bytes;
  for (const char c : std::string("javiator")) welcome.push_back(static_cast<std::byte>(c));
  put(bytes, FrameKind::welcome, welcome);
  put_garbage(bytes, packets, random);
  put(bytes, FrameKind::sensed, numbers({0}));
  return bytes;
}

void send_all(const Descriptor& to, std::span<const std::byte> bytes) {
  while (!bytes.empty()) {
    const auto length = ::send(to.get(), bytes.data(), bytes.size(), MSG_NOSIGNAL);
    if (length <= 0) return;  // the other end has had enough
    bytes = bytes.subspan(static_cast<std::size_t>(length));
  }
}

// Of the vehicle that is sent to each runner that connects.
class Peer {
 public:
  Peer(const std::vector<Bytes>& packets, std::size_t sessions) {
    thread_ = std::thread([this, &packets, sessions] {
      for (std::size_t i = 0; i < sessions; ++i) {
        Descriptor runner;
        while (!runner && !stop_) {
          pollfd door{socket_.get(), POLLIN, 0};
          ::poll(&door, 1, 100);
          runner = Descriptor(accept4(socket_.get(), nullptr, nullptr, SOCK_CLOEXEC));
        }
        if (!runner) return;
        send_all(runner, vehicle_session(packets, i));
        ::shutdown(runner.get(), SHUT_WR);
        char room[256];
        while (::read(runner.get(), room, sizeof room) > 0) {}
      }
    });
  }
  ~Peer() {
    stop_ = true;
    thread_.join();
  }
  Address address() const { return Address::parse("127.0.0.1:" + std::to_string(port_of(socket_))); }

 private:
  // with room for more than comes at once: what is dropped at a full door is sent again after seconds
  Descriptor socket_ = listen_at(Address::parse("127.0.0.1:0"), 64);
  std::atomic<bool> stop_ = false;
  std::thread thread_;
};
}  // namespace

TEST_SUITE("distributers/links/lockstep_garbage") {
  TEST_CASE("a vehicle's process takes what comes before the first frame that is wrong, and is there for the next") {
    const std::vector<Bytes> packets = protocol().packets();
    const Interrupter interrupter;
    std::size_t taken = 0, refused = 0;
    for (std::size_t session = 0; session < session_count(); ++session) {
      const Bytes bytes = runner_session(packets, session);
      int ends[2];
      REQUIRE(socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends) == 0);
      Descriptor runner(ends[0]);
      send_all(runner, bytes);
      ::shutdown(runner.get(), SHUT_WR);
      std::size_t accepted = 0;
      try {
        serve_runner(FrameStream(Descriptor(ends[1])),
                     {.set = protocol().set,
                      .name = "box",
                      .make = [&](std::uint64_t) { return std::make_unique<Box>(accepted); }},
                     interrupter);
        FAIL("it has not noticed the end");
      } catch (const FrameEnd&) { ++taken; } catch (const FrameError&) {
        ++refused;
      }
      REQUIRE(accepted == messages_before_an_error(bytes, true));
    }
    CHECK(refused > taken);
    CHECK(taken > 0);
    MESSAGE(session_count() << " sessions, of which " << refused << " were refused");
  }

  TEST_CASE("a runner takes what comes before the first frame that is wrong, and reports that the vehicle is lost") {
    const std::vector<Bytes> packets = protocol().packets();
    std::size_t taken = 0, refused = 0;
    const Peer peer(packets, session_count());
    for (std::size_t session = 0; session < session_count(); ++session) {
      CAPTURE(session);
      std::string said;
      const Bytes bytes = vehicle_session(packets, session);
      LockstepSystem system(peer.address(), 0, std::make_unique<Typed<JaviatorVehicle>>(),
                            [](Duration) { return std::string(); });
      system.begin();
      try {
        system.reach(Duration{});
        ++taken;
      } catch (const std::runtime_error& error) {
        said = error.what();
        ++refused;
      }
      CAPTURE(said);
      tasks::JaviatorSensors sensors;
      system.take(0, &sensors);
      REQUIRE(sensors.answers == messages_before_an_error(bytes, false));
    }
    CHECK(refused > taken);
    MESSAGE(session_count() << " sessions, of which " << refused << " were refused");
  }
}
