#include "tools/report/exit_code.h"

#include <doctest/doctest.h>

#include <csignal>
#include <iterator>

#include "tools/report/run_end.h"

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

  TEST_CASE("what could not be kept for the next run is an error, and the run is unfinished") {
    jarol::RunEnd end;
    CHECK(exit_code_of(end) == exit_good);
    end.unkept = {"can't write the trim to 'trim.txt'"};
    CHECK(exit_code_of(end) == exit_unfinished);
    CHECK(errors_of(end, {}) == "error: can't write the trim to 'trim.txt'\n");
  }
}
