#include "tools/report/exit_code.h"

#include <doctest/doctest.h>

#include <csignal>
#include <iterator>

TEST_SUITE("tools/exit_code") {
  using namespace jarol::tools;

  TEST_CASE("a signal's is 128 and its number, as a shell has it") {
    CHECK(exit_of_signal(0) == 0);
    CHECK(exit_of_signal(SIGHUP) == 129);
    CHECK(exit_of_signal(SIGINT) == 130);
    CHECK(exit_of_signal(SIGTERM) == 143);
  }

  TEST_CASE("of several 2 counts before 3, that before a signal's, that before 1, that before 0") {
    const int order[] = {exit_good, exit_negative, 143, exit_unfinished, exit_input};
    for (std::size_t high = 0; high < std::size(order); ++high)
      for (std::size_t low = 0; low <= high; ++low) {
        CHECK(exit_of({order[high], order[low]}) == order[high]);
        CHECK(exit_of({order[low], order[high]}) == order[high]);
      }
    CHECK(exit_of({0, 1, 130, 3}) == 3);
  }
}
