#include "distributers/links/lockstep.h"

#include "distributers/links/lockstep_frames.h"
#include "graph/language/quantities.h"

namespace jarol::distributers {
namespace {

constexpr std::size_t longest_mishap = 200;

[[noreturn]] void throw_busy(const FrameStream& stream, const FrameStream::Frame& frame) {
  throw FrameError(stream.who() + " is busy: " + text_after(frame, 0));
}

}  // namespace

// The vehicle as its runner sees it: commands and steps go out together with the next look at its sensors.
class RemoteVehicle : public vehicles::SteppedVehicle {
 public:
  RemoteVehicle(FrameStream stream, Duration grid, const messages::MessageSet& set)
      : stream_(std::move(stream)), grid_(grid), putter_(set, stream_), taker_(set) {}

  std::chrono::nanoseconds grid() const override { return grid_; }
  void accept(messages::MessageRef command) override { putter_.receive(command); }
  void step() override {
    stream_.put(FrameKind::step);
    ++steps_;
  }
  void flush() { stream_.flush(); }

  void sense(messages::Receiver& receiver) const override {
    stream_.put(FrameKind::sense);
    stream_.flush();
    for (const auto deadline = stream_.begin_wait();;) {
      const FrameStream::Frame frame = stream_.read(deadline);
      if (frame.kind == FrameKind::sensed) return end_of_answer(frame);
      if (frame.kind == FrameKind::busy) throw_busy(stream_, frame);
      if (frame.kind == FrameKind::no_state) throw vehicles::NoState(text_after(frame, 0));
      if (frame.kind != FrameKind::message) throw_unfit(stream_);
      receiver.receive(taker_.message(frame));
    }
  }

  std::optional<vehicles::Mishap> mishap() const override { return mishap_; }

 private:
  // An answer that came twice, or late, has the sensors of another step. The newest mishap counts: a vehicle that has
  // not taken off yet may do so later.
  void end_of_answer(const FrameStream::Frame& frame) const {
    const std::uint64_t steps = number(frame, 0);
    if (steps != steps_)
      throw FrameError(stream_.who() + " is out of step: got what it senses after step " + std::to_string(steps) +
                       ", expected that after step " + std::to_string(steps_));
    mishap_.reset();
    if (frame.bytes.size() == 8) return;
    const auto instant = static_cast<std::int64_t>(number(frame, 1));
    mishap_ = {std::chrono::nanoseconds(instant), text_after(frame, 2).substr(0, longest_mishap)};
  }

  std::uint64_t steps_ = 0;  // granted
  mutable std::optional<vehicles::Mishap> mishap_;
  mutable FrameStream stream_;
  Duration grid_;
  Putter putter_;
  mutable Taker taker_;
};

LockstepSystem::LockstepSystem(const Address& peer, std::uint64_t seed, std::unique_ptr<AnyDistributer> distributer,
                               CheckGrid check_grid, LockstepOptions options)
    : peer_(peer),
      seed_(seed),
      distributer_(std::move(distributer)),
      check_grid_(std::move(check_grid)),
      options_(std::move(options)) {}

LockstepSystem::~LockstepSystem() = default;

void LockstepSystem::begin() {
  FrameStream stream = FrameStream::connect(peer_, options_.patience);
  if (options_.key) stream.secure(*options_.key, distributer_->message_set().name);
  const FrameStream::Frame welcome = stream.read();
  const auto refuse = [&](const std::string& why) {
    throw FrameError("the vehicle at " + peer_.text() + " does not fit: " + why);
  };
  if (welcome.kind == FrameKind::busy) throw_busy(stream, welcome);
  if (welcome.kind != FrameKind::welcome || number(welcome, 0) != lockstep_version)
    refuse("it does not speak version " + std::to_string(lockstep_version) + " of the lockstep protocol");
  const Duration grid(static_cast<std::int64_t>(number(welcome, 1)));
  const std::string set = text_after(welcome, 2);
  if (set != distributer_->message_set().name)
    refuse("it speaks '" + set + "', not '" + std::string(distributer_->message_set().name) + "'");
  if (grid <= Duration::zero()) refuse("its step is " + duration_text(grid) + "; it has to be above zero");
  if (const std::string wrong = check_grid_(grid); !wrong.empty()) refuse(wrong);
  stream.put(FrameKind::begin, numbers({seed_}));
  auto vehicle = std::make_unique<RemoteVehicle>(std::move(stream), grid, distributer_->message_set());
  vehicle_ = vehicle.get();
  simulation_ = std::make_unique<SimulatedSystem>(std::move(vehicle), std::move(distributer_));
}

void LockstepSystem::finish() {
  if (simulation_) mishap_ = simulation_->mishap();
  vehicle_ = nullptr;
  simulation_.reset();
}

void LockstepSystem::flush() {
  if (vehicle_ != nullptr) vehicle_->flush();
}

}  // namespace jarol::distributers
