// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// Memory of the machine and of this process, as the kernel counts it.
#pragma once

#include <cstdint>
#include <istream>
#include <optional>
#include <string_view>

namespace mw::engine {

/// Returns the bytes in the line "NAME: N kB" of a file like /proc/meminfo or /proc/self/status;
/// empty when there is no such line.
[[nodiscard]] std::optional<std::uint64_t> proc_bytes(std::istream& file, std::string_view name);

/// Returns the budget when none is given: half of the memory that is available, or of the control
/// group's limit if that is less.  It may differ from run to run; no result depends on it.
[[nodiscard]] std::uint64_t default_memory_budget();

/// Returns the bytes of the process that are in memory; 0 where the kernel does not tell.
[[nodiscard]] std::uint64_t resident_bytes();

/// Returns freed memory to the kernel when the process holds more than `max`.  The allocator keeps
/// what is given back to it, for each thread apart, so without this the process could exceed a
/// budget that counts what is in use.  No result depends on it.
/// Cost: 10 us; milliseconds when there is much to return.  Thread-safe.
void return_free_memory_above(std::uint64_t max);

/// Makes large pieces of memory go back to the kernel when they are freed, so that they never count
/// twice against a budget.  (glibc would keep larger and larger pieces as they come and go, which
/// saves the time of getting them anew.)
void return_large_pieces_at_once();

/// Where address space is limited (`ulimit -v`), lets threads share the pools of the allocator, of
/// which each would take 64 MiB of it.  REQUIRES: called before there are other threads.
void save_address_space();

}  // namespace mw::engine
