#include "distributers/links/stamp_limits.h"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>

#include "distributers/messages/imc.h"
#include "distributers/messages/javiator.h"

namespace {
using namespace jarol;
using namespace jarol::distributers;
using namespace std::chrono_literals;
namespace imc = messages::imc;
using Stamp = StampLimits::Finding;

// At so many seconds of this machine's clock, which began at 1000 s.
struct Bench {
  StampLimits limits{imc::message_set(), 5s};
  Stamp look(double at, double stamp, std::uint16_t source = 1) {
    imc::Header header;
    header.timestamp = stamp;
    header.src = source;
    const auto now = StampLimits::Clock::time_point(
        std::chrono::duration_cast<StampLimits::Clock::duration>(std::chrono::duration<double>(at)));
    return limits.look(messages::refer_to(header), now, 1000 + at);
  }
};
}  // namespace

TEST_SUITE("distributers/links/stamp_limits") {
  TEST_CASE("stamps far ahead of their sender's clock or far behind it are refused, wherever that clock stands") {
    for (const double its : {1000.0, 1e9}) {
      CAPTURE(its);
      Bench b;
      CHECK(b.look(0, its) == Stamp::good);
      CHECK(b.look(1, its + 1 + 9.99) == Stamp::good);  // its clock goes on from there
      CHECK(b.look(1, its + 20.98) == Stamp::good);
      CHECK(b.look(1, its + 31) == Stamp::ahead);
      CHECK(b.look(1, its + 86400) == Stamp::ahead);
      CHECK(b.look(1, its + 20.98 - 599.9) == Stamp::good);
      CHECK(b.look(1, its + 20.98 - 600.1) == Stamp::behind);
      CHECK(b.look(2, its + 21.98) == Stamp::good);
      CHECK(b.look(2, its + 1e6, 2) == Stamp::good);  // another system, with a clock of its own
      CHECK(b.look(2, its + 22) == Stamp::good);
    }
  }

  TEST_CASE("what is no time is refused, also at the begin") {
    for (const double no : {std::nan(""), std::numeric_limits<double>::infinity(), -HUGE_VAL}) {
      Bench b;
      CHECK(b.look(0, no) == Stamp::no_time);
      CHECK(b.look(0, 1000) == Stamp::good);
      CHECK(b.look(0, no) == Stamp::no_time);
    }
  }

  TEST_CASE("a stamp before 1970 or after 2199 is no time of a clock, and no first one keeps away those that follow") {
    for (const double no : {1e308, -1e308, 1e12, 7'258'118'400.0, -0.001}) {
      CAPTURE(no);
      Bench b;
      CHECK(b.look(0, no) == Stamp::no_time);
      CHECK(b.look(0.1, 1000.1) == Stamp::good);
      CHECK(b.look(0.2, no) == Stamp::no_time);
      CHECK(b.look(0.3, 1000.3) == Stamp::good);
    }
    for (const double first : {0.0, 7'258'118'399.0}) CHECK(Bench().look(0, first) == Stamp::good);
  }

  TEST_CASE("a first stamp that is old gives way to one nearer to the time here") {
    Bench b;
    CHECK(b.look(0, 400) == Stamp::good);
    CHECK(b.look(0, 1000) == Stamp::good);
    CHECK(b.look(0, 1011) == Stamp::ahead);
  }

  TEST_CASE("a clock that was set is believed once nothing was taken for the silence") {
    Bench b;
    CHECK(b.look(0, 1000) == Stamp::good);
    for (double at = 0.1; at < 5; at += 0.1) CHECK(b.look(at, 5000 + at) == Stamp::ahead);
    CHECK(b.look(5, 5005) == Stamp::good);
    CHECK(b.look(5.1, 5005.1) == Stamp::good);
    CHECK(b.look(5.2, 1005.2) == Stamp::behind);
  }

  TEST_CASE("a clock that is slow or fast within reason is followed for days") {
    for (const double rate : {0.9999, 1.0001, 10.0}) {
      Bench b;
      std::uint64_t refused = 0;
      for (double at = 0; at < 3e4; at += 0.5) refused += b.look(at, 7 + rate * at) == Stamp::good ? 0 : 1;
      CHECK(refused == 0);
    }
  }

  TEST_CASE("messages without a time have no limits") {
    StampLimits limits(messages::javiator::message_set(), 5s);
    const messages::javiator::Header header;
    CHECK(limits.look(messages::refer_to(header), {}, 0) == Stamp::good);
  }
}
