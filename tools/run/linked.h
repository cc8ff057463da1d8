// The channels of a run while they are connected.
#pragma once

#include <iostream>
#include <memory>
#include <stdexcept>
#include <vector>

#include "runtime/channels.h"

namespace jarol::tools {

inline std::vector<Channels*> pointers_to(const std::vector<std::unique_ptr<Channels>>& all) {
  std::vector<Channels*> pointers;
  for (const auto& channels : all) pointers.push_back(channels.get());
  return pointers;
}

// Channels that are on links run while this lives.
class Linked {
 public:
  explicit Linked(std::vector<Channels*> channels) : channels_(std::move(channels)) {
    for (Channels* each : channels_) each->begin();
  }
  ~Linked() { finish(); }
  Linked(const Linked&) = delete;
  Linked& operator=(const Linked&) = delete;

  // what can't be kept for the next run is told, and the rest goes on
  void finish() {
    for (Channels* channels : channels_) {
      try {
        channels->finish();
      } catch (const std::runtime_error& error) { std::cerr << "note: " << error.what() << "\n"; }
    }
  }
  std::vector<LinkReport> reports() const {
    std::vector<LinkReport> reports;
    for (const Channels* channels : channels_)
      if (auto report = channels->link_report()) reports.push_back(std::move(*report));
    return reports;
  }

 private:
  std::vector<Channels*> channels_;
};

}  // namespace jarol::tools
