// A task of this program in a graph of its own.
#include <doctest/doctest.h>
#include <jarol/session.h>
#include <jarol/tools/library/built_in.h>

using namespace std::chrono_literals;
using jarol::describe, jarol::field, jarol::Tick;

namespace {
struct Double {
  static constexpr std::string_view summary = "twice its input";
  struct In {
    double in = 0;
    static constexpr auto fields() { return describe(field<&In::in>()); }
  };
  struct Out {
    double out = 0;
    static constexpr auto fields() { return describe(field<&Out::out>()); }
  };
  static void run(const Tick&, const In& in, Out& out) { out.out = 2 * in.in; }
};
}  // namespace

TEST_CASE("a graph names a task of this program") {
  jarol::distributers::Registries known = jarol::built_in();
  known.graph.add(jarol::task_class<Double>());
  const auto source = std::make_shared<const jarol::Source>(jarol::Source{"own.yaml", R"(
graph: own
timing: {period: 10ms}
tasks: {count: {type: Counter}, twice: {type: Double}}
connections: [count.out -> twice.in]
)"});
  jarol::Session session(known, source);
  session.run_until(100ms);
  CHECK(session.value<double>("twice.out") == 2 * session.value<double>("count.out"));
  CHECK(session.value<double>("twice.out") == 18);
  CHECK(session.report().activations == 20);
}
