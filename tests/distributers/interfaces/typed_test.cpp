#include "distributers/interfaces/typed.h"

#include <doctest/doctest.h>

#include "distributers/messages/javiator.h"
#include "graph/values/value.h"

namespace {
using namespace jarol;
using namespace jarol::distributers;
namespace javiator = messages::javiator;

struct SondeParam {
  double scale = 2;
  static constexpr auto fields() { return describe(field<&SondeParam::scale>("", "factor of the signals")); }
};

// With each of what a distributer may have.
class Sonde {
 public:
  static constexpr std::string_view summary = "a probe";
  static constexpr bool is_vehicle = true;
  using Param = SondeParam;
  struct In {
    Newest<double> front;
    Newest<double> rear;
    Computed<std::int64_t> count;
    static constexpr auto fields() {
      return describe(channel<&In::front>("signal in front"), channel<&In::rear>("signal behind"),
                      channel<&In::count>("messages so far"));
    }
  };
  struct Out {
    double limit = 0;
    bool lit = false;
    static constexpr auto fields() {
      return describe(channel<&Out::limit>("signal of idle"), channel<&Out::lit>("whether it shines"));
    }
  };
  static const messages::MessageSet& message_set() { return javiator::message_set(); }
  static constexpr auto handlers() {
    return handle(send<&Out::lit>(&Sonde::shine), on<javiator::MotorSignals>(&Sonde::motors),
                  on<javiator::JaviatorData>(&Sonde::data), compute<&In::count>(&Sonde::count),
                  send<&Out::limit>(&Sonde::idle));
  }
  explicit Sonde(const Param& param) : scale_(param.scale) {
    if (scale_ == 0) throw std::invalid_argument("a scale of 0 shows nothing");
  }

  void any_message(const messages::MessageRef&) { ++count_; }
  In in;
  int answers = 0;

 private:
  void motors(const javiator::MotorSignals& m) {
    if (m.front >= 0) in.front = scale_ * m.front;
    if (m.rear >= 0) in.rear.renew() = scale_ * m.rear;
  }
  void data(const javiator::JaviatorData&) { ++answers; }
  std::int64_t count() { return count_; }
  void idle(double limit, messages::Receiver& system) {
    system.receive(messages::refer_to(javiator::IdleLimit{static_cast<std::int16_t>(limit)}));
  }
  void shine(bool lit, messages::Receiver& system) {
    if (lit) system.receive(messages::refer_to(javiator::SwitchState{}));
  }

  double scale_;
  std::int64_t count_ = 0;
};

// With nothing beside its channels that come in.
class Ear {
 public:
  [[maybe_unused]] static constexpr std::string_view summary = "hears";
  [[maybe_unused]] static constexpr bool is_vehicle = true;
  struct In {
    Newest<double> front;
    static constexpr auto fields() { return describe(channel<&In::front>("signal in front")); }
  };
  static const messages::MessageSet& message_set() { return javiator::message_set(); }
  static constexpr auto handlers() { return handle(on<javiator::MotorSignals>(&Ear::motors)); }
  void motors(const javiator::MotorSignals& m) { in.front = m.front; }
  In in;
};

// That of no vehicle.
class Operator : public Ear {
 public:
  [[maybe_unused]] static constexpr bool is_vehicle = false;
  static constexpr auto handlers() { return handle(on<javiator::MotorSignals>(&Operator::motors)); }
};

// And with more, which it says.
class Counting : public Ear {
 public:
  static constexpr auto handlers() { return handle(on<javiator::MotorSignals>(&Counting::count)); }
  void count(const javiator::MotorSignals&) { in.front = ++count_; }
  void serialize(Archive& archive) { archive(count_); }

 private:
  int count_ = 0;
};

template <class D>
Archive::Bytes saved(Typed<D>& distributer) {
  Archive::Bytes bytes;
  Archive archive = Archive::to(bytes);
  distributer.serialize(archive);
  return bytes;
}

template <class D>
void restore(Typed<D>& distributer, const Archive::Bytes& bytes) {
  Archive archive = Archive::from(bytes);
  distributer.serialize(archive);
  archive.require_end();
}

using In = Sonde::In;
using Out = Sonde::Out;

struct Sent : messages::Receiver {
  void receive(messages::MessageRef message) override { names += std::string(message.descriptor->name) + " "; }
  std::string names;
};

javiator::MotorSignals signals(std::int16_t front, std::int16_t rear) {
  javiator::MotorSignals m;
  m.front = front;
  m.rear = rear;
  return m;
}
}  // namespace

