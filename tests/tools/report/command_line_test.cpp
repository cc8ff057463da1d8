// What the words of a command line may be, and what is said of others.
#include "tools/report/command_line.h"

#include <doctest/doctest.h>

#include "tests/tools/run_command.h"

namespace {
std::string refusal_of(const std::string& arguments) {
  const command::Result result = command::run_jarol(arguments);
  CHECK(result.exit_code == 2);
  return result.output;
}
}  // namespace

TEST_SUITE("tools/command_line") {
  TEST_CASE("a mistyped option is reported as such, wherever it stands and whatever follows it") {
    const std::string of_graph = "; it has: --help, --set, --profile, --no-plugins, --dot, --svg, --json\n";
    for (const char* const words : {"--profil lab specs/counting.yaml", "specs/counting.yaml --profil lab",
                                    "--profil=lab specs/counting.yaml", "--profil", "no/such.yaml --profil lab"}) {
      CAPTURE(words);
      CHECK(refusal_of(std::string("graph ") + words) ==
            "error: graph has no option '--profil'; did you mean '--profile'?" + of_graph);
    }
    CHECK(refusal_of("graph specs/counting.yaml -x") == "error: graph has no option '-x'" + of_graph);
    CHECK(refusal_of("run specs/counting.yaml --forr 1s")
              .starts_with("error: run has no option '--forr'; did you mean '--for'?; it has: --help, --for, "));
    // a value may begin with a dash, and stand right behind a letter
    CHECK(refusal_of("graph specs/counting.yaml --set -x=1 --profil lab") ==
          "error: graph has no option '--profil'; did you mean '--profile'?" + of_graph);
    CHECK(refusal_of("check --generate waters -ofolder --cout 3")
              .starts_with("error: check has no option '--cout'; did you mean '--count'?; it has: "));
    CHECK(refusal_of("check --generate waters -ofolder --count 0") ==
          "error: --count: Value 0 not in range 1 to 1000000\nRun with --help for more information.\n");
    // behind two dashes stand arguments
    CHECK(refusal_of("graph -- --profil") == "error: can't read '--profil': No such file or directory\n1 error\n");
    const std::string help = "\nRun with --help for more information.\n";
    CHECK(refusal_of("graph specs/counting.yaml another.yaml more.yaml") ==
          "error: graph takes FILE and no more, and has 'another.yaml'" + help);
    CHECK(refusal_of("graph specs/counting.yaml --svg counting.svg") ==
          "error: graph takes FILE and no more, and has 'counting.svg' behind --svg, which takes no value" + help);
    CHECK(refusal_of("doctor now") == "error: doctor takes no argument, and has 'now'" + help);
  }

  TEST_CASE("a flag takes no value, whatever it is") {
    const std::pair<const char*, const char*> flags[] = {{"check", "--sensitivity"},
                                                         {"check", "--chains"},
                                                         {"check", "--measure"},
                                                         {"check", "--write"},
                                                         {"check", "--lower"},
                                                         {"check", "--json"},
                                                         {"run", "--json"},
                                                         {"run", "--spin"},
                                                         {"run", "--force"},
                                                         {"vehicle", "--describe"},
                                                         {"vehicle", "--json"},
                                                         {"vehicle", "--bare"},
                                                         {"graph", "--dot"},
                                                         {"graph", "--json"},
                                                         {"messages", "--json"},
                                                         {"messages", "--decode"},
                                                         {"messages", "--encode"},
                                                         {"tasks", "--json"},
                                                         {"doctor", "--json"},
                                                         {"bench", "--json"},
                                                         {"run", "--no-guardian"},
                                                         {"tasks", "--help"},
                                                         {"tasks", "-h"},
                                                         {"", "--version"},
                                                         {"", "--help"}};
    for (const auto& each : flags)
      for (const std::string value : {"3", "false", "true", ""}) {
        const std::string command = each.first, flag = each.second;
        CAPTURE(command);
        CHECK(refusal_of(command + " " + flag + "=" + value) == "error: " + flag + " takes no value, and has '" +
                                                                    value + "'; write " + flag +
                                                                    " alone, or leave it out\n");
      }
    // what follows an option that takes a value is its value
    CHECK(refusal_of("graph no/such.yaml --profile --json=3") ==
          "error: can't read 'no/such.yaml': No such file or directory\n1 error\n");
    CHECK(refusal_of("graph -- --json=3") == "error: can't read '--json=3': No such file or directory\n1 error\n");
  }

  TEST_CASE("a seed is a whole number of 64 bits in decimal, nothing else") {
    const std::string run = "run specs/counting.yaml --for 10ms --seed ";
    for (const char* const seed : {"0", "7", "18446744073709551615"})
      CHECK(command::run_jarol(run + seed).exit_code == 0);
    for (const std::string seed : {"-1", "18446744073709551616", "010", "0x10", "1.5", "seven", "''", "+7", "-0"}) {
      CAPTURE(seed);
      CHECK(refusal_of(run + seed) ==
            "error: --seed: '" + (seed == "''" ? "" : seed) +
                "' is no whole number from 0 to 18446744073709551615; write it in decimal, without zeros in front\n"
                "Run with --help for more information.\n");
    }
  }

  TEST_CASE("so are other numbers: 010 is not eight") {
    CHECK(refusal_of("bench --repeats 010") ==
          "error: --repeats: '010' is no whole number from -2147483648 to 2147483647; write it in decimal, without "
          "zeros in "
          "front\nRun with --help for more information.\n");
  }

  TEST_CASE("a number that may have a fraction is finite, and decimal as well") {
    for (const std::string margin : {"nan", "inf", "1e999", "0x10", "twenty", "''", "+5"}) {
      CAPTURE(margin);
      CHECK(refusal_of("check --write no/such.yaml --margin " + margin) ==
            "error: --margin: '" + (margin == "''" ? "" : margin) +
                "' is no finite number in decimal; write it as in 20 or 0.5\nRun with --help for more information.\n");
    }
    CHECK(refusal_of("check --write no/such.yaml --margin -0.5") ==
          "error: --margin: Value -0.5 not in range 0.000000 to 10000.000000\nRun with --help for more information.\n");
    CHECK(refusal_of("check --write no/such.yaml --margin 2.5e1") ==
          "error: can't read 'no/such.yaml': No such file or directory\nno/such.yaml: 1 error\n");
  }

  TEST_CASE("an empty word is not taken for an option that is not there") {
    const std::string why =
        ": '' says nothing; leave the option out, or give it something\n"
        "Run with --help for more information.\n";
    const std::string run = "run specs/counting.yaml --for 10ms ";
    for (const std::string option : {"--trace", "--plot", "--profile", "--set", "--for", "--cpus"})
      CHECK(refusal_of((option == "--for" ? "run specs/counting.yaml " : run) + option + " ''") ==
            "error: " + option + why);
    CHECK(refusal_of("check '' specs/counting.yaml") == "error: FILE" + why);
    CHECK(refusal_of("check specs/counting.yaml --svg ''") == "error: --svg" + why);
    CHECK(refusal_of("vehicle submarine --link udp --listen ''") == "error: --listen" + why);
  }
}
