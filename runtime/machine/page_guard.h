// All memory of the process that is not left out, kept from being written for a while. Page protection does it, which
// holds for every thread: others that write meanwhile wait, a second at most.
#pragma once

#include <sys/types.h>

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace jarol {

class PageGuard {
 public:
  /// There is one at a time. Made by the main thread, whose stack stays writable as those of all threads do. Throws
  /// std::runtime_error where there is none to be had.
  PageGuard();
  ~PageGuard();
  PageGuard(const PageGuard&) = delete;
  PageGuard& operator=(const PageGuard&) = delete;

  /// By one thread, always the same: until `open` it writes to its stack and to these whole pages, and nowhere else.
  void close(std::span<std::byte> own);
  void open();

  // of the guard that there is, if any; for the thread that runs under it

  /// Opens it until `resume`; for what the language itself does within: exceptions.
  static void suspend();
  static void resume();
  static bool is_suspended();

  // for handlers of signals

  enum class Fault {
    other,      // not for the guard
    waited,     // another thread's write: it may go on
    forbidden,  // a write that the guard is there for
  };
  /// Of SIGSEGV. Unless it waited all memory is writable again, so that the fault can be reported.
  static Fault judge(const void* address);
  /// All memory is writable again.
  static void lift();
  /// What lies there, as the system names it: "libm.so.6", "[heap]"; empty: it has no name.
  static std::string_view name_of(const void* address);

 private:
  struct Pages {
    std::uintptr_t begin = 0, end = 0;
  };
  struct Region {
    Pages pages;
    int protection = 0;
    std::string name;
  };
  // stays writable itself
  struct Flags {
    std::atomic<bool> closed{false};
    std::atomic<bool> to_open{false};  // it was closed since it was opened last, whoever has lifted it meanwhile
    std::atomic<bool> suspended{false};
    std::atomic<bool> changing{false};  // the regions
    std::atomic<pid_t> thread{0};
  };
  static constexpr std::size_t max_regions = 4096;

  void leave_out(const void* begin, std::size_t size);
  void leave_out_stacks();
  void read_maps();
  void find_regions();
  void add_region(Region region);
  void protect(bool writable) const;
  const Region* find(const void* address) const;
  void wait_for_others() const;

  int maps_ = -1;
  std::string text_, read_;      // of /proc/self/maps, as the regions were found, and now
  std::vector<Pages> left_out_;  // always
  std::vector<Region> regions_;  // never moves
  Pages own_;
  Flags* flags_ = nullptr;
};

}  // namespace jarol
