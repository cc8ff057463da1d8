// What a program may hand to a session by mistake.
#include <doctest/doctest.h>

#include <limits>

#include "distributers/session/session.h"
#include "tests/distributers/all_parts.h"

namespace {
using namespace jarol;
using namespace std::chrono_literals;

std::shared_ptr<const Source> passing_on() {
  return std::make_shared<const Source>(Source{"t.yaml", R"(
graph: t
timing: {period: 10ms}
communicators: {a: {type: double, direction: in}, b: {type: double, direction: out}}
connections: [a -> b]
)"});
}

Session fed() { return {tests::all_parts_with<>(), passing_on(), {.fed = {"*"}}}; }

void open_by(const BuildOptions& program) {
  const Session session(tests::all_parts_with<>(), passing_on(), {.fed = {"*"}}, program);
}
}  // namespace

TEST_SUITE("distributers/session/edges") {
  TEST_CASE("a value that is not finite does not take the place of one that was fed before it") {
    Session session = fed();
    session.feed("a", 1.0);
    session.run_for(10ms);
    session.feed("a", 5.0);
    session.feed("a", std::numeric_limits<double>::quiet_NaN());
    const Checkpoint here = session.checkpoint();
    session.run_for(10ms);
    CHECK(session.value<double>("a") == 5);
    CHECK(session.report().non_finite_inputs == 1);
    Session other = fed();
    other.restore(here);
    other.run_for(10ms);
    CHECK(other.value<double>("a") == 5);
    CHECK(other.report().non_finite_inputs == 1);
  }

  TEST_CASE("without a text of a graph there is no session") {
    CHECK_THROWS_WITH_AS(Session(tests::all_parts_with<>(), std::shared_ptr<const Source>()),
                         "a session is of a graph's text; the source is null", NoSource);
    static_assert(!std::is_constructible_v<Session, const distributers::Registries&, std::nullptr_t>);
  }

  TEST_CASE("a program that was compiled otherwise than the library is refused, with the option") {
    const BuildOptions ours = options_of_this_file();
    CHECK_NOTHROW(open_by(ours));
    BuildOptions other = ours;
    other.address_sanitizer = 1 - ours.address_sanitizer;  // may look on at the program alone
    CHECK_NOTHROW(open_by(other));
    other = ours;
    other.debug_containers = 1;
    CHECK_THROWS_WITH_AS(open_by(other),
                         "this program was compiled with -D_GLIBCXX_DEBUG, the library of Jarol otherwise; compile "
                         "both with the same options",
                         WrongBuild);
    other = ours;
    other.fast_math = 1;
    CHECK_THROWS_WITH_AS(open_by(other),
                         "this program was compiled with -ffast-math or a part of it, so that it computes otherwise, "
                         "the library of Jarol otherwise; compile both with the same options",
                         WrongBuild);
    other = ours;
    other.largest_vector = 32;
    CHECK_THROWS_WITH_AS(open_by(other),
                         "this program was compiled with options that give the alignment of vectors (-march) 32 bytes "
                         "instead of 16, the library of Jarol otherwise; compile both with the same options",
                         WrongBuild);
  }
}
