// What check proposes where the answer is "no": each proposal, taken at its word, makes it a "yes".
#include <doctest/doctest.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tests/tools/run_command.h"

namespace {
using command::TemporaryFolder;

nlohmann::json check(const std::string& file, const std::string& options = "") {
  return nlohmann::json::parse(command::run_jarol("check --json " + options + " " + file, "2>/dev/null").output);
}

// The proposals, each of which holds.
std::vector<std::string> proposals(const std::string& file, const std::string& options = "") {
  const auto report = check(file, options);
  const auto& sets = report["suggested_sets"];
  REQUIRE(report["suggestions"].size() == sets.size());
  std::vector<std::string> texts;
  for (std::size_t i = 0; i < sets.size(); ++i) {
    std::string with = options;
    for (const std::string set : sets[i]) with += " --set '" + set + "'";
    CAPTURE(with);
    CHECK(command::run_jarol("check " + with + " " + file).exit_code == 0);
    texts.push_back(report["suggestions"][i]);
  }
  return texts;
}

std::string first_of(const std::vector<std::string>& texts) { return texts.empty() ? "" : texts.front(); }

bool proposes(const std::vector<std::string>& texts, const std::string& text) {
  return std::find(texts.begin(), texts.end(), text) != texts.end();
}
}  // namespace