TEST_SUITE("distributers/interfaces/typed") {
  TEST_CASE("channels are described in their order, those that come in before those that go out") {
    const DistributerClass described = distributer_class<Sonde>();
    CHECK(described.name == "Sonde");
    CHECK(described.summary == "a probe");
    CHECK(described.is_vehicle);
    CHECK(described.parameters == &type_of<SondeParam>());
    std::string text;
    for (const ChannelClass& c : described.channels)
      text += c.name + (c.direction == Direction::in ? " in " : " out ") + c.type->name + ": " + c.text + "; ";
    CHECK(text ==
          "front in double: signal in front; rear in double: signal behind; count in int64: messages so far; "
          "limit out double: signal of idle; lit out bool: whether it shines; ");
  }

  TEST_CASE("what was written since it was taken is new, each channel by itself, the same value too") {
    Typed<Sonde> sonde;
    double value = -1;
    CHECK_FALSE(sonde.take<&In::front>(value));
    CHECK(value == -1);
    sonde.receive(signals(3, -1));
    CHECK(sonde.take<&In::front>(value));
    CHECK(value == 6);
    CHECK_FALSE(sonde.take<&In::front>(value));
    CHECK_FALSE(sonde.take<&In::rear>(value));
    sonde.receive(signals(3, 4));
    CHECK(sonde.take<&In::front>(value));
    CHECK(sonde.take<&In::rear>(value));
    CHECK(value == 8);
  }

  TEST_CASE("what is computed is there whenever it is taken") {
    Typed<Sonde> sonde;
    std::int64_t count = -1;
    for (const std::int64_t wanted : {0, 0}) {
      CHECK(sonde.take<&In::count>(count));
      CHECK(count == wanted);
    }
    sonde.receive(signals(-1, -1));
    sonde.receive(javiator::StoreTrim{});  // without a handler, and counted
    CHECK(sonde.take<&In::count>(count));
    CHECK(count == 2);
  }

  TEST_CASE("of messages that share an id each has its own handler, or none") {
    static_assert(javiator::JaviatorData::message_id == javiator::JaviatorDataShort::message_id);
    Typed<Sonde> sonde;
    sonde.receive(javiator::JaviatorDataShort{});
    CHECK(sonde->answers == 0);
    sonde.receive(javiator::JaviatorData{});
    CHECK(sonde->answers == 1);
  }

  TEST_CASE("a vehicle is heard by messages that its distributer handles, any other system by whatever it sends") {
    Typed<Ear> vehicle;
    vehicle.receive(javiator::SwitchState{});
    CHECK(vehicle.used() == 0);
    vehicle.receive(javiator::MotorSignals{});
    CHECK(vehicle.used() == 1);
    Typed<Operator> hand;
    hand.receive(javiator::SwitchState{});
    hand.receive(javiator::MotorSignals{});
    CHECK(hand.used() == 2);
  }

  TEST_CASE("a channel's number is its place in the description, and values go to its handler") {
    const DistributerClass described = distributer_class<Sonde>();
    const Value parameters(*described.parameters);
    const auto made = described.make(parameters.data());
    made->receive(messages::refer_to(signals(1, 2)));
    double rear = 0, limit = 100;
    CHECK(made->take(1, &rear));
    CHECK(rear == 4);
    const bool lit = true;
    Sent sent;
    made->hand_over(4, &lit, sent);
    made->hand_over(3, &limit, sent);
    CHECK(sent.names == "SWITCH_STATE IDLE_LIMIT ");
    CHECK(made->non_finite_inputs() == 0);
  }

  TEST_CASE("a distributer that can't be made of its parameters says why") {
    const SondeParam none{0};
    CHECK_THROWS_WITH_AS(distributer_class<Sonde>().make(&none), "a scale of 0 shows nothing", std::invalid_argument);
  }

  TEST_CASE("channels that come in are saved with whether they are new, and what else a distributer says") {
    Typed<Ear> ear, other;
    ear.receive(signals(3, 0));
    restore(other, saved(ear));
    double value = 0;
    CHECK(other.take<&Ear::In::front>(value));
    CHECK(value == 3);
    restore(ear, saved(other));
    CHECK_FALSE(ear.take<&Ear::In::front>(value));
    Typed<Counting> counting, next;
    counting.receive(signals(3, 0));
    restore(next, saved(counting));
    next.receive(signals(3, 0));
    CHECK(next.take<&Ear::In::front>(value));
    CHECK(value == 2);
  }

  TEST_CASE("a distributer that has members of its own and does not say so can't be saved") {
    Typed<Sonde> sonde;
    CHECK_THROWS_WITH_AS(saved(sonde), "Sonde has members of its own, and no serialize(Archive&)", NotSaveable);
  }
}
