// The guardian of a program that steers something: a small process that holds its links' ways to their peers and the
// packets that bring what is there to rest. It sends them when the program is gone without having closed, whatever
// ended it, as a crash or `kill -9`.
#pragma once

#include <sys/types.h>

#include <cstddef>
#include <deque>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "distributers/links/descriptor.h"
#include "distributers/links/holder.h"
#include "distributers/links/seal.h"
#include "distributers/messages/message_set.h"

namespace jarol::distributers {

/// The name of the process, and what it is called as.
inline constexpr const char* guardian_name = "jarol-guardian";

/// The program's side of it.
class Guardian {
 public:
  /// Begins the process: `program` again, called as `guardian_name`, of which main makes run_guardian. Throws
  /// Unfinished with the reason.
  explicit Guardian(const std::string& program = "/proc/self/exe");
  /// Without `close` the program is taken for crashed, if it was armed.
  ~Guardian();
  Guardian(const Guardian&) = delete;
  Guardian& operator=(const Guardian&) = delete;

  /// Before `await_ready`: a link of that set, as people read it, and what brings its system to rest, in this order.
  /// Who learns of its way to the peer; lives as long as the guardian. `key`: packets go out sealed, or null.
  Holder* add(const messages::MessageSet& set, const std::string& text, std::span<const std::vector<std::byte>> packets,
              const GuardianKey* key = nullptr);
  /// Waits until all of this is there. The guardian takes that priority of SCHED_FIFO, if it may. Throws
  /// Unfinished if it is not to be had.
  void await_ready(std::optional<int> priority = {});

  /// It has ended, though it should not have.
  bool is_gone() const;

  /// From now on the program's end is a crash.
  void arm() const;
  /// In good order: nothing is sent. Waits for the end of the process, a second at most. False: it had been gone
  /// before; a second call does nothing.
  bool close();
  /// A crash is under way: it need not wait for the end of this process. For a signal handler.
  void wake() const;

 private:
  class LinkHolder : public Holder {
   public:
    LinkHolder(const Guardian& guardian, std::uint32_t link) : guardian_(guardian), link_(link) {}
    void hold(int fd, const std::vector<Address>& peers) override;
    void let_go() override;
    bool set_steers_itself(bool steers_itself) override;

   private:
    const Guardian& guardian_;
    std::uint32_t link_;
  };

  bool end();

  Descriptor socket_;
  pid_t process_ = -1;
  bool said_all_ = true;  // nothing was refused so far
  std::deque<LinkHolder> holders_;
};

}  // namespace jarol::distributers
