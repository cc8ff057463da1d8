// All memory of the process that is not left out, kept from being written for a while. Page protection does it, which
// holds for every thread: others that write meanwhile wait, a second at most. Each region costs a system call,
// and most are data of the system's libraries that hardly anybody writes to: those stay closed while the guard is open
// until somebody does.
#pragma once

#include <sys/types.h>

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "runtime/machine/map_line.h"

namespace jarol {

class PageGuard {
 public:
  /// There is one at a time. Made by the main thread, whose stack stays writable as those of all threads do. Throws
  /// Unfinished where there is none to be had.
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
  struct Region {
    Pages pages;
    int protection = 0;
    bool is_seldom_written = false;
    std::string name;
  };
  static constexpr std::size_t max_regions = 2048;
  // stays writable itself
  struct Flags {
    std::atomic<bool> closed{false};
    std::atomic<bool> to_open{false};  // it was closed since it was opened last, whoever has lifted it meanwhile
    std::atomic<bool> suspended{false};
    std::atomic<bool> changing{false};  // the regions
    std::atomic<bool> all_open{true};   // also those that are seldom written
    std::atomic<pid_t> thread{0};
    // of those that are seldom written: somebody has
    std::array<std::atomic<bool>, max_regions> written{};
  };

  void leave_out(const void* begin, std::size_t size);
  void leave_out_stacks();
  void read_maps();
  void look_for_changes();
  void find_regions();
  void add_region(Region region);
  void protect(const Region& region, bool writable) const;
  void open_all() const;
  const Region* find(const void* address) const;
  std::atomic<bool>& written_of(const Region& region) const;
  bool is_written(const Region& region) const;
  void open_for_good(const Region& region) const;
  void wait_for_others() const;

  int maps_ = -1;
  std::string text_, read_;      // of /proc/self/maps, as it was while the guard was open, and now
  bool is_text_due_ = false;     // the regions have just been found, with all of them open
  std::vector<Pages> mapped_;    // of any protection, as the regions were found
  std::vector<Pages> left_out_;  // always
  std::vector<Region> regions_;  // never moves
  Pages own_;
  Flags* flags_ = nullptr;
};

}  // namespace jarol
