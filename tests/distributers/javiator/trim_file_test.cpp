#include "distributers/javiator/trim_file.h"

#include <doctest/doctest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "distributers/interfaces/typed.h"
#include "distributers/javiator/operator.h"
#include "distributers/messages/javiator.h"
#include "graph/language/source_set.h"
#include "graph/text/errors.h"

namespace {
using namespace jarol;
using namespace jarol::distributers;

// A file in a folder that is gone afterwards.
struct Place {
  Place() { std::filesystem::create_directory(folder); }
  ~Place() { std::filesystem::remove_all(folder); }
  void hold(const std::string& text) const { std::ofstream(path()) << text; }
  std::string path() const { return folder / "trim.txt"; }
  const std::filesystem::path folder =
      std::filesystem::temp_directory_path() / ("jarol_trim_" + std::to_string(::getpid()));
};

struct Nobody : messages::Receiver {
  void receive(messages::MessageRef) override {}
};

tasks::PilotCommand command_of(Typed<JaviatorOperator>& adapter) {
  tasks::PilotCommand command;
  REQUIRE(adapter.take<&JaviatorOperator::In::command>(command));
  return command;
}
}  // namespace

TEST_SUITE("distributers/trim_file") {
  TEST_CASE("a trim comes back to the bit; where there is no file, there is no trim") {
    const Place place;
    CHECK(read_trim(place.path()) == Trim{});
    const Trim trim{0.1 / 3, -1e-9};
    write_trim(place.path(), trim);
    CHECK(read_trim(place.path()) == trim);
    write_trim(place.path(), {});
    CHECK(read_trim(place.path()) == Trim{});
  }

  TEST_CASE("where the files of runs are given, a trim is that of these files, or none") {
    const Place place;
    const Trim before{0.01, 0.02};
    write_trim(place.path(), before);
    const SourceSet read;
    CHECK(read_trim(place.path()) == before);
    const SourceSet::Sources files = read.read();
    write_trim(place.path(), {0.5, 0.5});
    {
      const SourceSet given(files, "it was not there");
      CHECK(read_trim(place.path()) == before);
      std::filesystem::remove(place.path());
      CHECK(read_trim(place.path()) == before);
      CHECK(given.missed().empty());
    }
    write_trim(place.path(), {0.5, 0.5});
    const SourceSet::Sources none;
    const SourceSet closed(none, "it was not there");
    CHECK(read_trim(place.path()) == Trim{});
  }

  TEST_CASE("what is no trim file is an error that says what would be right") {
    const Place place;
    for (const char* text : {"", "roll 0.1", "pitch 0.1\nroll 0.1\n", "roll x\npitch 0\n", "roll 0\npitch 1.5\n"}) {
      CAPTURE(text);
      place.hold(text);
      CHECK_THROWS_WITH_AS(read_trim(place.path()),
                           ("'" + place.path() +
                            "' is no trim file; it needs a line 'roll' and a line 'pitch', each with a number of rad "
                            "from -1 to 1")
                               .c_str(),
                           InputError);
    }
    CHECK_THROWS_WITH_AS(write_trim("/no/such/folder/trim.txt", {}),
                         "can't write the trim to '/no/such/folder/trim.txt'", InputError);
  }

  TEST_CASE("what was trimmed in a run is the level at the start of the next") {
    const Place place;
    JaviatorOperatorParameters parameters;
    parameters.trim_file = place.path();
    Nobody nobody;
    {
      Typed<JaviatorOperator> first(parameters);
      CHECK(command_of(first).kept_trim_roll == 0);
      const tasks::HelicopterReport report{.trim_roll = 0.02, .trim_pitch = -0.01};
      first.hand_over<&JaviatorOperator::Out::report>(report, nobody);
      first.finish();
    }
    Typed<JaviatorOperator> second(parameters);
    CHECK(command_of(second).kept_trim_roll == 0.02);
    CHECK(command_of(second).kept_trim_pitch == -0.01);
    // nothing new: nothing is written
    std::filesystem::remove(place.path());
    second.finish();
    CHECK_FALSE(std::filesystem::exists(place.path()));
  }

  TEST_CASE("without a trim file each run begins level") {
    Nobody nobody;
    Typed<JaviatorOperator> adapter;
    const tasks::HelicopterReport report{.trim_roll = 0.02};
    adapter.hand_over<&JaviatorOperator::Out::report>(report, nobody);
    adapter.finish();
    Typed<JaviatorOperator> next;
    CHECK(command_of(next).kept_trim_roll == 0);
  }

  TEST_CASE("a trim file is a small file") {
    const Place place;
    std::ofstream(place.path()) << "roll 0\npitch 0\n" << std::string(4096, 'x');
    CHECK_THROWS_WITH_AS(
        read_trim(place.path()),
        ("'" + place.path() +
         "' is no trim file; it needs a line 'roll' and a line 'pitch', each with a number of rad from "
         "-1 to 1")
            .c_str(),
        InputError);
  }
}
