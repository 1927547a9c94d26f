// SPDX-FileCopyrightText: The mwmesh authors
// SPDX-License-Identifier: Apache-2.0
// How much memory there is to share out.
#pragma once

#include <cstdint>
#include <filesystem>
#include <istream>

namespace mw::engine {

/// The budget when none is given: half of the memory that is available, or of the control group's
/// limit if that is less.  It may differ from run to run; no result depends on it.
[[nodiscard]] std::uint64_t default_memory_budget();

/// The least limit of the control groups that a process is in, version 2 or 1; none is a number too
/// large.  `own_groups` as /proc/self/cgroup, `root` as /sys/fs/cgroup.
[[nodiscard]] std::uint64_t cgroup_limit(const std::filesystem::path& root,
                                         std::istream& own_groups);

}  // namespace mw::engine
