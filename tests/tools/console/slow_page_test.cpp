// Pages that are slow: they show what is, or learn what they have missed, and hold nobody up.
#include <doctest/doctest.h>

#include <chrono>
#include <memory>
#include <string>
#include <thread>

#include "tests/tools/console/served.h"

namespace {
using jarol::tests::PageSocket;
using jarol::tests::Served;
}  // namespace

TEST_SUITE("console/slow_page") {
  TEST_CASE("a slow reader misses, is informed, and holds nobody up") {
    Served served;
    PageSocket slow(served.server.url(), "", 4096), quick(served.server.url());
    CHECK(slow.read()->contains("hello"));
    CHECK(quick.read()->contains("hello"));
    const std::string large(50'000, 'x');
    for (int round = 0; round < 40; ++round) {
      for (int i = 0; i < 10; ++i) served.said(large);
      for (int i = 0; i < 10; ++i) CHECK(quick.read_with("say")["say"].get<std::string>().size() == large.size());
    }
    served.said("end");
    CHECK(quick.read_with("say")["say"] == "end");
    std::uint64_t missed = 0, got = 0;
    for (auto message = slow.read(); message; message = slow.read()) {
      if (message->contains("missed")) missed += message->at("missed").get<std::uint64_t>();
      if (message->contains("say")) ++got;
      if (message->contains("say") && message->at("say") == "end") break;
    }
    CHECK(missed > 0);
    CHECK(missed + got == 401);
  }

  TEST_CASE("a page that says what it has seen gets no more while it is behind, and then the newest") {
    Served served;
    PageSocket page(served.server.url()), other(served.server.url());
    CHECK(page.read()->contains("hello"));
    CHECK(other.read()->contains("hello"));
    page.send(R"({"do": "seen", "messages": 1})");
    page.send("behind");
    CHECK(page.read_with("behind")["behind"] == 0);
    page.send(R"({"do": "seen", "messages": 2})");
    int sent = 2, shown = 0;
    // each comes in a frame of its own
    for (int i = 0; i < 80; ++i) {
      served.said("one");
      CHECK(other.read_with("say")["say"] == "one");
    }
    page.send("behind");
    page.send(R"({"do": "seen", "messages": 3})");
    std::uint64_t missed = 0;
    std::int64_t behind = 0;
    for (auto message = page.read(); message; message = page.read()) {
      ++sent;
      page.send(R"({"do": "seen", "messages": )" + std::to_string(sent) + "}");
      if (message->contains("say")) ++shown;
      if (message->contains("missed")) missed += message->at("missed").get<std::uint64_t>();
      if (message->contains("behind")) behind = message->at("behind").get<std::int64_t>();
      if (missed > 0 && behind > 0 && shown + static_cast<int>(missed) == 80) break;
    }
    CHECK(shown < 30);
    // 80 frames of 33 ms, less than the patience of 200 ms and what a busy machine takes
    CHECK(behind > 2'000'000'000);
    page.send("behind");
    CHECK(page.read_with("behind")["behind"].get<std::int64_t>() < behind);
  }

  TEST_CASE("what was not sent can't have been seen") {
    Served served;
    PageSocket page(served.server.url());
    CHECK(page.read()->contains("hello"));
    page.send(R"({"do": "seen", "messages": 2})");
    CHECK(page.read_with("error")["error"] == "'messages' of seen is 2, of 1 that were sent and 0 seen");
    page.send(R"({"do": "seen", "messages": -1})");
    CHECK(page.read_with("error")["error"] == R"(expected a whole number as in {"do": "seen", "messages": 12})");
    CHECK(served.asked == 0);
  }

  TEST_CASE("a page that asks on and does not take its answers is closed") {
    Served served;
    PageSocket page(served.server.url(), "", 4096), quiet(served.server.url());
    CHECK(page.read()->contains("hello"));
    // 4 MB, and what sockets hold
    for (int i = 0; i < 90; ++i) page.send("large");
    std::this_thread::sleep_for(std::chrono::milliseconds(1100));
    for (int i = 0; i < 90; ++i) page.send("large");
    while (page.read()) {}
    CHECK(page.close_code() == 1008);
    CHECK(page.close_reason() == "does not take its answers");
    quiet.send("echo");
    CHECK(quiet.read_with("echo")["echo"] == 1);
  }

  TEST_CASE("at the end a page that is slow and goes on gets the last, for five seconds at most") {
    auto served = std::make_unique<Served>();
    PageSocket page(served->server.url()), other(served->server.url());
    CHECK(page.read()->contains("hello"));
    page.send(R"({"do": "seen", "messages": 1})");
    page.send("behind");
    CHECK(page.read_with("behind")["behind"] == 0);
    page.send(R"({"do": "seen", "messages": 2})");
    for (int i = 0; i < 20; ++i) {
      served->said(std::to_string(i));
      CHECK(other.read_with("say")["say"] == std::to_string(i));
    }
    std::thread ends([&] { served.reset(); });
    std::string last;
    int seen = 2;
    for (auto message = page.read(); message; message = page.read()) {
      if (message->contains("say")) last = message->at("say");
      if (last != "19") std::this_thread::sleep_for(std::chrono::milliseconds(300));
      page.send(R"({"do": "seen", "messages": )" + std::to_string(++seen) + "}");
    }
    ends.join();
    CHECK(last == "19");
    CHECK(page.close_code() == 1001);
  }
}
