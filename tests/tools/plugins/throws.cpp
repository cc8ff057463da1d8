// A link type and a policy that throw where they are asked for what they do.
#include <memory>
#include <stdexcept>
#include <string>

#include "distributers/links/plugin_link.h"
#include "graph/plugins/plugin_policy.h"
#include "graph/text/errors.h"

namespace {
namespace links = jarol::distributers;

class Mute : public links::Transport {
 public:
  explicit Mute(std::string fault) : fault_(std::move(fault)) {}
  std::string text() const override { return "mute"; }
  std::vector<links::Address> announces_to() const override {
    if (fault_ == "address") throw jarol::InputError("nobody knows where to announce it");
    return {};
  }
  void open() override {}
  void close() override {}
  void receive(const links::Interrupter&, links::ByteSink&) override {}
  bool send(std::span<const std::byte>) override { return true; }

 private:
  const std::string fault_;
};

struct ThrowingSpec : links::PacketLinkSpec {
  jarol::Maybe<std::string> fault;
};

struct ThrowingLink {
  static links::LinkType link_type() {
    return links::packet_link<ThrowingSpec>(
        "throwing", "to nobody", {},
        {jarol::key<&ThrowingSpec::fault>("fault", jarol::Form::word, "what it throws", true)},
        [](const ThrowingSpec& spec, const jarol::Yaml&, const std::string&,
           jarol::Problems&) -> std::unique_ptr<links::Transport> {
          if (spec.fault->value == "text") throw std::runtime_error("there is no modem");
          if (spec.fault->value == "number") throw 7;
          if (spec.fault->value == "unfinished") throw jarol::Unfinished("the modem has no power");
          return std::make_unique<Mute>(spec.fault->value);
        });
  }
};

// As a link of channels of another sort.
struct ThrowingChannels {
  struct Spec {};
  static links::LinkType link_type() {
    links::LinkType type = links::link_type<Spec>(
        "throwing_channels", "to nobody", {},
        [](const Spec&, const links::LinkRequest&, jarol::Problems&) -> std::unique_ptr<jarol::ExternalSystem> {
          throw std::out_of_range("there are no channels");
        });
    return type;
  }
};

struct ThrowingPolicy {
  static constexpr std::string_view name = "throwing";
  static constexpr std::string_view how = "none runs";
  static constexpr jarol::Urgency urgency = jarol::Urgency::turn;
  static constexpr bool interrupts = false;
  static jarol::analysis::Result check(const jarol::analysis::System& system, bool, jarol::analysis::Budget&) {
    if (system.models.size() > 1) throw 3;
    throw std::length_error("there is no table for so few");
  }
};
}  // namespace

JAROL_PLUGIN(ThrowingLink, ThrowingChannels, ThrowingPolicy)
