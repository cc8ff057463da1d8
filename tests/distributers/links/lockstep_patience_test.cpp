// Vehicles and runners in lockstep that are mute, talk without end, or come when there is one already.
// In one file: all cases try the patience of one pair.
#include <doctest/doctest.h>

#include <sys/socket.h>
#include <unistd.h>
#include <cerrno>

#include <atomic>
#include <cstring>
#include <functional>
#include <mutex>
#include <thread>

#include "distributers/interfaces/typed.h"
#include "distributers/javiator/vehicle.h"
#include "distributers/links/lockstep.h"
#include "distributers/links/lockstep_server.h"
#include "distributers/links/tcp.h"
#include "distributers/messages/javiator.h"
#include "distributers/messages/packet.h"

namespace {
using namespace jarol;
using namespace jarol::distributers;
using namespace std::chrono_literals;
namespace javiator = messages::javiator;
using Bytes = std::vector<std::byte>;

constexpr auto short_patience = 400ms;

Bytes frame(FrameKind kind, const Bytes& content = {}) {
  Bytes bytes;
  const auto size = static_cast<std::uint32_t>(content.size());
  for (int shift = 0; shift < 32; shift += 8) bytes.push_back(static_cast<std::byte>(size >> shift));
  bytes.push_back(static_cast<std::byte>(kind));
  bytes.insert(bytes.end(), content.begin(), content.end());
  return bytes;
}

Bytes welcome() {
  Bytes content(16);
  const std::uint64_t version = 2, grid = 5'000'000;
  std::memcpy(content.data(), &version, 8);
  std::memcpy(content.data() + 8, &grid, 8);
  for (const char c : std::string("javiator")) content.push_back(static_cast<std::byte>(c));
  return frame(FrameKind::welcome, content);
}

Bytes message() {
  Bytes bytes;
  const javiator::Header header;
  REQUIRE(write_packet(messages::refer_to(header), messages::refer_to(javiator::JaviatorData{}),
                       javiator::message_set().order, bytes));
  return frame(FrameKind::message, bytes);
}

// A vehicle that does something else than it should, until it is let go.
struct Strange {
  explicit Strange(std::function<void(const Descriptor&, const std::atomic<bool>&)> does) {
    thread = std::thread([this, does] {
      Descriptor runner;
      while (!runner && !ending) runner = accept_from(socket);
      if (runner) does(runner, ending);
      while (!ending) std::this_thread::sleep_for(1ms);
    });
  }
  ~Strange() {
    ending = true;
    thread.join();
  }
  Descriptor socket = listen_at(Address::parse("0"));
  Address address = Address::parse(std::to_string(port_of(socket)));
  std::atomic<bool> ending{false};
  std::thread thread;
};

// All of it, or nothing more once the other end has gone: half a message would be another finding.
void say(const Descriptor& to, const Bytes& bytes) {
  for (std::size_t sent = 0; sent < bytes.size();) {
    const ssize_t now = ::send(to.get(), bytes.data() + sent, bytes.size() - sent, MSG_NOSIGNAL);
    if (now < 0 && errno != EAGAIN && errno != EINTR) return;
    if (now > 0) sent += static_cast<std::size_t>(now);
  }
}

// What a run says that looks at its sensors once.
std::string said_with(const Address& address, std::optional<SecretKey> key = {}) {
  try {
    LockstepSystem system(address, 0, std::make_unique<Typed<JaviatorVehicle>>(),
                          [](Duration) { return std::string(); }, {.key = key, .patience = short_patience});
    system.begin();
    system.reach(Duration{});
  } catch (const FrameError& error) {
    const std::string text = error.what(), who = "the vehicle at " + address.text() + " ";
    return text.starts_with(who) ? text.substr(who.size()) : text;
  }
  return "";
}

class EmptyBox : public vehicles::Vehicle {
 public:
  std::chrono::nanoseconds grid() const override { return 5ms; }
  void accept(messages::MessageRef) override {}
  void step() override {}
  void sense(messages::Receiver&) const override {}
  vehicles::VehicleState state() const override { return {}; }
  void place(const vehicles::VehicleState&) override {}
  void command(const void*) override {}
  const void* outputs() const override { return nullptr; }
};

// A vehicle's process; what it says of its runners.
struct Server {
  explicit Server(std::optional<SecretKey> key = {}, std::chrono::milliseconds patience = short_patience) {
    thread = std::thread([this, key, patience] {
      LockstepService service{.set = javiator::message_set(),
                              .name = "box",
                              .make = [](std::uint64_t) { return std::make_unique<EmptyBox>(); },
                              .key = key,
                              .patience = patience};
      service.note = [this](const std::string& text) { add(text); };
      serve_lockstep(socket, service, interrupter);
    });
  }
  ~Server() {
    interrupter.interrupt();
    thread.join();
  }
  void add(const std::string& text) {
    const std::lock_guard lock(mutex);
    said += text + "\n";
  }
  bool says(const std::string& text) { return says_begin(text + "\n"); }
  bool says_begin(const std::string& text) {
    for (const auto end = std::chrono::steady_clock::now() + 20s; std::chrono::steady_clock::now() < end;) {
      {
        const std::lock_guard lock(mutex);
        if (said.find(text) != std::string::npos) return true;
      }
      std::this_thread::sleep_for(1ms);
    }
    MESSAGE(said);
    return false;
  }
  Descriptor socket = listen_at(Address::parse("0"), 64);  // all of a case may come before one is looked at
  Address address = Address::parse(std::to_string(port_of(socket)));
  Interrupter interrupter;
  std::mutex mutex;
  std::string said;
  std::thread thread;
};

// A runner by hand.
struct Runner {
  explicit Runner(const Address& to) : socket(::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0)) {
    REQUIRE(connect(socket.get(), to.get(), to.size()) == 0);
    sockaddr_storage storage{};
    socklen_t size = sizeof storage;
    getsockname(socket.get(), reinterpret_cast<sockaddr*>(&storage), &size);
    name = "the runner at " + Address::of(storage, size).text();
  }
  void begin() const { say(socket, frame(FrameKind::begin, Bytes(8))); }
  Descriptor socket;
  std::string name;
};

