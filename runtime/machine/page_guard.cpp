#include "runtime/machine/page_guard.h"

#include <fcntl.h>
#include <pthread.h>
#include <signal.h>
#include <sys/mman.h>
#include <sys/syscall.h>
#include <time.h>
#include <unistd.h>

#include <algorithm>
#include <new>
#include <utility>

#include "graph/build_options.h"
#include "graph/text/errors.h"
#include "runtime/machine/map_line.h"

namespace jarol {
namespace {

constexpr std::uintptr_t page = 4096;
// glibc lays one page that can't be touched below each stack; more is what an arena has to grow into
constexpr std::uintptr_t largest_stack_guard = 64 << 10;

std::atomic<PageGuard*> page_guard{nullptr};

pid_t this_thread() { return static_cast<pid_t>(::syscall(SYS_gettid)); }

std::uintptr_t number(const void* address) { return reinterpret_cast<std::uintptr_t>(address); }

// Of threads that do not ask for another size.
std::uintptr_t find_stack_size() {
  std::size_t size = std::size_t{8} << 20;
  pthread_attr_t attributes;
  if (::pthread_getattr_default_np(&attributes) != 0) return size;
  ::pthread_attr_getstacksize(&attributes, &size);
  ::pthread_attr_destroy(&attributes);
  return size;
}

}  // namespace

PageGuard::PageGuard() {
  constexpr BuildOptions options = options_of_this_file();
  if constexpr (options.address_sanitizer != 0 || options.thread_sanitizer != 0)
    throw Unfinished("a program with sanitizers writes to memory of its own all the time");
  if (::sysconf(_SC_PAGESIZE) != static_cast<long>(page))
    throw Unfinished("this machine's pages are not of 4096 bytes");
  maps_ = ::open("/proc/self/maps", O_RDONLY | O_CLOEXEC);
  if (maps_ < 0) throw Unfinished("/proc/self/maps can't be read");
  // shared, so that no other mapping becomes one with it
  void* const flags = ::mmap(nullptr, page, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
  if (flags == MAP_FAILED) {
    ::close(maps_);
    throw Unfinished("there is no memory for it");
  }
  static_assert(sizeof(Flags) <= page);
  flags_ = new (flags) Flags;
  regions_.reserve(max_regions);
  leave_out(flags, page);
  // of the main thread: what the system writes when it stops and goes on lies beside its own data
  leave_out(reinterpret_cast<const void*>(::pthread_self()), page);
  leave_out_stacks();
  // what handlers call is bound now, as that writes
  const timespec no_time{};
  ::nanosleep(&no_time, nullptr);
  ::mprotect(flags, page, PROT_READ | PROT_WRITE);
  page_guard.store(this);
}

PageGuard::~PageGuard() {
  open();
  open_all();
  page_guard.store(nullptr);
  ::munmap(flags_, page);
  ::close(maps_);
}

void PageGuard::leave_out(const void* begin, std::size_t size) {
  left_out_.push_back({number(begin) / page * page, (number(begin) + size + page - 1) / page * page});
}

// Of the calling thread, and of its handlers.
void PageGuard::leave_out_stacks() {
  stack_t handlers{};
  if (::sigaltstack(nullptr, &handlers) == 0 && (handlers.ss_flags & SS_DISABLE) == 0)
    leave_out(handlers.ss_sp, handlers.ss_size);
  pthread_attr_t attributes;
  if (::pthread_getattr_np(::pthread_self(), &attributes) != 0) return;
  void* lowest = nullptr;
  std::size_t size = 0;
  if (::pthread_attr_getstack(&attributes, &lowest, &size) == 0) leave_out(lowest, size);
  ::pthread_attr_destroy(&attributes);
}

void PageGuard::close(std::span<std::byte> own) {
  if (flags_->thread.load() == 0) {
    leave_out_stacks();
    flags_->thread.store(this_thread());
  }
  own_ = {number(own.data()), number(own.data() + own.size())};
  look_for_changes();
  flags_->suspended.store(false);
  flags_->to_open.store(true);
  flags_->closed.store(true);
  const bool all = flags_->all_open.exchange(false);
  for (const Region& region : regions_)
    if (all || !region.is_seldom_written || is_written(region)) protect(region, false);
}

void PageGuard::open() {
  flags_->suspended.store(false);
  if (!flags_->to_open.load()) return;
  // also where another thread has lifted it: that may have been while it was being closed
  for (const Region& region : regions_)
    if (!region.is_seldom_written || is_written(region)) protect(region, true);
  flags_->closed.store(false);
  flags_->to_open.store(false);
}

// Whatever was mapped since, or is protected otherwise. The text is that of an open guard, with those closed that are
// seldom written; the first one after the regions were found differs from theirs in that alone.
void PageGuard::look_for_changes() {
  read_maps();
  if (std::exchange(is_text_due_, false) && find_mapped(read_) == mapped_) text_ = read_;
  if (read_ == text_) return;
  flags_->changing.store(true);
  open_all();
  read_maps();
  text_.swap(read_);
  mapped_ = find_mapped(text_);
  find_regions();
  is_text_due_ = true;
  flags_->changing.store(false);
}

// Reading must allocate nothing that changes what is read: the text has room from the first time on.
void PageGuard::read_maps() {
  constexpr std::size_t chunk = 16 << 10;
  std::size_t size = 0;
  for (;;) {
    if (read_.size() < size + chunk) read_.resize(2 * (size + chunk));
    const ssize_t got = ::pread(maps_, read_.data() + size, read_.size() - size, static_cast<off_t>(size));
    if (got <= 0) break;
    size += static_cast<std::size_t>(got);
  }
  std::fill(read_.begin() + static_cast<std::ptrdiff_t>(size), read_.end(), '\0');
}

// What is writable, but for what is left out and the stacks of threads.
void PageGuard::find_regions() {
  std::vector<std::uintptr_t> written;
  for (const Region& region : regions_)
    if (is_written(region)) written.push_back(region.pages.begin);
  regions_.clear();
  static const std::uintptr_t stack_size = find_stack_size() + largest_stack_guard;
  std::string_view text = text_;
  Pages closed;           // the last that were, which may be a stack's guard
  std::string_view file;  // of the line before, and where that ends
  std::uintptr_t file_end = 0;
  while (MapLine::is_left(text)) {
    MapLine line(text);
    if (line.is_closed()) closed = line.pages;
    // what begins as zeros lies behind the file's own data, without its name
    const std::string_view of_file = std::exchange(file, line.name.starts_with('/') ? line.name : std::string_view());
    const bool follows = line.pages.begin == std::exchange(file_end, line.pages.end);
    if (line.name.empty() && follows) line.name = of_file;
    if (!line.is_writable()) continue;
    const bool has_guard = line.pages.begin == closed.end && closed.end - closed.begin <= largest_stack_guard;
    if (line.name == "[stack]") continue;
    // the system may make one of a stack and what lies above it
    const std::uintptr_t begin =
        has_guard && line.name.empty() ? std::min(line.pages.begin + stack_size, line.pages.end) : line.pages.begin;
    const std::size_t slash = line.name.rfind('/');
    add_region({{begin, line.pages.end},
                line.writable_protection(),
                line.is_of_system_library(),
                std::string(slash == std::string_view::npos ? line.name : line.name.substr(slash + 1))});
  }
  for (const Region& region : regions_)
    written_of(region).store(std::find(written.begin(), written.end(), region.pages.begin) != written.end());
}

// Without what is left out. Those beyond the room that there is stay writable.
void PageGuard::add_region(Region region) {
  for (const Pages& hole : left_out_) {
    if (hole.end <= region.pages.begin || region.pages.end <= hole.begin) continue;
    Region before = region;
    before.pages.end = hole.begin;
    region.pages.begin = hole.end;
    if (before.pages.begin < before.pages.end) add_region(before);
  }
  if (region.pages.begin < region.pages.end && regions_.size() < max_regions) regions_.push_back(std::move(region));
}

// What is mapped no more is passed over.
void PageGuard::protect(const Region& region, bool writable) const {
  const int protection = writable ? region.protection : region.protection & ~PROT_WRITE;
  const auto set = [&](std::uintptr_t begin, std::uintptr_t end) {
    if (begin < end) ::mprotect(reinterpret_cast<void*>(begin), end - begin, protection);
  };
  const auto [begin, end] = region.pages;
  const std::uintptr_t first = std::clamp(own_.begin, begin, end), last = std::clamp(own_.end, begin, end);
  set(begin, first);
  set(last, end);
}

void PageGuard::open_all() const {
  for (const Region& region : regions_) protect(region, true);
  flags_->all_open.store(true);
}

std::atomic<bool>& PageGuard::written_of(const Region& region) const {
  return flags_->written[static_cast<std::size_t>(&region - regions_.data())];
}

bool PageGuard::is_written(const Region& region) const { return written_of(region).load(); }

void PageGuard::suspend() {
  PageGuard* const of = page_guard.load();
  if (of == nullptr || !of->flags_->closed.load() || of->flags_->thread.load() != this_thread()) return;
  of->open();
  of->flags_->suspended.store(true);
}

bool PageGuard::is_suspended() {
  const PageGuard* const of = page_guard.load();
  return of != nullptr && of->flags_->suspended.load() && of->flags_->thread.load() == this_thread();
}

void PageGuard::resume() {
  if (!is_suspended()) return;
  PageGuard& of = *page_guard.load();
  of.close({reinterpret_cast<std::byte*>(of.own_.begin), of.own_.end - of.own_.begin});
}

const PageGuard::Region* PageGuard::find(const void* address) const {
  const std::uintptr_t at = number(address);
  const auto found = std::find_if(regions_.begin(), regions_.end(), [&](const Region& region) {
    return region.pages.begin <= at && at < region.pages.end && !(own_.begin <= at && at < own_.end);
  });
  return found == regions_.end() ? nullptr : &*found;
}

// In a handler of a thread that is not guarded: until the guard is open, or for a second.
void PageGuard::wait_for_others() const {
  constexpr int looks = 1000;
  const timespec look{0, 1'000'000};
  for (int i = 0; i < looks; ++i) {
    if (!flags_->closed.load()) return;
    ::nanosleep(&look, nullptr);
  }
  lift();
}

PageGuard::Fault PageGuard::judge(const void* address) {
  const PageGuard* const of = page_guard.load();
  if (of == nullptr) return Fault::other;
  const bool guarded = of->flags_->thread.load() == this_thread();
  const bool closed = of->flags_->closed.load();
  while (!guarded && of->flags_->changing.load()) {
    const timespec look{0, 100'000};
    ::nanosleep(&look, nullptr);
  }
  const Region* const region = of->find(address);
  if (region != nullptr && !(guarded && closed)) {
    // it was writable, and is as soon as the guard is open
    of->wait_for_others();
    if (region->is_seldom_written) of->open_for_good(*region);
    return Fault::waited;
  }
  lift();
  return region != nullptr ? Fault::forbidden : Fault::other;
}

// In a handler: from now on this region is opened with the others. Where a task has begun meanwhile it stays closed:
// the next write has the next fault.
void PageGuard::open_for_good(const Region& region) const {
  written_of(region).store(true);
  protect(region, true);
  if (flags_->closed.load()) protect(region, false);
}

void PageGuard::lift() {
  const PageGuard* const of = page_guard.load();
  if (of == nullptr || (!of->flags_->closed.load() && of->flags_->all_open.load())) return;
  of->open_all();
  of->flags_->closed.store(false);
}

std::string_view PageGuard::name_of(const void* address) {
  const PageGuard* const of = page_guard.load();
  const Region* const found = of == nullptr ? nullptr : of->find(address);
  return found == nullptr ? std::string_view() : std::string_view(found->name);
}

}  // namespace jarol
