// A console's server whose messages the test says.
#pragma once

#include <atomic>
#include <cstdint>
#include <mutex>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "graph/text/errors.h"
#include "tests/tools/console/client.h"
#include "tools/console/server.h"

namespace jarol::tests {

struct Served {
  std::mutex mutex;
  std::vector<std::string> next;
  std::atomic<int> asked{0};
  tools::console::Server server{{},
                                R"({"hello": {"schema": "test"}})",
                                [this] {
                                  const std::lock_guard lock(mutex);
                                  return std::exchange(next, {});
                                },
                                [this](const tools::console::Page& page, const std::string& message) -> std::string {
                                  ++asked;
                                  if (message == "number") return R"({"number": )" + std::to_string(page.number) + "}";
                                  if (message == "behind")
                                    return R"({"behind": )" + std::to_string(page.behind.count()) + "}";
                                  if (message == "large") return R"({"large": ")" + std::string(100'000, 'x') + "\"}";
                                  if (message == "wrong") throw InputError("expected something else");
                                  return message == "echo" ? R"({"echo": 1})" : "";
                                },
                                [this](std::uint64_t page) { say(R"({"left": )" + std::to_string(page) + "}"); }};

  void say(const std::string& message) {
    const std::lock_guard lock(mutex);
    next.push_back(message);
  }
  std::string said(const std::string& what) {
    say(R"({"say": ")" + what + "\"}");
    return what;
  }
  Place place() const { return Place(server.url()); }
};

}  // namespace jarol::tests
