// A link that fails as its key says, and displays that block, as those of plugins may.
#include <chrono>
#include <memory>
#include <stdexcept>
#include <string>
#include <thread>

#include "distributers/interfaces/plugin_distributer.h"
#include "distributers/links/plugin_link.h"
#include "distributers/messages/javiator.h"

namespace {
namespace links = jarol::distributers;
using jarol::describe;
using jarol::messages::javiator::IdleLimit;

void block() {
  for (;;) std::this_thread::sleep_for(std::chrono::seconds(1));
}

class FaultyTransport : public links::Transport {
 public:
  explicit FaultyTransport(std::string fault) : fault_(std::move(fault)) {}

  std::string text() const override { return "faulty"; }
  void open() override {}
  void close() override {}
  void receive(const links::Interrupter& interrupter, links::ByteSink&) override {
    const auto woken = interrupter.wait(-1, std::chrono::milliseconds(fault_ == "receive_throws" ? 200 : -1));
    if (woken == links::Interrupter::Woken::timed_out) throw std::runtime_error("the modem has reset itself");
  }
  bool send(std::span<const std::byte>) override {
    if (fault_ == "send_never" || (fault_ == "send_fails" && sent_ >= 10)) {
      ++counts.unsent;
      return false;
    }
    if (++sent_ < 10) return true;
    if (fault_ == "send_throws") throw std::runtime_error("no carrier");
    if (fault_ == "send_throws_int") throw 7;
    if (fault_ == "send_blocks") block();
    return true;
  }

 private:
  const std::string fault_;
  int sent_ = 0;
};

struct FaultySpec : links::PacketLinkSpec {
  jarol::Maybe<std::string> fault;
};

struct Faulty {
  static links::LinkType link_type() {
    return links::packet_link<FaultySpec>(
        "faulty", "to nobody", {},
        {jarol::key<&FaultySpec::fault>("fault", jarol::Form::word, "what it does in place of its work", true)},
        [](const FaultySpec& spec, const jarol::Yaml&, const std::string&, jarol::Problems&)
            -> std::unique_ptr<links::Transport> { return std::make_unique<FaultyTransport>(spec.fault->value); });
  }
};

struct Display {
  static constexpr bool is_vehicle = false;
  struct In {
    links::Newest<double> pressed;
    static constexpr auto fields() { return describe(links::channel<&In::pressed>("button")); }
  };
  struct Out {
    double level = 0;
    static constexpr auto fields() { return describe(links::channel<&Out::level>("shown")); }
  };
  static const jarol::messages::MessageSet& message_set() { return jarol::messages::javiator::message_set(); }
  In in;

  void press(const IdleLimit& message) { in.pressed = static_cast<double>(message.idle); }
  static void send(const double& level, jarol::messages::Receiver& display) {
    IdleLimit message;
    message.idle = static_cast<decltype(message.idle)>(level);
    display.receive(jarol::messages::refer_to(message));
  }
};

struct GoodDisplay : Display {
  static constexpr std::string_view summary = "shows";
  static constexpr auto handlers() {
    return links::handle(links::on<IdleLimit>(&GoodDisplay::press), links::send<&Out::level>(&GoodDisplay::show));
  }
  void press(const IdleLimit& message) { Display::press(message); }
  void show(const double& level, jarol::messages::Receiver& display) { send(level, display); }
};

struct BlockingDisplay : Display {
  static constexpr std::string_view summary = "shows twenty levels";
  static constexpr auto handlers() {
    return links::handle(links::on<IdleLimit>(&BlockingDisplay::press),
                         links::send<&Out::level>(&BlockingDisplay::show));
  }
  void press(const IdleLimit& message) { Display::press(message); }
  void show(const double& level, jarol::messages::Receiver& display) {
    if (++shown > 20) block();
    send(level, display);
  }
  int shown = 0;
};

struct EndlessDisplay : Display {
  static constexpr std::string_view summary = "does not finish";
  static constexpr auto handlers() {
    return links::handle(links::on<IdleLimit>(&EndlessDisplay::press), links::send<&Out::level>(&EndlessDisplay::show));
  }
  void press(const IdleLimit& message) { Display::press(message); }
  void show(const double& level, jarol::messages::Receiver& display) { send(level, display); }
  void finish() { block(); }
};
}  // namespace

JAROL_PLUGIN(GoodDisplay, BlockingDisplay, EndlessDisplay, Faulty)
