// Memory of some MiB lies on large pages, where the system has them.
#include "runtime/machine/large_pages.h"

#include <doctest/doctest.h>

#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <string>

namespace {
using namespace jarol;

// Did somebody ask the system for large pages there? As it says in /proc/self/smaps.
bool asks_for_large_pages(const void* address) {
  std::ifstream maps("/proc/self/smaps");
  bool here = false;
  for (std::string line; std::getline(maps, line);) {
    std::uintptr_t begin = 0, end = 0;
    if (std::sscanf(line.c_str(), "%lx-%lx ", &begin, &end) == 2)
      here = begin <= reinterpret_cast<std::uintptr_t>(address) && reinterpret_cast<std::uintptr_t>(address) < end;
    if (here && line.starts_with("VmFlags:")) return line.find(" hg") != std::string::npos;
  }
  return false;
}

bool begins_one(const void* memory) { return reinterpret_cast<std::uintptr_t>(memory) % large_page == 0; }

}  // namespace

TEST_SUITE("runtime/large_pages") {
  TEST_CASE("memory of a large page or more begins on one, and less is as aligned as it is to be") {
    const LargeMemory large = make_large(3 * large_page + 100), small = make_large(large_page - 1, 4096);
    CHECK(begins_one(large.get()));
    if (std::filesystem::exists("/sys/kernel/mm/transparent_hugepage")) {
      CHECK(asks_for_large_pages(large.get()));
      CHECK(asks_for_large_pages(large.get() + 3 * large_page - 1));
    }
    CHECK(reinterpret_cast<std::uintptr_t>(small.get()) % 4096 == 0);
  }

  TEST_CASE("a vector on large pages holds what any vector does, however it grows") {
    LargeVector<std::uint64_t> numbers;
    for (std::uint64_t i = 0; i < 1'000'000; ++i) numbers.push_back(i);
    const LargeVector<std::uint64_t> copied = numbers;
    numbers.clear();
    numbers.shrink_to_fit();
    CHECK(begins_one(copied.data()));
    std::uint64_t wrong = 0;
    for (std::uint64_t i = 0; i < copied.size(); ++i) wrong += copied[i] == i ? 0 : 1;
    CHECK(wrong == 0);
  }
}
