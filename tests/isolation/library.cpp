// Tasks that reach what is not theirs through the C++ library and Eigen.
#include <Eigen/Dense>
#include <algorithm>
#include <atomic>
#include <chrono>
#include <exception>
#include <fstream>
#include <functional>
#include <iostream>
#include <map>
#include <memory>
#include <memory_resource>
#include <mutex>
#include <random>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

#include "tests/isolation/task.h"

namespace {

// offends: a file or stream: std::cout: WritesStream::run
TASK(WritesStream, { std::cout << in.in; })
// offends: a file or stream: std::ios_base::ios_base: WritesFileStream::run
TASK(WritesFileStream, { std::ofstream("/dev/null") << in.in; })
// offends: the locale: std::locale::locale: FormatsStream::run
TASK(FormatsStream, {
  std::ostringstream text;
  text << in.in;
  out.out = static_cast<double>(text.str().size());
})
// offends: the global allocator: operator new: GrowsString::run
TASK(GrowsString, {
  const std::string text(static_cast<std::size_t>(tick.activation), 'x');
  out.out = static_cast<double>(text.size());
})
// offends: the global allocator: operator new: GrowsVector::run
TASK(GrowsVector, {
  std::vector<double> all(static_cast<std::size_t>(tick.activation));
  all.push_back(in.in);
  out.out = all[0];
})
// offends: the global allocator: operator new: GrowsMap::run
TASK(GrowsMap, {
  std::map<double, double> all;
  all[in.in] = 1;
  out.out = all.begin()->second;
})
// offends: the global allocator: operator new: LargeFunction::run
TASK(LargeFunction, {
  std::array<double, 20> all{in.in};
  const std::function<double()> read = [all] { return all[3]; };
  asm volatile("" : : "r"(&read) : "memory");  // clang leaves the allocation out where none sees it
  out.out = read();
})
// offends: the global allocator: operator new: SharesPointer::run
TASK(SharesPointer, {
  const auto shared = std::make_shared<double>(in.in);
  const auto other = shared;
  out.out = *other;
})
// offends: the global allocator: operator new: StableSort::run
TASK(StableSort, {
  std::array<double, 100> all{in.in, 2, 1};
  std::stable_sort(all.begin(), all.end());
  out.out = all[0];
})
// offends: the global allocator: malloc: DynamicMatrix::run > ...
TASK(DynamicMatrix, {
  Eigen::MatrixXd matrix = Eigen::MatrixXd::Constant(tick.activation, tick.activation, in.in);
  out.out = matrix.sum();
})
// offends: the global allocator: malloc: DynamicProduct::run > ...
TASK(DynamicProduct, {
  const Eigen::Matrix<double, 20, 20> matrix = Eigen::Matrix<double, 20, 20>::Constant(in.in);
  out.out = (matrix * matrix).eval()(0, 0);
})
// offends: the global allocator: std::pmr::get_default_resource: DefaultResource::run
TASK(DefaultResource, {
  std::pmr::vector<double> all;
  all.push_back(in.in);
  out.out = all[0];
})
// offends: the global allocator: std::pmr::new_delete_resource: NewDeleteResource::run
TASK(NewDeleteResource, {
  std::pmr::vector<double> all(std::pmr::new_delete_resource());
  all.push_back(in.in);
  out.out = all[0];
})
// offends: a clock: std::chrono::_V2::steady_clock::now: SteadyClock::run
TASK(SteadyClock, { out.out = static_cast<double>(std::chrono::steady_clock::now().time_since_epoch().count()); })
// offends: random numbers: std::random_device::_M_getval: RandomDevice::run
TASK(RandomDevice, {
  std::random_device random;
  out.out = random();
})
// offends: a lock: pthread_mutex_lock: LocksMutex::run > __gthread_mutex_lock
TASK(LocksMutex, {
  std::mutex mutex;
  const std::scoped_lock lock(mutex);
})
// offends: a thread: std::thread::_M_start_thread: StartsStdThread::run
TASK(StartsStdThread, { std::thread([] {}).detach(); })
// offends: the state of exceptions: std::uncaught_exceptions: CountsExceptions::run
TASK(CountsExceptions, { out.out = std::uncaught_exceptions(); })
// offends: the state of exceptions: std::current_exception: KeepsException::run
TASK(KeepsException, {
  try {
    if (in.in > 3) throw 3;
  } catch (...) { out.out = std::current_exception() != nullptr ? 1 : 0; }
})
// offends: the floating-point environment: jarol::set_floating_point_control: SetsControl::run
TASK(SetsControl, { jarol::set_floating_point_control({0x5f80, 0x33f}); })

}  // namespace

JAROL_PLUGIN(WritesStream, WritesFileStream, FormatsStream, GrowsString, GrowsVector, GrowsMap, LargeFunction,
             SharesPointer, StableSort, DynamicMatrix, DynamicProduct, DefaultResource, NewDeleteResource, SteadyClock,
             RandomDevice, LocksMutex, StartsStdThread, CountsExceptions, KeepsException, SetsControl)
