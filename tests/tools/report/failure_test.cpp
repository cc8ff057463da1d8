#include "tools/report/failure.h"

#include <doctest/doctest.h>

#include <cerrno>
#include <new>
#include <optional>
#include <system_error>
#include <vector>

#include "distributers/session/errors.h"
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
    CHECK(failure_by(std::invalid_argument("--for: 'x' is no duration")).exit_code == exit_input);
    CHECK(failure_by(std::length_error("too long")).exit_code == exit_input);
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

  TEST_CASE("a file that can't be written by the name that it was given is bad input") {
    const std::string file = "can't write 'no/a.csv'";
    for (const int reason : {ENOENT, EACCES, EISDIR, ENOTDIR, EROFS}) {
      CAPTURE(reason);
      CHECK(failure_by(std::system_error(reason, std::generic_category(), file)).exit_code == exit_input);
    }
    CHECK(failure_by(std::system_error(ENOENT, std::generic_category(), file)).text ==
          "error: can't write 'no/a.csv': No such file or directory\n");
  }

  TEST_CASE("an error of ours says so, and exits with 3") {
    const Failure failure = failure_by(std::out_of_range("vector::at"));
    CHECK(failure.text == "error: jarol itself is wrong: vector::at; please report what you did\n");
    CHECK(failure.exit_code == exit_unfinished);
    CHECK(failure_by(std::bad_optional_access()).exit_code == exit_unfinished);
    CHECK(failure_by(std::logic_error("a class is there twice")).exit_code == exit_unfinished);
    CHECK(failure_by(42).text ==
          "error: jarol itself is wrong: something that is not a std::exception was thrown; "
          "please report what you did\n");
  }
}
