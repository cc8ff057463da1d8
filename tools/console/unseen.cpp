#include "tools/console/unseen.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "graph/text/errors.h"
#include "tools/console/page_message.h"

namespace jarol::tools::console {

std::optional<std::uint64_t> read_seen(const std::string& message) {
  constexpr std::size_t longest = 100;
  if (message.size() > longest) return std::nullopt;
  const auto json = parse_json(message);
  if (!json.is_object() || json.value("do", nlohmann::json()) != "seen") return std::nullopt;
  const auto messages = json.value("messages", nlohmann::json());
  if (!messages.is_number_unsigned())
    throw InputError("expected a whole number as in {\"do\": \"seen\", \"messages\": 12}");
  return messages.get<std::uint64_t>();
}

void Unseen::send(Time of, Time now) {
  if (!said_ && all_.size() == max_kept) {
    all_.pop_front();
    ++gone_;
  }
  all_.push_back({of, now});
}

void Unseen::see(std::uint64_t messages) {
  const std::uint64_t sent = gone_ + all_.size();
  if (messages > sent || messages < said_.value_or(0))
    throw InputError(
        fmt::format("'messages' of seen is {}, of {} that were sent and {} seen", messages, sent, said_.value_or(0)));
  said_ = messages;
  for (; gone_ < messages; ++gone_) all_.pop_front();
}

Duration Unseen::behind(Time now, const Time* next) const {
  if (!said_) return {};
  if (!all_.empty()) return now - all_.front().of;
  return next == nullptr ? Duration{} : now - *next;
}

}  // namespace jarol::tools::console
