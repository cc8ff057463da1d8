// MCAP files as such: check sums, compression, and that a file is read as it was written, or said to be damaged.
#include <doctest/doctest.h>

#include <filesystem>
#include <fstream>

#include "graph/values/seed.h"
#include "runtime/mcap/crc32.h"
#include "runtime/mcap/reader.h"
#include "runtime/mcap/verify.h"
#include "runtime/mcap/writer.h"

namespace {
using namespace jarol::mcap;

std::string random_bytes(std::size_t size, std::uint64_t seed) {
  std::string bytes;
  for (std::size_t i = 0; i < size; ++i)
    bytes += static_cast<char>(jarol::spread_seed(seed, std::to_string(i)) % (seed % 2 == 0 ? 256 : 3));
  return bytes;
}

class TemporaryFile {
 public:
  TemporaryFile() : path_(std::filesystem::temp_directory_path() / ("jarol_mcap_" + std::to_string(::getpid()))) {}
  ~TemporaryFile() { std::filesystem::remove(path_); }
  std::string path() const { return path_; }
  void write(const std::string& bytes) const { std::ofstream(path_, std::ios::binary) << bytes; }

 private:
  std::filesystem::path path_;
};

std::string content(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

// Two chunks of two channels, and an attachment.
void write_file(const std::string& path, Compression compression) {
  std::FILE* const file = std::fopen(path.c_str(), "wb");
  REQUIRE(file != nullptr);
  Writer writer(file, compression, "jarol");
  writer.write(Attachment{"notes", "text/plain", "of the run"});
  const Schema schema{1, "jarol/msg/double", "ros2msg", "float64 value\n"};
  const Channel a{1, 1, "a", "cdr"}, b{2, 1, "b", "cdr", {{"wrapped", "yes"}}};
  for (int i = 0; i < 2; ++i) {
    Chunk chunk;
    chunk.add(record_of(schema));
    chunk.add(record_of(a));
    chunk.add(record_of(b));
    for (std::uint32_t m = 0; m < 5; ++m)
      std::memset(chunk.add_message(m % 2 == 0 ? 1 : 2, m, jarol::Duration(100 * i + m), 12), static_cast<int>(m), 12);
    writer.write(chunk);
  }
  writer.end({schema}, {a, b});
  std::fclose(file);
}
}  // namespace

TEST_SUITE("runtime/mcap") {
  TEST_CASE("the check sum is that of zlib, with every instruction that is there, over any bytes and in pieces") {
    CHECK(crc32("123456789") == 0xcbf43926);  // the check value of CRC-32/ISO-HDLC
    CHECK(crc32("") == 0);
    const std::string bytes = random_bytes(1500, 0);
    for (std::size_t size = 0; size < 700; ++size) {
      const std::string_view piece = std::string_view(bytes).substr(size % 13, size);
      REQUIRE(crc32(piece) == crc32_by_table(piece));
      REQUIRE(crc32_by_narrow_folding(piece) == crc32_by_table(piece));
      const std::string_view more = std::string_view(bytes).substr(700, size);
      REQUIRE(joined_crc32(crc32(piece), crc32(more), more.size()) == crc32(std::string(piece) + std::string(more)));
      REQUIRE(crc32(more, crc32(piece)) == crc32(std::string(piece) + std::string(more)));
    }
  }

  TEST_CASE("what was compressed comes back, and what is not whole is refused") {
    for (const Compression compression : {Compression::lz4, Compression::zstd})
      for (const std::size_t size : {0UL, 1UL, 1000UL, 100'000UL})
        for (const std::uint64_t seed : {0U, 1U}) {
          const std::string bytes = random_bytes(size, seed);
          std::string compressed;
          compress(compression, bytes, compressed);
          const std::string name(name_of(compression));
          CHECK(uncompress(name, compressed, size) == bytes);
          CHECK_THROWS_AS(uncompress(name, compressed, size + 1), FormatError);
          CHECK_THROWS_AS(uncompress(name, compressed.substr(0, compressed.size() - 1), size), FormatError);
          CHECK_THROWS_AS(uncompress(name, compressed + "x", size), FormatError);
        }
    CHECK_THROWS_WITH_AS(uncompress("snappy", "", 0), "a chunk compressed by 'snappy'", FormatError);
  }

  TEST_CASE("each changed byte of a file is found, each file that breaks off, and what was added") {
    const TemporaryFile file;
    for (const Compression compression : {Compression::none, Compression::lz4, Compression::zstd}) {
      write_file(file.path(), compression);
      CHECK(verify(file.path()).empty());
      const std::string whole = content(file.path());
      for (std::size_t i = 0; i < whole.size(); ++i)
        for (const int change : {0x01, 0x80, 0xff}) {
          CAPTURE(i);
          std::string damaged = whole;
          damaged[i] = static_cast<char>(damaged[i] ^ change);
          file.write(damaged);
          if (i < magic.size())
            CHECK_THROWS_WITH_AS(verify(file.path()), "is no MCAP file", FormatError);
          else
            REQUIRE(!verify(file.path()).empty());
        }
      for (std::size_t size = magic.size(); size < whole.size(); ++size) {
        file.write(whole.substr(0, size));
        REQUIRE(!verify(file.path()).empty());
      }
      file.write(whole + "x");
      CHECK(verify(file.path()) ==
            std::vector<std::string>{"at byte " + std::to_string(whole.size()) + " there is more after the end"});
    }
  }

  TEST_CASE("where a byte was changed is said") {
    const TemporaryFile file;
    write_file(file.path(), Compression::none);
    std::string damaged = content(file.path());
    Reader reader(file.path());
    Record record;
    while (reader.next(record) && record.opcode != Opcode::chunk) {}
    const std::uint64_t chunk = record.offset;
    damaged[chunk + 300] ^= 1;
    file.write(damaged);
    const std::vector<std::string> problems = verify(file.path());
    REQUIRE(problems.size() >= 2);
    CHECK(problems[0] == "at byte " + std::to_string(chunk) + " there is a chunk whose check sum is another");
  }
}
