#include "tools/report/version.h"

#include <capstone/capstone.h>
#include <elfutils/version.h>
#include <fmt/format.h>
#include <lz4.h>
#include <oneapi/tbb/version.h>
#include <sodium/version.h>
#include <xxhash.h>
#include <yaml.h>
#include <zstd.h>

#ifndef JAROL_FIRST
#include <graphviz/graphviz_version.h>
#include <sqlite3.h>

#include <boost/version.hpp>
#endif

#include "tools/report/commit.h"

namespace jarol::tools {
namespace {

#if defined(__clang__)
constexpr char compiler[] = "clang " __clang_version__;
#else
constexpr char compiler[] = "g++ " __VERSION__;
#endif

// of those commands that are built later
std::string later_libraries() {
#ifdef JAROL_FIRST
  return "";
#else
  return fmt::format(", Boost {}.{}, SQLite {}, Graphviz {}", BOOST_VERSION / 100'000, BOOST_VERSION / 100 % 1'000,
                     SQLITE_VERSION, PACKAGE_VERSION);
#endif
}

// those that CMake does not know the versions of
std::string other_libraries() {
  return fmt::format(
      "libyaml {}, oneTBB {}.{}, lz4 {}, zstd {}, xxHash {}.{}.{}, sodium {}, Capstone {}.{}, elfutils {}",
      yaml_get_version_string(), TBB_VERSION_MAJOR, TBB_VERSION_MINOR, LZ4_VERSION_STRING, ZSTD_VERSION_STRING,
      XXH_VERSION_MAJOR, XXH_VERSION_MINOR, XXH_VERSION_RELEASE, SODIUM_VERSION_STRING, CS_API_MAJOR, CS_API_MINOR,
      _ELFUTILS_VERSION);
}

}  // namespace

std::string version_text() {
  const std::string commit = JAROL_COMMIT;
  return "jarol " JAROL_VERSION + (commit.empty() ? "" : ", commit " + commit) + "\n" + compiler +
         ", " JAROL_LIBRARIES ",\n" + other_libraries() + later_libraries();
}

}  // namespace jarol::tools
