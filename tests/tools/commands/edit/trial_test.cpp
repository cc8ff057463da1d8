// A text that is run in simulation: whatever it does, the editor goes on.
#include "tools/commands/edit/trial.h"

#include <doctest/doctest.h>

#include <condition_variable>
#include <filesystem>
#include <optional>

#include "graph/text/errors.h"
#include "tests/tools/console/client.h"
#include "tests/tools/run_command.h"

namespace {
using namespace std::chrono_literals;
using command::content;
using command::TemporaryFolder;
using jarol::tools::edit::Trial;
using jarol::tools::edit::TrialEnd;
using jarol::tools::edit::TrialOptions;

std::string program() { return std::filesystem::absolute(JAROL_COMMAND); }

// A trial, and how it goes.
class Tried {
 public:
  explicit Tried(const TrialOptions& options)
      : trial_(
            program(), options,
            [this](const std::string& url) {
              const std::lock_guard lock(mutex_);
              url_ = url;
              news_.notify_all();
            },
            [this](const TrialEnd& end) {
              const std::lock_guard lock(mutex_);
              end_ = end;
              news_.notify_all();
            }) {}

  TrialEnd end() {
    std::unique_lock lock(mutex_);
    REQUIRE(news_.wait_for(lock, 60s, [this] { return end_.has_value(); }));
    return *end_;
  }
  std::string url() {
    std::unique_lock lock(mutex_);
    REQUIRE(news_.wait_for(lock, 60s, [this] { return !url_.empty(); }));
    return url_;
  }
  void stop() { trial_.stop(); }

 private:
  std::mutex mutex_;
  std::condition_variable news_;
  std::optional<TrialEnd> end_;
  std::string url_;
  Trial trial_;  // last: its thread calls what stands above
};

std::string digest_in(const std::string& output) {
  const std::size_t at = output.find("digest      0x");
  return at == std::string::npos ? output : output.substr(at + 12, 18);
}
}  // namespace

TEST_SUITE("editor/trial") {
  TEST_CASE("a text is run as its file would be") {
    const TrialEnd end =
        Tried({.file = "specs/counting.yaml", .text = content("specs/counting.yaml"), .length = "1s"}).end();
    CHECK(end.exit_code == 0);
    CHECK_FALSE(end.ended);
    CHECK(digest_in(end.text) == digest_in(command::run_jarol("run specs/counting.yaml --for 1s").output));
  }

#ifdef JAROL_VEHICLES
  TEST_CASE("paths in it are those of its file's folder") {
    const TemporaryFolder folder;
    std::filesystem::create_directory(folder / "missions");
    std::filesystem::copy("specs/missions/dive.csv", folder / "missions");
    std::filesystem::create_directory(folder / "vehicles");
    std::filesystem::copy("specs/vehicles/submarine.yaml", folder / "vehicles");
    const std::string text = content("specs/exolauv.yaml");
    const TrialEnd end = Tried({.file = folder / "edited.yaml", .text = text, .length = "1s"}).end();
    CHECK(digest_in(end.text) == digest_in(command::run_jarol("run specs/exolauv.yaml --for 1s").output));
    CHECK_FALSE(std::filesystem::exists(folder / "edited.yaml"));
  }
#endif

  TEST_CASE("a text that is wrong is reported as such") {
    const TrialEnd end = Tried({.file = "specs/counting.yaml", .text = "graph: [\n"}).end();
    CHECK(end.exit_code == 2);
    CHECK(end.text.find("error: ") != std::string::npos);
  }

  TEST_CASE("a task that crashes ends the run alone") {
    const std::string plugin = std::filesystem::absolute(JAROL_PLUGIN_FOLDER "/crash.so");
    const std::string text = "graph: a\ntiming: {period: 10ms}\nplugins: [" + plugin + R"(]
communicators: {from: {type: JaviatorSensors, direction: in}, to: {type: MotorCommand, direction: out}}
tasks: {a: {type: CrashingPilot, isolation: weak, parameters: {way: segmentation}}}
connections: [from -> a.sensors, a.motors -> to]
)";
    const TrialEnd end = Tried({.file = "specs/counting.yaml", .text = text, .length = "1s"}).end();
    CAPTURE(end.text);
    CHECK(end.exit_code < 0);
  }

  TEST_CASE("what takes long is stopped, by whoever asks or by itself") {
    const std::string text = content("specs/counting.yaml");
    Tried asked({.file = "specs/counting.yaml", .text = text, .length = "1000h"});
    asked.stop();
    CHECK(asked.end().ended);
    const TrialEnd late = Tried({.file = "specs/counting.yaml", .text = text, .length = "1000h", .longest = 1s}).end();
    CHECK(late.ended);
    // the run's own words on Ctrl-C
    CHECK(late.exit_code == 130);
  }

  TEST_CASE("a run that is watched says where") {
    Tried tried(
        {.file = "specs/counting.yaml", .text = content("specs/counting.yaml"), .length = "1h", .watched = true});
    const std::string url = tried.url();
    CHECK(jarol::tests::PageSocket(url).read()->at("hello")["graph"] == "counting");
    tried.stop();
    CHECK(tried.end().ended);
  }

  TEST_CASE("what is no length or profile is not handed to a command") {
    const auto none = [](const auto&) {};
    CHECK_THROWS_WITH_AS(Trial(program(), {.file = "a.yaml", .length = "--json"}, none, none),
                         "the length '--json' has the unit '-json'; write one of h, min, s, ms, us or ns",
                         jarol::InputError);
    CHECK_THROWS_WITH_AS(Trial(program(), {.file = "a.yaml", .profile = "--json"}, none, none),
                         "'--json' is no name of a profile", jarol::InputError);
  }
}
