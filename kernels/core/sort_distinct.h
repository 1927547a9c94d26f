// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// From a list to a set.
#pragma once

#include <algorithm>
#include <vector>

namespace mw {

/// Sorts the values, and leaves each of them once.
template <typename Value>
void sort_distinct(std::vector<Value>& values) {
  std::sort(values.begin(), values.end());
  values.erase(std::unique(values.begin(), values.end()), values.end());
}

}  // namespace mw
