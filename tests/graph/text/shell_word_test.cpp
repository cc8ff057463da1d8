#include "graph/text/shell_word.h"

#include <doctest/doctest.h>

TEST_SUITE("graph/text/shell_word") {
  TEST_CASE("what a shell would take apart or replace stands in quotes") {
    CHECK(jarol::shell_word("tasks.a.kp=-0.3e-05") == "tasks.a.kp=-0.3e-05");
    CHECK(jarol::shell_word("a b") == "'a b'");
    CHECK(jarol::shell_word("it's $HOME") == "'it'\\''s $HOME'");
    CHECK(jarol::shell_word("") == "''");
  }
}