SecretKey secret_of(int seed) {
  SecretKey key{};
  key.fill(static_cast<std::byte>(seed));
  return key;
}
}  // namespace

TEST_SUITE("distributers/links/lockstep_patience") {
  TEST_CASE("a mute vehicle is not waited for without end, before its welcome or after") {
    CHECK(said_with(Strange([](const Descriptor&, const auto&) {}).address) == "has been silent for 400ms");
    CHECK(said_with(Strange([](const Descriptor& to, const auto&) { say(to, welcome()); }).address) ==
          "has been silent for 400ms");
  }

  TEST_CASE("a vehicle that talks without end is left: byte by byte, or in whole messages") {
    const Strange trickles([](const Descriptor& to, const std::atomic<bool>& ending) {
      say(to, welcome());
      const Bytes bytes = message();
      for (std::size_t i = 0; !ending; ++i) {
        say(to, {bytes[i % bytes.size()]});
        std::this_thread::sleep_for(20ms);
      }
    });
    CHECK(said_with(trickles.address) == "has not come to an end within 400ms");
    const Strange talks([](const Descriptor& to, const std::atomic<bool>& ending) {
      say(to, welcome());
      const Bytes bytes = message();
      while (!ending) say(to, bytes);
    });
    CHECK(said_with(talks.address) == "has not come to an end within 400ms");
  }

  TEST_CASE("a runner that connects and says nothing is left for the next, with its address") {
    Server server;
    const Runner mute(server.address);
    CHECK(server.says(mute.name + " has been silent for 400ms"));
    CHECK(said_with(server.address) == "");
  }

  TEST_CASE("those who connect and say nothing keep the vehicle from nobody, with a key or without, however many") {
    for (const auto& key : {std::optional<SecretKey>(), std::optional(secret_of(1))}) {
      Server server(key, 1h);
      std::vector<Runner> mute;
      for (int i = 0; i < 20; ++i) mute.emplace_back(server.address);
      CHECK(said_with(server.address, key) == "");
      CHECK(server.says(mute[0].name + " has said nothing and makes room for another"));
      CHECK(server.says_begin(mute[19].name + " was turned away: the vehicle is with the runner at 127.0.0.1:"));
    }
  }

  TEST_CASE("a second runner is turned away with the address of the first, whom that does not disturb") {
    Server server;
    LockstepSystem first(server.address, 0, std::make_unique<Typed<JaviatorVehicle>>(),
                         [](Duration) { return std::string(); });
    first.begin();
    std::string said;
    for (int i = 0; i < 20'000 && !said.starts_with("is busy"); ++i) {
      first.reach(i * 5ms);  // it is not silent
      if (i % 100 == 50) said = said_with(server.address);
    }
    CHECK(said.starts_with("is busy: it is with the runner at 127.0.0.1:"));
    CHECK(server.says("was turned away: the vehicle is with " + said.substr(said.find("the runner"))));
    first.reach(1000s);
  }

  TEST_CASE("a runner that falls silent makes room when another comes") {
    Server server;
    const Runner first(server.address);
    first.begin();
    say(first.socket, frame(FrameKind::sense));
    std::this_thread::sleep_for(2 * short_patience);
    for (int i = 0; i < 50 && said_with(server.address) != ""; ++i) std::this_thread::sleep_for(100ms);
    CHECK(server.says(first.name + " has been silent for 400ms and makes room for another"));
    CHECK(said_with(server.address) == "");
  }

  TEST_CASE("a runner that sends without a look at the sensors, or never ends a frame, is left") {
    Server server;
    {
      const Runner talks(server.address);
      talks.begin();
      Bytes steps;
      for (int i = 0; i < 70'000; ++i) {
        const Bytes one = frame(FrameKind::step);
        steps.insert(steps.end(), one.begin(), one.end());
      }
      say(talks.socket, steps);
      CHECK(server.says(talks.name + " has sent 65536 frames without a look at the sensors"));
    }
    const Runner trickles(server.address);
    trickles.begin();
    say(trickles.socket, {std::byte{200}});
    CHECK(server.says(trickles.name + " has not come to an end within 400ms"));
  }

  TEST_CASE("with a key both ends have to have it") {
    Server sealed(secret_of(1)), open;
    CHECK(said_with(sealed.address, secret_of(1)) == "");
    CHECK(said_with(sealed.address, secret_of(2)) == "has another key");
    CHECK(said_with(sealed.address) == "asks for a key; both ends need the same, or none");
    CHECK(said_with(open.address, secret_of(1)) == "has no key; both ends need the same, or none");
    CHECK(said_with(sealed.address, secret_of(1)) == "");
  }

  TEST_CASE("a frame that somebody changes on its way ends the run") {
    Server server(secret_of(1));
    const Descriptor door = listen_at(Address::parse("0"));
    const Address address = Address::parse(std::to_string(port_of(door)));
    std::thread between([&] {
      Descriptor runner;
      while (!runner) runner = accept_from(door);
      const Runner to(server.address);
      // what comes from the vehicle after the hellos has a bit changed: its 3rd read and on
      std::atomic<bool> ending{false};
      std::thread forth([&] {
        char room[4096];
        while (!ending) {
          const auto length = ::recv(runner.get(), room, sizeof room, MSG_DONTWAIT);
          if (length > 0) ::send(to.socket.get(), room, static_cast<std::size_t>(length), MSG_NOSIGNAL);
          if (length == 0) ::shutdown(to.socket.get(), SHUT_RDWR);
          if (length == 0) return;
        }
      });
      char room[4096];
      std::size_t passed = 0;
      for (ssize_t length = 0; (length = ::recv(to.socket.get(), room, sizeof room, 0)) > 0;) {
        for (ssize_t i = 0; i < length; ++i)
          if (++passed == 4 * 72 + 60) room[i] ^= 1;
        if (::send(runner.get(), room, static_cast<std::size_t>(length), MSG_NOSIGNAL) < 0) break;
      }
      ending = true;
      forth.join();
    });
    std::string said;
    try {
      LockstepSystem system(address, 0, std::make_unique<Typed<JaviatorVehicle>>(),
                            [](Duration) { return std::string(); }, {.key = secret_of(1), .patience = short_patience});
      system.begin();
      for (int i = 0; i < 100; ++i) system.reach(i * 5ms);
    } catch (const FrameError& error) { said = error.what(); }
    between.join();
    CHECK(said == "the vehicle at " + address.text() + " has another key");
  }
}
