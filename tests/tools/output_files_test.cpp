// Where the command's outputs go: what stands at a path, and what it means when nothing can be written.
// In one file: a list of what can stand at a path.
#include <doctest/doctest.h>
#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <sys/sysmacros.h>
#include <unistd.h>

#include <cstdlib>
#include <fstream>
#include <set>
#include <string>

#include "runtime/files/atomic_file.h"
#include "runtime/record/recorded_run.h"
#include "runtime/record/recording_writer.h"
#include "tests/tools/default_signals.h"
#include "tests/tools/run_command.h"
#include "tools/commands/run/load_graph.h"

namespace {
namespace fs = std::filesystem;
using command::content;
using command::TemporaryFolder;

int partials_in(const TemporaryFolder& folder) {
  int count = 0;
  for (const auto& entry : fs::directory_iterator(folder / "")) count += entry.path().extension() == ".part";
  return count;
}

void write(const std::string& path, const std::string& text) {
  jarol::AtomicFile file(path);
  file.write(text);
  file.commit();
}
}  // namespace

TEST_SUITE("tools/output_files") {
  TEST_CASE("a link is followed, and what it leads to is replaced and keeps its permissions") {
    const TemporaryFolder folder;
    const std::string target = folder.write("target", "old"), link = folder / "link", chain = folder / "chain";
    fs::permissions(target, fs::perms(0640));
    fs::create_symlink("target", link);
    fs::create_symlink(link, chain);
    write(chain, "new");
    CHECK(content(target) == "new");
    CHECK(fs::is_symlink(chain));
    CHECK(fs::is_symlink(link));
    CHECK(fs::status(target).permissions() == fs::perms(0640));
    fs::create_symlink("not there yet", folder / "ahead");
    write(folder / "ahead", "new");
    CHECK(fs::is_symlink(folder / "ahead"));
    CHECK(content(folder / "not there yet") == "new");
    CHECK(partials_in(folder) == 0);
  }

  TEST_CASE("what is not committed leaves the file as it was") {
    const TemporaryFolder folder;
    const std::string path = folder.write("file", "old");
    { jarol::AtomicFile(path).write("new"); }
    CHECK(content(path) == "old");
    CHECK(partials_in(folder) == 0);
  }

  TEST_CASE("a partial file has a name that nobody foresees, and its own permissions") {
    const TemporaryFolder folder;
    std::set<std::string> names;
    for (int i = 0; i < 20; ++i) {
      const jarol::AtomicFile file(folder / "file");
      for (const auto& entry : fs::directory_iterator(folder / "")) names.insert(entry.path().filename());
      CHECK(partials_in(folder) == 1);
    }
    CHECK(names.size() == 20);
    // as long as one writes, no other does, by whatever path; and then it does
    fs::create_directory_symlink(folder / "", folder / "again");
    {
      const jarol::AtomicFile first(folder / "file");
      const std::string other = folder / "again/file";
      CHECK_THROWS_WITH_AS(
          jarol::AtomicFile{other},
          ("can't write '" + other + "': another run writes it; choose another file, or wait until that ends").c_str(),
          std::runtime_error);
      const jarol::AtomicFile beside(folder / "file2");
    }
    write(folder / "file", "new");
    CHECK(content(folder / "file") == "new");
  }

#ifdef JAROL_VEHICLES
  TEST_CASE("a signal that ends a command leaves nothing half written") {
    const command::DefaultSignals taken;
    const TemporaryFolder folder;
    const std::string script = folder.write("s.csv", "time,thruster\n0,0.5\n"), csv = folder / "o.csv";
    for (const std::string signal : {"INT", "TERM", "HUP", "PIPE", "QUIT"}) {
      CAPTURE(signal);
      // in the foreground: what a shell starts in the background ignores SIGINT
      const std::string pid = folder / "pid";
      const auto ended = command::run_jarol("schema > /dev/null; (for i in $(seq 600); do ls " + csv +
                                            ".*.part >/dev/null 2>&1 && break; sleep 0.05; done; kill -" + signal +
                                            " $(cat " + pid + ")) & exec sh -c 'echo $$ > " + pid +
                                            "; exec " JAROL_COMMAND " vehicle submarine --for 100000s --script " +
                                            script + " --csv " + csv + "'");
      CHECK(ended.exit_code == -1);  // by the signal
      CHECK(ended.output == "");
      CHECK(partials_in(folder) == 0);
      CHECK(!fs::exists(csv));
    }
  }
#endif

  TEST_CASE("what another process still writes is not taken away, also where its output can't be known as locked") {
    const TemporaryFolder folder;
    const std::string live = folder.write("t.csv.77.part", "half"),
                      run = "run specs/counting.yaml --for 1s --trace " + (folder / "t.csv");
    const int writer = ::open(live.c_str(), O_WRONLY);
    REQUIRE(::flock(writer, LOCK_EX | LOCK_NB) == 0);
    CHECK(command::run_jarol(run).exit_code == 0);
    CHECK(content(live) == "half");
    ::close(writer);
    CHECK(command::run_jarol(run).exit_code == 0);
    CHECK(!fs::exists(live));
  }

  TEST_CASE("what a killed run left half written the next one removes that writes the same file, and nothing else") {
    const TemporaryFolder folder;
    const std::string trace = folder / "t.csv";
    const auto ended = command::run_jarol("schema > /dev/null; " JAROL_COMMAND
                                          " run specs/counting.yaml --clock real --for 1h"
                                          " --trace " +
                                          trace + " & id=$!; until ls " + trace +
                                          ".*.part >/dev/null 2>&1; do sleep 0.01; done; kill -KILL $id; wait $id");
    CHECK(ended.exit_code == 128 + 9);
    CHECK(partials_in(folder) == 1);
    CHECK(!fs::exists(trace));
    const std::vector<std::string> others{folder.write("t.csv.part", "other"), folder.write("t.csv.1x.part", "other"),
                                          folder.write("s.csv.12.part", "other"), folder.write("t.csv.12.parts", "x")};
    fs::create_symlink("t.csv.part", folder / "t.csv.12.part");
    CHECK(command::run_jarol("run specs/counting.yaml --for 1s --trace " + trace).exit_code == 0);
    CHECK(fs::exists(trace));
    for (const std::string& other : others) CHECK(fs::exists(other));
    CHECK(fs::is_symlink(folder / "t.csv.12.part"));
    CHECK(partials_in(folder) == 4);
  }

  TEST_CASE("a device or a FIFO is written in place") {
    const TemporaryFolder folder;
    // a node of one's own is for root
    const std::string full = folder / "full";
    if (::mknod(full.c_str(), S_IFCHR | 0666, makedev(1, 7)) == 0) {
      const auto failed = command::run_jarol("run specs/counting.yaml --for 1s --trace " + full);
      CHECK(failed.exit_code != 0);
      CHECK(failed.output.find("error: can't write '" + full + "': No space left on device\n") != std::string::npos);
      CHECK(fs::is_character_file(full));
    }
    const std::string fifo = folder / "fifo", copy = folder / "copy", trace = folder / "trace.csv";
    REQUIRE(::mkfifo(fifo.c_str(), 0600) == 0);
    REQUIRE(std::system(("timeout 60 cat " + fifo + " > " + copy + " &").c_str()) == 0);
    CHECK(command::run_jarol("run specs/counting.yaml --for 1s --trace " + fifo).exit_code == 0);
    CHECK(command::run_jarol("run specs/counting.yaml --for 1s --trace " + trace).exit_code == 0);
    CHECK(fs::is_fifo(fifo));
    for (int i = 0; i < 1000 && content(copy) != content(trace); ++i) ::usleep(20'000);
    CHECK(content(copy) == content(trace));
    CHECK(command::run_jarol("run specs/counting.yaml --for 1s --trace /dev/stdout", "2>/dev/null")
              .output.starts_with(content(trace) + "counting: 1 s"));
    // also where that is a file, which then holds both
    command::run_jarol("run specs/counting.yaml --for 1s --trace /dev/stdout > " + copy);
    CHECK(content(copy).starts_with(content(trace) + "counting: 1 s"));
  }

  TEST_CASE("an output that would replace an input or another output is refused") {
    const TemporaryFolder folder;
    const std::string graph = folder / "g.yaml", link = folder / "l.csv";
    fs::copy_file("specs/counting.yaml", graph, fs::copy_options::overwrite_existing);
    fs::create_symlink(graph, link);
    const auto refusal = [&](const std::string& arguments) {
      const auto result = command::run_jarol(arguments);
      CHECK(result.exit_code == 2);
      return result.output;
    };
    CHECK(refusal("run " + graph + " --for 1s --trace " + graph) ==
          "error: --trace '" + graph + "' would replace what FILE names; choose another file\n");
    CHECK(refusal("run " + graph + " --for 1s --plot " + link) ==
          "error: --plot '" + link + "' would replace what FILE names; choose another file\n");
    CHECK(refusal("run " + graph + " --for 1s --trace " + (folder / "x") + " --plot " + (folder / "./x")) ==
          "error: --trace and --plot both name '" + (folder / "./x") + "'; choose another file for one of them\n");
    CHECK(refusal("check " + graph + " --svg " + graph) ==
          "error: --svg '" + graph + "' would replace what FILE names; choose another file\n");
    CHECK(content(graph) == content("specs/counting.yaml"));
    CHECK(command::run_jarol("run " + graph + " --for 1s --trace /dev/null --plot /dev/null").exit_code == 0);
  }

  TEST_CASE("no output takes the place of a file that the run has read, by whatever name") {
    const TemporaryFolder folder;
    fs::copy("specs", folder / "specs", fs::copy_options::recursive);
    const std::string graph = folder / "specs/exolauv.yaml";
    for (const std::string input : {"specs/missions/dive.csv", "specs/vehicles/submarine.yaml"}) {
      const std::string path = folder / input, hard = folder / "hard", soft = folder / "soft", before = content(path);
      REQUIRE(before != "");
      fs::create_hard_link(path, hard);
      fs::create_symlink(path, soft);
      for (const std::string& name : {path, hard, soft})
        for (const std::string option : {"--trace ", "--plot ", "--log ", "--record ", "--save 500ms="}) {
          CAPTURE(option + name);
#ifndef JAROL_VEHICLES
          if (true) continue;
#endif
          const auto refused = command::run_jarol("run " + graph + " --for 1s " + option + name);
          CHECK(refused.exit_code == 2);
          CHECK(refused.output ==
                "error: can't write '" + name + "': it is '" + path + "', which was read; choose another file\n");
          CHECK(content(path) == before);
        }
      fs::remove(hard);
      fs::remove(soft);
    }
    // a key of a link is read, too
    const std::string key = folder.write("c.key", std::string(32, 'k')), spec = folder.write("k.yaml", R"(graph: g
distributers: {v: {type: JaviatorVehicle, link: {type: udp, peer: 9}}}
tasks: {a: {type: Counter, period: 10ms}}
)");
    fs::permissions(key, fs::perms(0600));
    for (const std::string option : {"--trace", "--plot", "--log", "--record"}) {
      const auto refused = command::run_jarol(
          "run " + spec + " --clock real --for 50ms --set distributers.v.link.key=" + key + " " + option + " " + key);
      CHECK(refused.exit_code == 2);
      CHECK(refused.output.ends_with("error: can't write '" + key + "': it is '" + key +
                                     "', which was read; choose another file\n"));
      CHECK(content(key) == std::string(32, 'k'));
    }
    // a plugin is read too, and a log by its replay
    const std::string so = folder / "t.so",
                      with = folder.write("w.yaml",
                                          "graph: g\nplugins: [t.so]\ntasks: {a: {type: Counter, period: 10ms}}\n");
    fs::copy_file(std::string(JAROL_PLUGIN_FOLDER) + "/twice.so", so);
    CHECK(command::run_jarol("run " + with + " --for 1s --trace " + so, "2>&1 >/dev/null")
              .output.ends_with("error: can't write '" + so + "': it is '" + so +
                                "', which was read; choose another file\n"));
    const std::string log = folder / "log", same = folder / "same";
    REQUIRE(command::run_jarol("run specs/counting.yaml --for 1s --log " + log).exit_code == 0);
    fs::create_hard_link(log, same);
    CHECK(command::run_jarol("replay " + log + " --trace " + same).exit_code == 2);
    CHECK(command::run_jarol("replay " + log).exit_code == 0);
#ifdef JAROL_VEHICLES
    // and what a recording holds is as good as read: its run came from there
    const std::string mission = folder.write(
                          "dive.csv", "time,setpoint.depth,setpoint.heading,setpoint.speed\n0,2,0deg,1\n1,2,0deg,1\n"),
                      run = folder / "r.mcap", before = content(mission);
    REQUIRE(command::run_jarol("run specs/exolauv.yaml --set expect=nothing --set distributers.neptus.link.file=" +
                               mission + " --record " + run)
                .exit_code == 0);
    CHECK(command::run_jarol("replay " + run + " --trace " + mission).output ==
          "error: can't write '" + mission + "': it is '" + mission + "', which was read; choose another file\n");
    CHECK(content(mission) == before);
#endif
  }

  TEST_CASE("of two runs into one log the second is refused, and the first goes on") {
    const TemporaryFolder folder;
    const std::string log = folder / "run.log", fifo = folder / "fifo";
    const jarol::RecordingHeader header{.graph = "counting", .file = "", .overrides = {}, .clock = "virtual"};
    const auto loaded = jarol::tools::load_graph("specs/counting.yaml", {});
    jarol::RecordingWriter first(log, header, {}, *loaded.graph);
    first.open();
    const auto second = command::run_jarol("run specs/counting.yaml --for 1s --log " + log);
    CHECK(second.exit_code == 2);
    CHECK(second.output ==
          "error: can't write '" + log + "': another run writes it; choose another file, or wait until that ends\n");
    first.close({});
    CHECK(jarol::RecordedRun(log).end());
  }

  TEST_CASE("so it is where the second has another name of the same file") {
    const TemporaryFolder folder;
    const std::string log = folder / "run.log", other = folder / "other.log";
    const jarol::RecordingHeader header{.graph = "counting", .file = "", .overrides = {}, .clock = "virtual"};
    const auto loaded = jarol::tools::load_graph("specs/counting.yaml", {});
    jarol::RecordingWriter first(log, header, {}, *loaded.graph);
    first.open();
    fs::create_hard_link(log, other);
    const auto second = command::run_jarol("run specs/counting.yaml --for 1s --log " + other);
    CHECK(second.exit_code == 2);
    CHECK(second.output == "error: can't write '" + other +
                               "': another run writes it by another name; choose another file, or wait until that "
                               "ends\n");
    first.close({});
    CHECK(jarol::RecordedRun(log).end());
    // once that has ended it can be written anew
    CHECK(command::run_jarol("run specs/counting.yaml --for 1s --log " + other).exit_code == 0);
  }

  TEST_CASE("what is written does not take the place of the program that writes") {
    const TemporaryFolder folder;
    const std::string own = folder / "own";
    fs::copy_file(JAROL_COMMAND, own);
    const auto size = fs::file_size(own);
    for (const std::string option : {"--trace ", "--plot ", "--log "}) {
      CAPTURE(option);
      const auto refused = command::run_jarol("run specs/counting.yaml --for 1s " + option + own, "2>&1", own);
      CHECK(refused.exit_code == 2);
      CHECK(refused.output ==
            "error: can't write '" + own + "': it is '" + own + "', which was read; choose another file\n");
    }
    CHECK(fs::file_size(own) == size);
  }

  TEST_CASE("check --generate overwrites nothing, and says so before it writes anything") {
    const TemporaryFolder folder;
    const std::string graphs = folder / "g", third = graphs + "/waters_7.yaml";
    const std::string generate = "check --generate waters -o " + graphs + " --count 3 --seed ";
    CHECK(command::run_jarol(generate + "5").exit_code == 0);
    std::ofstream(third) << "mine";
    const auto refused = command::run_jarol(generate + "3");
    CHECK(refused.exit_code == 2);
    CHECK(refused.output == "error: '" + graphs +
                                "/waters_5.yaml' is there, and --generate overwrites nothing; choose another folder or "
                                "--seed, or remove it\n");
    CHECK(!fs::exists(graphs + "/waters_3.yaml"));
    CHECK(content(third) == "mine");
    CHECK_THROWS_WITH_AS((jarol::AtomicFile{third, jarol::Replaces::nothing}),
                         ("can't write '" + third + "': File exists").c_str(), std::runtime_error);
    // also where it has come to be there meanwhile
    jarol::AtomicFile late(graphs + "/late", jarol::Replaces::nothing);
    std::ofstream(graphs + "/late") << "mine";
    CHECK_THROWS_AS(late.commit(), std::runtime_error);
    CHECK(content(graphs + "/late") == "mine");
  }

  TEST_CASE("where the disk is full a command that reports into files exits with 3, as on stdout") {
    const TemporaryFolder folder;
    const std::string file = folder / "r.mcap", tables = folder / "tables", no_room = "': No space left on device\n";
    REQUIRE(command::run_jarol("run specs/counting.yaml --for 10s --record " + file).exit_code == 0);
    const std::string campaign = "campaign specs/counting.yaml --for 1s --vary seed=1..3 --results " + (folder / "c");
    for (const std::string& command :
         {"log trace " + file + " -o /dev/full", "log report " + file + " -o /dev/full", campaign + " --csv /dev/full",
          campaign + " --report /dev/full", std::string("run specs/counting.yaml --for 1s --log /dev/full")}) {
      CAPTURE(command);
      const auto failed = command::run_jarol(command, "2>&1 >/dev/null");
      CHECK(failed.exit_code == 3);
      CHECK(failed.output == "error: can't write '/dev/full" + no_room);
    }
    // a limit of sizes, for there is no folder that is full
    const auto by_rate = command::run_jarol("log csv " + file + " --by-rate " + tables, "2>&1",
                                            std::string("trap '' XFSZ; ulimit -f 1; ") + JAROL_COMMAND);
    CHECK(by_rate.exit_code == 3);
    CHECK(by_rate.output == "error: can't write '" + tables + "/10ms.csv': File too large\n");
    CHECK(fs::is_empty(tables));
    // a name that is no good is bad input, as ever
    const auto in_file = command::run_jarol("log csv " + file + " --by-rate " + file + "/x");
    CHECK(in_file.exit_code == 2);
    CHECK(in_file.output == "error: can't make the folder '" + file + "/x': Not a directory\n");
    CHECK(command::run_jarol("log trace " + file + " -o /no/x.json").exit_code == 2);
    CHECK(command::run_jarol("log --help")
              .output.find(", 2 bad input or nothing to compare,\n3 can't write, as on a full disk\n") !=
          std::string::npos);
  }

  TEST_CASE("output that can't be written is reported, and exits with 3") {
    for (const std::string to : {">/dev/full", ">&-"})
      for (const std::string command : {"run specs/counting.yaml --for 1s", "run specs/counting.yaml --for 1s --json",
                                        "tasks", "schema", "--help"}) {
        CAPTURE(command + to);
        const auto failed = command::run_jarol(command, "2>&1 " + to);
        CHECK(failed.exit_code == 3);
        CHECK(failed.output ==
              "error: can't write to stdout, what stands there is not whole; is the disk full, or stdout closed?\n");
      }
    CHECK(command::run_jarol("tasks", ">/dev/null 2>&1").exit_code == 0);
    const auto closed = command::run_jarol("run specs/counting.yaml --for 1s --trace -", "2>&1 >&-");
    CHECK(closed.exit_code == 2);
    CHECK(closed.output == "error: '-' is stdout, which is closed; name a file, or open it\n");
    // what can't be written is named, whatever else can't be
    const TemporaryFolder full;
    const auto both = command::run_jarol(
        "run specs/counting.yaml --for 60s --trace " + (full / "t.csv") + " --log " + (full / "t.log"),
        "2>&1 >/dev/null", std::string("ulimit -f 4; ") + JAROL_COMMAND);
    CHECK(both.exit_code == 3);
    for (const char* const name : {"t.csv", "t.log"})
      CHECK(both.output.find("can't write '" + (full / name) + "'") != std::string::npos);
    // a disk that has no room left, as the limit of a file's size has none
    const TemporaryFolder small;
    const auto campaign = command::run_jarol(
        "campaign specs/counting.yaml --for 100ms --runs 200 --vary seed=1..200 "
        "--metric m=loop.out --results " +
            (small / "c.sqlite"),
        "2>&1 >/dev/null", std::string("ulimit -f 16; ") + JAROL_COMMAND);
    CHECK(campaign.exit_code == 3);
    CHECK(campaign.output.starts_with("error: can't use '" + (small / "c.sqlite") + "' for results: "));
    // and no other file takes the place of a stdout that is closed
    const TemporaryFolder folder;
    command::run_jarol("run specs/counting.yaml --for 1s --trace " + (folder / "t.csv"), ">&- 2>/dev/null");
    CHECK(content(folder / "t.csv").starts_with("time,"));
    CHECK(content(folder / "t.csv").find("digest") == std::string::npos);
  }
}
