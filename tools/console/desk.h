// Who steers at the pages of a console: of each operator one page at a time commands, and no longer than it is heard.
// What it sends are messages of the operator's message set.
#pragma once

#include <chrono>
#include <cstdint>
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "distributers/links/console.h"

namespace jarol::tools::console {

/// An operator whose link is the console, and its distributer's way to it.
struct DeskOperator {
  std::string name;  // of the distributer
  std::string type;
  std::shared_ptr<distributers::ConsolePort> port{};
};

/// On one thread, that of the server.
class Desk {
 public:
  using Clock = std::chrono::steady_clock;

  explicit Desk(std::vector<DeskOperator> operators);

  bool empty() const { return seats_.empty(); }
  /// As the first message names them.
  nlohmann::ordered_json describe() const;

  /// What page number so-and-so asks for: {"do": "take" | "alive" | "send" | "release", "desk": NAME, ...}. Throws
  /// InputError, of which the page is shown the text. `behind`: so old is what the page shows.
  void obey(std::uint64_t page, const nlohmann::json& message, Clock::time_point now, Duration behind = {});
  /// The first desk that another page commands; empty: there is none.
  std::string commanded_by_others(std::uint64_t page) const;
  /// The page is gone.
  void leave(std::uint64_t page);
  /// Who commands, if that has changed since the last call, and again after `repeat`, for pages that missed it; else
  /// null. A commander that has fallen silent no longer does.
  nlohmann::ordered_json news(Clock::time_point now);

  /// What the operators' distributers have said since the last call, as in {"neptus": [{"message": "PlanControl",
  /// "fields": {...}}]}; null: nothing.
  nlohmann::ordered_json answers();

  /// So long a page that is silent still commands.
  static constexpr std::chrono::milliseconds patience{1000};
  /// Who looks at what is older than that does not command, as who is silent does not.
  static constexpr std::chrono::milliseconds max_behind{3000};
  /// So often it is said who commands where that does not change.
  static constexpr std::chrono::milliseconds repeat{2000};
  /// A stick within that part of its way is centred.
  static constexpr double centred = 0.05;

 private:
  struct Seat {
    DeskOperator of;
    std::optional<std::uint64_t> page{};  // that commands
    std::string as{};                     // what it calls itself
    std::uint64_t sequence = 0;           // of the newest message
    Clock::time_point heard{};
    Duration behind{};  // of what came since, which does not count
    std::string why{};  // nobody commands any more
  };
  Seat& find(const nlohmann::json& message);
  void take(Seat& seat, std::uint64_t page, const nlohmann::json& message);
  void send(Seat& seat, const nlohmann::json& message);
  void leave_out(Seat& seat, const nlohmann::json& message, Duration behind);
  void free(Seat& seat, const std::string& why);

  std::vector<Seat> seats_;
  bool changed_ = false;
  Clock::time_point reported_{};  // who commands, to all pages
};

}  // namespace jarol::tools::console
