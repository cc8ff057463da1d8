// The server of a console, and all that may be tried against it.
#include "tools/console/server.h"

#include <doctest/doctest.h>

#include <atomic>
#include <mutex>
#include <thread>

#include "tests/tools/console/client.h"

namespace {
using namespace jarol;
using tests::HttpAnswer;
using tests::PageSocket;
using tests::Place;
using tools::console::Page;
using tools::console::Server;

// A server whose messages the test says.
struct Served {
  std::mutex mutex;
  std::vector<std::string> next;
  std::atomic<int> asked{0};
  Server server{{},
                R"({"hello": {"schema": "test"}})",
                [this] {
                  const std::lock_guard lock(mutex);
                  return std::exchange(next, {});
                },
                [this](const Page& page, const std::string& message) -> std::string {
                  ++asked;
                  if (message == "number") return R"({"number": )" + std::to_string(page.number) + "}";
                  if (message == "behind") return R"({"behind": )" + std::to_string(page.behind.count()) + "}";
                  if (message == "large") return R"({"large": ")" + std::string(100'000, 'x') + "\"}";
                  if (message == "wrong") throw std::invalid_argument("expected something else");
                  return message == "echo" ? R"({"echo": 1})" : "";
                },
                [this](std::uint64_t page) { say(R"({"left": )" + std::to_string(page) + "}"); }};

  void say(const std::string& message) {
    const std::lock_guard lock(mutex);
    next.push_back(message);
  }
  std::string said(const std::string& what) {
    say(R"({"say": ")" + what + "\"}");
    return what;
  }
  Place place() const { return Place(server.url()); }
};

// What a page that asks for its socket gets; "none": it has it.
std::string refusal(const std::string& url, const std::string& origin = "") {
  const Place place(url);
  const HttpAnswer answer = get(place, place.socket_target(),
                                "Connection: Upgrade\r\nUpgrade: websocket\r\nSec-WebSocket-Version: 13\r\n"
                                "Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\n" +
                                    (origin.empty() ? "" : "Origin: " + origin + "\r\n"));
  return answer.status == 101 ? "none" : std::to_string(answer.status) + ": " + answer.body;
}
}  // namespace

