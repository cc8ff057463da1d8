#include "tools/report/failure.h"

#include <doctest/doctest.h>

#include <cerrno>
#include <new>
#include <optional>
#include <system_error>
#include <vector>

#include "distributers/campaign/results.h"
#include "distributers/interfaces/no_state.h"
#include "distributers/links/frames.h"
#include "distributers/session/errors.h"
#include "graph/text/errors.h"
#include "runtime/checkpoint/checkpoint.h"
#include "runtime/record/recording_format.h"
#include "tools/report/exit_code.h"

namespace {
using namespace jarol;
using namespace jarol::tools;

template <class E>
Failure failure_by(const E& error) {
  return failure_of(std::make_exception_ptr(error));
}
}  // namespace

TEST_SUITE("tools/failure") {
  TEST_CASE("bad input is said as it was found, and exits with 2") {
    CHECK(failure_by(UnknownName("no 'x'")).text == "error: no 'x'\n");
    CHECK(failure_by(UnknownName("no 'x'")).exit_code == exit_input);
    CHECK(failure_by(InputError("--for: 'x' is no duration")).text == "error: --for: 'x' is no duration\n");
    CHECK(failure_by(InputError("--for: 'x' is no duration")).exit_code == exit_input);
    CHECK(failure_by(LogError("'a.mcap' is no recording")).exit_code == exit_input);
    CHECK(failure_by(CheckpointError("is no checkpoint")).exit_code == exit_input);
    CHECK(failure_by(NotSaveable("its link can't be saved")).exit_code == exit_input);
    CHECK(failure_by(NegativeVerdict("not schedulable")).exit_code == exit_negative);
  }

  TEST_CASE("what the machine has too little of exits with 3") {
    CHECK(failure_by(std::bad_alloc()).text == "error: there is not enough memory for this\n");
    CHECK(failure_by(std::bad_alloc()).exit_code == exit_unfinished);
    CHECK(failure_by(std::system_error(std::make_error_code(std::errc::resource_unavailable_try_again))).exit_code ==
          exit_unfinished);
    const std::string file = "can't write 'a.csv'";
    for (const int reason : {ENOSPC, EDQUOT, EFBIG, EIO, EPIPE, ENOMEM, EMFILE, ENFILE}) {
      CAPTURE(reason);
      CHECK(failure_by(std::system_error(reason, std::generic_category(), file)).exit_code == exit_unfinished);
    }
    CHECK(failure_by(std::system_error(ENOSPC, std::generic_category(), file)).text ==
          "error: can't write 'a.csv': No space left on device\n");
  }

  TEST_CASE("what neither the input nor the program is to blame for exits with 3") {
    CHECK(failure_by(Unfinished("no random numbers can be had")).text == "error: no random numbers can be had\n");
    CHECK(failure_by(Unfinished("no random numbers can be had")).exit_code == exit_unfinished);
    CHECK(failure_by(distributers::FrameError("the vehicle is silent")).exit_code == exit_unfinished);
    CHECK(failure_by(vehicles::NoState("no state at t = 3")).exit_code == exit_unfinished);
    CHECK(failure_by(campaign::ResultsError("the results are lost")).exit_code == exit_unfinished);
  }

  TEST_CASE("a file that can't be written by the name that it was given is bad input") {
    const std::string file = "can't write 'no/a.csv'";
    for (const int reason : {ENOENT, EACCES, EISDIR, ENOTDIR, EROFS}) {
      CAPTURE(reason);
      CHECK(failure_by(std::system_error(reason, std::generic_category(), file)).exit_code == exit_input);
    }
    CHECK(failure_by(std::system_error(ENOENT, std::generic_category(), file)).text ==
          "error: can't write 'no/a.csv': No such file or directory\n");
  }

  TEST_CASE("an exception of no type of ours is an internal error, says so, and exits with 3") {
    const auto internal = [](const Failure& failure) {
      CHECK(failure.exit_code == exit_unfinished);
      return failure.text;
    };
    const std::string remedy = "; please report what you did\n";
    CHECK(internal(failure_by(std::out_of_range("vector::at"))) == "error: internal error: vector::at" + remedy);
    CHECK(internal(failure_by(std::runtime_error("no"))) == "error: internal error: no" + remedy);
    CHECK(internal(failure_by(std::invalid_argument("stoi"))) == "error: internal error: stoi" + remedy);
    CHECK(internal(failure_by(std::length_error("vector::reserve"))) ==
          "error: internal error: vector::reserve" + remedy);
    CHECK(internal(failure_by(std::logic_error("a class is there twice"))) ==
          "error: internal error: a class is there twice" + remedy);
    CHECK(internal(failure_by(std::bad_optional_access())) == "error: internal error: bad optional access" + remedy);
    CHECK(internal(failure_by(42)) ==
          "error: internal error: something that is not a std::exception was thrown" + remedy);
  }
}
