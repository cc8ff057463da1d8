#include "runtime/record/trace_csv.h"

#include <doctest/doctest.h>

#include <filesystem>

#include "graph/language/yaml.h"
#include "graph/values/type_of.h"
#include "tasks/values/lauv.h"

namespace {
using namespace jarol;

std::string text_of(const std::string& path) { return jarol::read_source(path)->text; }

std::string temporary(const std::string& name) { return (std::filesystem::temp_directory_path() / name).string(); }
}  // namespace

TEST_SUITE("runtime/trace_csv") {
  TEST_CASE("a row per instant, a column per number in order of name, empty where nothing was published") {
    const std::string path = temporary("jarol_trace_test.csv");
    const std::vector<Output> outputs{{"a.out", &type_of<double>()}, {"fins.actuation", &type_of<tasks::Actuation>()}};
    TraceCsv trace(path, outputs);
    const double tenth = 0.1;
    const tasks::Actuation actuation{1, {-0.5, 1e-7, 3, 1.0 / 3}};
    trace.take(Duration(0), 0, &tenth);
    trace.take(Duration(50'000'000), 0, &tenth);
    trace.take(Duration(50'000'000), 1, &actuation);
    trace.take(Duration(60'000'001), 1, &actuation);
    CHECK_FALSE(std::filesystem::exists(path));  // not before it is whole
    trace.finish();
    CHECK(text_of(path) ==
          "time,a.out,fins.actuation.fins.0,fins.actuation.fins.1,fins.actuation.fins.2,fins.actuation.fins.3,"
          "fins.actuation.thruster\n"
          "0,0.1,,,,,\n"
          "0.05,0.1,-0.5,1e-07,3,0.3333333333333333,1\n"
          "0.060000001,,-0.5,1e-07,3,0.3333333333333333,1\n");
    std::filesystem::remove(path);
  }

  TEST_CASE("a trace that can't be written says why") {
    CHECK_THROWS_WITH_AS(TraceCsv("no/such/folder/x.csv", {}),
                         "can't write 'no/such/folder/x.csv': No such file or directory", std::runtime_error);
  }

  TEST_CASE("a run that is not brought to its end leaves no file") {
    const std::string path = temporary("jarol_trace_unfinished.csv");
    { TraceCsv trace(path, {}); }
    CHECK_FALSE(std::filesystem::exists(path));
  }
}
