// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Sums and peaks under one lock; reservations are few and large.
#include "engine/store/memory_budget.h"

#include <algorithm>
#include <utility>

#include "io/file/text_numbers.h"
#include "kernels/core/assert.h"
#include "kernels/core/error.h"

namespace mw::engine {
namespace {

std::size_t position(Purpose purpose) {
  return static_cast<std::size_t>(purpose);
}

}  // namespace

MemoryBudget::Reservation::Reservation(Reservation&& other) noexcept
    : budget_(std::exchange(other.budget_, nullptr)),
      purpose_(other.purpose_),
      bytes_(std::exchange(other.bytes_, 0)) {}

MemoryBudget::Reservation& MemoryBudget::Reservation::operator=(Reservation&& other) noexcept {
  Reservation taken(std::move(other));
  std::swap(budget_, taken.budget_);
  std::swap(purpose_, taken.purpose_);
  std::swap(bytes_, taken.bytes_);
  return *this;
}

MemoryBudget::Reservation::~Reservation() {
  if (budget_ != nullptr) budget_->release(purpose_, bytes_);
}

void MemoryBudget::Account::add(std::uint64_t bytes) {
  used += bytes;
  peak = std::max(peak, used);
}

std::optional<MemoryBudget::Reservation> MemoryBudget::try_reserve(Purpose purpose,
                                                                   std::uint64_t bytes) {
  const std::lock_guard lock(mutex_);
  if (bytes > limit_ - total_.used) return std::nullopt;
  total_.add(bytes);
  accounts_[position(purpose)].add(bytes);
  return Reservation(*this, purpose, bytes);
}

MemoryBudget::Reservation MemoryBudget::reserve(Purpose purpose, std::uint64_t bytes) {
  std::optional<Reservation> reserved = try_reserve(purpose, bytes);
  if (!reserved) fail(bytes);
  return std::move(*reserved);
}

MemoryBudget::Reservation MemoryBudget::carve(Reservation& from, Purpose purpose,
                                              std::uint64_t bytes) {
  MW_ASSERT(from.budget_ == this && from.bytes_ >= bytes);
  const std::lock_guard lock(mutex_);
  accounts_[position(from.purpose_)].used -= bytes;
  accounts_[position(purpose)].add(bytes);
  from.bytes_ -= bytes;
  return {*this, purpose, bytes};
}

void MemoryBudget::release(Purpose purpose, std::uint64_t bytes) {
  const std::lock_guard lock(mutex_);
  MW_ASSERT(accounts_[position(purpose)].used >= bytes);
  total_.used -= bytes;
  accounts_[position(purpose)].used -= bytes;
}

std::uint64_t MemoryBudget::min_with(std::uint64_t bytes) const {
  const std::lock_guard lock(mutex_);
  return total_.used - accounts_[position(Purpose::kBlocks)].used + bytes;
}

std::uint64_t MemoryBudget::memory_with(std::uint64_t bytes, double grows) const {
  std::uint64_t least = min_with(bytes);
  if (least > limit_) {
    least = limit_ + static_cast<std::uint64_t>(static_cast<double>(least - limit_) / (1 - grows));
  }
  return static_cast<std::uint64_t>(sharers_) * (least + beside_);
}

void MemoryBudget::fail(std::uint64_t bytes, double grows) const {
  refuse(io::min_memory(memory_with(bytes, grows)));
}

void MemoryBudget::refuse(const std::string& way_out) const {
  const std::string share =
      sharers_ > 1 ? ", one of " + std::to_string(sharers_) + " shares of --memory," : "";
  throw Error(ErrorKind::kResource, "a memory budget of " + io::size_words(limit_ + beside_) +
                                        share + " is too small; " + way_out);
}

std::uint64_t MemoryBudget::used() const {
  const std::lock_guard lock(mutex_);
  return total_.used;
}

std::uint64_t MemoryBudget::used(Purpose purpose) const {
  const std::lock_guard lock(mutex_);
  return accounts_[position(purpose)].used;
}

std::uint64_t MemoryBudget::peak() const {
  const std::lock_guard lock(mutex_);
  return total_.peak;
}

std::uint64_t MemoryBudget::peak(Purpose purpose) const {
  const std::lock_guard lock(mutex_);
  return accounts_[position(purpose)].peak;
}

}  // namespace mw::engine
