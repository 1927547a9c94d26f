// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Distinct values of a long row of repeated ones.
#pragma once

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

#include "kernels/core/sort_distinct.h"

namespace mw::audit {

/// A list that is given the same values again and again.  Memory: at most twice the distinct ones,
/// or `first_limit` if that is more.
template <class T>
class DistinctList {
 public:
  explicit DistinctList(std::size_t first_limit) : first_limit_(first_limit) {}

  void add(const T& value) {
    if (values_.size() == limit_) compact();
    values_.push_back(value);
  }
  /// Returns the distinct values, ascending; the list is empty afterwards.
  [[nodiscard]] std::vector<T> take() {
    compact();
    return std::exchange(values_, {});
  }

 private:
  void compact() {
    sort_distinct(values_);
    limit_ = std::max(first_limit_, 2 * values_.size());
  }

  std::vector<T> values_;
  std::size_t first_limit_;
  std::size_t limit_ = first_limit_;
};

}  // namespace mw::audit
