// Is found what compiled tasks reach, and by which way?
#include <doctest/doctest.h>
#include <elf.h>

#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "tests/isolation/expected.h"
#include "tests/tools/run_command.h"

namespace {
using command::run_jarol;

std::string library(const std::string& name) {
  return std::filesystem::absolute(std::string(JAROL_ISOLATION_FOLDER) + "/" + name + ".so").string();
}
std::string source(const std::string& name) { return "tests/isolation/" + name + ".cpp"; }

std::string graph_of(const std::string& plugin, const std::string& tasks) {
  return "graph: g\nplugins: [" + plugin + "]\ntiming: {period: 10ms}\ntasks:\n" + tasks;
}

// An ELF file whose section `name` is said to be another one, and not writable.
std::string with_constant_section(std::string file, const std::string& name, const std::string& as) {
  Elf64_Ehdr head;
  std::memcpy(&head, file.data(), sizeof head);
  const auto at = [&](std::size_t i) { return head.e_shoff + i * sizeof(Elf64_Shdr); };
  Elf64_Shdr names, section;
  std::memcpy(&names, file.data() + at(head.e_shstrndx), sizeof names);
  for (std::size_t i = 0; i < head.e_shnum; ++i) {
    std::memcpy(&section, file.data() + at(i), sizeof section);
    if (file.c_str() + names.sh_offset + section.sh_name != name) continue;
    section.sh_flags &= ~static_cast<Elf64_Xword>(SHF_WRITE);
    const std::string_view all(file.data() + names.sh_offset, names.sh_size);
    section.sh_name = static_cast<Elf64_Word>(all.find(std::string(1, '\0') + as + std::string(1, '\0')) + 1);
    std::memcpy(file.data() + at(i), &section, sizeof section);
  }
  return file;
}
}  // namespace

