#include "graph/language/read_source.h"

#include <doctest/doctest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "graph/language/problems.h"
#include "graph/language/yaml.h"

namespace {
using namespace jarol;
}  // namespace

TEST_SUITE("graph/read_source") {
  TEST_CASE("only regular files are read, and stdin where that is said, each up to its limit") {
    const std::string folder = std::filesystem::temp_directory_path() / ("jarol_yaml_" + std::to_string(::getpid()));
    std::filesystem::create_directories(folder);
    const std::string fifo = folder + "/fifo", file = folder + "/file";
    REQUIRE(::mkfifo(fifo.c_str(), 0600) == 0);  // nobody writes it, and nobody waits
    CHECK_THROWS_WITH_AS(
        read_source(fifo),
        ("error: can't read '" + fifo + "': it is no regular file; give - for what comes on stdin").c_str(), SpecError);
    CHECK_THROWS_WITH_AS(read_source("/dev/zero"),
                         "error: can't read '/dev/zero': it is no regular file; give - for what comes on stdin",
                         SpecError);
    std::ofstream(file) << "graph: g\n";
    CHECK(read_source(file)->text == "graph: g\n");
    std::filesystem::resize_file(file, 1 << 10);
    CHECK(read_source(file, 1 << 10)->text.size() == 1 << 10);
    std::filesystem::resize_file(file, (1 << 10) + 1);
    CHECK_THROWS_WITH_AS(read_source(file, 1 << 10),
                         ("error: can't read '" + file + "': it is larger than 1 KiB").c_str(), SpecError);
    std::filesystem::resize_file(file, std::uintmax_t{1} << 40);  // sparse
    CHECK_THROWS_WITH_AS(read_source(file), ("error: can't read '" + file + "': it is larger than 64 MiB").c_str(),
                         SpecError);
    std::filesystem::remove_all(folder);
  }

  TEST_CASE("a file that can't be read says why") {
    CHECK_THROWS_WITH_AS(read_source("no/such/file.yaml"),
                         "error: can't read 'no/such/file.yaml': No such file or directory", SpecError);
  }

  TEST_CASE("a folder is no file") {
    CHECK_THROWS_WITH_AS(read_source("specs"), "error: can't read 'specs': it is a directory", SpecError);
  }
}
