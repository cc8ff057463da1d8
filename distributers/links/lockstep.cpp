#include "distributers/links/lockstep.h"

#include <cstring>

#include "distributers/links/tcp.h"
#include "distributers/messages/packet.h"
#include "graph/language/quantities.h"

namespace jarol::distributers {
namespace {

constexpr std::uint64_t version = 1;
constexpr std::size_t longest_mishap = 200;

// Both ends are this program, which runs on little-endian machines only.
std::vector<std::byte> numbers(std::initializer_list<std::uint64_t> all, const std::string& text = "") {
  std::vector<std::byte> bytes(8 * all.size() + text.size());
  std::memcpy(bytes.data(), all.begin(), 8 * all.size());
  std::memcpy(bytes.data() + 8 * all.size(), text.data(), text.size());
  return bytes;
}

std::uint64_t number(const FrameStream::Frame& frame, std::size_t index) {
  std::uint64_t value = 0;
  if (frame.bytes.size() < 8 * (index + 1)) throw FrameError("a frame of the lockstep protocol is too short");
  std::memcpy(&value, frame.bytes.data() + 8 * index, 8);
  return value;
}

[[noreturn]] void throw_unfit(const FrameStream& stream) {
  throw FrameError(stream.who() + " does not speak the lockstep protocol");
}

std::string text_after(const FrameStream::Frame& frame, std::size_t count) {
  const auto* characters = reinterpret_cast<const char*>(frame.bytes.data());
  return {characters + 8 * count, characters + frame.bytes.size()};
}

}  // namespace

// Puts messages into frames.
class Putter : public messages::Receiver {
 public:
  Putter(const messages::MessageSet& set, FrameStream& stream) : set_(set), header_(*set.header), stream_(stream) {}
  void receive(messages::MessageRef message) override {
    if (write_packet(header_, message, set_.order, packet_)) stream_.put(FrameKind::message, packet_);
  }

 private:
  const messages::MessageSet& set_;
  messages::Message header_;
  std::vector<std::byte> packet_;
  FrameStream& stream_;
};

// Takes messages out of them.
class Taker {
 public:
  explicit Taker(const messages::MessageSet& set) : reader_(set) {}
  messages::MessageRef message(const FrameStream::Frame& frame) {
    if (reader_.read(frame.bytes) != messages::Flaw::none)
      throw FrameError("a frame of the lockstep protocol has a message that can't be read");
    return reader_.message();
  }

 private:
  messages::PacketReader reader_;
};

// The vehicle as its runner sees it: commands and steps go out together with the next look at its sensors.
class RemoteVehicle : public vehicles::Stepped {
 public:
  RemoteVehicle(FrameStream stream, Duration grid, const messages::MessageSet& set)
      : stream_(std::move(stream)), grid_(grid), putter_(set, stream_), taker_(set) {}

  std::chrono::nanoseconds grid() const override { return grid_; }
  void accept(messages::MessageRef command) override { putter_.receive(command); }
  void step() override { stream_.put(FrameKind::step); }
  void flush() { stream_.flush(); }

  void sense(messages::Receiver& receiver) const override {
    stream_.put(FrameKind::sense);
    stream_.flush();
    for (const auto deadline = stream_.begin_wait();;) {
      const FrameStream::Frame frame = stream_.read(deadline);
      if (frame.kind == FrameKind::sensed) return hear_of_mishap(frame);
      if (frame.kind == FrameKind::no_state) throw vehicles::NoState(text_after(frame, 0));
      if (frame.kind != FrameKind::message) throw_unfit(stream_);
      receiver.receive(taker_.message(frame));
    }
  }

  std::optional<vehicles::Mishap> mishap() const override { return mishap_; }

 private:
  // The newest counts: one that has not taken off yet may do so later.
  void hear_of_mishap(const FrameStream::Frame& frame) const {
    mishap_.reset();
    if (frame.bytes.empty()) return;
    const auto instant = static_cast<std::int64_t>(number(frame, 0));
    mishap_ = {std::chrono::nanoseconds(instant), text_after(frame, 1).substr(0, longest_mishap)};
  }

