#include "distributers/links/lockstep_server.h"

#include <algorithm>

#include "distributers/links/lockstep_frames.h"
#include "distributers/links/tcp.h"
#include "graph/language/quantities.h"
#include "graph/text/errors.h"

namespace jarol::distributers {
namespace {

using Clock = FrameStream::Clock;

// no runner has as much to say between two looks at the sensors
constexpr int max_frames = 65536;
// with one who has begun to say who it is
constexpr std::chrono::milliseconds first_patience{1000};

std::vector<std::byte> end_of_answer(std::uint64_t steps, const std::optional<vehicles::Mishap>& mishap) {
  if (!mishap) return numbers({steps});
  return numbers({steps, static_cast<std::uint64_t>(mishap->instant.count())}, mishap->text);
}

void welcome(FrameStream& stream, const LockstepService& service) {
  const auto grid = static_cast<std::uint64_t>(service.make(0)->grid().count());
  stream.put(FrameKind::welcome, numbers({lockstep_version, grid}, std::string(service.set.name)));
  stream.flush();
}

// What is said to whom nothing was heard of yet.
void greet(FrameStream& stream, const LockstepService& service) {
  if (service.key)
    stream.offer_seal(*service.key, service.set.name);
  else
    welcome(stream, service);
}

// Those who have connected and said nothing yet. None of them keeps the vehicle from another.
class Callers {
 public:
  Callers(const Descriptor& door, const LockstepService& service, const Interrupter& interrupter)
      : door_(door), service_(service), interrupter_(interrupter) {}

  /// The first who speaks; nobody: it was interrupted.
  std::optional<FrameStream> next() {
    for (;;) {
      std::vector<int> descriptors;
      for (const Caller& caller : callers_) descriptors.push_back(caller.stream.descriptor());
      descriptors.push_back(door_.get());
      const auto woken = interrupter_.wait_for_any(descriptors, look);
      if (woken.interrupted) return std::nullopt;
      if (woken.ready && *woken.ready < callers_.size()) {
        const auto speaks = callers_.begin() + static_cast<std::ptrdiff_t>(*woken.ready);
        FrameStream stream = std::move(speaks->stream);
        callers_.erase(speaks);
        return stream;
      }
      if (woken.ready) let_in();
      leave_silent();
    }
  }

  /// The vehicle is with that runner now.
  void turn_away_all(const FrameStream& runner) {
    for (Caller& caller : callers_) turn_away(caller.stream, runner);
    callers_.clear();
  }
  void turn_away_newest(const FrameStream& runner) {
    if (std::optional<FrameStream> stream = accept()) turn_away(*stream, runner);
  }

 private:
  struct Caller {
    FrameStream stream;
    Clock::time_point since;
  };
  static constexpr std::size_t max = 16;
  static constexpr std::chrono::milliseconds look{100};

  std::optional<FrameStream> accept() const {
    Descriptor socket = accept_from(door_);
    if (!socket) return std::nullopt;
    const std::string who = "the runner at " + peer_of(socket).text();
    return FrameStream(std::move(socket), who, std::min(service_.patience, first_patience));
  }

  void let_in() {
    std::optional<FrameStream> stream = accept();
    if (!stream) return;
    try {
      greet(*stream, service_);
    } catch (const FrameError&) {
      return;  // it has gone by itself
    }
    if (callers_.size() == max) {
      service_.note(callers_.front().stream.who() + " has said nothing and makes room for another");
      callers_.erase(callers_.begin());
    }
    callers_.push_back({std::move(*stream), Clock::now()});
  }

  void leave_silent() {
    std::erase_if(callers_, [&](const Caller& caller) {
      const bool leaves = Clock::now() - caller.since >= service_.patience;
      if (leaves) service_.note(caller.stream.who() + " has been silent for " + duration_text(service_.patience));
      return leaves;
    });
  }

  // Not sealed, also with a key: whether it has the key is not waited for.
  void turn_away(FrameStream& other, const FrameStream& runner) const {
    service_.note(other.who() + " was turned away: the vehicle is with " + runner.who());
    const std::string why = "it is with " + runner.who();
    try {
      other.put(FrameKind::busy, std::as_bytes(std::span(why)));
      other.flush();
    } catch (const FrameError&) {
      // it has gone by itself
    }
  }

  const Descriptor& door_;
  const LockstepService& service_;
  const Interrupter& interrupter_;
  std::vector<Caller> callers_;  // as they came
};

// A vehicle with its runner, until that one has gone.
class Served {
 public:
  Served(FrameStream& stream, const LockstepService& service)
      : stream_(stream), service_(service), putter_(service.set, stream), taker_(service.set) {}
  ~Served() {
    std::optional<vehicles::Mishap> mishap;
    with_vehicle([&] { mishap = vehicle_ ? vehicle_->mishap() : std::nullopt; });
    if (mishap) service_.mishap(*mishap, stream_.who());
  }
  Served(const Served&) = delete;
  Served& operator=(const Served&) = delete;

