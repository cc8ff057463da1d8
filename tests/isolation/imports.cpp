// Tasks that call what no task may: threads, clocks, files, sockets, locks and the like.
#include <arpa/inet.h>
#include <dlfcn.h>
#include <fcntl.h>
#include <malloc.h>
#include <pthread.h>
#include <sched.h>
#include <semaphore.h>
#include <setjmp.h>
#include <sys/mman.h>
#include <sys/socket.h>
#include <sys/time.h>
#include <unistd.h>

#include <cerrno>
#include <cfenv>
#include <clocale>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <ctime>

#include "tests/isolation/task.h"

namespace {

double seconds() {
  timespec now{};
  clock_gettime(CLOCK_MONOTONIC, &now);
  return static_cast<double>(now.tv_sec);
}
template <int N>
[[gnu::noinline]] double deep(double x) {
  if constexpr (N == 0)
    return x + seconds();
  else
    return deep<N - 1>(x * N) + 1;
}
void* nothing(void*) { return nullptr; }
extern "C" [[gnu::weak]] int perhaps(int);
using Clock = std::time_t (*)(std::time_t*);
std::time_t no_clock(std::time_t*) { return 0; }
constexpr Clock clocks[] = {std::time, no_clock};

// offends: a clock: clock_gettime: ReadsClock::run > seconds
TASK(ReadsClock, { out.out = seconds(); })
// offends: a clock: clock_gettime: DeepClock::run > deep<3> > deep<2> > deep<1> > deep<0> > seconds
TASK(DeepClock, { out.out = deep<3>(in.in); })
// offends: a clock: time: ReadsTime::run
TASK(ReadsTime, { out.out = static_cast<double>(std::time(nullptr)); })
// offends: a clock: time: ClockTable::run > clocks
TASK(ClockTable, { out.out = static_cast<double>(clocks[tick.activation & 1](nullptr)); })
// offends: a clock: nanosleep: Sleeps::run
TASK(Sleeps, {
  const timespec moment{0, 1000};
  nanosleep(&moment, nullptr);
})
// offends: a thread: pthread_create: StartsThread::run
TASK(StartsThread, {
  pthread_t thread;
  pthread_create(&thread, nullptr, nothing, nullptr);
})
// offends: a thread: sched_getcpu: AsksForCore::run
TASK(AsksForCore, { out.out = sched_getcpu(); })
// offends: a lock: pthread_mutex_lock: Locks::run
TASK(Locks, {
  pthread_mutex_t mutex = PTHREAD_MUTEX_INITIALIZER;
  pthread_mutex_lock(&mutex);
})
// offends: a lock: sem_wait: Waits::run
TASK(Waits, {
  sem_t semaphore;
  sem_wait(&semaphore);
})
// offends: a file or stream: printf: Prints::run
TASK(Prints, { std::printf("%f\n", in.in); })
// offends: a file or stream: open: OpensFile::run
TASK(OpensFile, { out.out = ::open("/dev/null", O_RDONLY); })
// offends: a file or stream: write: WritesFile::run
TASK(WritesFile, { out.out = static_cast<double>(::write(1, "x", 1)); })
// offends: a file or stream: mmap: MapsMemory::run
TASK(MapsMemory, { out.out = mmap(nullptr, 4096, PROT_READ, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0) == nullptr ? 1 : 0; })
// offends: a socket: socket: OpensSocket::run
TASK(OpensSocket, { out.out = ::socket(AF_INET, SOCK_DGRAM, 0); })
// offends: random numbers: rand: Random::run
TASK(Random, { out.out = std::rand(); })
// offends: the environment: getenv: ReadsEnvironment::run
TASK(ReadsEnvironment, { out.out = std::getenv("HOME") != nullptr ? 1 : 0; })
// offends: the locale: setlocale: SetsLocale::run
TASK(SetsLocale, { out.out = std::setlocale(LC_ALL, "C") != nullptr ? 1 : 0; })
// offends: the locale: snprintf: FormatsByLocale::run
TASK(FormatsByLocale, {
  char text[32];
  out.out = std::snprintf(text, sizeof text, "%f", in.in);
})
// offends: the locale: strtod: ParsesByLocale::run
TASK(ParsesByLocale, { out.out = std::strtod(in.in > 3 ? "1,5" : "2.5", nullptr); })
// offends: a signal: raise: RaisesSignal::run
TASK(RaisesSignal, { std::raise(SIGUSR1); })
// offends: the floating-point environment: fesetround: Rounds::run
TASK(Rounds, { std::fesetround(FE_UPWARD); })
// offends: the floating-point environment: fetestexcept: ReadsExceptions::run
TASK(ReadsExceptions, { out.out = std::fetestexcept(FE_INEXACT); })
// offends: the dynamic loader: dlsym: LooksUp::run
TASK(LooksUp, { out.out = reinterpret_cast<double (*)(double)>(dlsym(RTLD_DEFAULT, "sin"))(in.in); })
// offends: a jump past the end of functions: longjmp: Jumps::run
TASK(Jumps, {
  jmp_buf place;
  longjmp(place, 1);
})
// offends: the global allocator: malloc: Allocates::run
TASK(Allocates, {
  double* volatile room = static_cast<double*>(std::malloc(static_cast<std::size_t>(tick.activation)));
  out.out = *room;
})
// offends: the global allocator: operator new: News::run
TASK(News, {
  const double* volatile room = new double(in.in);
  out.out = *room;
  delete room;
})
// offends: a process or the system: fork: Forks::run
TASK(Forks, { out.out = fork(); })
// offends: a process or the system: syscall: CallsSystem::run
TASK(CallsSystem, { out.out = static_cast<double>(syscall(39)); })
// offends: a process or the system: exit: Exits::run
TASK(Exits, {
  if (in.in > 3) std::exit(1);
})
// offends: thread-local storage: __errno_location: ReadsErrno::run
TASK(ReadsErrno, {
  out.out = std::log(in.in);
  if (errno == ERANGE) out.out = 0;
})
// offends: an import that is not on the list: perhaps: WeakImport::run
TASK(WeakImport, {
  if (&perhaps != nullptr) out.out = perhaps(3);
})
// offends: a writable global of the C library: lgamma: WritesSign::run
TASK(WritesSign, { out.out = std::lgamma(in.in); })

}  // namespace

JAROL_PLUGIN(ReadsClock, DeepClock, ReadsTime, ClockTable, Sleeps, StartsThread, AsksForCore, Locks, Waits, Prints,
             OpensFile, WritesFile, MapsMemory, OpensSocket, Random, ReadsEnvironment, SetsLocale, FormatsByLocale,
             ParsesByLocale, RaisesSignal, Rounds, ReadsExceptions, LooksUp, Jumps, Allocates, News, Forks, CallsSystem,
             Exits, ReadsErrno, WeakImport, WritesSign)
