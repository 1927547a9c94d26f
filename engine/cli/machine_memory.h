// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// How much memory there is to share out.
#pragma once

#include <cstdint>

namespace mw::cli {

/// The budget when none is given: half of the machine's memory, or of the cgroup's limit if that
/// is less.
[[nodiscard]] std::uint64_t default_memory_budget();

}  // namespace mw::cli
