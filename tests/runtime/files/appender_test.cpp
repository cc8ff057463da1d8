#include "runtime/files/appender.h"

#include <doctest/doctest.h>
#include <fcntl.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <string>
#include <system_error>

namespace {
using namespace jarol;

// An empty file that is gone with it.
class OwnFile {
 public:
  explicit OwnFile(const std::string& name = "appended")
      : path_(std::filesystem::temp_directory_path() / (name + "_" + std::to_string(::getpid()))) {
    file_ = std::fopen(path_.c_str(), "wb");
    REQUIRE(file_ != nullptr);
  }
  ~OwnFile() {
    std::fclose(file_);
    std::filesystem::remove(path_);
  }
  OwnFile(const OwnFile&) = delete;
  OwnFile& operator=(const OwnFile&) = delete;

  std::FILE* stream() const { return file_; }
  std::string content() const {
    std::ifstream file(path_, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
  }
  // What it takes of the disk, in bytes.
  std::uint64_t taken() const {
    struct stat status {};
    REQUIRE(::stat(path_.c_str(), &status) == 0);
    return static_cast<std::uint64_t>(status.st_blocks) * 512;
  }

 private:
  std::filesystem::path path_;
  std::FILE* file_ = nullptr;
};

std::string some(std::size_t bytes, unsigned seed) {
  std::string text(bytes, ' ');
  for (std::size_t i = 0; i < bytes; ++i) text[i] = static_cast<char>(i * 31 + i / 251 + seed);
  return text;
}

constexpr std::size_t mebibyte = std::size_t{1} << 20;
}  // namespace

TEST_SUITE("runtime/appender") {
  TEST_CASE("what is appended in pieces stands one after another, and in the file at once") {
    const OwnFile file;
    Appender appender(file.stream());
    appender.append("", "first ");
    appender.append("second ", "", "third");
    CHECK(file.content() == "first second third");
    appender.append("");
    appender.append(" and last");
    CHECK(file.content() == "first second third and last");
    CHECK(appender.bytes() == 27);
    appender.end();
    CHECK(file.content() == "first second third and last");
  }

  TEST_CASE("a long file gets its place ahead, as much as it has already, and keeps none beyond its end") {
    const OwnFile file;
    Appender appender(file.stream());
    const auto piece = [&](unsigned i) { return some(mebibyte + 17, i); };
    std::string expected;
    std::uint64_t max_ahead = 0;
    for (unsigned i = 0; i < 20; ++i) {
      appender.append("head", piece(i), "tail");
      expected += "head" + piece(i) + "tail";
      if (i == 2) CHECK_MESSAGE(file.taken() < 4 * mebibyte, "a short file gets nothing ahead");
      max_ahead = std::max(max_ahead, file.taken() - expected.size());
    }
    CHECK(file.content() == expected);
    const OwnFile probe("probe");
    if (::fallocate(::fileno(probe.stream()), FALLOC_FL_KEEP_SIZE, 0, 4096) == 0)
      CHECK(max_ahead > 3 * mebibyte);
    else
      MESSAGE("this file system allocates nothing ahead");
    CHECK(max_ahead <= 16 * mebibyte);
    appender.end();
    CHECK(file.content() == expected);
    CHECK(file.taken() < expected.size() + 64 * 1024);
  }

  TEST_CASE("what is no regular file gets the pieces, too") {
    std::array<int, 2> ends{};
    REQUIRE(::pipe(ends.data()) == 0);
    std::FILE* const stream = ::fdopen(ends[1], "wb");
    Appender appender(stream);
    appender.append("one", " two");
    std::array<char, 16> got{};
    CHECK(std::string(got.data(), static_cast<std::size_t>(::read(ends[0], got.data(), got.size()))) == "one two");
    appender.end();
    std::fclose(stream);
    ::close(ends[0]);
  }

  TEST_CASE("a full device says so") {
    std::FILE* const stream = std::fopen("/dev/full", "wb");
    REQUIRE(stream != nullptr);
    Appender appender(stream);
    try {
      appender.append("more than nothing");
      FAIL("it was taken");
    } catch (const std::system_error& error) { CHECK(error.code().value() == ENOSPC); }
    CHECK(appender.bytes() == 0);
    std::fclose(stream);
  }

  TEST_CASE("a file that may grow no further has all that fits") {
    const OwnFile file;
    Appender appender(file.stream());
    rlimit before{};
    REQUIRE(::getrlimit(RLIMIT_FSIZE, &before) == 0);
    const auto handler = std::signal(SIGXFSZ, SIG_IGN);
    const std::size_t max_size = 2 * mebibyte + 1000;
    const rlimit limit{max_size, before.rlim_max};
    REQUIRE(::setrlimit(RLIMIT_FSIZE, &limit) == 0);
    std::string given;
    int reason = 0;
    try {
      for (unsigned i = 0; i < 5; ++i) {
        const std::string head = some(600, i), body = some(mebibyte, i + 7), tail = some(900, i + 9);
        given += head + body + tail;
        appender.append(head, body, tail);
      }
    } catch (const std::system_error& error) { reason = error.code().value(); }
    ::setrlimit(RLIMIT_FSIZE, &before);
    std::signal(SIGXFSZ, handler);
    CHECK(reason == EFBIG);
    CHECK(file.content() == given.substr(0, max_size));
  }
}
