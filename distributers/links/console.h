// The link to an operator at a console of this process: messages come from the console's thread by a Jarol port, and
// reach the distributer at the next instant, as from any other operator; its answers go back by another one.
#pragma once

#include <atomic>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "distributers/interfaces/any_distributer.h"
#include "distributers/messages/packet.h"
#include "runtime/external_system.h"
#include "runtime/jarol/port.h"

namespace jarol::distributers {

struct LinkType;

/// The link type `console`.
LinkType console_link();

/// The way from the console to the distributer and back, which either may outlive.
class ConsolePort {
 public:
  explicit ConsolePort(const messages::MessageSet& set);

  const messages::MessageSet& message_set() const { return set_; }

  /// By the console's thread: the distributer gets the message at the next instant. False: it can't be sent, and `why`
  /// says why not.
  bool send(messages::MessageRef message, std::string& why);
  /// By the console's thread: who sent what the run has not received yet is gone, so that it is left out, but for
  /// emergencies.
  void leave_out_waiting() { left_out_before_.store(given(), std::memory_order_release); }
  /// By the run: all that was sent.
  void receive(messages::Receiver& receiver);

  /// Whoever sends these wants an end, whatever he sees and wherever he is by then.
  static bool is_for_emergencies(std::string_view message) { return message == "Abort" || message == "SHUT_DOWN"; }

  /// By the run: what the distributer says to the operator. What finds no room is lost and counted; nobody waits.
  void answer(messages::MessageRef message);
  /// By the console's thread: all that was answered.
  void receive_answers(messages::Receiver& receiver);

  std::uint64_t given() const { return given_.load(std::memory_order_relaxed); }
  std::uint64_t left_out() const { return left_out_.load(std::memory_order_relaxed); }
  std::uint64_t refused() const { return refused_.load(std::memory_order_relaxed); }
  std::uint64_t answered() const { return answered_.load(std::memory_order_relaxed); }
  std::uint64_t lost() const { return lost_.load(std::memory_order_relaxed); }

  static constexpr std::size_t max_packets = 64;  // on their way, each way

 private:
  const messages::MessageSet& set_;
  const messages::Message header_;
  PacketPort port_, answers_;
  std::atomic<std::uint64_t> given_{0}, refused_{0}, left_out_{0}, answered_{0}, lost_{0};
  std::atomic<std::uint64_t> left_out_before_{0};  // the message of that number, counted from 0
  struct Reading {
    std::vector<std::byte> room;
    messages::PacketReader reader;
  };
  template <class Take>
  static void read_all(PacketPort& port, Reading& reading, Take take);
  // of the console's thread
  std::vector<std::byte> packet_;
  Reading answers_read_;
  // of the run
  std::vector<std::byte> answer_packet_;
  Reading read_;
  std::uint64_t taken_ = 0;  // from the port
};

class ConsoleSystem : public ExternalSystem {
 public:
  explicit ConsoleSystem(std::unique_ptr<AnyDistributer> distributer);

  const std::shared_ptr<ConsolePort>& port() const { return port_; }

  void finish() override { distributer_->finish(); }
  std::optional<LinkReport> link_report() const override;
  std::uint64_t non_finite_inputs() const override { return distributer_->non_finite_inputs(); }
  void ending() override { distributer_->ending(); }
  bool overrides_end() const override { return distributer_->overrides_end(); }
  void reach(Duration instant) override;
  bool take(std::size_t channel, void* value) override { return distributer_->take(channel, value); }
  void hand_over(std::size_t channel, const void* value) override { distributer_->hand_over(channel, value, unread_); }

 private:
  struct Answers : messages::Receiver {
    explicit Answers(ConsolePort& to) : port(to) {}
    void receive(messages::MessageRef message) override { port.answer(message); }
    ConsolePort& port;
  };
  // Pages see what the graph publishes; what is made of it in the operator's messages says the same.
  struct Unread : messages::Receiver {
    void receive(messages::MessageRef) override {}
  };

  std::unique_ptr<AnyDistributer> distributer_;
  std::shared_ptr<ConsolePort> port_;
  Answers answers_{*port_};
  Unread unread_;
};

}  // namespace jarol::distributers
