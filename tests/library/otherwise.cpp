// A program that is compiled with an option that the library was not: OPTION is what it is refused for.
#include <jarol/session.h>
#include <jarol/tools/library/built_in.h>

#include <cstdio>
#include <string>

namespace {
// Whether it is refused as it should be.
template <class Do>
bool is_refused(Do act) {
  const std::string should =
      "this program was compiled with " OPTION ", the library of Jarol otherwise; compile both with the same options";
  try {
    act();
    std::puts("error: it is not refused");
  } catch (const jarol::WrongBuild& error) {
    if (error.what() == should) return true;
    std::printf("error: it is refused by: %s\n", error.what());
  }
  return false;
}
}  // namespace

int main() {
  const std::string text = "{graph: t, tasks: {a: {type: Counter, period: 10ms, wcet: 1us}}}";
  const bool all = is_refused([] { jarol::built_in(); }) && is_refused([&] { jarol::open_text(text); }) &&
                   is_refused([] { jarol::open("t.yaml", {.set = {"timing.period=1ms"}}); });
  return all ? 0 : 1;
}
