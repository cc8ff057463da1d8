#include "graph/model/parameters.h"

#include <doctest/doctest.h>

#include <memory>
#include <string>

namespace {
using namespace jarol;

DistributerClass sonde() {
  DistributerClass sonde;
  sonde.name = "Sonde";
  return sonde;
}

std::string report_of(const std::string& text) {
  Problems problems;
  const Yaml yaml = read_yaml(std::make_shared<Source>(Source{"p.yaml", text}), problems);
  read_parameters("probe", sonde(), &yaml, problems);
  try {
    problems.throw_if_any();
  } catch (const SpecError& error) { return error.what(); }
  return "";
}
}  // namespace

TEST_SUITE("graph/model/parameters") {
  TEST_CASE("parameters of a distributer of a program whose class has none are an error, and none are not") {
    CHECK(report_of("{rate: 1}") ==
          "p.yaml:1:1: error: distributer 'probe' (Sonde) has no parameters\n  {rate: 1}\n  ^");
    Problems problems;
    read_parameters("probe", sonde(), nullptr, problems);
    problems.throw_if_any();
  }
}