TEST_SUITE("console/server") {
  TEST_CASE("the address that is printed leads to the page, with all that keeps it to itself") {
    const Served served;
    const Place place = served.place();
    CHECK(place.host == "127.0.0.1");
    const HttpAnswer page = get(place, place.target);
    CHECK(page.status == 200);
    CHECK(page.headers.at("content-type") == "text/html; charset=utf-8");
    CHECK(page.headers.at("content-security-policy")
              .starts_with("default-src 'none'; script-src 'self'; style-src 'self'; "));
    CHECK(page.headers.at("x-content-type-options") == "nosniff");
    CHECK(page.headers.at("referrer-policy") == "no-referrer");
    CHECK(page.body.size() > 100);
    const std::string etag = page.headers.at("etag");
    const HttpAnswer again = get(place, place.target, "If-None-Match: " + etag + "\r\n");
    CHECK(again.status == 304);
    CHECK(again.body == "");
    const HttpAnswer head = ask(place, "HEAD / HTTP/1.1\r\nHost: x\r\n\r\n");
    CHECK(head.status == 200);
    CHECK(head.body == "");
  }

  TEST_CASE("what is not there, and what is no question, is said") {
    const Served served;
    const Place place = served.place();
    CHECK(get(place, "/../../etc/passwd").status == 404);
    CHECK(get(place, "/none").body == "there is no such file; the page is at /\n");
    CHECK(ask(place, "POST / HTTP/1.1\r\nHost: x\r\n\r\n").status == 405);
    CHECK(get(place, "/socket").status == 426);
    CHECK(ask(place, "\x16\x03\x01 garbage\r\n\r\n").status == 0);
    CHECK(ask(place, "GET / HTTP/1.1\r\nX: " + std::string(100'000, 'x') + "\r\n\r\n").status != 200);
    CHECK(get(place, "/").status == 200);
  }

  TEST_CASE("without the token nobody watches") {
    const Served served;
    const std::string url = served.server.url(), bare = url.substr(0, url.find("token="));
    const std::string why = "403: the token is missing or wrong; open the URL that jarol has printed\n";
    CHECK(refusal(bare) == why);
    CHECK(refusal(bare + "token=") == why);
    CHECK(refusal(url.substr(0, url.size() - 1)) == why);
    CHECK(refusal(url.substr(0, url.size() - 1) + (url.back() == '0' ? "1" : "0")) == why);
    CHECK(refusal(url + "0") == why);
    CHECK(refusal(bare + "x=1&" + url.substr(url.find("token="))) == "none");
  }

  TEST_CASE("a page that was not served from here does not watch, whatever it knows") {
    const Served served;
    const std::string url = served.server.url(), own = url.substr(0, url.find("/?"));
    CHECK(refusal(url, own) == "none");
    for (const std::string foreign : {"http://evil.example", "null", "http://127.0.0.1:1", "file://"})
      CHECK(refusal(url, foreign) == "403: this page was not served from here\n");
  }

  TEST_CASE("tokens are not the same twice") {
    const Served one, two;
    CHECK(one.place().target != two.place().target);
    CHECK(one.place().target.size() == std::string("/?token=").size() + 32);
  }

  TEST_CASE("a page gets the description, then all that is shown, also what was shown before it came") {
    Served served;
    PageSocket first(served.server.url());
    CHECK(first.read() == nlohmann::json{{"hello", {{"schema", "test"}}}});
    served.said("one");
    CHECK(first.read_with("say")["say"] == "one");
    PageSocket second(served.server.url());
    CHECK(second.read()->contains("hello"));
    CHECK(second.read_with("say")["say"] == "one");
    served.said("two");
    CHECK(first.read_with("say")["say"] == "two");
    CHECK(second.read_with("say")["say"] == "two");
  }

  TEST_CASE("what a page asks for is answered to it alone, and an error is said") {
    Served served;
    PageSocket one(served.server.url()), two(served.server.url());
    one.send("echo");
    CHECK(one.read_with("echo")["echo"] == 1);
    one.send("wrong");
    CHECK(one.read_with("error")["error"] == "expected something else");
    served.said("end");
    CHECK(two.read()->contains("hello"));
    CHECK(two.read()->at("say") == "end");
    CHECK(served.asked == 2);
  }

  TEST_CASE("pages have numbers, and who has left is reported, however it did") {
    Served served;
    PageSocket one(served.server.url()), two(served.server.url());
    two.send("number");
    const std::uint64_t number = two.read_with("number")["number"];
    one.send("number");
    CHECK(one.read_with("number")["number"] != number);
    two.cut();
    CHECK(one.read_with("left")["left"] == number);
  }

  TEST_CASE("ten megabytes are refused") {
    Served served;
    PageSocket socket(served.server.url());
    socket.send(std::string(10 << 20, 'x'));
    while (socket.read()) {}
    CHECK(served.asked == 0);
    CHECK(refusal(served.server.url()) == "none");
  }

  TEST_CASE("bytes that are no text are refused") {
    Served served;
    PageSocket socket(served.server.url());
    socket.send_bytes("\xff\x00");
    while (socket.read()) {}
    CHECK(socket.close_code() == 1008);
    CHECK(socket.close_reason() == "expected text, got bytes");
    CHECK(served.asked == 0);
  }

  TEST_CASE("who sends too much is closed, and the others are not") {
    Served served;
    PageSocket loud(served.server.url()), quiet(served.server.url());
    for (int i = 0; i < 100'000; ++i) loud.send("x");
    while (loud.read()) {}
    CHECK(served.asked < 50'000);
    quiet.send("echo");
    CHECK(quiet.read_with("echo")["echo"] == 1);
  }

  TEST_CASE("a socket that is cut is forgotten") {
    Served served;
    for (int i = 0; i < 300; ++i) PageSocket(served.server.url()).cut();
    // more than may watch at once: those are gone
    PageSocket socket(served.server.url());
    CHECK(socket.read()->contains("hello"));
  }

  TEST_CASE("a hundred watch") {
    Served served;
    std::vector<PageSocket> all;
    for (int i = 0; i < 100; ++i) all.emplace_back(served.server.url());
    served.said("all");
    for (PageSocket& one : all) CHECK(one.read_with("say")["say"] == "all");
  }

  TEST_CASE("more than may watch are turned away, with a word") {
    Served served;
    std::vector<PageSocket> all;
    for (std::size_t i = 0; i < Server::max_clients; ++i) all.emplace_back(served.server.url());
    CHECK(refusal(served.server.url()) == "503: too many watch; try again later\n");
    served.said("on");
    CHECK(all.front().read_with("say")["say"] == "on");
  }

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

  TEST_CASE("at the end pages get what there was, and are closed") {
    auto served = std::make_unique<Served>();
    PageSocket socket(served->server.url());
    CHECK(socket.read()->contains("hello"));
    served->said("last");
    served.reset();
    CHECK(socket.read_with("say")["say"] == "last");
    CHECK_FALSE(socket.read().has_value());
    CHECK(socket.close_code() == 1001);
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

  TEST_CASE("a server that can't be had says why") {
    const Served served;
    CHECK_THROWS_WITH_AS(
        Server(
            {.port = std::stoi(served.place().port)}, "", [] { return std::vector<std::string>(); },
            [](const Page&, const std::string&) { return ""; }),
        doctest::Contains(("the console can't listen on 127.0.0.1 port " + served.place().port + ": ").c_str()),
        std::runtime_error);
    CHECK_THROWS_WITH_AS(
        Server(
            {.listen = "nowhere"}, "", [] { return std::vector<std::string>(); },
            [](const Page&, const std::string&) { return ""; }),
        "the console can't listen on 'nowhere', which is no address; write it as in 127.0.0.1 or 0.0.0.0",
        std::invalid_argument);
  }
}
