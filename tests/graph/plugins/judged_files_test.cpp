#include "graph/plugins/judged_files.h"

#include <doctest/doctest.h>
#include <unistd.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <stdexcept>

namespace {
namespace fs = std::filesystem;

class File {
 public:
  File() : path_(fs::temp_directory_path() / ("judged_files_" + std::to_string(::getpid()))) { write("a"); }
  ~File() { fs::remove(path_); }
  std::string path() const { return path_.string(); }
  void write(const std::string& text) const { std::ofstream(path_) << text; }
  void replace(const std::string& text) const {
    std::ofstream(path() + ".new") << text;
    fs::rename(path() + ".new", path_);
  }
  void set_time(std::chrono::nanoseconds earlier) const {
    fs::last_write_time(path_, fs::last_write_time(path_) - earlier);
  }

 private:
  fs::path path_;
};
}  // namespace

TEST_SUITE("graph/plugins/judged_files") {
  TEST_CASE("a file is judged once, and anew when it is another one or has changed") {
    const File file;
    jarol::JudgedFiles<int> judged;
    int times = 0;
    const auto judge = [&](const std::string& what = "") {
      return judged.find(file.path(), what, [&] { return ++times; });
    };
    CHECK(judge() == 1);
    CHECK(judge() == 1);
    CHECK(judge("something else about it") == 2);
    CHECK(judge() == 1);
    file.write("ab");
    CHECK(judge() == 3);
    CHECK(judge() == 3);
    file.replace("cd");
    CHECK(judge() == 4);
    file.set_time(std::chrono::hours(1));
    CHECK(judge() == 5);
    CHECK(judge() == 5);
    fs::remove(file.path());
    CHECK(judge() == 6);
  }

  TEST_CASE("what could not be judged is judged again") {
    const File file;
    jarol::JudgedFiles<int> judged;
    CHECK_THROWS_WITH_AS(judged.find(file.path(), "", []() -> int { throw std::runtime_error("not now"); }), "not now",
                         std::runtime_error);
    CHECK(judged.find(file.path(), "", [] { return 7; }) == 7);
  }
}