  void begin(const FrameStream::Frame& frame) {
    if (frame.kind != FrameKind::begin) throw_unfit(stream_);
    vehicle_ = service_.make(number(frame, 0));
  }

  /// The next frame. Throws FrameEnd when the runner has gone.
  void read_and_obey() {
    try {
      obey(stream_.read());
    } catch (const FrameEnd&) {
      require_works();
      throw;
    }
  }

 private:
  void obey(const FrameStream::Frame& frame) {
    if (++frames_ > max_frames)
      throw FrameError(stream_.who() + " has sent " + std::to_string(max_frames) +
                       " frames without a look at the sensors");
    switch (frame.kind) {
      case FrameKind::message: return accept(taker_.message(frame));
      case FrameKind::step: return step();
      case FrameKind::sense: return sense();
      default: throw_unfit(stream_);
    }
  }

  void accept(messages::MessageRef command) {
    with_vehicle([&] { vehicle_->accept(command); });
  }

  void step() {
    ++steps_;
    if (no_state_) return;
    try {
      with_vehicle([&] { vehicle_->step(); });
    } catch (const vehicles::NoState& error) { no_state_ = error.what(); }
  }

  void sense() {
    frames_ = 0;
    std::optional<vehicles::Mishap> mishap;
    if (!no_state_)
      with_vehicle([&] {
        vehicle_->sense(putter_);
        mishap = vehicle_->mishap();
      });
    if (no_state_)
      stream_.put(FrameKind::no_state, std::as_bytes(std::span(*no_state_)));
    else
      stream_.put(FrameKind::sensed, end_of_answer(steps_, mishap));
    stream_.flush();
    require_works();
  }

  // What else a plugin's vehicle throws than NoState is not this program's; the runner reads it where it looks at the
  // sensors.
  template <class Work>
  void with_vehicle(const Work& work) {
    if (failed_) return;
    try {
      work();
    } catch (const FrameError&) { throw; } catch (const vehicles::NoState&) {
      throw;
    } catch (const std::exception& error) { fail(error.what()); } catch (...) {
      fail("it throws what is no std::exception");
    }
  }
  void fail(const std::string& text) {
    failed_ = true;
    no_state_ = "vehicle '" + service_.name + "': " + text;
  }
  void require_works() const {
    if (failed_) throw Unfinished(*no_state_);
  }

  FrameStream& stream_;
  const LockstepService& service_;
  Putter putter_;
  Taker taker_;
  std::unique_ptr<vehicles::Vehicle> vehicle_;
  std::optional<std::string> no_state_;  // why it can't be stepped any more
  bool failed_ = false;                  // that is what it threw
  std::uint64_t steps_ = 0;              // since the start
  int frames_ = 0;                       // since the last look at the sensors
};

// One that was greeted; `callers` may be null.
void serve(FrameStream& stream, const LockstepService& service, const Interrupter& interrupter, int door,
           Callers* callers) {
  if (service.key) {
    stream.await_seal();
    welcome(stream, service);
  }
  Served served(stream, service);
  served.begin(stream.read());
  stream.set_patience(service.patience);
  if (callers != nullptr) callers->turn_away_all(stream);
  for (auto heard = Clock::now();;) {
    const auto ready = stream.wait(interrupter, door, std::chrono::milliseconds(-1));
    if (ready.interrupted) return;
    if (ready.one) {
      served.read_and_obey();
      heard = Clock::now();
      continue;
    }
    if (!ready.other) continue;
    if (Clock::now() - heard >= service.patience)
      throw FrameError(stream.who() + " has been silent for " + duration_text(service.patience) +
                       " and makes room for another");
    callers->turn_away_newest(stream);
  }
}

}  // namespace

void serve_runner(FrameStream stream, const LockstepService& service, const Interrupter& interrupter) {
  greet(stream, service);
  serve(stream, service, interrupter, -1, nullptr);
}

void serve_lockstep(const Descriptor& door, const LockstepService& service, const Interrupter& interrupter) {
  Callers callers(door, service, interrupter);
  while (std::optional<FrameStream> runner = callers.next()) {
    try {
      serve(*runner, service, interrupter, door.get(), &callers);
    } catch (const FrameEnd&) {
      // the run is over
    } catch (const FrameError& error) { service.note(error.what()); }
  }
}

}  // namespace jarol::distributers
