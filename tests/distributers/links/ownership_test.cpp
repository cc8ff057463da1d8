#include "distributers/links/ownership.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <iterator>
#include <map>
#include <random>

namespace {
using namespace jarol;
using namespace jarol::distributers;
using namespace std::chrono_literals;
using Clock = Ownership::Clock;

Address at(int port) { return Address::parse(std::to_string(port)); }

// Time goes on as a receiving thread sees it.
Clock::time_point pass(Ownership& ownership, Clock::time_point now, std::chrono::milliseconds time) {
  for (; time > 0ms; time -= std::min(time, Ownership::look_interval))
    ownership.look(now += std::min(time, Ownership::look_interval));
  return now;
}

LinkReport report_of(const Ownership& ownership) {
  LinkReport report;
  ownership.add_to(report);
  return report;
}
}  // namespace

TEST_SUITE("distributers/links/ownership") {
  TEST_CASE("a link is that of the first that speaks, until it has been silent for the limit") {
    Ownership ownership(2s);
    auto now = Clock::time_point(100s);
    ownership.begin(now);
    CHECK(ownership.may_speak(at(1)));
    CHECK(ownership.may_speak(at(2)));
    ownership.heard(at(1), now);
    CHECK(ownership.may_speak(at(1)));
    CHECK_FALSE(ownership.may_speak(at(2)));
    now = pass(ownership, now, 1999ms);
    CHECK_FALSE(ownership.may_speak(at(2)));
    now = pass(ownership, now, 1ms);
    CHECK(ownership.may_speak(at(2)));
    CHECK(ownership.may_speak(at(1)));
    ownership.heard(at(1), now);  // it speaks again: not taken over
    CHECK_FALSE(ownership.may_speak(at(2)));
    CHECK(ownership.takeovers() == 0);
    now = pass(ownership, now, 2s);
    ownership.heard(at(2), now);
    CHECK_FALSE(ownership.may_speak(at(1)));
    const LinkReport report = report_of(ownership);
    REQUIRE(report.takeovers.size() == 1);
    CHECK(report.takeovers[0].from == "127.0.0.1:1");
    CHECK(report.takeovers[0].to == "127.0.0.1:2");
    CHECK(report.takeovers[0].at == 4s);
  }

  TEST_CASE("unless it is said otherwise a link is its owner's until it has been silent for 5 s") {
    Ownership ownership;
    auto now = Clock::time_point(100s);
    ownership.begin(now);
    ownership.heard(at(1), now);
    now = pass(ownership, now, 4990ms);
    CHECK_FALSE(ownership.is_silent());
    CHECK_FALSE(ownership.may_speak(at(2)));
    now = pass(ownership, now, 10ms);
    CHECK(ownership.is_silent());
    CHECK(ownership.may_speak(at(2)));
  }

  TEST_CASE("a halt of this machine is no silence of the owner") {
    Ownership ownership(2s);
    const auto now = Clock::time_point(100s);
    ownership.begin(now);
    ownership.heard(at(1), now);
    ownership.look(now + 1h);
    CHECK_FALSE(ownership.may_speak(at(2)));
  }

  TEST_CASE("an owner that has gone leaves the link to the next, which is no takeover") {
    Ownership ownership(2s);
    const auto now = Clock::time_point(100s);
    ownership.begin(now);
    ownership.heard(at(1), now);
    ownership.gone();
    CHECK(ownership.may_speak(at(2)));
    ownership.heard(at(2), now);
    CHECK(ownership.takeovers() == 0);
  }

  TEST_CASE("a named peer owns the link for ever") {
    Ownership ownership(1ms, at(1));
    const auto now = Clock::time_point(100s);
    ownership.begin(now);
    CHECK_FALSE(ownership.may_speak(at(2)));
    ownership.gone();
    pass(ownership, now, 10s);
    CHECK_FALSE(ownership.may_speak(at(2)));
    CHECK(ownership.may_speak(at(1)));
  }

  TEST_CASE("strangers and takeovers are listed up to sixteen, and counted beyond") {
    Ownership ownership(1ms);
    auto now = Clock::time_point(100s);
    ownership.begin(now);
    for (int port = 1; port <= 20; ++port)
      for (int times = 0; times < port; ++times) ownership.count_stranger(at(port));
    for (int port = 1; port <= 20; ++port) {
      ownership.heard(at(port), now);
      now = pass(ownership, now, 1ms);
    }
    const LinkReport report = report_of(ownership);
    REQUIRE(report.strangers.size() == 16);
    CHECK(report.strangers[15].address == "127.0.0.1:16");
    CHECK(report.strangers[15].times == 16);
    CHECK(report.more_strangers == 17 + 18 + 19 + 20);
    CHECK(report.takeovers.size() == 16);
    CHECK(ownership.takeovers() == 19);
  }

  TEST_CASE("a link with two places is that of the first two that speak; the one that is silent gives its place up") {
    Ownership ownership(2s, {}, 2);
    auto now = Clock::time_point(100s);
    ownership.begin(now);
    CHECK(ownership.heard(at(1), now) == 0);
    now = pass(ownership, now, 1s);
    CHECK(ownership.may_speak(at(2)));
    CHECK(ownership.heard(at(2), now) == 1);
    CHECK_FALSE(ownership.may_speak(at(3)));
    now = pass(ownership, now, 1s);
    CHECK(ownership.is_silent(0));
    CHECK_FALSE(ownership.is_silent(1));
    CHECK(ownership.may_speak(at(3)));
    CHECK(ownership.heard(at(3), now) == 0);
    CHECK_FALSE(ownership.is_owner(at(1)));
    CHECK_FALSE(ownership.may_speak(at(1)));
    CHECK(ownership.is_owner(at(2)));
    ownership.gone(1);
    CHECK(ownership.heard(at(1), now) == 1);  // a free place
    const LinkReport report = report_of(ownership);
    REQUIRE(report.takeovers.size() == 1);
    CHECK(report.takeovers[0].from == "127.0.0.1:1");
    CHECK(report.takeovers[0].to == "127.0.0.1:3");
    CHECK(report.takeovers[0].at == 2s);
    REQUIRE(report.peers.size() == 3);
    CHECK(report.peers[0].address == "127.0.0.1:1");
    CHECK(report.peers[0].packets == 2);
    CHECK(report.peers[1].address == "127.0.0.1:2");
    CHECK(report.peers[1].packets == 1);
    CHECK(report.peers[2].address == "127.0.0.1:3");
    CHECK(report.peers[2].packets == 1);
  }

  TEST_CASE("with several places a tenure begins when one comes while no other is there, or all others are silent") {
    Ownership ownership(2s, {}, 3);
    auto now = Clock::time_point(100s);
    ownership.begin(now);
    CHECK(ownership.tenure_of(at(1)) == 1);
    ownership.heard(at(1), now);
    CHECK(ownership.tenure_of(at(1)) == 1);
    CHECK(ownership.tenure_of(at(2)) == 1);
    ownership.heard(at(2), now);
    ownership.gone(0);
    CHECK(ownership.tenure_of(at(1)) == 1);  // the other is still there
    ownership.gone(1);
    CHECK(ownership.tenure_of(at(1)) == 2);
    ownership.heard(at(3), now);
    CHECK(ownership.tenure_of(at(3)) == 2);
    now = pass(ownership, now, 2s);
    CHECK(ownership.tenure_of(at(3)) == 2);  // it speaks again
    CHECK(ownership.tenure_of(at(1)) == 3);
    ownership.heard(at(1), now);
    CHECK(ownership.tenure_of(at(3)) == 3);
    CHECK(ownership.takeovers() == 0);
  }

  TEST_CASE("of random speakers and silences those are heard who ought to be, for as many places as there are") {
    // the rule again, from the times at which each of the owners spoke alone
    std::mt19937 random(7);
    for (int round = 0; round < 400; ++round) {
      const auto limit = 100ms * (1 + random() % 5);
      const std::size_t places = 1 + random() % 4;
      CAPTURE(places);
      Ownership ownership(limit, {}, places);
      auto now = Clock::time_point(100s);
      ownership.begin(now);
      std::map<int, Clock::time_point> last;  // of each owner
      std::map<int, std::uint64_t> strangers, spoken;
      std::map<int, std::size_t> place;
      std::uint64_t takeovers = 0;
      std::uint32_t tenure = 0;
      for (int step = 0; step < 300; ++step) {
        now = pass(ownership, now, std::chrono::milliseconds(1 + random() % (random() % 8 == 0 ? 700 : 60)));
        const int speaker = 1 + static_cast<int>(random() % 6);
        const bool valid = random() % 3 != 0;
        if (random() % 50 == 0 && !last.empty()) {
          const int leaver = std::next(last.begin(), static_cast<int>(random() % last.size()))->first;
          ownership.gone(place[leaver]);
          last.erase(leaver);
        }
        const auto longest = std::min_element(last.begin(), last.end(),
                                              [](const auto& a, const auto& b) { return a.second < b.second; });
        const bool is_silent = longest != last.end() && now - longest->second >= limit;
        const bool may = last.count(speaker) > 0 || last.size() < places || is_silent;
        REQUIRE(ownership.may_speak(at(speaker)) == may);
        const bool alone = std::none_of(last.begin(), last.end(), [&](const auto& owner) {
          return owner.first == speaker || now - owner.second < limit;
        });
        REQUIRE(ownership.tenure_of(at(speaker)) == tenure + (alone ? 1 : 0));
        if (!may) {
          ownership.count_stranger(at(speaker));
          ++strangers[speaker];
        } else if (valid) {
          place[speaker] = ownership.heard(at(speaker), now);
          tenure += alone ? 1 : 0;
          ++spoken[speaker];
          if (last.count(speaker) == 0 && last.size() == places) {
            ++takeovers;
            last.erase(longest);
          }
          last[speaker] = now;
        }
      }
      CHECK(ownership.takeovers() == takeovers);
      const LinkReport report = report_of(ownership);
      CHECK(report.strangers.size() == strangers.size());
      for (const LinkReport::Stranger& stranger : report.strangers)
        CHECK(stranger.times == strangers[Address::parse(stranger.address).port()]);
      CHECK(report.peers.size() == (places == 1 ? 0 : spoken.size()));
      for (const LinkReport::Peer& peer : report.peers)
        CHECK(peer.packets == spoken[Address::parse(peer.address).port()]);
    }
  }
}
