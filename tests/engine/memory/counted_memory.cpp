// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// operator new on malloc, counted.
#include "tests/engine/memory/counted_memory.h"

#include <malloc.h>

#include <new>

namespace {

std::atomic<std::uint64_t> allocated = 0;
std::atomic<std::uint64_t> peak = 0;
std::atomic<std::uint64_t> calls = 0;
std::atomic<std::uint64_t> first_failure = ~std::uint64_t{0};
std::atomic<bool> all_fail_then = false;

bool fails() {
  const std::uint64_t call = ++calls, first = first_failure;
  return call == first || (call > first && all_fail_then);
}

std::uint64_t size_of(void* piece) {
  return malloc_usable_size(piece) + sizeof(std::size_t);
}

void* counted_or_null(void* piece) {
  if (piece == nullptr) return nullptr;
  const std::uint64_t now = allocated += size_of(piece);
  std::uint64_t max = peak;
  while (max < now && !peak.compare_exchange_weak(max, now)) {
  }
  return piece;
}

void* counted(void* piece) {
  if (piece == nullptr) throw std::bad_alloc();
  return counted_or_null(piece);
}

void give_back(void* piece) {
  if (piece != nullptr) allocated -= size_of(piece);
  std::free(piece);
}

}  // namespace

// The array forms end in these by default; so does the nothrow form (std::stable_sort's), but not
// under AddressSanitizer.
void* operator new(std::size_t size) {
  return counted(fails() ? nullptr : std::malloc(size));
}
void* operator new(std::size_t size, const std::nothrow_t&) noexcept {
  return counted_or_null(fails() ? nullptr : std::malloc(size));
}
void* operator new(std::size_t size, std::align_val_t alignment) {
  const auto multiple = static_cast<std::size_t>(alignment);
  if (fails()) throw std::bad_alloc();
  return counted(std::aligned_alloc(multiple, (size + multiple - 1) / multiple * multiple));
}
void operator delete(void* piece) noexcept {
  give_back(piece);
}
void operator delete(void* piece, std::size_t) noexcept {
  give_back(piece);
}
void operator delete(void* piece, std::align_val_t) noexcept {
  give_back(piece);
}
void operator delete(void* piece, std::size_t, std::align_val_t) noexcept {
  give_back(piece);
}

namespace mw::test {

std::uint64_t allocated_bytes() {
  return allocated;
}

std::uint64_t peak_allocated_bytes() {
  return peak;
}

void start_peak() {
  peak = allocated.load();
}

void fail_allocations(std::uint64_t first, bool lasting) {
  calls = 0;
  all_fail_then = lasting;
  first_failure = first;
}

std::uint64_t end_failures() {
  first_failure = ~std::uint64_t{0};
  return calls;
}

}  // namespace mw::test
