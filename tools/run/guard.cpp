#include "tools/run/guard.h"

#include <iostream>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "distributers/distributers.h"
#include "distributers/links/linked.h"

namespace jarol::tools {
namespace {

struct Guarded {
  std::size_t distributer = 0;
  distributers::Link* link = nullptr;
};

std::vector<Guarded> find_guarded(const Loaded& loaded, std::vector<std::string>& safe) {
  std::vector<Guarded> guarded;
  for (std::size_t i = 0; i < loaded.channels.size(); ++i) {
    auto* const linked = dynamic_cast<distributers::LinkedChannels*>(loaded.channels[i].get());
    if (linked == nullptr) continue;
    const std::size_t before = safe.size();
    for (const Communicator& c : loaded.graph->communicators)
      if (c.distributer == i && c.safe) safe.push_back(c.name);
    if (safe.size() > before) guarded.push_back({i, &linked->link()});
  }
  return guarded;
}

}  // namespace

Guard::Guard(const Loaded& loaded, bool wanted, std::optional<int> priority) {
  const std::vector<Guarded> guarded = find_guarded(loaded, safe_);
  if (!wanted) missing_ = "--no-guardian";
  if (guarded.empty() || !wanted) return;
  try {
    auto guardian = std::make_unique<distributers::Guardian>();
    std::vector<distributers::Holder*> holders;
    for (const auto& [distributer, link] : guarded) {
      const auto key = link->guardian_key();
      holders.push_back(guardian->add(link->set(), link->transport().text(),
                                      distributers::safe_packets(*loaded.graph, distributer, *link),
                                      key ? &*key : nullptr));
    }
    guardian->await_ready(priority);
    for (std::size_t i = 0; i < guarded.size(); ++i) guarded[i].link->hold_by(holders[i]);
    guardian_ = std::move(guardian);
  } catch (const std::runtime_error& error) {
    missing_ = error.what();
    std::cerr << "note: there is no guardian, and a crash leaves the last commands in force: " << missing_ << "\n";
  }
}

void Guard::arm() const {
  if (guardian_) guardian_->arm();
}

void Guard::close() {
  if (guardian_ && !guardian_->close()) missing_ = "it was gone before the run ended";
}

std::string Guard::to_text() const {
  if (safe_.empty()) return "";
  std::string names;
  for (const std::string& name : safe_) names += (names.empty() ? "" : ", ") + name;
  return "  guardian    " + (missing_.empty() ? "was ready with safe of " + names : "none: " + missing_) + "\n";
}

nlohmann::ordered_json Guard::to_json() const {
  if (safe_.empty()) return nullptr;
  nlohmann::ordered_json json{{"ready", missing_.empty()}, {"safe", safe_}};
  if (!missing_.empty()) json["missing"] = missing_;
  return json;
}

std::string guardian_refused() {
  try {
    distributers::Guardian guardian;
    guardian.await_ready();
    return guardian.close() ? "" : "it does not end";
  } catch (const std::runtime_error& error) { return error.what(); }
}

}  // namespace jarol::tools
