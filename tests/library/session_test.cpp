// A session beside the command, and what it refuses.
#include <doctest/doctest.h>
#include <jarol/runtime/machine/arithmetic.h>
#include <jarol/session.h>
#include <jarol/tasks/values/lauv.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <string>

using namespace std::chrono_literals;

namespace {
std::string output_of(const std::string& arguments) {
  std::string output;
  std::FILE* pipe = popen((JAROL_COMMAND " " + arguments).c_str(), "r");
  std::array<char, 4096> chunk{};
  for (std::size_t n = 0; (n = std::fread(chunk.data(), 1, chunk.size(), pipe)) > 0;) output.append(chunk.data(), n);
  pclose(pipe);
  return output;
}

std::string hex(std::uint64_t digest) {
  std::array<char, 24> text{};
  std::snprintf(text.data(), text.size(), "0x%016llx", static_cast<unsigned long long>(digest));
  return text.data();
}
}  // namespace

TEST_CASE("a shipped graph has the digest that the command has, in one piece or in many") {
  for (const std::string name : {"counting", "exolauv", "javiator"}) {
    const std::string run = output_of("run " SPECS "/" + name + ".yaml --for 5s --seed 3");
    auto whole = jarol::open(SPECS "/" + name + ".yaml", {.seed = 3}),
         pieces = jarol::open(SPECS "/" + name + ".yaml", {.seed = 3});
    whole.run_until(5s);
    for (auto end = 7ms; end < 5s; end += 137ms) pieces.run_until(end);
    pieces.run_until(5s);
    CHECK(run.find("  digest      " + hex(whole.report().digest) + "\n") != std::string::npos);
    CHECK(pieces.report().digest == whole.report().digest);
    CHECK(pieces.report().activations == whole.report().activations);
  }
}

TEST_CASE("what is fed to a distributer in place of its link is what its tasks get") {
  auto session = jarol::open(SPECS "/exolauv.yaml", {.fed = {"dune", "neptus"}});
  session.watch("supervisor.*");
  session.feed("neptus.setpoint", jarol::tasks::Setpoint{.depth = 2.0, .speed = 1.0});
  session.run_until(500ms);
  CHECK(session.value<jarol::tasks::Setpoint>("from_neptus").depth == 2.0);
  CHECK(session.samples<jarol::tasks::Setpoint>("supervisor.setpoint").size() == 10);
  CHECK(session.samples<double>("supervisor.setpoint.depth").front().instant == 0ms);
  CHECK(std::isfinite(session.value<double>("fins.actuation.fins.3")));
}

TEST_CASE("the verdict on a whole mission is that of the command") {
  auto session = jarol::open(SPECS "/exolauv.yaml");
  session.run_until(session.end_of_mission());
  const jarol::RunVerdict verdict = session.finish();
  CHECK(verdict.expectations.size() == 5);
  CHECK_FALSE(verdict.is_negative());
  CHECK_THROWS_WITH_AS(session.run_for(1s), "the run is over at 100 s: it was finished", jarol::RunOver);
}

TEST_CASE("every library that this program loads calls the same sin and exp, those of jarol::math") {
  CHECK(jarol::find_arithmetic().foreign_calls == std::vector<std::string>{});
}