TEST_SUITE("isolation") {
  TEST_CASE("each task that offends is rejected by what it reaches and the way there, and no other") {
    for (const std::string& name : verdicts::isolation_sources()) {
      CAPTURE(name);
      CHECK(verdicts::differences(library(name), source(name)) == "");
    }
  }

  TEST_CASE(
      "however it is linked, with packed relocations, optimised as a whole, for far addresses, each is rejected") {
    CHECK(verdicts::differences(library("packed"), source("globals")) == "");
    CHECK(verdicts::wrong_verdicts(library("at_link_time"), source("globals"), "-O2") == "");
    CHECK(verdicts::wrong_verdicts(library("large"), source("far"), "-O2") == "");
    CHECK(verdicts::differences(library("own_new"), source("own_new")) == "");
    const auto done = run_jarol("isolation " + library("whole_runtime"));
    CHECK(done.exit_code == 2);
    CHECK(done.output ==
          "error: '" + library("whole_runtime") +
              "' has the runtime of C++ within it, which can't be looked at; link it without -static-libstdc++ and "
              "-static-libgcc\n");
  }

  TEST_CASE("there are enough of both sorts to mean something") {
    std::size_t offending = 0, innocent = 0;
    for (const std::string& name : verdicts::isolation_sources())
      for (const auto& [task, expected] : verdicts::expected_in(source(name)))
        ++(expected.empty() ? innocent : offending);
    CHECK(offending >= 60);
    CHECK(innocent >= 60);
  }

  TEST_CASE("the tasks that are built in are isolated") {
    const auto done = run_jarol("isolation");
    CHECK(done.exit_code == 0);
    CHECK(done.output.starts_with("built in: ISOLATED, "));
  }

  TEST_CASE("the report shows the way to what offends, with lines, and what can't be seen") {
    const auto done = run_jarol("isolation " + library("globals"));
    CHECK(done.exit_code == 1);
    CHECK(
        done.output.find("  task Calls\n    reaches the writable global 'counter'\n      Calls::run at tests/isolation/"
                         "globals.cpp:") != std::string::npos);
    CHECK(done.output.find("\nnot seen:\n") != std::string::npos);
    const auto json = nlohmann::json::parse(run_jarol("isolation --json " + library("globals")).output);
    CHECK(json["schema"] == "jarol.isolation/1");
    CHECK(json["isolated"] == false);
    for (const auto& task : json["files"][0]["tasks"]) {
      if (task["name"] != "Calls") continue;
      const auto& last = task["violations"][0]["path"].back();
      CHECK(last["function"] == "add_to_counter");
      CHECK(last["file"] == "tests/isolation/globals.cpp");
      std::ifstream in(source("globals"));
      std::string line;
      for (int i = 0; i < last["line"]; ++i) std::getline(in, line);
      CHECK(line == "[[gnu::noinline]] void add_to_counter(double by) { counter += by; }");
    }
  }

  TEST_CASE("what can't be read is refused with the reason") {
    const command::TemporaryFolder folder;
    const auto refused = [](const std::string& file, const std::string& why) {
      const auto done = run_jarol("isolation " + file);
      CHECK(done.exit_code == 2);
      CHECK(done.output == "error: " + why + "\n");
    };
    refused(library("with_ubsan"), "'" + library("with_ubsan") +
                                       "' is built with -fsanitize=undefined, whose checks reach what is not a task's "
                                       "own; build it without");
    refused("nowhere.so", "there is no file 'nowhere.so'");
    const std::string text = folder.write("text.so", "hello");
    refused(text, "'" + text + "' is no object file for x86-64 that can be read");
    const std::string stripped = folder / "stripped.so";
    REQUIRE(std::system(("strip -o " + stripped + " " + library("innocent_eigen")).c_str()) == 0);
    refused(stripped, "'" + stripped +
                          "' has no table of symbols, so that its code has no names; link it without -s and don't "
                          "strip it");
    // constants and code in memory that stays writable, whatever the sections say
    const auto stays = [&](const std::string& file, const std::string& section) {
      refused(file, "'" + file + "' has its " + section +
                        " in memory that stays writable; link it without -z norelro, -N and --omagic");
    };
    stays(library("not_closed"), ".data.rel.ro");
    const std::string globals = command::content(library("globals"));
    stays(folder.write("constants.so", with_constant_section(globals, ".data", ".rodata")), ".rodata");
    // what no task has business with is as writable as it is
    const std::string odd = folder.write("odd.so", with_constant_section(globals, ".data", ".init_array"));
    CHECK(verdicts::differences(odd, source("globals")) == "");
    // cut or bent anywhere it ends with a report
    std::ifstream in(library("innocent_eigen"), std::ios::binary);
    std::stringstream bytes;
    bytes << in.rdbuf();
    const std::string whole = bytes.str();
    for (std::size_t part = 1; part < 10; ++part) {
      const int code =
          run_jarol("isolation " + folder.write("cut.so", whole.substr(0, whole.size() * part / 10))).exit_code;
      CHECK(code == 2);
    }
    for (std::size_t at = 16; at < 4096; at += 97) {
      std::string bent = whole;
      for (std::size_t i = at; i < whole.size(); i += 4096) bent[i] = static_cast<char>(bent[i] ^ 0x55);
      const int code = run_jarol("isolation " + folder.write("bent.so", bent)).exit_code;
      CHECK(code >= 0);
      CHECK(code <= 2);
    }
  }

  TEST_CASE("a graph whose task promises isolation and does not keep it is refused; declared weak, it runs") {
    const command::TemporaryFolder folder;
    const std::string plugin = library("imports");
    const std::string file = folder.write("g.yaml", graph_of(plugin, "  a: {type: ReadsTime}\n  b: {type: Rounds}\n"));
    for (const std::string command : {"run --for 20ms ", "check ", "graph "}) {
      CAPTURE(command);
      const auto refused = run_jarol(command + file + " --set tasks.b.isolation=weak", "2>&1 >/dev/null");
      CHECK(refused.exit_code == 2);
      CHECK(refused.output.find(file +
                                ":5:13: error: task 'a' (ReadsTime) is not isolated: calls or uses 'time', a clock, in "
                                "ReadsTime::run at tests/isolation/imports.cpp:") != std::string::npos);
      CHECK(refused.output.find("; leave that out, or declare it with 'isolation: weak' (jarol isolation " + plugin +
                                " shows the way there)\n") != std::string::npos);
      CHECK(refused.output.find("task 'b'") == std::string::npos);
    }
    // what its structs begin with, too
    const std::string begins = folder.write("begins.yaml", graph_of(library("values"), "  a: {type: Starts}\n"));
    CHECK(run_jarol("graph " + begins, "2>&1 >/dev/null")
              .output.find("task 'a' (Starts) is not isolated: calls or uses 'std::chrono::_V2::steady_clock::now', a "
                           "clock, in now at tests/isolation/values.cpp:") != std::string::npos);
    const std::string alone = folder.write("weak.yaml", graph_of(plugin, "  a: {type: ReadsTime, isolation: weak}\n"));
    const auto weak = run_jarol("run --for 20ms " + alone + " --json", "2>/dev/null");
    CHECK(weak.exit_code == 0);
    CHECK(nlohmann::json::parse(weak.output)["digest_claimed"] == false);
  }

  TEST_CASE("a plugin with tasks that offend lends those that don't") {
    const command::TemporaryFolder folder;
    const std::string file = folder.write("g.yaml", graph_of(library("innocent"), "  a: {type: Nothing}\n"));
    CHECK(run_jarol("run --for 20ms " + file).exit_code == 0);
  }
}
