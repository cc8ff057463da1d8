// In one file: one search, whose steps share the state.
#include "tests/runtime/model/explorer.h"

#include <stdexcept>

namespace jarol::model {
namespace {

constexpr std::uint64_t max_steps = 2000;
constexpr std::size_t stack_size = 64 * 1024;

Explorer* explorer = nullptr;

bool acquires(std::memory_order order) {
  return order != std::memory_order_relaxed && order != std::memory_order_release;
}
bool releases(std::memory_order order) {
  return order != std::memory_order_relaxed && order != std::memory_order_acquire;
}

}  // namespace

Explorer& Explorer::current() { return *explorer; }

Result explore(const std::function<Program()>& make) {
  Explorer made;
  explorer = &made;
  Result result;
  do {
    ++result.executions;
    if (!made.run(make)) break;
  } while (made.next_path());
  result.states = made.states_.size();
  result.failure = made.failure_;
  made.program_ = {};
  explorer = nullptr;
  return result;
}

void check(bool holds, const std::string& text) {
  if (!holds) explorer->fail(text);
}

Event event() { return {explorer->running_, explorer->self().now.events[explorer->running_]}; }
bool happened(const Event& event) { return explorer->self().now.events[event.thread] >= event.number; }

void set_time(std::int64_t time) {
  explorer->step();
  explorer->note("sets the time to", 0, static_cast<std::uint64_t>(time));
  explorer->time_ = time;
}

std::int64_t time() {
  explorer->step();
  explorer->self().history = mix(explorer->self().history, static_cast<std::uint64_t>(explorer->time_));
  return explorer->time_;
}

// One execution along the path chosen so far; false: it failed.
bool Explorer::run(const std::function<Program()>& make) {
  depth_ = 0;
  known_ = false;
  running_ = 0;
  count_ = 0;
  time_ = 0;
  program_ = {};
  places_.clear();
  plains_.clear();
  steps_.clear();
  threads_.resize(1);
  threads_[0].now = {};
  program_ = make();
  if (program_.threads.size() + 1 > max_threads) throw std::length_error("too many threads for the model");
  threads_.resize(program_.threads.size() + 1);
  for (std::size_t i = 1; i < threads_.size(); ++i) {
    Thread& thread = threads_[i];
    thread.now = threads_[0].now;
    stacks_[i].resize(stack_size);
    getcontext(&thread.context);
    thread.context.uc_stack.ss_sp = stacks_[i].data();
    thread.context.uc_stack.ss_size = stacks_[i].size();
    thread.context.uc_link = nullptr;
    makecontext(&thread.context, &Explorer::enter, 0);
  }
  // each up to its first step
  starting_ = true;
  for (std::size_t i = 1; i < threads_.size() && failure_.empty(); ++i) switch_to(i);
  starting_ = false;
  switch_to(pick());
  if (failure_.empty()) {
    for (const Thread& thread : threads_) threads_[0].now.join(thread.now);
    if (program_.at_end) program_.at_end();
  }
  return failure_.empty();
}

bool Explorer::next_path() {
  while (!path_.empty() && path_.back().chosen + 1 == path_.back().count) path_.pop_back();
  if (path_.empty()) return false;
  ++path_.back().chosen;
  return true;
}

void Explorer::enter() {
  Explorer& e = *explorer;
  e.program_.threads[e.running_ - 1]();
  e.self().status = Status::done;
  e.switch_to(e.starting_ ? 0 : e.pick());
}

// Before each operation on shared memory: who goes on?
void Explorer::step() {
  if (running_ == 0) return;
  if (++count_ > max_steps) fail("it does not end");
  switch_to(starting_ ? 0 : pick());
  ++self().now.events[running_];
}

void Explorer::switch_to(std::size_t thread) {
  if (thread == running_) return;
  Thread& from = self();
  running_ = thread;
  Thread& to = self();
  if (to.status == Status::waits) {
    to.in_time = false;
    to.status = Status::runs;
  }
  swapcontext(&from.context, &to.context);
}

std::size_t Explorer::pick() {
  if (!failure_.empty()) return 0;
  if (depth_ == path_.size() && !known_ && !states_.insert(state()).second) known_ = true;
  std::array<std::size_t, max_threads> ready{};
  std::size_t count = 0;
  bool all_done = true;
  for (std::size_t i = 1; i < threads_.size(); ++i) {
    const Thread& t = threads_[i];
    all_done = all_done && t.status == Status::done;
    if (t.status == Status::runs || (t.status == Status::waits && t.deadline && *t.deadline <= time_))
      ready[count++] = i;
  }
  if (all_done) return 0;
  if (count == 0) {
    fail("nobody can go on");
    return 0;
  }
  return ready[choose(count)];
}

std::size_t Explorer::choose(std::size_t count) {
  if (count == 1) return 0;
  if (depth_ < path_.size()) return path_[depth_++].chosen;
  if (known_) return 0;
  path_.push_back({0, count});
  return path_[depth_++].chosen;
}

std::uint64_t Explorer::state() const {
  std::uint64_t h = mix(1, static_cast<std::uint64_t>(time_));
  for (const Thread& t : threads_) {
    h = mix(h, t.history);
    h = mix(h, static_cast<std::uint64_t>(t.status) * 2 + (t.in_time ? 1 : 0));
    h = t.now.hash(h);
  }
  for (const auto& place : places_)
    for (const Message& message : place) h = mix(h, message.hash);
  for (const Plain& plain : plains_) {
    h = mix(h, plain.writer.thread * 65536 + plain.writer.number);
    for (const std::uint16_t reader : plain.readers) h = mix(h, reader);
  }
  return h;
}

void Explorer::fail(const std::string& text) {
  if (!failure_.empty()) return;
  failure_ = text;
  for (const Step& s : steps_)
    failure_ += "\n  thread " + std::to_string(s.thread) + " " + s.what + " " + std::to_string(s.place) + ": " +
                std::to_string(s.value);
  // the other fibres stay where they are: they own nothing
  if (running_ != 0) switch_to(0);
}

void Explorer::note(const char* what, std::size_t place, std::uint64_t value) {
  if (running_ == 0) return;
  self().history = mix(self().history, value);
  steps_.push_back({running_, what, place, value});
}

std::size_t Explorer::new_place(std::uint64_t value) {
  if (places_.size() == max_places) throw std::length_error("too many places for the model");
  places_.push_back({{value, {}, value}});
  return places_.size() - 1;
}

// The thread reads that store of the place.
void Explorer::see(std::size_t place, std::size_t message, std::memory_order order) {
  Thread& t = self();
  const Message& m = places_[place][message];
  t.now.seen[place] = static_cast<std::uint16_t>(message);
  if (acquires(order)) t.now.join(m.view);
}

// The thread stores into the place; an exchange carries on what the store before it released.
void Explorer::add(std::size_t place, std::uint64_t value, std::memory_order order, const View* before) {
  Thread& t = self();
  t.now.seen[place] = static_cast<std::uint16_t>(places_[place].size());
  Message made{value, {}, 0};
  if (releases(order)) made.view = t.now;
  if (before != nullptr) made.view.join(*before);
  made.hash = made.view.hash(value);
  places_[place].push_back(made);
}

std::uint64_t Explorer::load(std::size_t place, std::memory_order order) {
  step();
  const std::size_t newest = places_[place].size() - 1;
  const std::size_t message = newest - choose(newest - self().now.seen[place] + 1);
  see(place, message, order);
  const std::uint64_t value = places_[place][message].value;
  note("loads", place, value);
  return value;
}

void Explorer::store(std::size_t place, std::uint64_t value, std::memory_order order) {
  step();
  note("stores to", place, value);
  add(place, value, order, nullptr);
}

std::uint64_t Explorer::change(std::size_t place, const std::function<std::uint64_t(std::uint64_t)>& f,
                               std::memory_order order) {
  step();
  see(place, places_[place].size() - 1, order);
  const Message before = places_[place].back();
  note("changes", place, before.value);
  add(place, f(before.value), order, &before.view);
  return before.value;
}

// Looks at the newest value even if it fails, as processors do; C++ would let it fail with an older one.
bool Explorer::compare_exchange(std::size_t place, std::uint64_t& expected, std::uint64_t value,
                                std::memory_order success, std::memory_order failure) {
  step();
  const Message before = places_[place].back();
  const bool succeeds = before.value == expected;
  see(place, places_[place].size() - 1, succeeds ? success : failure);
  note(succeeds ? "exchanges" : "fails to exchange", place, before.value);
  if (succeeds) add(place, value, success, &before.view);
  expected = before.value;
  return succeeds;
}

// Two accesses of which one writes, and neither happens before the other, are a data race. No step of their own: where
// there is no race, their order does not matter.
void Explorer::plain(const void* at, bool writes) {
  std::size_t i = 0;
  while (i < plains_.size() && plains_[i].at != at) ++i;
  if (i == plains_.size()) plains_.push_back({at, {}, {}});
  Plain& p = plains_[i];
  const auto ordered = [&](std::size_t thread, std::uint16_t number) {
    return running_ == 0 || thread == running_ || self().now.events[thread] >= number;
  };
  bool raced = !ordered(p.writer.thread, p.writer.number);
  for (std::size_t t = 0; writes && t < p.readers.size(); ++t) raced = raced || !ordered(t, p.readers[t]);
  if (raced) fail("data race");
  // it has happened for whoever sees the event that comes next
  const auto number = static_cast<std::uint16_t>(running_ == 0 ? 0 : self().now.events[running_] + 1);
  if (writes)
    p = {at, {running_, number}, {}};
  else
    p.readers[running_] = number;
}

bool Explorer::wait(std::size_t place, std::uint64_t old, std::optional<std::int64_t> deadline) {
  step();
  // the kernel looks at the newest value
  see(place, places_[place].size() - 1, std::memory_order_seq_cst);
  const std::uint64_t value = places_[place].back().value;
  note("waits on", place, value);
  if (value != old) return true;
  Thread& t = self();
  t.place = place;
  t.deadline = deadline;
  t.in_time = true;
  t.status = Status::waits;
  const std::size_t me = running_;
  const std::size_t next = pick();
  if (next == me) {
    t.in_time = false;
    t.status = Status::runs;
  }
  switch_to(next);
  note(t.in_time ? "is woken on" : "times out on", place, t.in_time ? 1 : 0);
  return t.in_time;
}

void Explorer::wake_all(std::size_t place) {
  step();
  note("wakes all on", place, 0);
  for (Thread& t : threads_)
    if (t.status == Status::waits && t.place == place) t.status = Status::runs;
}

}  // namespace jarol::model
