#include "tasks/generic.h"

#include <doctest/doctest.h>

TEST_SUITE("tasks/generic") {
  using namespace jarol;
  using namespace jarol::tasks;

  TEST_CASE("a counter gives the index of its activation") {
    Counter::Out out;
    Counter::run(Tick{Duration(70), 7, Duration(10)}, out);
    CHECK(out.out == 7);
  }

  TEST_CASE("a sum adds, a relay passes on") {
    Sum::Out sum;
    Sum::run(Tick{}, {2, 3}, sum);
    CHECK(sum.out == 5);
    Relay::Out relay;
    Relay::run(Tick{}, {2.5}, relay);
    CHECK(relay.out == 2.5);
  }

  TEST_CASE("a window gives the newest inputs, a mean their mean") {
    Window::State state;
    Window::Out out;
    for (const double x : {1.0, 2.0, 3.0}) Window::run({.length = 2}, Tick{}, {x}, state, out);
    CHECK(out.out == Sequence<double>{2, 3});
    Window::run({.length = 3}, Tick{}, {4}, state, out);
    CHECK(out.out == Sequence<double>{2, 3, 4});
    Window::run({.length = 1}, Tick{}, {5}, state, out);  // made shorter
    CHECK(out.out == Sequence<double>{5});
    Window::run({.length = 0}, Tick{}, {6}, state, out);
    CHECK(out.out.empty());
    Mean::Out mean;
    Mean::run(Tick{}, {{2, 3}}, mean);
    CHECK(mean.out == 2.5);
    Mean::run(Tick{}, {}, mean);
    CHECK(mean.out == 0);
  }

  TEST_CASE("an accumulator keeps the running sum in its state") {
    Accumulate::State state;
    Accumulate::Out out;
    Accumulate::run(Tick{}, {2}, state, out);
    Accumulate::run(Tick{}, {3}, state, out);
    CHECK(out.out == 5);
    CHECK(state.sum == 5);
  }

  TEST_CASE("work depends on the rounds asked for and on nothing else") {
    Work::State one, two;
    Work::run({3}, Tick{}, one);
    Work::run({1}, Tick{}, two);
    Work::run({2}, Tick{}, two);
    CHECK(one.number == two.number);
    CHECK(one.number != Work::State{}.number);
  }
}
