#include "tools/report/version.h"

#include "tools/report/commit.h"

namespace jarol::tools {
namespace {

#if defined(__clang__)
constexpr char compiler[] = "clang " __clang_version__;
#else
constexpr char compiler[] = "g++ " __VERSION__;
#endif

}  // namespace

std::string version_text() {
  const std::string commit = JAROL_COMMIT;
  return "jarol " JAROL_VERSION + (commit.empty() ? "" : ", commit " + commit) + "\n" + compiler + ", " JAROL_LIBRARIES;
}

}  // namespace jarol::tools