  mutable std::optional<vehicles::Mishap> mishap_;
  mutable FrameStream stream_;
  Duration grid_;
  Putter putter_;
  mutable Taker taker_;
};

LockstepChannels::LockstepChannels(const Address& peer, std::uint64_t seed, std::unique_ptr<AnyDistributer> distributer,
                                   CheckGrid check_grid, LockstepOptions options)
    : peer_(peer),
      seed_(seed),
      distributer_(std::move(distributer)),
      check_grid_(std::move(check_grid)),
      options_(std::move(options)) {}

LockstepChannels::~LockstepChannels() = default;

void LockstepChannels::begin() {
  FrameStream stream = FrameStream::connect(peer_, options_.patience);
  if (options_.key) stream.secure(*options_.key, distributer_->message_set().name);
  const FrameStream::Frame welcome = stream.read();
  const auto refuse = [&](const std::string& why) {
    throw FrameError("the vehicle at " + peer_.text() + " does not fit: " + why);
  };
  if (welcome.kind == FrameKind::busy) throw FrameError(stream.who() + " is busy: " + text_after(welcome, 0));
  if (welcome.kind != FrameKind::welcome || number(welcome, 0) != version)
    refuse("it does not speak version " + std::to_string(version) + " of the lockstep protocol");
  const Duration grid(static_cast<std::int64_t>(number(welcome, 1)));
  const std::string set = text_after(welcome, 2);
  if (set != distributer_->message_set().name)
    refuse("it speaks '" + set + "', not '" + std::string(distributer_->message_set().name) + "'");
  if (grid <= Duration::zero()) refuse("its step is " + duration_text(grid) + "; it has to be above zero");
  if (const std::string wrong = check_grid_(grid); !wrong.empty()) refuse(wrong);
  stream.put(FrameKind::begin, numbers({seed_}));
  auto vehicle = std::make_unique<RemoteVehicle>(std::move(stream), grid, distributer_->message_set());
  vehicle_ = vehicle.get();
  simulation_ = std::make_unique<SimulationChannels>(std::move(vehicle), std::move(distributer_));
}

void LockstepChannels::finish() {
  if (simulation_) mishap_ = simulation_->mishap();
  vehicle_ = nullptr;
  simulation_.reset();
}

void LockstepChannels::flush() {
  if (vehicle_ != nullptr) vehicle_->flush();
}

namespace {

// no runner has as much to say between two looks at the sensors
constexpr int max_frames = 65536;

std::vector<std::byte> bytes_of(const std::optional<vehicles::Mishap>& mishap) {
  if (!mishap) return {};
  return numbers({static_cast<std::uint64_t>(mishap->instant.count())}, mishap->text);
}

// Another has come while the vehicle is with a runner.
void turn_away(const Descriptor& door, const FrameStream& runner, const LockstepOptions& options) {
  Descriptor other = accept_from(door);
  if (!other) return;
  const std::string who = "the runner at " + peer_of(other).text();
  options.note(who + " was turned away: the vehicle is with " + runner.who());
  const std::string why = "it is with " + runner.who();
  try {
    FrameStream stream(std::move(other), who, options.patience);
    stream.put(FrameKind::busy, std::as_bytes(std::span(why)));
    stream.flush();
  } catch (const FrameError&) {
    // it has gone by itself
  }
}

}  // namespace

void serve_lockstep(FrameStream stream, const messages::MessageSet& set,
                    const std::function<std::unique_ptr<vehicles::Vehicle>(std::uint64_t seed)>& make,
                    const Interrupter& interrupter, const LockstepOptions& options, const Descriptor& door) {
  using Clock = FrameStream::Clock;
  const auto grid = static_cast<std::uint64_t>(make(0)->grid().count());
  if (options.key) stream.secure(*options.key, set.name);
  stream.put(FrameKind::welcome, numbers({version, grid}, std::string(set.name)));
  stream.flush();
  Putter putter(set, stream);
  Taker taker(set);
  struct Served {
    const LockstepOptions& options;
    std::unique_ptr<vehicles::Vehicle> vehicle{};
    ~Served() {
      const auto mishap = vehicle ? vehicle->mishap() : std::nullopt;
      if (mishap) options.mishap(*mishap);
    }
  } served{options};
  std::unique_ptr<vehicles::Vehicle>& vehicle = served.vehicle;
  std::optional<std::string> no_state;
  auto heard = Clock::now();
  const auto is_silent = [&] { return Clock::now() - heard >= stream.patience(); };
  int frames = 0;
  for (;;) {
    const auto ready = stream.wait(interrupter, door.get(), std::chrono::milliseconds(vehicle == nullptr ? 100 : -1));
    if (ready.interrupted) return;
    if (!ready.one) {
      if (is_silent() && (ready.other || vehicle == nullptr))
        throw FrameError(stream.who() + " has been silent for " + duration_text(stream.patience()) +
                         (vehicle == nullptr ? "" : " and makes room for another"));
      if (ready.other) turn_away(door, stream, options);
      continue;
    }
    const FrameStream::Frame frame = stream.read();
    if (++frames > max_frames)
      throw FrameError(stream.who() + " has sent " + std::to_string(max_frames) +
                       " frames without a look at the sensors");
    if (vehicle == nullptr) {
      if (frame.kind != FrameKind::begin) throw_unfit(stream);
      vehicle = make(number(frame, 0));
    } else if (frame.kind == FrameKind::message) {
      vehicle->accept(taker.message(frame));
    } else if (frame.kind == FrameKind::step) {
      try {
        if (!no_state) vehicle->step();
      } catch (const vehicles::NoState& error) { no_state = error.what(); }
    } else if (frame.kind == FrameKind::sense) {
      frames = 0;
      if (no_state)
        stream.put(FrameKind::no_state, std::as_bytes(std::span(*no_state)));
      else
        vehicle->sense(putter), stream.put(FrameKind::sensed, bytes_of(vehicle->mishap()));
      stream.flush();
    } else {
      throw_unfit(stream);
    }
    heard = Clock::now();
  }
}

}  // namespace jarol::distributers
