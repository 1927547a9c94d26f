// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// What the process really holds, as the kernel counts it.
#pragma once

#include <cstdint>

namespace mw::engine {

/// Pages of the process in memory now; 0 where the kernel does not tell.
[[nodiscard]] std::uint64_t resident_bytes();

/// The allocator keeps what is given back to it, for each thread apart; a budget that counts what
/// is in use can therefore be exceeded.  This returns such memory to the kernel when the process
/// holds more than `most`.  No result depends on it.
/// Cost: 10 us; milliseconds when there is much to return.  Thread safety: yes.
void return_free_memory_above(std::uint64_t most);

}  // namespace mw::engine