TEST_SUITE("tools/remedies") {
  TEST_CASE("a task that is late by the work of another gets an offset, and that comes first") {
    const TemporaryFolder folder;
    const std::string file = folder.write("t.yaml", R"(graph: t
tasks:
  long:  {type: Work, period: 20ms, offset: 5ms, wcet: 8500us}
  short: {type: Work, period: 10ms, wcet: 1ms, deadline: 2ms}
)");
    CHECK(proposals(file).front() == "'offset: 2.5ms' of 'long'");
  }

  TEST_CASE("priorities against deadlines are found") {
    const TemporaryFolder folder;
    const std::string file = folder.write("t.yaml", R"(graph: t
platform: {policy: fixed_priority, phasing: any}
tasks:
  long:  {type: Work, period: 20ms, wcet: 8ms, priority: 0}
  short: {type: Work, period: 5ms, wcet: 1ms, priority: 1}
)");
    const auto texts = proposals(file);
    CHECK(texts.front() == "priorities by deadline, without 'priority'");
    CHECK(proposes(texts, "'cores: 2'"));
  }

  TEST_CASE("a deadline that was declared too early is found") {
    const TemporaryFolder folder;
    const std::string file = folder.write("t.yaml", R"(graph: t
platform: {policy: fixed_priority, phasing: any}
tasks:
  a: {type: Work, period: 10ms, wcet: 4ms}
  b: {type: Work, period: 10ms, wcet: 4ms, deadline: 3ms}
)");
    CHECK(proposes(proposals(file), "no 'deadline' of 'b'"));
  }

  TEST_CASE("another core for a task that stands on a full one is found") {
    const TemporaryFolder folder;
    const std::string file = folder.write("t.yaml", R"(graph: t
platform: {cores: 2}
tasks:
  a: {type: Work, period: 10ms, wcet: 6ms, core: 0}
  b: {type: Work, period: 10ms, wcet: 6ms, core: 0}
)");
    CHECK(proposes(proposals(file), "'core: 1' of 'a'"));
  }

  TEST_CASE("of a core that the tasks on it fill beyond all time one is moved, and that comes first") {
    const TemporaryFolder folder;
    // the longer ones stand elsewhere
    std::string text = "graph: t\nplatform: {cores: 3, policy: edf}\ntasks:\n";
    for (const std::string name : {"d", "e", "f", "g", "h", "i"})
      text += "  " + name + ": {type: Work, period: 100ms, wcet: 13ms, core: 1}\n";
    text +=
        "  a: {type: Work, period: 10ms, wcet: 6ms, core: 0}\n  b: {type: Work, period: 10ms, wcet: 6ms, core: 0}\n";
    const auto texts = proposals(folder.write("t.yaml", text));
    CHECK(first_of(texts) == "'core: 2' of 'a'");
    const std::string two = folder.write("u.yaml", R"(graph: t
platform: {cores: 3}
tasks:
  a: {type: Work, period: 10ms, wcet: 6ms, core: 0}
  b: {type: Work, period: 10ms, wcet: 6ms, core: 0}
  c: {type: Work, period: 10ms, wcet: 6ms, core: 0}
)");
    CHECK(first_of(proposals(two)) == "no 'core', so that check assigns them");
    // of many tasks what can't help is not looked for until there is no more effort
    std::string many = "graph: t\nplatform: {cores: 2}\ntasks:\n";
    for (int i = 0; i < 900; ++i)
      many += "  t" + std::to_string(i) + ": {type: Work, period: 10ms, wcet: " + (i < 2 ? "6ms" : "1us") +
              ", core: " + (i < 2 ? "0" : "1") + "}\n";
    CHECK(first_of(proposals(folder.write("v.yaml", many))) == "'core: 1' of 't0'");
  }

  TEST_CASE("where no single change helps, two together are looked for") {
    const TemporaryFolder folder;
    const std::string file = folder.write("t.yaml", R"(graph: t
platform: {policy: fixed_priority, phasing: any}
tasks:
  a: {type: Work, period: 10ms, wcet: 6ms, priority: 0}
  b: {type: Work, period: 20ms, wcet: 12ms, priority: 1}
  c: {type: Work, period: 5ms, wcet: 1ms, priority: 2}
)");
    const auto texts = proposals(file);
    CHECK(texts.front() == "'cores: 2' and priorities by deadline, without 'priority'");
  }

  TEST_CASE("more work than time is the headline, and so many cores are proposed as it takes") {
    const TemporaryFolder folder;
    const std::string file = folder.write("t.yaml", R"(graph: t
tasks:
  a: {type: Work, period: 10ms, wcet: 9ms}
  b: {type: Work, period: 10ms, wcet: 9ms}
  c: {type: Work, period: 10ms, wcet: 9ms}
)");
    CHECK(command::run_jarol("check " + file)
              .output.starts_with(
                  file + ": NOT SCHEDULABLE utilisation 270.00% of one core: there is more to do than time; core 0: "));
    CHECK(proposes(proposals(file), "'cores: 3'"));
  }

  TEST_CASE("a chain that is too slow gets proposals, too, which keep the deadlines") {
#ifdef JAROL_VEHICLES
    // the submarine moves in steps of 10 ms, and half of 50 ms is none
    CHECK(proposals("specs/exolauv.yaml", "--set chains.steer.reaction=50ms").empty());
#endif
    const TemporaryFolder folder;
    const std::string file = folder.write("t.yaml", R"(graph: t
communicators:
  i: {type: double, direction: in, period: 20ms}
  o: {type: double, direction: out, period: 20ms}
tasks:
  a: {type: Relay, period: 20ms, wcet: 1ms}
  b: {type: Relay, period: 20ms, let: 10ms, wcet: 1ms}
connections: [i -> a.in, a.out -> b.in, b.out -> o]
chains:
  loop: {path: [i, a, b, o], reaction: 35ms}
)");
    CHECK(proposes(proposals(file), "half the periods of all of chain 'loop'"));
  }

  TEST_CASE("a chain that is too slow by its LETs gets those named that are too many, and no other") {
    const TemporaryFolder folder;
    const std::string file = folder.write("t.yaml", R"(graph: t
communicators:
  i: {type: double, direction: in, period: 10ms}
  o: {type: double, direction: out, period: 10ms}
timing: {period: 10ms}
tasks:
  a: {type: Relay, let: 10ms, wcet: 1ms}
  b: {type: Relay, let: 10ms, wcet: 1ms}
  c: {type: Relay, let: 10ms, wcet: 1ms}
  d: {type: Relay, let: 10ms, wcet: 1ms}
connections: [i -> a.in, a.out -> b.in, b.out -> c.in, c.out -> d.in, d.out -> o]
chains:
  loop: {path: [i, a, b, c, d, o]}
)");
    const auto with_limit = [&](const std::string& limit) {
      return proposals(file, "--set chains.loop.reaction=" + limit);
    };
    CHECK(proposes(with_limit("40ms"), "no 'let' of 'a'"));
    CHECK(proposes(with_limit("35ms"), "no 'let' of 'a' and 'b'"));
    CHECK(proposes(with_limit("30ms"), "no 'let' of 'a' and 'b'"));
    CHECK(with_limit("20ms") == std::vector<std::string>{"no 'let' of 'a', 'b' and 'c'"});
    CHECK(check(file, "--set chains.loop.reaction=30ms")["suggested_sets"].back() ==
          nlohmann::json{"tasks.a.let=null", "tasks.b.let=null"});
    CHECK(with_limit("10ms").empty());
    // where values go round, a LET has to stay
    const std::string round = folder.write("u.yaml", R"(graph: t
timing: {period: 10ms}
tasks:
  a: {type: Relay, let: 10ms, wcet: 1ms}
  b: {type: Relay, wcet: 1ms}
connections: [a.out -> b.in, b.out -> a.in]
chains:
  loop: {path: [a, b], reaction: 15ms}
)");
    CHECK(!proposes(proposals(round), "no 'let' of 'a'"));
  }

  TEST_CASE("whatever is proposed for random graphs holds") {
    const TemporaryFolder folder;
    std::size_t proposed = 0, refused = 0;
    for (const std::string policy : {"table", "fixed_priority", "edf"}) {
      command::run_jarol("check --generate uunifast --count 8 --tasks 6 --utilisation 1.05 --policy " + policy +
                         " -o " + (folder / policy));
      for (int seed = 0; seed < 8; ++seed) {
        const std::string file = (folder / policy) + "/uunifast_" + std::to_string(seed) + ".yaml";
        const auto texts = proposals(file);
        if (check(file)["verdict"] == "not_schedulable") ++refused;
        proposed += texts.size();
      }
    }
    CHECK(refused > 10);
    CHECK(proposed > refused);
  }
}
