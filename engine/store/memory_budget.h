// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// One budget in bytes for everything the process holds, accounted by purpose.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <mutex>
#include <optional>
#include <string>

namespace mw::engine {

enum class Purpose {
  kProgram,  ///< code, stacks, the allocator's slack, the label table
  kLabels,   ///< prepared labels, and their making
  kIndex,    ///< where blocks are, which windows are done
  kBlocks,   ///< encoded blocks in memory; they can be spilled to make room
  kWindows,  ///< windows in flight, pages that they map to read their blocks among them
  kOutput,   ///< what the writing of the mesh needs
};
inline constexpr std::size_t kPurposes = 6;
/// The names of the purposes in reports, in the order of Purpose.
inline constexpr std::array<const char*, kPurposes> kPurposeNames{"program", "labels",  "index",
                                                                  "blocks",  "windows", "output"};

/// Thread safety: all members, and reservations of one budget, may be used from many threads.
class MemoryBudget {
 public:
  static constexpr std::uint64_t kUnlimited = std::numeric_limits<std::uint64_t>::max();

  /// A part of the budget, given back by the destructor.  The budget outlives it.
  class Reservation {
   public:
    Reservation() = default;
    Reservation(Reservation&& other) noexcept;
    Reservation& operator=(Reservation&& other) noexcept;
    ~Reservation();

    [[nodiscard]] std::uint64_t bytes() const { return bytes_; }

   private:
    friend class MemoryBudget;
    Reservation(MemoryBudget& budget, Purpose purpose, std::uint64_t bytes)
        : budget_(&budget), purpose_(purpose), bytes_(bytes) {}

    MemoryBudget* budget_ = nullptr;
    Purpose purpose_ = Purpose::kProgram;
    std::uint64_t bytes_ = 0;
  };

  /// sharers is the number of processes that --memory was divided by; beside are the bytes of the
  /// share of one of them that were taken off before it became the limit.
  explicit MemoryBudget(std::uint64_t limit = kUnlimited, int sharers = 1, std::uint64_t beside = 0)
      : limit_(limit), sharers_(sharers), beside_(beside) {}
  MemoryBudget(const MemoryBudget&) = delete;
  MemoryBudget& operator=(const MemoryBudget&) = delete;

  /// Reserves bytes; returns nothing when they would exceed the limit.
  [[nodiscard]] std::optional<Reservation> try_reserve(Purpose purpose, std::uint64_t bytes);
  /// Reserves bytes.  ERRORS: those of fail() when they would exceed the limit.
  [[nodiscard]] Reservation reserve(Purpose purpose, std::uint64_t bytes);

  /// Moves bytes from one reservation to a new one, for another purpose; the sum stays.
  /// REQUIRES: from is of this budget and holds at least `bytes`.
  [[nodiscard]] Reservation carve(Reservation& from, Purpose purpose, std::uint64_t bytes);

  /// Returns the least limit under which `bytes` could be reserved now, with all blocks spilled.
  [[nodiscard]] std::uint64_t min_with(std::uint64_t bytes) const;
  /// Returns the --memory that gives each process min_with(bytes), when buffers among these bytes
  /// take the part `grows` of whatever is added to the limit.  REQUIRES: 0 <= grows < 1.
  [[nodiscard]] std::uint64_t memory_with(std::uint64_t bytes, double grows = 0) const;
  /// ERRORS: mw::Error(kResource) with the limit, and memory_with().
  [[noreturn]] void fail(std::uint64_t bytes, double grows = 0) const;
  /// ERRORS: mw::Error(kResource) with the limit and this way out.
  [[noreturn]] void refuse(const std::string& way_out) const;

  [[nodiscard]] std::uint64_t limit() const { return limit_; }
  [[nodiscard]] std::uint64_t used() const;
  [[nodiscard]] std::uint64_t used(Purpose purpose) const;
  [[nodiscard]] std::uint64_t peak() const;
  [[nodiscard]] std::uint64_t peak(Purpose purpose) const;

 private:
  struct Account {
    std::uint64_t used = 0;
    std::uint64_t peak = 0;

    void add(std::uint64_t bytes);
  };

  void release(Purpose purpose, std::uint64_t bytes);

  const std::uint64_t limit_;
  const int sharers_;
  const std::uint64_t beside_;
  mutable std::mutex mutex_;
  Account total_;
  std::array<Account, kPurposes> accounts_;
};

}  // namespace mw::engine
