// The server of a console, and all that may be tried against it.
#include "tools/console/server.h"

#include <doctest/doctest.h>
#include <unistd.h>

#include <chrono>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "graph/text/errors.h"
#include "tests/tools/console/served.h"

namespace {
using namespace jarol;
using tests::HttpAnswer;
using tests::PageSocket;
using tests::Place;
using tests::Served;
using tests::SilentConnection;
using tools::console::Page;
using tools::console::Server;

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

  TEST_CASE("a server on all addresses is called by the machine's name, which others can open") {
    for (const std::string all : {"0.0.0.0", "::"}) {
      const Server server(
          {.listen = all}, "", [] { return std::vector<std::string>(); },
          [](const Page&, const std::string&) { return ""; });
      char name[256] = {};
      REQUIRE(::gethostname(name, sizeof name - 1) == 0);
      CHECK(server.url().starts_with("http://" + std::string(name) + ":"));
    }
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

  TEST_CASE("connections that have not shown the token keep nobody out who has it") {
    Served served;
    const Place place = served.place();
    PageSocket before(served.server.url());
    std::vector<SilentConnection> silent;
    for (std::size_t i = 0; i < Server::max_clients + 50; ++i) silent.emplace_back(place);
    for (int i = 0; i < 3; ++i) CHECK(get(place, place.target).status == 200);
    PageSocket late(served.server.url());
    CHECK(late.read()->contains("hello"));
    served.said("on");
    CHECK(before.read_with("say")["say"] == "on");
    // the oldest ones have made room, long before their time is over
    const auto begun = std::chrono::steady_clock::now();
    for (int i = 0; i < 50; ++i) silent[i].wait_for_end();
    CHECK(std::chrono::steady_clock::now() - begun < std::chrono::seconds(5));
  }

  TEST_CASE("pages fill all places against connections that have not shown the token") {
    Served served;
    std::vector<SilentConnection> silent;
    for (std::size_t i = 0; i < Server::max_clients; ++i) silent.emplace_back(served.place());
    std::vector<PageSocket> all;
    for (std::size_t i = 0; i < Server::max_clients; ++i) all.emplace_back(served.server.url());
    CHECK(refusal(served.server.url()) == "503: too many watch; try again later\n");
    served.said("on");
    for (PageSocket& one : all) CHECK(one.read_with("say")["say"] == "on");
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
        "the console can't listen on 'nowhere', which is no address; write it as in 127.0.0.1 or 0.0.0.0", InputError);
  }
}
