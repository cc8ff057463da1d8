#include "tasks/generic.h"

#include <algorithm>

#include "tasks/add_task.h"

namespace jarol::tasks {

void Counter::run(const Tick& tick, Out& out) { out.out = static_cast<double>(tick.activation); }

void Relay::run(const Tick&, const In& in, Out& out) { out.out = in.in; }

void Sum::run(const Tick&, const In& in, Out& out) { out.out = in.a + in.b; }

void Accumulate::run(const Tick&, const In& in, State& state, Out& out) {
  state.sum += in.in;
  out.out = state.sum;
}

void Window::run(const Param& p, const Tick&, const In& in, State& state, Out& out) {
  Sequence<double>& values = state.values;
  values.push_back(in.in);
  if (values.size() > p.length) {
    std::copy(values.end() - p.length, values.end(), values.begin());
    values.resize(p.length);
  }
  out.out = values;
}

void Mean::run(const Tick&, const In& in, Out& out) {
  double sum = 0;
  for (const double value : in.in) sum += value;
  out.out = in.in.empty() ? 0 : sum / static_cast<double>(in.in.size());
}

void Work::run(const Param& p, const Tick&, State& state) {
  // a chain that no compiler shortens: the multiplier of Knuth's linear congruential generator (MMIX)
  for (std::uint32_t i = 0; i < p.rounds; ++i)
    state.number = state.number * 6364136223846793005ULL + 1442695040888963407ULL;
}

template void add_task<Accumulate>(Registry&);
template void add_task<Counter>(Registry&);
template void add_task<Mean>(Registry&);
template void add_task<Relay>(Registry&);
template void add_task<Sum>(Registry&);
template void add_task<Window>(Registry&);
template void add_task<Work>(Registry&);

}  // namespace jarol::tasks
