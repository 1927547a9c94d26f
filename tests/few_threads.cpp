// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// To be preloaded: a system that gives as many threads as ALLOWED_THREADS says, then no more.
#include <dlfcn.h>
#include <pthread.h>

#include <atomic>
#include <cerrno>
#include <cstdlib>
#include <new>

namespace {

using CreateThread = int (*)(pthread_t*, const pthread_attr_t*, void* (*)(void*), void*);

int allowed_threads() {
  const char* const text = std::getenv("ALLOWED_THREADS");
  return text == nullptr ? 0 : std::atoi(text);
}

/// Threads that are alive; those that end make room for others.
std::atomic<int> alive = 0;

struct Start {
  void* (*work)(void*);
  void* argument;
};

void* run_and_count(void* argument) {
  const Start start = *static_cast<Start*>(argument);
  delete static_cast<Start*>(argument);
  void* const out = start.work(start.argument);
  --alive;
  return out;
}

}  // namespace

extern "C" int pthread_create(pthread_t* thread, const pthread_attr_t* attributes,
                              void* (*work)(void*), void* argument) {
  static const auto real = reinterpret_cast<CreateThread>(dlsym(RTLD_NEXT, "pthread_create"));
  static const int allowed = allowed_threads();
  if (alive.fetch_add(1) >= allowed) {
    --alive;
    return EAGAIN;
  }
  auto* const start = new (std::nothrow) Start{work, argument};
  if (start != nullptr) return real(thread, attributes, &run_and_count, start);
  --alive;
  return EAGAIN;
}
