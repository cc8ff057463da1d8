// run --guard: tasks that can write to nothing but their own memory.
#include <doctest/doctest.h>

#include <csignal>
#include <nlohmann/json.hpp>
#include <string>

#include "tests/tools/process.h"
#include "tests/tools/reports.h"
#include "tests/tools/run_command.h"

namespace {
using command::report_of;
using command::TemporaryFolder;
using jarol::tests::Process;
using nlohmann::json;

// `wild` gets the address of what lies in the heap of `owner`; none of the others offends.
std::string graph_in(const TemporaryFolder& folder, const std::string& where) {
  const std::string plugin = std::filesystem::absolute(JAROL_PLUGIN_FOLDER "/guarded.so").string();
  return folder.write("guarded.yaml", "graph: g\nplugins: [" + plugin + R"(]
timing: {period: 10ms}
fault_limit: 100%
tasks:
  count: {type: Counter}
  let: {type: Relay, let: 5ms}
  owner: {type: Owner}
  held: {type: Owner, on_fault: hold, heap: 1KiB}
  large: {type: Large, on_fault: hold}
  thrower: {type: Thrower, on_fault: hold}
  again: {type: Thrower, on_fault: restart, let: 10ms}
  wild: {type: Wild, isolation: weak, parameters: {where: )" +
                                          where + R"(}}
connections:
  - count.out -> let.in
  - let.out -> owner.in
  - count.out -> held.in
  - owner.address -> wild.address
)");
}

// Without what an address is: it is another one in each process.
json comparable(json report) {
  for (const char* const name : {"digest", "wall_ns", "real_time_factor", "guard"}) report.erase(name);
  return report;
}
}  // namespace

TEST_SUITE("tools/guard") {
  TEST_CASE("under guard a run is what it is without, to the bit") {
    for (const std::string run : {
             "specs/counting.yaml --for 20s",
#ifdef JAROL_VEHICLES
             "specs/exolauv.yaml --for 3s",
             "specs/javiator.yaml --for 2s",
#endif
         }) {
      const json without = report_of(run), with = report_of(run + " --guard");
      CHECK(with["digest"] == without["digest"]);
      CHECK(comparable(with) == comparable(without));
      CHECK(with["guard"] == true);
    }
    CHECK(command::run_jarol("run specs/counting.yaml --for 1s --guard")
              .output.find("  guard       no task wrote to memory that is not its own\n") != std::string::npos);
  }

  TEST_CASE("what tasks throw and catch, their heaps and their faults are under guard as ever") {
    const TemporaryFolder folder;
    const std::string run = graph_in(folder, "nowhere") + " --for 3s";
    const json without = report_of(run), with = report_of(run + " --guard");
    CHECK(with["fault_count"] > 100);
    CHECK(comparable(with) == comparable(without));
    // its own inputs belong to a task
    CHECK(report_of(graph_in(folder, "input") + " --for 1s --guard")["activations"] == 800);
  }

  TEST_CASE("a guarded run is recorded, saved, resumed and late as any other") {
    const TemporaryFolder folder;
    const std::string run = "specs/counting.yaml --for 20s", log = folder / "run.mcap", saved = folder / "saved";
    const json whole = report_of(run);
    CHECK(report_of(run + " --guard --record " + log + " --trace " + (folder / "run.csv") +
                    " --save 7s=" + saved)["digest"] == whole["digest"]);
    CHECK(command::run_jarol("replay " + log).exit_code == 0);
    CHECK(report_of(run + " --guard --resume " + saved)["digest"] == whole["digest"]);
    // what was saved under guard goes on without it, and the other way round
    CHECK(report_of(run + " --resume " + saved)["digest"] == whole["digest"]);
    CHECK(report_of(run + " --save 7s=" + saved)["digest"] == whole["digest"]);
    CHECK(report_of(run + " --guard --resume " + saved)["digest"] == whole["digest"]);
    CHECK(report_of(run + " --guard --execution random")["digest"] == whole["digest"]);
  }

  TEST_CASE("a wild write ends the run with the task's name and where it wrote") {
    const TemporaryFolder folder;
    struct Write {
      std::string where, cause;
    };
    for (const Write& write : {Write{"task", "wrote to the memory of task 'owner' at address 0x"},
                               Write{"plan", "wrote to memory that is not its own"},
                               Write{"global", "wrote to memory that is not its own, of 'guarded.so', at address 0x"},
                               Write{"library", "wrote to memory that is not its own"},
                               Write{"behind", "wrote to memory that is not its own at address 0x"},
                               Write{"parameters", "wrote to the parameters of task 'wild' at address 0x"},
                               Write{"zero", "segmentation fault at address 0x0; the process ends\n"},
                               Write{"overflow", "stack overflow at address 0x"}}) {
      CAPTURE(write.where);
      Process process("run " + graph_in(folder, write.where) + " --for 1s --guard");
      CHECK(process.end() == -SIGSEGV);
      const std::string begin = "crash: task 'wild' activation 3 at 0.03 s: " + write.cause;
      CHECK_MESSAGE(process.errors().find(begin) != std::string::npos, process.errors());
      CHECK(process.output() == "");
    }
    // without it nobody notices
    for (const std::string where : {"global", "library", "behind", "parameters"})
      CHECK(report_of(graph_in(folder, where) + " --for 1s")["activations"] == 800);
  }

  TEST_CASE("what does not go with it is refused with the reason") {
    const auto error_of = [](const std::string& arguments) {
      const command::Result result = command::run_jarol("run specs/counting.yaml --for 1s --guard " + arguments);
      CHECK(result.exit_code == 2);
      return result.output;
    };
    CHECK(error_of("--clock real") ==
          "error: --guard belongs to the virtual clock: pages are protected for all threads\n");
    CHECK(error_of("--workers 2") ==
          "error: --workers does not go with --guard: pages are protected for all threads, and one task runs at a "
          "time\n");
    CHECK(error_of("--console") ==
          "error: --console does not go with --guard: the page's server reads into memory while tasks run\n");
    CHECK(error_of("--what-if 'at=0s set=tasks.count.parameters.x=1'") ==
          "error: --what-if does not go with --guard; leave out one of them\n");
  }
}
