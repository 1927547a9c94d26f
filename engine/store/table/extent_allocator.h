// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Which bytes of a file are free.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <set>

namespace mw::engine {

/// A run of bytes in a file, or none where the size is 0.
struct Extent {
  std::uint64_t offset = 0;
  std::uint64_t size = 0;

  friend bool operator==(const Extent&, const Extent&) = default;
};

/// Deals out a file's bytes in multiples of a sector, so that no write touches the sector of
/// another extent.  It takes the best fit, at the lowest offset, and joins free neighbours.
/// Thread safety: none.  Cost of each member: logarithmic in the number of free runs.
class ExtentAllocator {
 public:
  static constexpr std::uint64_t kSectorBytes = 512;

  /// Adds [end(), end) to what can be dealt out.  REQUIRES: whole sectors, end >= end().
  void grow(std::uint64_t end);
  /// Gives up what is free at the end; end() is then that of the last extent.
  void trim();
  [[nodiscard]] std::uint64_t end() const { return end_; }

  /// Returns nothing when no free run is long enough.  REQUIRES: size > 0.
  [[nodiscard]] std::optional<Extent> allocate(std::uint64_t size);
  /// Takes the lowest place that lies before `end` as a whole.  Cost: linear in the number
  /// of free runs.
  [[nodiscard]] std::optional<Extent> allocate_before(std::uint64_t end, std::uint64_t size);
  /// Takes a given extent, for an index that is read back.
  /// ENSURES: false, and nothing taken, when part of it is not free.
  [[nodiscard]] bool take(const Extent& extent);
  /// REQUIRES: allocated or taken, with the same size.
  void release(const Extent& extent);

  [[nodiscard]] std::uint64_t free_bytes() const;

 private:
  using Runs = std::map<std::uint64_t, std::uint64_t>;  ///< offset -> size

  void add(std::uint64_t offset, std::uint64_t size);
  void remove(Runs::iterator run);

  Runs free_;
  std::set<std::pair<std::uint64_t, std::uint64_t>> by_size_;  ///< (size, offset) of free_
  std::uint64_t end_ = 0;
};

}  // namespace mw::engine
