// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// How a kernel lends out a loop: its caller may bring threads, the kernel knows none.
#pragma once

#include <cstddef>
#include <functional>

namespace mw {

/// Work on the indices of [first, last).
using RangeBody = std::function<void(std::size_t first, std::size_t last)>;

/// Calls the body for disjoint ranges that together are [0, n), in any order and possibly at the
/// same time, and returns when all are done.  Ranges are few, so a body may use scratch of size n.
using ParallelFor = std::function<void(std::size_t n, const RangeBody& body)>;

/// Calls the body once, for the whole range.
inline void serial_for(std::size_t n, const RangeBody& body) {
  if (n != 0) body(0, n);
}

}  // namespace mw
