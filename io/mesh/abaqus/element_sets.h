// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Which set each tet of an Abaqus input file is in.
#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "kernels/core/label.h"

namespace mw::io {

/// Elements first, first + step, .. up to last.
struct ElementRange {
  std::uint64_t first = 0;
  std::uint64_t last = 0;
  std::uint64_t step = 1;
};

/// Tets come with their set, or are looked for in lists of elements at the end.
class ElementSets {
 public:
  /// The number of the set of that name, in any case; "" is that of tets in no set.
  [[nodiscard]] std::uint64_t number_of(const std::string& name);
  /// A tet that came without set: its number in the file, its place among all tets.
  void add_open(std::uint64_t element, std::uint64_t tet) { open_.push_back({element, tet}); }
  /// REQUIRES: range.step > 0.
  void add_range(std::uint64_t set, const ElementRange& range) { ranges_.push_back({set, range}); }

  /// Gives open tets the number of the first set that has them.
  void close(std::span<RawLabel> marks);
  /// The sets that tets are in, in the order of their numbers, as those came; marks become places
  /// in the list.
  [[nodiscard]] std::vector<std::string> keep_used(std::span<RawLabel> marks) const;

 private:
  struct Open {
    std::uint64_t element = 0;
    std::uint64_t tet = 0;
    bool operator<(const Open& other) const { return element < other.element; }
  };
  struct Members {
    std::uint64_t set = 0;
    ElementRange range;
  };

  void mark_range(const Members& members, std::uint64_t none, std::span<RawLabel> marks) const;

  std::map<std::string, std::uint64_t> numbers_;  ///< by name in capitals
  std::vector<std::string> names_;
  std::vector<Open> open_;
  std::vector<Members> ranges_;
};

}  // namespace mw::io
