#include "distributers/session/guard.h"

#include <stdexcept>

#include "distributers/distributers.h"
#include "distributers/links/linked.h"

namespace jarol {
namespace {

struct Guarded {
  std::size_t distributer = 0;
  distributers::Link* link = nullptr;
};

std::vector<Guarded> find_guarded(const Loaded& loaded, std::vector<std::string>& safe,
                                  std::vector<std::string>& unreached) {
  std::vector<Guarded> guarded;
  for (std::size_t i = 0; i < loaded.systems.size(); ++i) {
    auto* const linked = dynamic_cast<distributers::LinkedSystem*>(loaded.systems[i].get());
    if (linked == nullptr) continue;
    std::vector<std::string> names;
    for (const Communicator& c : loaded.graph->communicators)
      if (c.distributer == i && c.safe) names.push_back(c.name);
    if (names.empty()) continue;
    if (const auto& transport = linked->link().transport(); !transport.can_be_held()) {
      unreached.push_back(transport.text());
      continue;
    }
    safe.insert(safe.end(), names.begin(), names.end());
    guarded.push_back({i, &linked->link()});
  }
  return guarded;
}

}  // namespace

Guard::Guard(const Loaded& loaded, const std::string& unwanted, std::optional<int> priority, const NoteSink& note)
    : missing_(unwanted) {
  const std::vector<Guarded> guarded = find_guarded(loaded, safe_, unreached_);
  if (!unwanted.empty()) return;
  for (const std::string& link : unreached_)
    note("the guardian has no way over " + link + ", and a crash leaves the last commands in force there");
  if (guarded.empty()) return;
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
    note("there is no guardian, and a crash leaves the last commands in force: " + missing_);
  }
}

void Guard::arm() const {
  if (guardian_) guardian_->arm();
}

void Guard::look(const NoteSink& note) {
  if (reported_ || !guardian_ || !guardian_->is_gone()) return;
  reported_ = true;
  note("the guardian is gone; the run goes on, and from now on a crash leaves the last commands in force");
}

void Guard::close() {
  if (guardian_ && !guardian_->close()) missing_ = "it was gone before the run ended";
}

std::string guardian_refused() {
  try {
    distributers::Guardian guardian;
    guardian.await_ready();
    return guardian.close() ? "" : "it does not end";
  } catch (const std::runtime_error& error) { return error.what(); }
}

}  // namespace jarol
