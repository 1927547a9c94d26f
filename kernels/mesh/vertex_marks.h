// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// A set of local vertices that is emptied in constant time: scratch for walks over stars.
#pragma once

#include <cstdint>
#include <vector>

namespace mw {

class VertexMarks {
 public:
  explicit VertexMarks(std::size_t vertices) : marks_(vertices, 0) {}

  void clear() { ++epoch_; }
  /// True when v was not yet in the set.
  bool insert(std::uint32_t v) {
    const bool is_new = marks_[v] != epoch_;
    marks_[v] = epoch_;
    return is_new;
  }
  [[nodiscard]] bool contains(std::uint32_t v) const { return marks_[v] == epoch_; }

 private:
  std::vector<std::uint32_t> marks_;
  std::uint32_t epoch_ = 1;
};

}  // namespace mw
