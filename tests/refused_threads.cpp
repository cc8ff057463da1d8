#include "tests/refused_threads.h"

#include <dlfcn.h>
#include <pthread.h>

#include <cerrno>

namespace {
constexpr int any_number = -1;
thread_local int left = any_number;
}  // namespace

namespace jarol::tests {

RefusedThreads::RefusedThreads(int granted) { left = granted; }
RefusedThreads::~RefusedThreads() { left = any_number; }

}  // namespace jarol::tests

#ifndef JAROL_SANITIZED
// In place of that of the library, by which all threads are made.
extern "C" int pthread_create(pthread_t* thread, const pthread_attr_t* attributes, void* (*start)(void*),
                              void* context) {
  using Create = int (*)(pthread_t*, const pthread_attr_t*, void* (*)(void*), void*);
  static const auto create = reinterpret_cast<Create>(dlsym(RTLD_NEXT, "pthread_create"));
  if (left == 0) return EAGAIN;
  if (left > 0) --left;
  return create(thread, attributes, start, context);
}
#endif
