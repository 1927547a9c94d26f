// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// What this program has allocated, and at most so far; and allocations that fail.
#pragma once

#include "tests/testing.h"

namespace mw::test {

/// Bytes that operator new has given to all threads and not got back, the allocator's rounding
/// and head of each piece among them.  Linking this file in replaces operator new.
[[nodiscard]] std::uint64_t allocated_bytes();

/// The most of allocated_bytes() since the last start_peak().
[[nodiscard]] std::uint64_t peak_allocated_bytes();
void start_peak();

/// Lets operator new fail at its call `first`, from 1 on, of all threads, and at all calls after
/// that if `lasting` is true.
void fail_allocations(std::uint64_t first, bool lasting);
/// Ends that.  Returns how many calls there were.
std::uint64_t end_failures();

}  // namespace mw::test
