// An external system on a link: a distributer speaks with a peer in another process or device, in real time.
#pragma once

#include <memory>

#include "distributers/interfaces/any_distributer.h"
#include "distributers/links/link.h"

namespace jarol::distributers {

class LinkedSystem : public ExternalSystem {
 public:
  LinkedSystem(std::unique_ptr<Link> link, std::unique_ptr<AnyDistributer> distributer);

  Link& link() { return *link_; }
  const Link& link() const { return *link_; }

  void begin() override;
  void finish() override;
  bool needs_real_clock() const override { return true; }
  bool sends() const override { return link_->sends(); }
  std::uint64_t unsent() const override { return link_->unsent(); }
  bool has_sent() const override { return link_->has_sent(); }
  std::string doubt() const override { return link_->transport().doubt(); }
  std::optional<LinkReport> link_report() const override;
  /// Packets that came, so far, and are of use to the distributer; any thread.
  std::uint64_t heard() const;
  std::uint64_t non_finite_inputs() const override { return distributer_->non_finite_inputs(); }
  void ending() override { distributer_->ending(); }
  bool overrides_end() const override { return distributer_->overrides_end(); }

  void reach(Duration instant) override;
  bool take(std::size_t channel, void* value) override { return distributer_->take(channel, value); }
  void hand_over(std::size_t channel, const void* value) override;

 private:
  // What the distributer sends goes to a link.
  struct ToLink : messages::Receiver {
    explicit ToLink(Link& to) : link(to) {}
    void receive(messages::MessageRef message) override { link.send(message); }
    Link& link;
  };

  // Or to all who may look for this system.
  struct ToAll : messages::Receiver {
    explicit ToAll(Link& by) : link(by) {}
    void receive(messages::MessageRef message) override { link.announce(message); }
    Link& link;
  };

  // What the peer sends goes to the distributer, which learns of a new peer before.
  struct FromPeer : messages::Receiver {
    FromPeer(const Link& from, AnyDistributer& to) : link(from), distributer(to) {}
    void receive(messages::MessageRef message) override;
    const Link& link;
    AnyDistributer& distributer;
    std::uint32_t peer = 0;
  };

  void report_steering();

  std::unique_ptr<Link> link_;
  std::unique_ptr<AnyDistributer> distributer_;
  bool steers_itself_ = false;  // what is at the other end, as the guardian knows
  FromPeer from_peer_;
  ToLink to_link_;
  ToAll to_all_;
};

}  // namespace jarol::distributers
