#include "distributers/session/linked.h"

#include <stdexcept>
#include <utility>

namespace jarol {

std::vector<ExternalSystem*> pointers_to(const std::vector<std::unique_ptr<ExternalSystem>>& all) {
  std::vector<ExternalSystem*> pointers;
  for (const auto& channels : all) pointers.push_back(channels.get());
  return pointers;
}

Linked::Linked(std::vector<ExternalSystem*> channels, NoteSink note)
    : channels_(std::move(channels)), note_(std::move(note)) {
  for (ExternalSystem* each : channels_) each->begin();
}

void Linked::finish() {
  for (ExternalSystem* channels : channels_) {
    try {
      channels->finish();
    } catch (const std::runtime_error& error) { note_(error.what()); }
  }
}

std::vector<LinkReport> Linked::reports() const {
  std::vector<LinkReport> reports;
  for (const ExternalSystem* channels : channels_)
    if (auto report = channels->link_report()) reports.push_back(std::move(*report));
  return reports;
}

}  // namespace jarol
