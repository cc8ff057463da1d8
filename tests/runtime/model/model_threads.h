// Stands for Memory and Futex where the real code is explored.
#pragma once

#include <cstring>

#include "tests/runtime/model/explorer.h"

namespace jarol::model {

/// `strongest` weakens every order that is stronger, to see that the orders matter.
template <std::memory_order strongest = std::memory_order_seq_cst>
struct ModelMemory {
  template <class T>
  class Atomic {
   public:
    Atomic(T value) : place_(Explorer::current().new_place(static_cast<std::uint64_t>(value))) {}  // NOLINT
    T load(std::memory_order order) const { return static_cast<T>(Explorer::current().load(place_, weak(order))); }
    void store(T value, std::memory_order order) {
      Explorer::current().store(place_, static_cast<std::uint64_t>(value), weak(order));
    }
    T fetch_or(T bits, std::memory_order order) {
      return static_cast<T>(Explorer::current().change(
          place_, [&](std::uint64_t old) { return old | bits; }, weak(order)));
    }
    T fetch_add(T more, std::memory_order order) {
      return static_cast<T>(Explorer::current().change(
          place_, [&](std::uint64_t old) { return old + more; }, weak(order)));
    }
    bool compare_exchange_strong(T& expected, T value, std::memory_order success, std::memory_order failure) {
      auto old = static_cast<std::uint64_t>(expected);
      const bool done = Explorer::current().compare_exchange(place_, old, static_cast<std::uint64_t>(value),
                                                             weak(success), weak(failure));
      expected = static_cast<T>(old);
      return done;
    }
    bool compare_exchange_weak(T& expected, T value, std::memory_order success, std::memory_order failure) {
      return compare_exchange_strong(expected, value, success, failure);
    }
    std::size_t place() const { return place_; }

   private:
    static std::memory_order weak(std::memory_order order) {
      return strongest == std::memory_order_relaxed ? std::memory_order_relaxed : order;
    }
    std::size_t place_;
  };

  static void copy_in(std::byte* to, const void* from, std::size_t bytes) {
    Explorer::current().plain(to, true);
    std::memcpy(to, from, bytes);
  }
  static void copy_out(void* to, const std::byte* from, std::size_t bytes) {
    Explorer::current().plain(from, false);
    std::memcpy(to, from, bytes);
  }
};

struct ModelFutex {
  template <class T>
  using Atomic = ModelMemory<>::Atomic<T>;
  using Time = std::int64_t;

  static Time now() { return time(); }
  static bool wait(Atomic<std::uint32_t>& word, std::uint32_t old, std::optional<Time> deadline) {
    return Explorer::current().wait(word.place(), old, deadline);
  }
  static void wake_all(Atomic<std::uint32_t>& word) { Explorer::current().wake_all(word.place()); }
};

}  // namespace jarol::model
