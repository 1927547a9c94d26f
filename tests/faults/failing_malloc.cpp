// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Preloaded into a program (LD_PRELOAD): one of its allocations fails, as when memory is out.
#include <atomic>
#include <cerrno>
#include <cstddef>
#include <cstdlib>
#include <fstream>

// FAILING_MALLOC_AT=N: the N-th of all calls of malloc, calloc, realloc and the aligned forms, over
// all threads, from 1 on, returns nothing; those behind it work again. FAILING_MALLOC_COUNT=FILE:
// how many there were is written there at the end.

extern "C" {
// The allocator itself, by the names that the C library keeps for this.
void* __libc_malloc(std::size_t size);                           // NOLINT
void* __libc_calloc(std::size_t count, std::size_t size);        // NOLINT
void* __libc_realloc(void* piece, std::size_t size);             // NOLINT
void* __libc_memalign(std::size_t alignment, std::size_t size);  // NOLINT
}

namespace {

std::atomic<unsigned long> calls{0};
/// Set before main(); what the loader allocates before that never fails.
unsigned long fail_at = 0;

bool fails() {
  if (++calls != fail_at) return false;
  errno = ENOMEM;
  return true;
}

__attribute__((constructor)) void begin() {
  const char* number = std::getenv("FAILING_MALLOC_AT");
  calls = 0;
  if (number != nullptr) fail_at = std::strtoul(number, nullptr, 10);
}

__attribute__((destructor)) void end() {
  const char* file = std::getenv("FAILING_MALLOC_COUNT");
  const unsigned long counted = calls;
  if (file != nullptr) std::ofstream(file) << counted << "\n";
}

}  // namespace

extern "C" {

void* malloc(std::size_t size) {
  return fails() ? nullptr : __libc_malloc(size);
}

void* calloc(std::size_t count, std::size_t size) {
  return fails() ? nullptr : __libc_calloc(count, size);
}

void* realloc(void* piece, std::size_t size) {
  return fails() ? nullptr : __libc_realloc(piece, size);
}

void* memalign(std::size_t alignment, std::size_t size) {
  return fails() ? nullptr : __libc_memalign(alignment, size);
}

void* aligned_alloc(std::size_t alignment, std::size_t size) {
  return memalign(alignment, size);
}

int posix_memalign(void** out, std::size_t alignment, std::size_t size) {
  void* const piece = memalign(alignment, size);
  if (piece == nullptr) return ENOMEM;
  *out = piece;
  return 0;
}

}  // extern "C"
