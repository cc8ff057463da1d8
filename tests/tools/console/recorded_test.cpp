// A recording at the console: shown as its run published it.
#include <doctest/doctest.h>

#include <map>
#include <nlohmann/json.hpp>

#include "tests/tools/console/client.h"
#include "tests/tools/console/digest_in.h"
#include "tests/tools/process.h"
#include "tests/tools/run_command.h"

namespace {
using namespace jarol;
using command::TemporaryFolder;
using nlohmann::json;
using tests::digest_in;
using tests::PageSocket;
}  // namespace

TEST_SUITE("console/recorded") {
  TEST_CASE("console: a recording is shown as its run published it, until Ctrl-C") {
    const TemporaryFolder folder;
    const std::string file = folder / "counting.mcap";
    const std::string digest =
        digest_in(command::run_jarol("run specs/counting.yaml --for 2s --record " + file).output);
    tests::Process shown("console " + file);
    const std::string url = shown.rest_of_line("console: ");
    REQUIRE(url.starts_with("http://127.0.0.1:"));
    PageSocket page(url);
    const json hello = page.read()->at("hello");
    CHECK(hello["clock"] == "recorded");
    CHECK(hello["file"] == file);
    CHECK(hello["until"] == 2.0);
    std::map<std::string, std::size_t> values;
    auto message = page.read();
    for (; !message->contains("ended"); message = page.read())
      for (const json& sample : message->value("samples", json::array()))
        ++values[hello["outputs"][sample[0].get<std::size_t>()]["name"]];
    CHECK(values["count.out"] == 200);
    CHECK(values["slow.out"] == 100);
    CHECK(values["loop.out"] == 39);  // the last one of two seconds is at their end
    CHECK(values["total"] == 20);
    CHECK(digest_in(message->at("ended")) == digest);
    shown.interrupt();
    CHECK(shown.end() == 130);
  }

  TEST_CASE(
      "console: of a recording that is damaged after its begin what stands before that is shown, and it is said") {
    const TemporaryFolder folder;
    const std::string file = folder / "counting.mcap";
    command::run_jarol("run specs/counting.yaml --for 20s --record " + file);
    std::string bytes = command::content(file);
    // in its first chunk, behind the header, which names the library; its end, which is read first, is whole
    bytes[bytes.find("lz4", bytes.find("lz4") + 1) + 100] ^= 1;
    folder.write("counting.mcap", bytes);
    tests::Process shown("console " + file);
    PageSocket page(shown.rest_of_line("console: "));
    CHECK(page.read()->at("hello")["until"] == 20.0);
    auto message = page.read();
    while (!message->contains("ended")) message = page.read();
    CHECK(message->at("ended") ==
          "recorded    specs/counting.yaml on the virtual clock\nit breaks off; how the run ended is not known\n");
    shown.interrupt();
    CHECK(shown.end() == 130);
  }

  TEST_CASE("console: what is no recording is refused with its name") {
    const TemporaryFolder folder;
    const std::string file = folder.write("none.mcap", "garbage");
    const auto refused = command::run_jarol("console " + file);
    CHECK(refused.exit_code == 2);
    CHECK(refused.output == command::run_jarol("replay " + file).output);
    CHECK(command::run_jarol("console " + (folder / "nowhere.mcap")).exit_code == 2);
  }
}
