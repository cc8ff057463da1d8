// A program that links jarol::jarol, and no more than that, loads plugins.
#include <doctest/doctest.h>
#include <jarol/session.h>

#include <string>
#include <vector>

using namespace std::chrono_literals;

namespace {
const char* const doubled = R"(
graph: doubled
timing: {period: 10ms}
plugins: [")" DOUBLING R"("]
tasks: {count: {type: Counter}, twice: {type: Doubling}}
connections: [count.out -> twice.in]
)";
}  // namespace

TEST_CASE("a graph names a plugin, which is noted") {
  std::vector<std::string> notes;
  jarol::Session session = jarol::open_text(doubled, {.note = [&](const std::string& note) { notes.push_back(note); }});
  CHECK(notes == std::vector<std::string>{"loads plugin '" DOUBLING "'"});
  session.run_until(100ms);
  CHECK(session.value<double>("twice.out") == 18);
}

TEST_CASE("whoever wants no notes gets none") {
  jarol::Session session = jarol::open_text(doubled, {.note = nullptr});
  session.run_until(100ms);
  CHECK(session.value<double>("twice.out") == 18);
}
