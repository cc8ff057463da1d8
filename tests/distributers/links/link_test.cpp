// What holds of links of each kind.
#include "distributers/links/link.h"

#include <doctest/doctest.h>

#include <cerrno>
#include <new>
#include <stdexcept>
#include <system_error>

#include "graph/text/errors.h"
#include "tests/distributers/links/open_link.h"
#include "tests/distributers/links/pairs.h"
#include "tests/refused_threads.h"

namespace {
using namespace jarol;
using namespace jarol::distributers;
using namespace jarol::tests;
namespace javiator = messages::javiator;

void check_carries_all(Pair pair) {
  REQUIRE(meet(pair));
  Ids at_one, at_other;
  constexpr int packets = 512;
  for (int id = 0; id < packets; ++id) {
    send_id(*pair.one, id);
    send_id(*pair.other, id);
    // no more under way than fits the ports
    REQUIRE(wait_for([&] {
      pair.one->receive(at_one);
      pair.other->receive(at_other);
      const auto newest = [](const Ids& ids) { return ids.ids.empty() ? -1 : ids.ids.back(); };
      return id % 16 != 15 || (newest(at_one) == id && newest(at_other) == id);
    }));
  }
  std::vector<int> expected;
  for (int id = 0; id < packets; ++id) expected.push_back(id);
  for (Ids* ids : {&at_one, &at_other}) {
    std::erase(ids->ids, 60000);
    CHECK(ids->ids == expected);
  }
  CHECK(count_of(*pair.one, "packets in") >= packets);
  CHECK(count_of(*pair.one, "packets out") >= packets);
  CHECK(count_of(*pair.one, "dropped: bad checksum") == 0);
}

void check_disconnects(Pair pair) {
  REQUIRE(meet(pair));
  pair.one->connect();  // already is
  Ids got;
  for (int id = 0; id < 20; ++id)
    pair.other->send(messages::refer_to(javiator::MotorSignals{0, 0, 0, 0, static_cast<std::uint16_t>(id)}));
  pair.other->disconnect();  // sends what is pending
  pair.other->disconnect();  // already is
  REQUIRE(wait_for([&] {
    pair.one->receive(got);
    return !got.ids.empty() && got.ids.back() == 19;
  }));
  std::erase(got.ids, 60000);
  CHECK(got.ids.size() == 20);
}

void check_meets_again(Pair pair) {
  REQUIRE(meet(pair));
  for (int i = 0; i < 3; ++i) {
    pair.other->disconnect();
    pair.other->connect();
    CHECK(meet(pair));
  }
}

// Throws where it receives or sends.
class ThrowingTransport : public Transport {
 public:
  explicit ThrowingTransport(bool sends) : sends_(sends) {}
  std::string text() const override { return "radio"; }
  void open() override {}
  void close() override {}
  void receive(const Interrupter& interrupter, ByteSink&) override {
    if (!sends_) throw std::runtime_error("the modem has reset itself");
    static_cast<void>(interrupter.wait(-1, std::chrono::milliseconds(-1)));
  }
  bool send(std::span<const std::byte>) override {
    if (sends_) throw 5;
    return true;
  }

 private:
  const bool sends_;
};

// Can't be opened.
template <class Error>
class ClosedTransport : public ThrowingTransport {
 public:
  explicit ClosedTransport(const Error& error) : ThrowingTransport(false), error_(error) {}
  void open() override { throw error_; }

 private:
  const Error error_;
};

template <class Error>
std::unique_ptr<Link> closed_by(const Error& error) {
  return make(std::make_unique<ClosedTransport<Error>>(error));
}

// What a call throws, tried until it does.
template <class Call>
std::string thrown_by(Call call) {
  std::string thrown;
  CHECK(wait_for([&] {
    try {
      call();
    } catch (const Unfinished& error) { thrown = error.what(); }
    return !thrown.empty();
  }));
  return thrown;
}
}  // namespace

TEST_SUITE("distributers/links/link") {
  TEST_CASE("what a transport throws in a thread of the link, whoever uses the link gets, with the link's name") {
    Ids ids;
    const auto receives = make(std::make_unique<ThrowingTransport>(false));
    receives->connect();
    CHECK(thrown_by([&] { receives->receive(ids); }) == "radio: receiving has failed: the modem has reset itself");
    send_id(*receives, 1);  // what is safe still goes out
    CHECK(wait_for([&] { return count_of(*receives, "packets out") == 1; }));
    receives->disconnect();
    const auto sends = make(std::make_unique<ThrowingTransport>(true));
    sends->connect();
    const std::string sending = "radio: sending has failed: something was thrown that is no exception";
    CHECK(thrown_by([&] { send_id(*sends, 1); }) == sending);
    CHECK(thrown_by([&] { sends->receive(ids); }) == sending);
    sends->disconnect();
    CHECK_FALSE(sends->sends());
  }

  TEST_CASE(
      "a transport that can't be opened is bad input, whatever it throws, but where the machine lacks something") {
    CHECK_THROWS_WITH_AS(closed_by(std::logic_error("no modem"))->connect(), "no modem", InputError);
    CHECK_THROWS_WITH_AS(closed_by(std::runtime_error("no carrier"))->connect(), "no carrier", InputError);
    CHECK_THROWS_WITH_AS(closed_by(Unfinished("no random numbers"))->connect(), "no random numbers", Unfinished);
    CHECK_THROWS_AS(closed_by(std::bad_alloc())->connect(), std::bad_alloc);
    const std::system_error no_descriptors(EMFILE, std::generic_category());
    CHECK_THROWS_AS(closed_by(no_descriptors)->connect(), std::system_error);
  }

  TEST_CASE("a link that gets no thread, or only one, is closed again and can be connected later") {
    for (const int granted : {0, 1}) {
      if (!RefusedThreads::possible) return;
      const auto link = make(listening<UdpTransport>(std::chrono::hours(1)));
      {
        const RefusedThreads refused(granted);
        CHECK_THROWS_AS(link->connect(), std::system_error);
      }
      CHECK_FALSE(link->sends());
      link->connect();
      CHECK(link->sends());
      link->disconnect();
    }
  }

  TEST_CASE("packets arrive both ways, in order and whole: UDP") { check_carries_all(udp("127.0.0.1")); }
  TEST_CASE("packets arrive both ways, in order and whole: UDP over IPv6") { check_carries_all(udp("[::1]")); }
  TEST_CASE("packets arrive both ways, in order and whole: TCP") { check_carries_all(tcp("127.0.0.1")); }
  TEST_CASE("packets arrive both ways, in order and whole: TCP over IPv6") { check_carries_all(tcp("[::1]")); }
  TEST_CASE("packets arrive both ways, in order and whole: serial line") { check_carries_all(serial()); }

  TEST_CASE("connect and disconnect are idempotent; disconnect sends what is pending: UDP") {
    check_disconnects(udp("127.0.0.1"));
  }
  TEST_CASE("connect and disconnect are idempotent; disconnect sends what is pending: TCP") {
    check_disconnects(tcp("127.0.0.1"));
  }
  TEST_CASE("connect and disconnect are idempotent; disconnect sends what is pending: serial line") {
    check_disconnects(serial());
  }

  TEST_CASE("a peer that comes back is found again: UDP") { check_meets_again(udp("127.0.0.1")); }
  TEST_CASE("a peer that comes back is found again: TCP") { check_meets_again(tcp("127.0.0.1")); }
  TEST_CASE("a peer that comes back is found again: serial line") { check_meets_again(serial()); }
}
